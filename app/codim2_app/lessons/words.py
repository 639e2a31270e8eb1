"""Words with facts in them, such as ``Limit directions: {limit_directions}, |e| = {radius:.3f}``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

FIELD = re.compile(r"\{(\w+)(?::\.(\d)([fg]))?\}")


def fields(text: str) -> tuple[str, ...]:
    """Return the names of the facts in a text."""
    return tuple(match[1] for match in FIELD.finditer(text))


def fill_facts(text: str, facts: Mapping[str, Any]) -> str:
    """Return the text with the facts put in; ``:.3f`` and ``:.3g`` say how a number is written."""

    def format_fact(match: re.Match[str]) -> str:
        value = facts[match[1]]
        if value is None:
            return "–"
        if isinstance(value, tuple):
            return ", ".join(map(str, value)) or "none"
        if isinstance(value, float):
            return f"{value + 0.0:.{match[2] or 4}{match[3] or 'g'}}".replace("-", "−")
        return str(value)

    return FIELD.sub(format_fact, text)
