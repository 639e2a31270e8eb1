"""Read a request of a browser: every value of the right type, and no larger than a control can hold."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..phrases import say

#: Characters of one text, entries of one list or mapping, and controls that one request sets.
MAX_TEXT_CHARACTERS, MOST_ENTRIES, MOST_CONTROLS = 4000, 64, 64
#: Numbers of requests are whole numbers that a browser counts without rounding.
LARGEST_NUMBER = 2**53


def read_request(given: Any) -> tuple[dict[str, Any], dict[str, Any], str]:
    """Read ``{"id": number, "set": {control: value}, "all": bool, "rest": bool, "window": list}``.

    Returns
    -------
    request : dict
        "id", "all", "rest" and "window", as far as they are what they should be.
    values : dict
        By control; each is small, and may still be wrong.
    sentence : str
        What was left out, and why; "" if nothing was.
    """
    if given is not None and not isinstance(given, Mapping):
        return {"id": 0}, {}, say("request of a wrong kind", kind=_asked_kind(given))
    given = given or {}
    number = given.get("id", 0)
    whole = isinstance(number, (int, float)) and not isinstance(number, bool) and abs(number) <= LARGEST_NUMBER
    request = {
        "id": number if whole else 0,
        "all": given.get("all") is True,
        "rest": given.get("rest") is True,
        "window": given.get("window"),
    }
    asked = given.get("set")
    if asked is None:
        return request, {}, ""
    if not isinstance(asked, Mapping):
        return request, {}, say("values of a wrong kind", kind=_asked_kind(asked))
    if len(asked) > MOST_CONTROLS:
        return request, {}, say("too many values", count=len(asked), most=MOST_CONTROLS)
    values: dict[str, Any] = {}
    refused: list[str] = []
    for name, value in asked.items():
        why = _too_large(value)
        if not isinstance(name, str) or len(name) > MAX_TEXT_CHARACTERS:
            why = "its name is none"
        if why:
            refused.append(f"{str(name)[:20]} ({why})")
        else:
            values[name] = value
    return request, values, say("values left out", names=", ".join(refused[:3])) if refused else ""


def _asked_kind(value: Any) -> str:
    return "nothing" if value is None else type(value).__name__


def _too_large(value: Any, depth: int = 0) -> str:
    """Say why a value is no control's; "" if it may be."""
    if value is None or isinstance(value, (bool, float)):
        return ""
    if isinstance(value, int):
        return "" if abs(value) < 10**300 else "the number is too large"
    if isinstance(value, str):
        return (
            ""
            if len(value) <= MAX_TEXT_CHARACTERS
            else f"{len(value)} characters, at most {MAX_TEXT_CHARACTERS} are read"
        )
    if depth == 0 and isinstance(value, (list, tuple, Mapping)):
        if len(value) > MOST_ENTRIES:
            return f"{len(value)} entries, at most {MOST_ENTRIES} are read"
        parts = [*value, *value.values()] if isinstance(value, Mapping) else value
        return next(filter(None, (_too_large(part, 1) for part in parts)), "")
    if depth == 1 and isinstance(value, (list, tuple)) and len(value) == 2:  # the ends of a range
        return next(filter(None, (_too_large(part, 2) for part in value)), "")
    return f"{_asked_kind(value)} is no value of a control"
