"""Mutants that are known to change nothing that anybody can see, each with the reason.

They stand in ``allowed.tsv``, a line each with tabs between: the module, words, the reason. Mutants of the lines that
hold the words are not tried.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple


class Explained(NamedTuple):
    """Lines of a module that hold these words, and why their mutants live."""

    module: str
    words: str
    why: str


_TABLE = Path(__file__).with_name("allowed.tsv").read_text(encoding="utf-8")
ALLOWED = tuple(Explained(*line.split("\t")) for line in _TABLE.splitlines())


def explained(module: str, line: str) -> bool:
    """Whether it is known why mutants of this line may live."""
    return any(one.module == module and one.words in line for one in ALLOWED)
