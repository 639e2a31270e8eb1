"""Formulas with kinks and jumps as smooth branches: abs, sign, min, max and floor take one of their forms at a time.

On a branch every formula is smooth, also a little beyond its end. A branch lasts while all its guards are positive, so
that the time at which it ends is the zero of a smooth function.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from .expression import Expression
from .names import FAST_NAMES
from .tape import FUNCTIONS_OF_TWO, JUMPS, Builder, compact

Rows = tuple[Expression, ...]
ZERO = Expression((("num", 0.0),))
BORDER = 1e-13  # of the terms of a switch's argument: a smaller value is that of its border, to rounding


@dataclass(frozen=True)
class Branch:
    """Smooth rows, and what ends them."""

    choices: tuple[int, ...] = ()  # for each switch, the sign of its argument, or the value of floor
    rows: Rows = ()
    guards: Rows = ()  # one for each switch: positive on the branch
    jumps: tuple[bool, ...] = ()  # whether the rows jump where that guard vanishes; else they have a kink
    arguments: Rows = ()

    def next_choice(self, switch: int, values: Mapping[str, float]) -> int:
        """Return the choice past the end of a guard."""
        argument, choice = self.arguments[switch], self.choices[switch]
        if self.guards[switch] in (argument, _guard("sign", argument, -1)):
            return -choice
        nearest = round(float(argument.evaluate(values)))
        return nearest if nearest > choice else choice - 1

    def returns_to(self, before: Branch, switch: int, values: Mapping[str, float], rates: Mapping[str, float]) -> bool:
        """Whether this branch ends at once where it begins, at a switch of the branch before at which rows jump."""
        argument = before.arguments[switch]
        if not before.jumps[switch] or argument not in self.arguments:
            return False
        guard = self.guards[self.arguments.index(argument)]
        return sum(float(guard.derivative(name).evaluate(values)) * rates[name] for name in guard.names) < 0.0


def kinks(rows: Sequence[Expression], names: Collection[str]) -> Rows:
    """Return the arguments of every abs, and the differences within every min and max, that read some names."""
    found: dict[Expression, None] = {}
    for row in rows:
        for op, *args in row.tape:
            if op == "abs" or op in FUNCTIONS_OF_TWO:
                one = _argument(list(row.tape), op, args)
                if any(name in names for name in one.names):
                    found[one] = None
    return tuple(found)


def jump_names(rows: Sequence[Expression]) -> frozenset[str]:
    """Return the names that the arguments of sign and floor read: what decides where rows jump."""
    found: set[str] = set()
    for row in rows:
        for op, *args in row.tape:
            if op in JUMPS:
                found.update(_argument(list(row.tape), op, args).names)
    return frozenset(found)


def has_switches(rows: Sequence[Expression], names: Collection[str], slip: Sequence[str] = FAST_NAMES[2:]) -> bool:
    """Whether rows have a kink or a jump where a formula in some of the names, and in no others, vanishes."""
    if not any(op in FUNCTIONS_OF_TWO or op == "abs" or op in JUMPS for row in rows for op, *_ in row.tape):
        return False
    return bool(branch_at(rows, names, {name: 0.5 for row in rows for name in row.names}, slip=slip).choices)


def branch_at(
    rows: Sequence[Expression],
    names: Collection[str],
    values: Mapping[str, float],
    rates: Mapping[str, float] | None = None,
    known: Sequence[int] = (),
    slip: Sequence[str] = FAST_NAMES[2:],
) -> Branch:
    """Return the branch at a place, or, where a guard vanishes there, the one towards which its rates lead."""
    choices: dict[tuple[str, Expression], int] = {}
    guards: dict[tuple[str, Expression], Expression] = {}
    jumps: dict[tuple[str, Expression], bool] = {}
    smooth: list[Expression] = []
    for row in rows:
        build, at = Builder(simplify=True), list[int]()
        for op, *args in row.tape:
            if op in ("num", "name"):
                at.append(build.number(args[0]) if op == "num" else build.name(args[0]))
                continue
            own = [at[i] for i in args]
            if op not in FUNCTIONS_OF_TWO and op != "abs" and op not in JUMPS:
                at.append(build.apply(op, *own))
                continue
            argument = _argument(build.nodes, op, own)
            if any(name not in names for name in argument.names) or _vanishes_with(slip, argument):
                at.append(build.apply(op, *own))
                continue
            key = ("floor" if op == "floor" else "sign", argument)
            if key not in choices:
                given = known[len(choices)] if len(choices) < len(known) else None
                choices[key] = _choice(key, values, rates) if given is None else given
                guards[key] = _guard(*key, choices[key])
            jumps[key] = jumps.get(key, False) or op in JUMPS
            at.append(_chosen(build, op, own, choices[key]))
        smooth.append(Expression(compact(build.nodes, at[-1])))
    arguments = tuple(argument for _, argument in choices)
    return Branch(tuple(choices.values()), tuple(smooth), tuple(guards.values()), tuple(jumps.values()), arguments)


def _vanishes_with(slip: Sequence[str], argument: Expression) -> bool:
    """Whether an argument is a number, or 0 where all names of a slip are."""
    if argument.constant is not None:
        return True
    for name in slip:
        argument = argument.substitute(name, ZERO) if name in argument.names else argument
    return argument.constant == 0.0


def _argument(nodes: list[tuple], op: str, args: Sequence[int]) -> Expression:
    """Return the formula whose sign decides abs and sign, min and max; the argument of floor."""
    if op in FUNCTIONS_OF_TWO:
        build = Builder(tuple(nodes), simplify=True)
        return Expression(compact(build.nodes, build.apply("-", *args)))
    return Expression(compact(nodes, args[0]))


def _choice(key: tuple[str, Expression], values: Mapping[str, float], rates: Mapping[str, float] | None) -> int:
    """Return the sign, or the value of floor, at a place; on the border by the first derivative along the motion."""
    kind, argument = key
    value = float(argument.evaluate(values))
    if not math.isfinite(value):
        return 1 if kind == "sign" else 0
    nearest = round(value) if kind == "floor" else 0
    slopes = {name: float(argument.derivative(name).evaluate(values)) for name in argument.names}
    size = abs(value) + sum(abs(slope * values[name]) for name, slope in slopes.items() if math.isfinite(slope))
    if abs(value - nearest) > BORDER * size:
        return math.floor(value) if kind == "floor" else (1 if value > 0.0 else -1)
    rate = 0.0 if rates is None else sum(slope * rates[name] for name, slope in slopes.items() if rates[name] != 0.0)
    if kind == "floor":
        return nearest if rate >= 0.0 else nearest - 1
    return 1 if rate > 0.0 or (rate == 0.0 and value >= 0.0) else -1


def _guard(kind: str, argument: Expression, choice: int) -> Expression:
    build = Builder(argument.tape, simplify=True)
    root = len(argument.tape) - 1
    if kind == "sign":
        return Expression(compact(build.nodes, root if choice > 0 else build.apply("neg", root)))
    below = build.apply("-", root, build.number(float(choice)))
    above = build.apply("-", build.number(choice + 1.0), root)
    return Expression(compact(build.nodes, build.apply("*", below, above)))


def _chosen(build: Builder, op: str, args: Sequence[int], choice: int) -> int:
    """Entry of the smooth form of a switch."""
    if op in JUMPS:
        return build.number(float(choice))
    if op == "abs":
        return args[0] if choice > 0 else build.apply("neg", args[0])
    return args[0] if (choice > 0) == (op == "max") else args[1]
