"""The numbers of every preset are those of `numbers.txt`: figures of the paper that change are read next to it first.

A line a preset: its name, a, b, d, f1, f2, B, g, the example, z, the family of Psi and its parameter, what shows it.
"""

from __future__ import annotations

from pathlib import Path

import codim2_core as c2

KEPT = Path(__file__).with_name("numbers.txt")


def _line(name: str) -> str:
    one = c2.presets[name]
    numbers = (one.a, one.b, one.d, one.f1, one.f2)
    told = (one.B, one.g, one.example or "-", one.z, one.family, one.parameter, one.view or "-")
    return "  ".join([name, *(f"{value:g}" for value in numbers), *map(str, told)])


def test_the_numbers_of_presets_are_kept():
    assert "\n".join(map(_line, c2.presets)) + "\n" == KEPT.read_text(encoding="utf-8")
