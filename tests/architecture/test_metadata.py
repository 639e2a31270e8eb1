"""What the metadata says is so: dependencies, version, types, linters."""

import re
import subprocess
import sys
import tomllib
from importlib.metadata import packages_distributions
from pathlib import Path

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
#: Lines that import, at any depth, with the package of what they import.
IMPORT = re.compile(r"^ *(?:from (\w+)[\w.]* import\b|import (\w+)[\w.]*(?: as \w+)?$)", re.MULTILINE)


def imported(folder):
    """Distributions that a folder imports anywhere, also on first use."""
    found = set()
    for path in (ROOT / folder).rglob("*.py"):
        if "node_modules" in path.parts:
            continue
        found |= {first or second for first, second in IMPORT.findall(path.read_text("utf-8"))}
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
    for name in ("requires-python", "license", "authors"):
        assert project[name] == whole[name]
    build, wheel = core["tool"]["hatch"]["build"], PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]
    assert [f"codim2_core/{one}" for one in build["artifacts"]] == wheel["artifacts"]
    alone = {one.removeprefix("codim2_core/") for one in wheel["exclude"]}
    tracked = subprocess.run(
        ["git", "ls-files", "."], capture_output=True, text=True, check=True, cwd=ROOT / "codim2_core"
    )
    assert {
        one for one in tracked.stdout.split() if not any(Path(one).match(form) for form in build["include"])
    } == alone
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
    assert "version" in PROJECT["project"]["dynamic"]
    assert PROJECT["tool"]["hatch"]["version"] == {"path": "codim2_core/__init__.py"}
    assert re.fullmatch(r"\d+\.\d+\.\d+", codim2_core.__version__)
    import codim2_app

    assert codim2_app.__version__ == codim2_core.__version__
    log = (ROOT / "app" / "codim2_app" / "site" / "docs" / "text" / "changelog.md").read_text("utf-8")
    assert log == (ROOT / "CHANGELOG.md").read_text("utf-8")  # the documentation in a wheel has its own
    assert f"\n## {codim2_core.__version__}" in log


def test_dir_shows_the_public_names_and_nothing_else():
    assert sorted(dir(codim2_core)) == sorted(["__version__", *codim2_core.__all__])


def test_the_packages_say_that_they_are_typed():
    assert all(
        (ROOT / folder / "py.typed").is_file()
        for folder in PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    )
