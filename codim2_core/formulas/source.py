"""Formulas as straight-line Python source: equal subformulas are computed once."""

from __future__ import annotations

from collections.abc import Sequence

from .expression import Expression
from .functions import known
from .tape import BESIDE_ZERO, BESIDE_ZERO_SOURCE, FUNCTIONS_OF_TWO, Builder, Node


def program(rows: Sequence[Expression]) -> tuple[list[str], list[str]]:
    """Return statements ``t7 = t3*t4``, one for each distinct operation, and a name or a number for each formula."""
    build = Builder()
    roots = [_entry_of(build, row) for row in rows]
    shown, statements = list[str](), list[str]()
    for k, (op, *args) in enumerate(build.nodes):
        if op == "num":
            shown.append(f"({args[0]!r})" if args[0] < 0.0 else repr(args[0]))
        elif op == "name":
            shown.append(args[0])
        else:
            exponent = _integer(build.nodes[args[1]]) if op == "**" else None
            statements.append(f"t{k} = {_operation(op, [shown[i] for i in args], exponent)}")
            shown.append(f"t{k}")
    return statements, [shown[i] for i in roots]


def _entry_of(build: Builder, row: Expression) -> int:
    """Entry of a formula among those already there."""
    at: list[int] = []
    for op, *args in row.tape:
        if op == "num":
            at.append(build.number(args[0]))
        elif op == "name":
            at.append(build.name(args[0]))
        else:
            at.append(build.apply(op, *(at[i] for i in args)))
    return at[-1]


def _integer(node: Node) -> int | None:
    return int(node[1]) if node[0] == "num" and float(node[1]).is_integer() else None


def _operation(op: str, args: list[str], exponent: int | None) -> str:
    if op == "neg":
        return f"-{args[0]}"
    if op in FUNCTIONS_OF_TWO:
        return f"{op}({args[0]}, {args[1]})"
    if op == BESIDE_ZERO:
        return BESIDE_ZERO_SOURCE.format(*args)
    if len(args) == 1:
        return known[op].python_source(args[0])
    if op != "**":
        return f"{args[0]}{op}{args[1]}"
    if exponent is None:
        return f"math.sqrt({args[0]})" if args[1] == "0.5" else f"math.pow({args[0]}, {args[1]})"
    if exponent == 0:
        return "1.0"
    # A literal integer exponent becomes multiplications when compiled.
    return f"{args[0]}**{exponent}" if exponent > 0 else f"1.0/{args[0]}**{-exponent}"
