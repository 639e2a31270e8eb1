"""What may import what, what importing costs, and what the wheel installs."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import codim2_core

ROOT = Path(__file__).parents[2]


def imported_by(module):
    code = f"import sys, {module}; print(' '.join(sorted(sys.modules)))"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT.parent)
    return set(out.stdout.split())


def test_the_core_draws_nothing_and_serves_nothing():
    loaded = {name.split(".")[0] for name in imported_by("codim2_core")}
    assert not loaded & {"bokeh", "panel", "holoviews", "param", "tornado", "matplotlib", "pandas", "sympy"}


def test_a_name_of_the_core_is_imported_when_it_is_asked_for():
    """The package alone loads nothing, and what a first picture needs loads no SciPy and compiles nothing."""
    assert not {name.split(".")[0] for name in imported_by("codim2_core")} & {"numpy", "scipy", "numba"}
    scene = {name.split(".")[0] for name in imported_by("codim2_core; from codim2_core import Scene, ELinear, psi")}
    assert "numpy" in scene
    assert not scene & {"scipy", "numba"}


def test_type_checkers_find_every_name_where_python_does():
    tree = ast.parse((ROOT / "codim2_core" / "__init__.py").read_text())
    (typed,) = [one.body for one in tree.body if isinstance(one, ast.If) and isinstance(one.test, ast.Name)]
    told = [f"{one.module or ''}.{alias.name}".strip(".") for one in typed for alias in one.names]
    found = [*codim2_core._MODULES.values(), *(f"{home}.{name}" for name, home in codim2_core._HOME.items())]
    assert sorted(told) == sorted(found)
    assert sorted({*codim2_core._MODULES, *codim2_core._HOME}) == sorted(codim2_core.__all__)
    assert all(getattr(codim2_core, name) is not None for name in codim2_core.__all__)
    with pytest.raises(AttributeError, match="no attribute 'scene_table'"):
        _ = codim2_core.scene_table


SYSTEMS = {"AnySystem", "Coefficients", "ELinear", "Formulas", "Frozen", "FrozenSystem", "System"}


def questions_of_kind(source):
    """Lines that read `typed` of anything but the record of a Psi, or check for a class of systems."""
    found = []
    if ".typed" not in source and not any(name in source for name in SYSTEMS):
        return found
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute) and node.attr == "typed" and ast.unparse(node.value)[-6:] != "record":
            found.append(node.lineno)
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "isinstance":
            named = {getattr(one, "id", getattr(one, "attr", "")) for one in ast.walk(node.args[1])}
            found += [node.lineno] if named & SYSTEMS else []
    return found


def test_no_module_outside_systems_asks_for_the_kind_of_a_system():
    core = ROOT / "codim2_core"
    files = [path for path in core.rglob("*.py") if path.relative_to(core).parts[0] != "systems"]
    found = {str(path.relative_to(core)): questions_of_kind(path.read_text()) for path in files}
    asking = {name: lines for name, lines in found.items() if lines}
    assert asking == {}
