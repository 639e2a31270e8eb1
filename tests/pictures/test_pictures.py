"""Pictures are compared with those kept next to the tests, as text; changed ones are written to build/pictures."""

import re
from pathlib import Path

import numpy as np
import pytest

from .pictures import kept_file, pictures

CHANGED = Path(__file__).parents[2] / "build" / "pictures"
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
STROKE = re.compile(r'(?<=<path d=")([^"]*)(?="[^>]*stroke=)')
#: How far two strokes may be apart: corners are rounded to pixels, and those within half a pixel left out.
PIXELS = 1.5


def same(one: str, other: str) -> bool:
    """Say whether two texts differ by no more than a step in the last digits of numbers, as between machines.

    A stroke is a curve: which of its corners are written depends on those digits, where it runs does not.
    """
    if NUMBER.sub("#", STROKE.sub("", one)) != NUMBER.sub("#", STROKE.sub("", other)):
        return False
    numbers = (NUMBER.findall(STROKE.sub("", text)) for text in (one, other))
    if not all(a == b or _near(a, b) for a, b in zip(*numbers, strict=True)):
        return False
    return all(a == b or _along(a, b) for a, b in zip(STROKE.findall(one), STROKE.findall(other), strict=True))


def _near(one: str, other: str) -> bool:
    """Say whether two numbers differ by a step; but 0 and 1 may be no and yes, -1 and 1 a sense."""
    if "." in one + other:
        return abs(float(one) - float(other)) <= 0.0021
    return abs(int(one) - int(other)) <= 1 and min(abs(int(one)), abs(int(other))) > 1


def _along(one: str, other: str) -> bool:
    """Say whether each corner of a stroke's curves is on the other's, which begin there too; a turn's end is on it."""
    pieces, others = (
        [np.array(NUMBER.findall(piece), float).reshape(-1, 2) for piece in text.split("M")[1:]]
        for text in (one, other)
    )
    return len(pieces) == len(others) and all(
        max(_off(a, b), _off(b, a), np.linalg.norm(a[0] - b[0])) <= PIXELS for a, b in zip(pieces, others, strict=True)
    )


def _off(corners: np.ndarray, curve: np.ndarray) -> float:
    start, side = curve, np.diff(curve, axis=0, append=curve[-1:])
    way = ((corners[:, None] - start) * side).sum(2) / np.maximum((side**2).sum(1), 1e-12)
    return np.linalg.norm(corners[:, None] - (start + np.clip(way, 0, 1)[..., None] * side), axis=2).min(1).max()


@pytest.mark.parametrize("name", pictures())
def test_a_picture_is_the_one_that_is_kept(name):
    made = pictures()[name]()
    kept = kept_file(name)
    if not kept.is_file() or not same(made, kept.read_text()):
        CHANGED.mkdir(parents=True, exist_ok=True)
        (CHANGED / name).write_text(made)
        pytest.fail(f"{name} has changed: see it with `python -m tests.pictures`, keep it with `--accept`.")
