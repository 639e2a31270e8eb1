"""What the container installs: pinned with hashes, and fit for pyproject.toml. `.ci/lock` writes it."""

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
LOCKED = ROOT / "app" / "locked"
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
LOCKS = {
    "requirements.txt": PYPROJECT["project"]["dependencies"],
    "build.txt": PYPROJECT["build-system"]["requires"],
}


def pinned(text):
    """Versions by name; a name has several where they differ by Python's version."""
    found = {}
    for name, version in re.findall(r"^([\w.-]+)==([\w.]+)", text, re.MULTILINE):
        found.setdefault(name.lower().replace("_", "-"), []).append(numbers(version))
    return found


def numbers(version):
    return tuple(map(int, re.findall(r"\d+", version)))


def fits(version, requirement):
    bounds = re.findall(r"(>=|<)([\d.]+)", requirement)
    assert bounds, requirement
    return all(version >= numbers(bound) if sign == ">=" else version < numbers(bound) for sign, bound in bounds)


@pytest.mark.parametrize("name", LOCKS)
def test_what_is_required_is_pinned_within_its_bounds(name):
    found = pinned((LOCKED / name).read_text())
    for requirement in LOCKS[name]:
        package = re.match(r"[\w-]+", requirement)[0].lower().replace("_", "-")
        assert package in found, f"{requirement}: run .ci/lock"
        assert all(fits(version, requirement) for version in found[package]), f"{requirement}: run .ci/lock"


@pytest.mark.parametrize("name", LOCKS)
def test_every_pin_has_hashes(name):
    for entry in re.split(r"\n(?=[\w])", (LOCKED / name).read_text()):
        if "==" in entry.splitlines()[0]:
            assert "--hash=sha256:" in entry, entry


def test_the_image_installs_nothing_else():
    installs = re.findall(r"pip (?:install|wheel)[^&\n]*", (ROOT / "Dockerfile").read_text())
    assert len(installs) == 4
    for install in installs:
        assert "--require-hashes -r" in install or "--no-deps" in install, install
    assert sum("--no-build-isolation" in install for install in installs) == 1  # or pip would fetch what it likes
