"""The import contracts refuse what they should: upward imports planted in a copy, in every room and in every form."""

import re
import shutil
import subprocess
import sys
import tomllib
from itertools import pairwise
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CONTRACTS = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]["contracts"]
LAYERS = [one for one in CONTRACTS if one["type"] == "layers"]
FLOORS = {one["containers"][0]: [floor.split(" | ") for floor in one["layers"]] for one in LAYERS}  # from the top
MOST_MODULES = 14  # of a package
FORMS = (
    "import {name}\n", "from {package} import {room}\n", "def late():\n    import {name}\n",
    "from typing import TYPE_CHECKING\n\nif TYPE_CHECKING:\n    import {name}\n",
    "try:\n    import {name}\nexcept ImportError:\n    pass\n", "from {dots}{room} import anything\n",
    "class Local:\n    from {package} import {room}\n",
)  # fmt: skip


@pytest.fixture
def copy(tmp_path):
    """Both packages and their contracts in a folder of their own."""
    skipped = shutil.ignore_patterns("__pycache__", "static")
    shutil.copytree(ROOT / "codim2_core", tmp_path / "codim2_core", ignore=skipped)
    shutil.copytree(ROOT / "app", tmp_path / "codim2_app", ignore=skipped)
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def refused(folder):
    """What lint-imports prints in that folder, or None if all contracts are kept."""
    code = "from importlinter.cli import lint_imports; raise SystemExit(lint_imports(no_cache=True))"
    run = [sys.executable, "-c", code]
    done = subprocess.run(run, cwd=folder, capture_output=True, text=True, check=False, env={"COLUMNS": "400"})
    assert not done.stderr, done.stderr
    return None if done.returncode == 0 else done.stdout


def modules(folder, room):
    path = folder / room
    return [path.with_suffix(".py")] if path.with_suffix(".py").is_file() else sorted(path.rglob("*.py"))


def test_every_module_stands_on_a_floor():
    for package, folder in (("codim2_core", "codim2_core"), ("codim2_app", "app")):
        rooms = {room for floor in FLOORS[package] for room in floor}
        found = {p.name for p in (ROOT / folder).iterdir() if (p / "__init__.py").is_file()}
        found |= {p.stem for p in (ROOT / folder).glob("*.py") if p.name != "__init__.py"}
        assert found == rooms
    assert all(one["exhaustive"] for one in LAYERS)
    assert not any("ignore_imports" in one or "exhaustive_ignores" in one for one in CONTRACTS)


def test_an_upward_import_is_refused_in_every_room(copy):
    """One in each room below the top, in its last module, of the room above it; seven forms of an import."""
    planted = []
    for package, floors in FLOORS.items():
        for upper, lower in pairwise(floors):
            for room in lower:
                path = modules(copy / package, room)[-1]
                target = upper[len(planted) % len(upper)]
                dots = "." * len(path.relative_to(copy / package).parts)
                names = {"name": f"{package}.{target}", "package": package, "room": target, "dots": dots}
                form = FORMS[len(planted) % len(FORMS)].format(**names)
                source = path.read_text()
                path.write_text(f"{source}\n\n{form}")
                line = source.count("\n") + 2 + 1 + next(i for i, t in enumerate(form.split("\n")) if target in t)
                importer = ".".join(path.relative_to(copy).with_suffix("").parts).removesuffix(".__init__")
                planted.append((importer, f"{package}.{target}", line))
    assert len(planted) >= 7
    said = refused(copy)
    for importer, target, line in planted:
        assert re.search(rf"{re.escape(importer)} -> {re.escape(target)}\S* \(.*l\.{line}\b", said), (importer, target)


def test_a_room_on_no_floor_and_a_circle_in_a_room_are_refused(copy):
    (copy / "codim2_core" / "attic").mkdir()
    (copy / "codim2_core" / "attic" / "__init__.py").write_text('"""No floor."""\n')
    low = copy / "codim2_core" / "numerics"
    for one, other in (("circle_a", "circle_b"), ("circle_b", "circle_a")):
        (low / f"{one}.py").write_text(f"from . import {other}\n")
    said = refused(copy)
    assert "attic" in said
    assert "circle_a" in said


def test_rooms_on_one_floor_do_not_know_each_other_nor_the_core_the_app_or_what_draws(copy):
    core = copy / "codim2_core"
    one, other, *_ = next(floor for floor in FLOORS["codim2_core"] if len(floor) > 1)
    planted = {core / "scene/scene.py": "codim2_app", core / "psi/function.py": "panel"}
    planted[modules(core, one)[-1]] = f"codim2_core.{other}"
    for path, name in planted.items():
        path.write_text(f"{path.read_text()}\nimport {name}\n")
    said = refused(copy)
    for importer, name in (("codim2_core", "codim2_app"), ("codim2_core", "panel"), (one, f"codim2_core.{other}")):
        assert f"{importer} is not allowed to import {name}" in said


def test_no_package_is_large():
    for folder in ("codim2_core", "app"):
        for face in (ROOT / folder).rglob("__init__.py"):
            count = len([path for path in face.parent.glob("*.py") if path != face])
            assert count <= MOST_MODULES, f"{face.parent.relative_to(ROOT)} has {count} modules"
