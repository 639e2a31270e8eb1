"""Find where a formula may have a kink: the formulas that vanish there."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from .expression import Expression
from .tape import FUNCTIONS_OF_TWO, Node, compact


def kinks(rows: Sequence[Expression], names: Collection[str]) -> tuple[Expression, ...]:
    """Return the arguments of every abs, and the differences within every min and max, that read some names.

    Parameters
    ----------
    rows : sequence of Expression
    names : collection of str
    """
    found: dict[Expression, None] = {}
    for row in rows:
        nodes: list[Node] = list(row.tape)
        for op, *args in row.tape:
            if op == "abs":
                one = Expression(compact(nodes, args[0]))
            elif op in FUNCTIONS_OF_TWO:
                one = Expression(compact([*nodes, ("-", *args)], len(nodes)))
            else:
                continue
            if any(name in names for name in one.names):
                found[one] = None
    return tuple(found)
