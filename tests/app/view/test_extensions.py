"""An installed package adds to the explorer: the one of the how-to, as it is printed."""

import re
import subprocess
import sys
from pathlib import Path

import codim2_app
import pytest

HOWTO = (Path(codim2_app.__file__).parent / "site" / "docs" / "text" / "howto-extend.md").read_text(encoding="utf-8")
ASK = """
import sys
sys.path.insert(0, {folder!r})
from codim2_app.view import extensions
print(extensions.register_all())
from codim2_core import classify, psi
from codim2_app.picture.state.chosen_system import titles
print("curling_stone" in titles(), classify("curling_stone", "ice").name, psi.from_text("ice").family)
"""


@pytest.fixture
def package(tmp_path):
    """The how-to's package as pip leaves it: its module, and what it is called by."""
    toml, python = (re.search(rf"```{kind}\n(.*?)```", HOWTO, re.DOTALL)[1] for kind in ("toml", "py"))
    (tmp_path / "pyproject.toml").write_text(toml, encoding="utf-8")
    (tmp_path / "codim2_ice.py").write_text(python, encoding="utf-8")
    named = re.search(r"\[project\.entry-points\.codim2\]\n(.*)\n", toml)[1].replace('"', "")
    info = tmp_path / "codim2_ice-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: codim2-ice\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[codim2]\n{named}\n")
    return tmp_path


def asked(folder):
    done = subprocess.run([sys.executable, "-c", ASK.format(folder=str(folder))], capture_output=True, text=True)
    return done.stdout.splitlines(), done.stderr


def test_its_example_and_psi_are_there(package):
    (failed, there), said = asked(package)
    assert failed == "()", said
    assert there.startswith("True ")
    assert re.search(r"C?M\d", there)


def test_one_that_fails_is_left_out_with_a_sentence(package):
    (package / "codim2_ice.py").write_text("def register():\n    raise RuntimeError('no ice')\n", encoding="utf-8")
    lines, said = asked(package)
    assert "left out: RuntimeError: no ice" in lines[0]
    assert "curling_stone" in said


@pytest.mark.slow
def test_it_is_installed_by_pip(package, tmp_path_factory):
    target = tmp_path_factory.mktemp("installed")
    command = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--target", str(target), str(package)]
    subprocess.run(command, check=True)
    (failed, there), said = asked(target)
    assert (failed, there[:5]) == ("()", "True "), said
