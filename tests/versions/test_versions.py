"""The least versions that pyproject.toml declares, and the newest ones, each in an environment of its own."""

import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
RUNNING = ("hypothesis", "mpmath", "pytest", "pytest-xdist")


def least(dependency):
    """``name==version`` of ``name>=version``."""
    name, version = re.match(r"([\w-]+)>=([\d.]+)", dependency).groups()
    return f"{name}=={version}"


def tracked(*folders):
    """Return the files that git knows."""
    command = ["git", "ls-files", *folders]
    return subprocess.run(command, capture_output=True, text=True, check=True, cwd=ROOT).stdout.split()


def source(folder):
    """Copy what is tracked: what a build leaves behind here would get into the next wheel."""
    for name in tracked("app", "codim2_core", "pyproject.toml", "README.md", "LICENSE"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, folder / name)
    return folder


def pip(folder, *arguments):
    """Run pip of the environment in a folder, which is made if it is not there; return its Python."""
    python = folder / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(folder)], check=True)
    subprocess.run([str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", *arguments], check=True)
    return python


@pytest.mark.parametrize("which", ["least", "newest"])
def test_the_inner_loop_passes_with(which, tmp_path):
    dependencies = PROJECT["dependencies"] + PROJECT["optional-dependencies"]["figures"]
    wanted = map(least, dependencies) if which == "least" else dependencies
    pip(tmp_path / "env", "install", *wanted, *RUNNING)
    python = pip(tmp_path / "env", "install", "--no-deps", str(source(tmp_path / "source")))
    done = subprocess.run(
        [str(python), "-m", "pytest", "-q", "-p", "no:cacheprovider", str(ROOT / "tests" / "core")],
        cwd=tmp_path, capture_output=True, text=True, check=False,
        env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "numba")},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-2000:]


def test_the_wheel_holds_what_is_tracked(tmp_path):
    pip(tmp_path / "env", "wheel", "--no-deps", "--wheel-dir", str(tmp_path), str(source(tmp_path / "source")))
    (wheel,) = tmp_path.glob("codim2-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    held = {name for name in names if ".dist-info/" not in name}
    assert held == {name.removeprefix("app/") for name in tracked("app/codim2_app", "codim2_core")} - ALONE_ONLY
    (shown,) = (name for name in names if name.endswith(".dist-info/METADATA"))
    links = re.findall(r"\]\((?!https?:)[^)]*", zipfile.ZipFile(wheel).read(shown).decode())
    assert not links, "an index does not have the files of the repository"


#: What makes a distribution of the core alone.
ALONE_ONLY = {"codim2_core/LICENSE", "codim2_core/README.md", "codim2_core/pyproject.toml"}
#: Classifies, follows, draws and simulates, and says which distributions there are.
ALONE = """
import importlib, pkgutil, sys
from importlib.metadata import distributions
import codim2_core as c2
for module in pkgutil.walk_packages(c2.__path__, "codim2_core."):
    importlib.import_module(module.name)
preset = c2.presets["case1-cm4"]
assert c2.classify(preset.system, preset.psi).name == "CM4"
assert len(c2.trajectories(preset.system, preset.psi, [(0.3, 0.2), (1.4, 0.3)])) == 2
assert c2.Scene(preset.system, preset.psi, preset.z)["name"].name == "CM4"
assert c2.simulate(preset.system, preset.psi, (0.3, 0.2), (0, 0.5), eps=0.01).states.size
print(*sorted(one.name for one in distributions()))
"""


def test_the_core_is_installed_alone(tmp_path):
    folder = source(tmp_path / "source")
    python = pip(tmp_path / "env", "install", str(folder / "codim2_core"))
    done = subprocess.run(
        [str(python), "-P", "-c", ALONE], cwd=tmp_path, capture_output=True, text=True, check=True,
        env={**os.environ, "PYTHONPATH": "", "NUMBA_CACHE_DIR": str(tmp_path)},
    )  # fmt: skip
    assert set(done.stdout.split()) - {"pip", "setuptools"} == {"codim2-core", "llvmlite", "numba", "numpy", "scipy"}
