"""The form in which a formula is kept: a flat tape of operations, each on earlier entries.

A tape has no depth, so nothing here recurses, and equal subformulas are one entry, so derivatives stay small.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from .functions import FUNCTIONS as _FUNCTIONS
from .functions import known

Node = tuple[Any, ...]  # ("num", 2.0), ("name", "s"), ("neg", i), ("sin", i), ("+", i, j), ...
Tape = tuple[Node, ...]

FUNCTIONS = tuple(one.name for one in _FUNCTIONS)
FUNCTIONS_OF_TWO = ("min", "max")
JUMPS = ("sign", "floor")
BESIDE_ZERO = "*0"  # of derivatives alone: u v, and 0 where one is 0 and the other infinite
BESIDE_ZERO_SOURCE = "(0.0 if ({0} == 0.0 and math.isinf({1})) or ({1} == 0.0 and math.isinf({0})) else {0}*{1})"
CONSTANTS = {"pi": math.pi, "e": math.e}
MOST_NODES = 20_000


def least(u: float, v: float) -> float:
    """Return the smaller one; NaN if either is."""
    return u + v if u != u or v != v else min(u, v)


def most(u: float, v: float) -> float:
    """Return the larger one; NaN if either is."""
    return u + v if u != u or v != v else max(u, v)


def beside_zero(u: float, v: float) -> float:
    """Return u v, and 0 where one is 0 and the other infinite."""
    return 0.0 if (u == 0.0 and math.isinf(v)) or (v == 0.0 and math.isinf(u)) else u * v


def _beside_zeros(u: Any, v: Any) -> Any:
    return np.where(((u == 0.0) & np.isinf(v)) | ((v == 0.0) & np.isinf(u)), 0.0, np.multiply(u, v))


# math.* is some ten times faster than NumPy on one float, but raises where IEEE arithmetic answers inf or nan;
# a formula then goes through NumPy instead.
SCALAR: dict[str, Callable[..., Any]] = {
    **{one.name: one.scalar for one in _FUNCTIONS},
    "min": least,
    "max": most,
    "neg": operator.neg,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "**": math.pow,  # never complex, unlike the operator
    BESIDE_ZERO: beside_zero,
}
VECTOR: dict[str, Callable[..., Any]] = {
    **{one.name: one.vector for one in _FUNCTIONS},
    "min": np.minimum,
    "max": np.maximum,
    "neg": np.negative,
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "**": np.power,
    BESIDE_ZERO: _beside_zeros,
}


class NotFiniteError(ValueError):
    """A part of the formula that has no name in it is infinite or undefined."""


class Builder:
    """Appends operations to a tape, folding constants; with `simplify` also 0 + u, 1 u, u^1 and the like."""

    def __init__(self, tape: Tape = (), simplify: bool = False, limit: int = MOST_NODES) -> None:
        self.nodes: list[Node] = list(tape)
        self._where = {node: i for i, node in enumerate(tape)}
        self._simplify = simplify
        self._limit = limit

    def _entry(self, *node: Any) -> int:
        i = self._where.get(node)
        if i is None:
            if len(self.nodes) >= self._limit:
                raise ValueError(f"the formula has more than {self._limit} operations; write a shorter one.")
            i = self._where[node] = len(self.nodes)
            self.nodes.append(node)
        return i

    def number(self, value: float) -> int:
        """Entry of a constant."""
        return self._entry("num", value + 0.0)

    def name(self, name: str) -> int:
        """Entry of a variable."""
        return self._entry("name", name)

    def value(self, i: int) -> float | None:
        """Return the constant at entry i, or None."""
        node = self.nodes[i]
        return node[1] if node[0] == "num" else None

    def enter_tape(self, tape: Tape, meanings: Mapping[str, int]) -> int:
        """Entry of a formula, other entries put in for names."""
        at: list[int] = []
        for op, *args in tape:
            if op == "num":
                at.append(self.number(args[0]))
            elif op == "name":
                at.append(meanings[args[0]] if args[0] in meanings else self.name(args[0]))
            else:
                at.append(self.apply(op, *(at[i] for i in args)))
        return at[-1]

    def apply(self, op: str, *args: int) -> int:
        """Entry of ``op`` on earlier entries, folded if all of them are constants."""
        values = [self.value(i) for i in args]
        if None not in values:
            try:
                result = SCALAR[op](*values)
            except (ArithmeticError, ValueError):
                result = math.nan
            if math.isfinite(result):
                return self.number(result)
            if not self._simplify:
                raise NotFiniteError("this part is infinite or undefined")
        if op == "neg" and self.nodes[args[0]][0] == "neg":
            return self.nodes[args[0]][1]
        if op == BESIDE_ZERO and values != [None, None]:
            op = "*"  # by a number, which is finite: 0 is simplified away
        if self._simplify and len(args) == 2:
            i = self._simpler(op, *args, *values)
            if i is not None:
                return i
        return self._entry(op, *args)

    def _simpler(self, op: str, i: int, j: int, u: float | None, v: float | None) -> int | None:
        match op:
            case "+" if u == 0.0 or v == 0.0:
                return j if u == 0.0 else i
            case "-" if v == 0.0:
                return i
            case "-" if u == 0.0:
                return self.apply("neg", j)
            case "*" if u == 0.0 or v == 0.0:
                return self.number(0.0)
            case "*" if u == 1.0 or v == 1.0:
                return j if u == 1.0 else i
            case "*" if u == -1.0 or v == -1.0:
                return self.apply("neg", j if u == -1.0 else i)
            case "/" if v == 1.0:
                return i
            case "/" if u == 0.0 and v != 0.0:
                return self.number(0.0)
            case "**" if v == 1.0:
                return i
            case "**" if v == 0.0:
                return self.number(1.0)
        return None


def compact(nodes: list[Node], root: int) -> Tape:
    """Only what `root` needs, in the order in which reading from left to right meets it: the canonical tape."""
    order: dict[int, int] = {}
    tape: list[Node] = []
    pending = [root]
    while pending:
        i = pending[-1]
        if i in order:
            pending.pop()
            continue
        op, *args = nodes[i]
        waiting = [] if op in ("num", "name") else [j for j in reversed(args) if j not in order]
        if waiting:
            pending.extend(waiting)
            continue
        pending.pop()
        order[i] = len(tape)
        tape.append(nodes[i] if op in ("num", "name") else (op, *(order[j] for j in args)))
    return tuple(tape)


def derivative(tape: Tape, name: str) -> Tape:
    """Tape of the partial derivative: one pass of the chain rule, forwards.

    The root of what is 0 has an infinite slope. Next to it a factor 0 stays 0: an inner slope 0 (the root of a square
    has a kink there, and the mean of its two slopes is 0), and a factor u = 0 of a product u v with a finite slope,
    since (u v)' = u' v there whatever the slope of v.

    Raises ValueError: The derivative has more than `MOST_NODES` operations.
    """
    build = Builder(tape, simplify=True)
    apply, zero = build.apply, build.number(0.0)
    steep = _steep(tape)
    rates: list[int] = []
    for k, (op, *args) in enumerate(tape):
        if op == "num" or op == "name":
            rates.append(build.number(1.0) if op == "name" and args[0] == name else zero)
            continue
        du = rates[args[0]]
        if len(args) == 2:
            rates.append(_binary_rate(build, op, k, args[0], args[1], du, rates[args[1]], zero, steep))
        elif du == zero:
            rates.append(zero)
        elif op == "neg":
            rates.append(apply("neg", du))
        else:
            function = known[op]
            outer = function.rate(build, k, args[0])
            if function.steep and steep[k]:
                rates.append(apply(BESIDE_ZERO, du, apply("/", build.number(1.0), outer)))
            else:
                rates.append(apply("/", du, outer) if function.divides else apply("*", outer, du))
    return compact(build.nodes, rates[-1])


def _steep(tape: Tape) -> list[bool]:
    """Whether entries may have infinite slopes where they are finite: roots, and powers, of what may be 0."""
    least: list[int] = []  # 1: positive, 0: not negative, -1: anything
    steep: list[bool] = []
    for op, *args in tape:
        if op in ("num", "name"):
            value = args[0] if op == "num" else -1.0
            least.append(1 if value > 0.0 else 0 if value == 0.0 else -1)
            steep.append(False)
            continue
        signs = [least[i] for i in args]
        natural = op == "**" and tape[args[1]][0] == "num" and tape[args[1]][1] in range(1, 1001)
        square = (natural and tape[args[1]][1] % 2 == 0) or (op == "*" and args[0] == args[1])
        function = known.get(op)
        if op == "+":
            sign = min(max(signs), 1) if min(signs) >= 0 else -1
        elif op in ("*", "/", "min", "max"):
            sign = 0 if square and signs[0] < 1 else max(signs) if op == "max" else min(signs)
        elif function is not None:
            sign = {"positive": 1, "kept": signs[0], "not negative": max(signs[0], 0), "any": -1}[function.sign]
        else:
            sign = signs[0] if op == "**" else -1
            sign = max(sign, 0) if square else sign
        least.append(sign)
        own = (function is not None and function.steep) or (op == "**" and not natural)
        steep.append((own and signs[0] < 1) or any(steep[i] for i in args))
    return steep


def _binary_rate(
    build: Builder, op: str, k: int, u: int, v: int, du: int, dv: int, zero: int, steep: list[bool]
) -> int:
    apply = build.apply
    match op:
        case "+" | "-":
            return apply(op, du, dv)
        case "*" | "*0":  # BESIDE_ZERO
            # 0 times an infinite slope is 0 where the other slope is finite
            first = apply(BESIDE_ZERO if steep[u] and not steep[v] else "*", du, v)
            return apply("+", first, apply(BESIDE_ZERO if steep[v] and not steep[u] else "*", u, dv))
        case "min" | "max":  # where both are equal the mean of the two slopes
            less = apply("sign", apply("-", u, v) if op == "max" else apply("-", v, u))
            if not (steep[u] or steep[v]):
                mean, half = apply("+", du, dv), apply("-", du, dv)
                return apply("*", build.number(0.5), apply("+", mean, apply("*", less, half)))
            one, half = build.number(1.0), build.number(0.5)
            first = apply(BESIDE_ZERO, apply("*", half, apply("+", one, less)), du)
            return apply("+", first, apply(BESIDE_ZERO, apply("*", half, apply("-", one, less)), dv))
        case "/":
            first = apply("/", du, v)
            if dv == zero:
                return first
            # u dv/v/v rather than u dv/v^2, which overflows sooner
            return apply("-", first, apply("/", apply("*", k, dv), v))
    by_base = zero
    if du != zero:
        power = apply("**", u, apply("-", v, build.number(1.0)))
        times = BESIDE_ZERO if steep[k] else "*"
        by_base = apply(times, apply(times, v, power), du)  # v = 0: u^0 has no slope, at u = 0 neither
    if dv == zero:
        return by_base
    by_exponent = apply(BESIDE_ZERO, dv, apply(BESIDE_ZERO, k, apply("log", u)))
    return apply("+", by_exponent, by_base)


def substitute(tape: Tape, name: str, replacement: Tape) -> Tape:
    """Replace `name` by another formula."""
    build = Builder(replacement, simplify=True)
    return compact(build.nodes, build.enter_tape(tape, {name: len(replacement) - 1}))
