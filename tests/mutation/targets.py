"""Which tests guard which module."""

from __future__ import annotations

from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = {"core": "codim2_core", "app": "app"}
EVERYWHERE = {"core": ("core/test_read_only.py", "core/test_tables.py")}
# Beside the tests in the room itself.
ELSEWHERE: dict[str, tuple[str, ...]] = {
    "app.__main__": ("app/server/test_commands.py",),
    "core.bifurcations": ("precision/test_bifurcations.py",),
    "core.cycles": ("core/layer_problem/test_given_matrix.py", "precision/test_cycles.py"),
    "core.expressions": ("core/systems",),
    "core.layer_problem": (
        "core/portrait/test_classify.py",
        "core/portrait/test_portrait_words.py",
        "precision/test_bifurcations.py",
        "precision/test_critical.py",
        "precision/test_equator.py",
        "stress/test_rounding.py",
    ),
    "core.motion": ("core/initial_value",),
    "core.numerics": ("core/layer_problem", "precision/test_equator.py"),
    "core.psi": ("precision/test_steepness.py",),
    "core.portrait": ("precision/test_separatrices.py",),
    "core.sliding": ("core/layer_problem/test_critical.py",),
    "core.stepping": ("core/orbits",),
    "core.systems": ("core/layer_problem/test_critical.py",),
    "core.figures": ("presets",),
    "app.draw": ("app/view/test_view.py",),
    "app.frame": ("app/panels", "app/view/test_refresh.py", "app/view/test_refused.py"),
    "app.phrases": ("words/test_app_words.py",),
    "app.slow_layers": ("app/panels",),
    "app.state": ("app/view/test_refresh.py", "app/view/test_refused.py"),
    "app.view": ("app/state",),
}


# Of kernels, which are run as Python: tests that are quick all the same.
KERNELS = {
    "core.cycles": tuple(f"core/cycles/test_{name}.py" for name in ("return_map_steps", "ray_section_kernel")),
    "core.initial_value": ("core/initial_value/kernels", "core/initial_value/test_short_motions.py"),
}


def modules() -> dict[str, Path]:
    """All modules that are more than a list of names, as ``core.ROOM.NAME`` and ``app.ROOM.NAME``."""
    found = {}
    for short, folder in FOLDERS.items():
        for path in sorted((ROOT / folder).rglob("*.py")):
            parts = path.relative_to(ROOT / folder).with_suffix("").parts
            if parts[-1] == "__init__" and "def " not in path.read_text():
                continue
            if len(parts) > 1 or parts[0] != "__init__":
                found[".".join((short, *parts))] = path
    return found


def front_end() -> dict[str, Path]:
    """All modules of the browser's half, as ``static/NAME.js``."""
    app = ROOT / "app"
    return {path.relative_to(app).as_posix(): path for path in sorted((app / "static").rglob("*.js"))}


def room(module: str) -> str:
    """``core.ROOM`` of ``core.ROOM.NAME``."""
    return ".".join(module.split(".")[:2])


def is_kernel(module: str) -> bool:
    """Whether Numba compiles what a module defines: its mutants are tried as Python."""
    return room(module) == "core.stepping" or "jit import" in modules()[module].read_text()


def guards(name: str, kernels: bool = False) -> tuple[str, ...]:
    """Files and folders of the tests that guard a room, or its kernels."""
    if kernels and name in KERNELS:
        return KERNELS[name]
    own = name.replace(".", "/")
    folder = ROOT / "tests" / own
    # a module beside the rooms has files of tests beside their folders
    beside = (path.relative_to(ROOT / "tests").as_posix() for path in folder.parent.glob(f"test_{folder.name}*.py"))
    there = [own] if folder.is_dir() else sorted(beside)
    return (*there, *ELSEWHERE.get(name, ()), *EVERYWHERE.get(name.split(".")[0], ()))
