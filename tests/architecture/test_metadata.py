"""What the metadata says is so: dependencies, version, types, linters."""

import ast
import re
import subprocess
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

import pytest
import yaml

import codim2_core

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
OWN = {"codim2_core", "codim2_app", "tests"}
# Run as programs, needed by a library that is imported, or asked for by pytest.importorskip.
COMMANDS = {
    "mujoco", "pyright", "pytest-xdist", "ruff", "pre-commit", "import-linter", "ipywidgets", "sympy",
    "jupyter-bokeh",
}  # fmt: skip
# Left out of the extras: the notebook tests are skipped where JupyterLab, which brings them, is missing; CI has it.
OPTIONAL = {"jupyterlab", "jupyter-bokeh", "nbclient", "nbconvert", "nbformat"}


def statements(block):
    """All statements of a module, at any depth."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        inner = getattr(block, part, None)
        for node in inner if isinstance(inner, list) else ():  # the body of a lambda is no list
            yield node
            yield from statements(node)


def imported(folder):
    """Distributions that a folder imports anywhere, also on first use."""
    found = set()
    for path in (ROOT / folder).rglob("*.py"):
        if "node_modules" in path.parts:
            continue
        for node in statements(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom) and not node.level:
                names = [node.module]
            else:
                continue
            found |= {name.split(".")[0] for name in names}
    given = packages_distributions()  # what is not installed bears the name of its module
    return {normal(given.get(name, [name])[0]) for name in found - OWN - set(sys.stdlib_module_names)}


def normal(name):
    return name.lower().replace("_", "-")


def declared(*extras):
    """Names of the dependencies, or of those of some extras."""
    project = PROJECT["project"]
    given = [one for extra in extras for one in project["optional-dependencies"][extra]]
    return {normal(re.match(r"[\w-]+", one)[0]) for one in given or project["dependencies"]}


def test_dependencies_are_those_imported():
    used = imported("app") | imported("codim2_core")
    optional = set(PROJECT["project"]["optional-dependencies"]) - {"test", "bench"}
    assert declared() <= used
    assert used <= declared() | declared(*optional)


def test_extras_hold_what_the_tests_and_benchmarks_import():
    used = imported("tests")
    assert used <= declared() | declared("test", "bench") | OPTIONAL
    assert declared("test", "bench", "notebook") - COMMANDS <= used


def test_the_core_alone_asks_for_what_it_imports_and_else_is_the_same_project():
    core = tomllib.loads((ROOT / "codim2_core" / "pyproject.toml").read_text("utf-8"))
    project, whole = core["project"], PROJECT["project"]
    extras = project["optional-dependencies"]
    asked = [*project["dependencies"], *extras["frames"]]
    assert set(asked) <= set(whole["dependencies"])
    assert extras["symbolic"] == whole["optional-dependencies"]["symbolic"]
    assert {one.split(">=")[0] for one in asked} == imported("codim2_core")
    for name in ("dynamic", "requires-python", "license", "authors"):
        assert project[name] == whole[name]
    build, data = core["tool"]["hatch"]["build"], PROJECT["tool"]["setuptools"]["package-data"]["codim2_core"]
    assert {*build["include"], *build["artifacts"]} == {"*.py", *data}
    assert (ROOT / "codim2_core" / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()


def test_what_is_cited_is_this_program():
    cited = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
    page = (ROOT / "app" / "codim2_app" / "site" / "docs" / "text" / "citing.md").read_text("utf-8")
    assert (cited["cff-version"], cited["type"]) == ("1.2.0", "software")
    assert cited["version"] == codim2_core.__version__
    assert cited["license"] == PROJECT["project"]["license"]
    (paper,) = cited["references"]
    for title in (cited["title"], paper["title"]):
        assert f"{{{title}}}" in page
    assert [one["family-names"] for one in paper["authors"]] == re.findall(r"(\w+), \w\.", page)


def test_the_version_stands_in_one_place():
    assert PROJECT["project"]["dynamic"] == ["version"]
    assert PROJECT["tool"]["setuptools"]["dynamic"]["version"] == {"attr": "codim2_core.__version__"}
    assert re.fullmatch(r"\d+\.\d+\.\d+", codim2_core.__version__)
    import codim2_app

    assert codim2_app.__version__ == codim2_core.__version__
    log = (ROOT / "app" / "codim2_app" / "site" / "docs" / "text" / "changelog.md").read_text("utf-8")
    assert f"\n## {codim2_core.__version__}" in log


@pytest.mark.parametrize(("package", "folder"), [("codim2_core", "codim2_core"), ("codim2_app", "app/codim2_app")])
def test_the_packages_say_that_they_are_typed(package, folder):
    assert (ROOT / folder / "py.typed").is_file()
    assert "py.typed" in PROJECT["tool"]["setuptools"]["package-data"][package]
    tracked = subprocess.run(["git", "ls-files", folder], capture_output=True, text=True, check=True, cwd=ROOT).stdout
    data = PROJECT["tool"]["setuptools"]["package-data"][package]
    for line in tracked.splitlines():
        name = Path(line).relative_to(folder)
        if line in ("codim2_core/LICENSE", "codim2_core/README.md", "codim2_core/pyproject.toml"):
            continue  # of the core alone
        assert name.suffix == ".py" or any(name.match(one) and len(name.parts) == one.count("/") + 1 for one in data), (
            f"{line} is tracked, but not in the wheel"
        )
