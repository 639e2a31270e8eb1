"""Names that mean something in a formula of a system: c, s, x, y, the slow variables, and numbers next to them."""

from __future__ import annotations

from collections.abc import Sequence

from .expression import Expression

MOST_SLOW_VARIABLES = 16


FAST_NAMES = ("c", "s", "x", "y")
TIME = "t"  # unless a parameter or a definition has that name
SLOW_NAMES = tuple(f"z{i}" for i in range(1, MOST_SLOW_VARIABLES + 1))


def number_names(rows: Sequence[Expression]) -> tuple[str, ...]:
    """Slow variables, then parameters by alphabet, that formulas read: an order that they alone decide."""
    used = {name for row in rows for name in row.names}
    return (*(name for name in SLOW_NAMES if name in used), *sorted(used.difference(FAST_NAMES, SLOW_NAMES)))
