"""Mutants that are known to change nothing that anybody can see, each with the reason.

They stand in two tables, a line each with tabs between: the module, words, the reason. Of ``allowed.tsv`` mutants of
the lines that hold the words are not tried; of ``lives.tsv`` they were tried, and the words are part of their text.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple


class Explained(NamedTuple):
    """Mutants of a module that these words tell, and why they live."""

    module: str
    words: str
    why: str


def _read(name: str) -> tuple[Explained, ...]:
    text = (Path(__file__).parent / name).read_text(encoding="utf-8")
    return tuple(Explained(*line.split("\t")) for line in text.splitlines())


ALLOWED, LIVES = _read("allowed.tsv"), _read("lives.tsv")


def explained(module: str, line: str) -> bool:
    """Whether it is known why mutants of this line may live."""
    return any(one.module == module and one.words in line for one in ALLOWED)


def reason(module: str, change: str) -> str:
    """Return why a mutant lives, as far as it is known, to be written after it."""
    return next((f": {one.why}" for one in LIVES if one.module == module and one.words in change), "")
