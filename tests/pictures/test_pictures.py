"""Pictures are compared with those kept beside the tests, as text; changed ones are written to build/pictures."""

import re
from pathlib import Path

import pytest

from .panels import DRAWN
from .pictures import pictures

KEPT = Path(__file__).parent / "kept"
CHANGED = Path(__file__).parents[2] / "build" / "pictures"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def same(one: str, other: str) -> bool:
    """Say whether two texts differ by no more than a step in the last digits of numbers, as between machines."""
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return False
    return all(a == b or _near(a, b) for a, b in zip(NUMBER.findall(one), NUMBER.findall(other), strict=True))


def _near(one: str, other: str) -> bool:
    """Say whether two numbers differ by a step; but 0 and 1 may be no and yes, -1 and 1 a sense."""
    if "." in one + other:
        return abs(float(one) - float(other)) <= 0.0021
    return abs(int(one) - int(other)) <= 1 and min(abs(int(one)), abs(int(other))) > 1


@pytest.mark.parametrize("name", pictures())
@pytest.mark.usefixtures("in_python")
def test_a_picture_is_the_one_that_is_kept(name):
    made = pictures()[name]()
    kept = KEPT / name
    if not kept.is_file() or not same(made, kept.read_text()):
        CHANGED.mkdir(parents=True, exist_ok=True)
        (CHANGED / name).write_text(made)
        pytest.fail(f"{name} has changed: see it with `python -m tests.pictures`, keep it with `--accept`.")


def test_nothing_is_kept_that_is_not_made():
    drawn = {"explorer.txt", *(f"panel-{name}.txt" for name in DRAWN)}  # by Node: tests/app/static/played/drawing.js
    assert {path.name for path in KEPT.iterdir()} == pictures().keys() | drawn


def test_a_flip_is_no_rounding():
    assert same("M1 2L3 -4", "M1 2L3 -5")
    assert not same("M1 2L3 -4", "M1 2L3 4")
    assert not same('"filled":[1,0]', '"filled":[0,0]')
    assert not same('"shown":[0.5,-1.0]', '"shown":[0.5,1.0]')
    assert not same('stroke="var(--attr)" 1', 'stroke="var(--rep)" 1')
    assert not same("M1 2L3 4", "M1 2")
