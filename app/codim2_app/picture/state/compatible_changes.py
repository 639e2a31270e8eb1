"""Several changes at once, of which some may be impossible: those that can be had, and whose fault the others are."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .chosen_system import BOXES
from .cleaning import InputError
from .controls import CONTROL_NAMES

_TYPED_BOXES = frozenset(box.name for boxes in BOXES.values() for box in boxes)


def compatible_changes(
    good: Mapping[str, Any], attempt: Callable[[Mapping[str, Any]], Any]
) -> tuple[dict[str, Any], dict[str, Exception]]:
    """Return the changes that can be had together, and why not the others: one may need another to come first.

    Parameters
    ----------
    good : mapping
        Values by control.
    attempt : callable
        Raises where the changes that it is given cannot be had.
    """
    had: dict[str, Any] = {}
    failed: dict[str, Exception] = {}
    left = sorted(good, key=CONTROL_NAMES.index)
    while left:
        failed = {}
        for name in left:
            try:
                attempt({**had, name: good[name]})
                had[name] = good[name]
            except Exception as error:  # shown next to its control
                failed[name] = error
        if len(failed) == len(left):
            break
        left = list(failed)
    return had, failed


def culprit(error: Exception, name: str) -> str:
    """Return the control next to which an error is shown: of typed formulas the box, else `name`."""
    if isinstance(error, InputError):
        return error.control
    word = str(error).partition(" ")[0]  # what is wrong with one formula begins with its name; W holds W1, W2, …
    box = "W" if word[:1] == "W" else word
    return f"text:{box}" if name == "texts" and box in _TYPED_BOXES else name
