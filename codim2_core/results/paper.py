"""Printed names of the paper's labels.

Docstrings name sections, theorems and equations as the paper prints them: (2.7) is an equation. The attribute `label`
of results gives labels of the paper's source. `tests/paper` numbers these by the rules of the paper's class.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from .special_kinds import SPECIAL_KINDS

_TABLES = tomllib.loads(Path(__file__).with_name("paper.toml").read_text("utf-8"))
PRINTED: dict[str, tuple[str, str]] = {label: tuple(one) for label, one in _TABLES["printed"].items()}
CHANGES: dict[str, str] = _TABLES["changes"]


def label_of(kind: str) -> str:
    """Return where the paper has a kind of change."""
    return next((row.label for row in SPECIAL_KINDS if row.kind == kind), None) or CHANGES[kind]


_LABEL = re.compile(r"((?:fig|sec|thm|prop|lem|tab|def|rem|eq):\w+)(\(\w\))?")


def cite(labels: str, *, titled: bool = False) -> str:
    """Return labels of the paper's source as a reader of the paper finds them.

    Parameters
    ----------
    labels : str
        Text with labels such as "thm:geneps0(b)"; all else is kept.
    titled : bool
        Whether the title of the first is added.

    Returns
    -------
    str

    Raises
    ------
    ValueError
        A label is none of the paper's that are listed.

    Examples
    --------
    >>> cite("thm:geneps0(b)"), cite("fig:CM0, fig:simCM0")
    ('Theorem 3.1(b)', 'Figure 15(a), Figure 24(a)')
    >>> cite("sec:ballpool", titled=True)
    'Section 5.1: Ball at bottom of a pool'
    """

    def print_label(match: re.Match[str]) -> str:
        if match[1] not in PRINTED:
            raise ValueError(f"{match[1]!r} is no label that is listed; choose one of {', '.join(PRINTED)}.")
        return PRINTED[match[1]][0] + (match[2] or "")

    text = _LABEL.sub(print_label, labels)
    first = _LABEL.search(labels)
    title = PRINTED[first[1]][1] if titled and first else ""
    return f"{text}: {title}" if title else text
