"""Formulas as straight-line Python source for a compiler: equal subformulas are computed once."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from .expression import Expression
from .functions import FUNCTIONS, known
from .tape import BESIDE_ZERO, BESIDE_ZERO_SOURCE, FUNCTIONS_OF_TWO, Builder, Node

# Smooth wherever their argument is finite, however far a step strays.
ENTIRE = frozenset({"num", "name", "neg", "+", "-", "*", *(one.name for one in FUNCTIONS if one.entire)})


@dataclass(frozen=True)
class Source:
    """Statements that compute formulas.

    Attributes
    ----------
    before : tuple of str
        Statements that depend on none of the `inner` names: for outside the loop.
    inside : tuple of str
        The others, in order.
    results : tuple of str
        An expression for the value of each formula: a name, or a number.
    entire : bool
        In the inner names no formula has a pole, an edge or a branch point.
    """

    before: tuple[str, ...]
    inside: tuple[str, ...]
    results: tuple[str, ...]
    entire: bool


def program(rows: Sequence[Expression], names: Mapping[str, str], inner: Collection[str]) -> Source:
    """Write formulas as statements ``t7 = t3*t4``, one for each distinct operation.

    Parameters
    ----------
    rows : sequence of Expression
    names : mapping of str to str
        What each name of the formulas is called in the source.
    inner : collection of str
        Names (of the formulas) that change from one evaluation to the next.
    """
    build = Builder()
    roots = [_entry_of(build, row) for row in rows]
    shown: list[str] = []
    varies: list[bool] = []
    before: list[str] = []
    inside: list[str] = []
    entire = True
    for k, (op, *args) in enumerate(build.nodes):
        if op == "num":
            shown.append(f"({args[0]!r})" if args[0] < 0.0 else repr(args[0]))
            varies.append(False)
        elif op == "name":
            shown.append(names[args[0]])
            varies.append(args[0] in inner)
        else:
            varies.append(any(varies[i] for i in args))
            exponent = _integer(build.nodes[args[1]]) if op == "**" else None
            text = _operation(op, [shown[i] for i in args], exponent)
            (inside if varies[k] else before).append(f"t{k} = {text}")
            shown.append(f"t{k}")
            if varies[k] and op not in ENTIRE:
                # A quotient by what does not vary, and a natural power, are entire too.
                entire = entire and ((op == "/" and not varies[args[1]]) or (exponent is not None and exponent >= 0))
    return Source(tuple(before), tuple(inside), tuple(shown[i] for i in roots), entire)


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
