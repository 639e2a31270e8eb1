"""Formulas as arrays that compiled code (`interpreter`) interprets: a new system is evaluated without compiling it.

The rows of U share one tape: equal sub-formulas are one entry. Numbers of the system (parameters, slow variables)
are put in, and what then is constant is folded, in about a microsecond: a slider move costs no more than that.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..results.arrays import Array
from .expression import Expression
from .functions import FUNCTIONS, code
from .names import FAST_NAMES, SLOW_NAMES, number_names
from .opcodes import ADD, BESIDE, DIV, HYPOT, MAX, MIN, MUL, NEG, NUM, POW, POWI, SLOT, SUB, VAR
from .tape import BESIDE_ZERO

Key = tuple[tuple[Expression, ...], tuple[float, ...]]  # `Frozen.key`: rows of U, and the numbers that they read

_CODES = {
    "neg": NEG,
    "+": ADD,
    "-": SUB,
    "*": MUL,
    "/": DIV,
    "**": POW,
    "min": MIN,
    "max": MAX,
    BESIDE_ZERO: BESIDE,
    **code,
}

_ENTIRE = (NUM, VAR, NEG, ADD, SUB, MUL, *(code[one.name] for one in FUNCTIONS if one.entire))

ONE_SIDED_DISTANCE = 1e-6  # so far from a point its slopes are looked at where it has none by the rules,
AGREED = 1e-4  # and there they agree
ONE_SIDED_DIRECTIONS = np.stack(
    [np.cos(np.arange(16) * math.pi / 8.0 + 0.1), np.sin(np.arange(16) * math.pi / 8.0 + 0.1)], axis=-1
)
ONE_SIDED_DIRECTIONS.flags.writeable = False


@dataclass(frozen=True, eq=False)
class Program:
    """Formulas with numbers put in: what the compiled interpreters run."""

    # (n,) Operation of each entry and the entries it acts on (`left` of a variable: 0 … 3 for c, s, x, y, then z1,
    # ...)
    op: NDArray[np.int64]
    left: NDArray[np.int64]
    right: NDArray[np.int64]
    number: Array  # (n,) Value of a constant entry, and exponent of an integer power
    roots: NDArray[np.int64]  # (rows,) Entries of the rows

    @property
    def arrays(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], Array, NDArray[np.int64]]:
        """The five arrays, as the kernels take them."""
        return self.op, self.left, self.right, self.number, self.roots

    @property
    def is_entire(self) -> bool:
        """Whether no row has a pole, an edge or a branch point: each is smooth wherever its variables are finite."""
        divides = (self.op == DIV) & (self.op[self.right] == NUM)
        whole = (self.op == POWI) & (self.number >= 0.0)
        return bool((np.isin(self.op, _ENTIRE) | divides | whole).all())

    def evaluate(self, points: Array) -> Array:
        """Return the rows and their partial derivatives by c and by s, at points (k, 2 to 4)."""
        out = np.empty((len(points), len(self.roots), 3))
        from . import interpreter  # on first use: it loads the compiler

        interpreter.batch(*self.arrays, np.array(points, order="C"), out)  # one compilation, read-only or not
        if not np.isfinite(out).all():
            self._limits(points, out)
        return out

    def _limits(self, points: Array, out: Array) -> None:
        """Put in slopes that exist where the rules of calculus meet inf/inf, as that of exp(-1/c^2) at 0."""
        from . import interpreter

        finite = np.isfinite(out)
        for i in np.flatnonzero(finite[:, :, 0].all(axis=1) & ~finite.all(axis=(1, 2))):
            around = np.empty((len(ONE_SIDED_DIRECTIONS), len(self.roots), 3))
            around_point = np.repeat(points[i : i + 1], len(ONE_SIDED_DIRECTIONS), axis=0)
            around_point[:, :2] += ONE_SIDED_DISTANCE * ONE_SIDED_DIRECTIONS
            interpreter.batch(*self.arrays, around_point, around)
            mean = around.mean(axis=0)
            spread = np.abs(around - mean).max(axis=0)
            with np.errstate(invalid="ignore"):
                known = (spread <= AGREED * (1.0 + np.abs(mean))) & np.isfinite(mean)
            out[i, :, 1:] = np.where(~finite[i, :, 1:] & known[:, 1:], mean[:, 1:], out[i, :, 1:])


@lru_cache(maxsize=64)
def _encode(rows: tuple[Expression, ...]) -> Program:
    names = {name: slot for slot, name in enumerate(number_names(rows))}
    where: dict[tuple[Any, ...], int] = {}
    nodes: list[tuple[int, int, int, float]] = []
    roots = []

    def enter(node: tuple[int, int, int, float]) -> int:
        if node not in where:
            where[node] = len(nodes)
            nodes.append(node)
        return where[node]

    def norm(i: int) -> int | None:
        """Entry of the root of entry i, if that is a sum of squares: it has a tip at 0, and bounded slopes."""
        op, j, k, _ = nodes[i]
        if (op == POW and nodes[k][0] == NUM and nodes[k][3] == 2.0) or (op == MUL and j == k):
            return j
        if op == MUL and nodes[j][0] == NUM and nodes[j][3] > 0.0:
            within = norm(k)
            return None if within is None else enter((MUL, enter((NUM, 0, 0, math.sqrt(nodes[j][3]))), within, 0.0))
        if op != ADD:
            return None
        first, second = norm(j), norm(k)
        return None if first is None or second is None else enter((HYPOT, first, second, 0.0))

    for row in rows:
        at: list[int] = []
        for op, *args in row.tape:
            if op == "num":
                node: tuple[int, int, int, float] = (NUM, 0, 0, float(args[0]))
            elif op == "name":
                name = args[0]
                node = (VAR, FAST_NAMES.index(name), 0, 0.0) if name in FAST_NAMES else (SLOT, names[name], 0, 0.0)
            else:
                rooted = op == "sqrt" or (op == "**" and row.tape[args[1]] == ("num", 0.5))
                root = norm(at[args[0]]) if rooted else None
                if root is not None:
                    at.append(root if nodes[root][0] == HYPOT else enter((code["abs"], root, root, 0.0)))
                    continue
                node = (_CODES[op], at[args[0]], at[args[-1]], 0.0)
            at.append(enter(node))
        roots.append(at[-1])
    op, left, right, number = zip(*nodes, strict=True)
    first, second, third = (np.array(v, np.int64) for v in (op, left, right))
    return Program(first, second, third, np.array(number, float), np.array(roots, np.int64))


@lru_cache(maxsize=32)
def program(key: Hashable) -> Program:
    """Return the tape of the formulas of `Frozen.key` with its numbers put in."""
    from . import interpreter  # on first use: it loads the compiler

    rows, numbers = key  # type: ignore[misc]
    template = _encode(rows)
    op, right, number = template.op.copy(), template.right.copy(), template.number.copy()
    interpreter.specialise(op, template.left, right, number, np.array(numbers, float))
    return Program(op, template.left, right, number, template.roots)


@lru_cache(maxsize=64)
def path_program(rows: tuple[Expression, ...]) -> Program:
    """Return the tape of formulas in c, s, x, y, z1, ..., all of which are its variables, in this order."""
    from . import interpreter  # on first use: it loads the compiler

    template, names = _encode(rows), (*FAST_NAMES, *SLOW_NAMES)
    slots = np.array([names.index(name) for name in number_names(rows)], np.int64)
    op, left, right, number = (
        template.op.copy(), template.left.copy(), template.right.copy(), template.number.copy(),
    )  # fmt: skip
    slow = op == SLOT
    op[slow], left[slow] = VAR, slots[left[slow]]
    interpreter.specialise(op, left, right, number, np.zeros(0))
    return Program(op, left, right, number, template.roots)


def polynomial_degree(rows: tuple[Expression, ...], names: tuple[str, ...] = FAST_NAMES[:2]) -> int | None:
    """Total degree of formulas in some names, c and s on Sigma, in which they are polynomials; None if one is not."""
    degrees = [_degree(row, names) for row in rows]
    return None if None in degrees else max(d for d in degrees if d is not None)


@lru_cache(maxsize=256)
def _degree(row: Expression, names: tuple[str, ...]) -> int | None:
    found: list[int | None] = []
    for op, *args in row.tape:
        if op in ("num", "name"):
            found.append(1 if op == "name" and args[0] in names else 0)
            continue
        of = [found[i] for i in args]
        first, last = of[0], of[-1]
        if first is None or last is None:
            found.append(None)
        elif all(d == 0 for d in of):
            found.append(0)
        elif op in ("+", "-", "neg"):
            found.append(max(first, last))
        elif op == "*":
            found.append(first + last)
        elif op == "/" and last == 0:
            found.append(first)
        elif op == "**" and row.tape[args[1]][0] == "num" and float(row.tape[args[1]][1]) in range(1, 65):
            found.append(first * int(row.tape[args[1]][1]))
        else:
            found.append(None)
    return found[-1]


MAX_DEGREE = 16
Terms = dict[tuple[int, int], Fraction]  # the coefficient of c^i s^j by (i, j)


def polynomials(run: Program) -> tuple[Terms, ...] | None:
    """Return the rows of a tape as polynomials on Sigma; None if one is none, or of a degree beyond `MAX_DEGREE`."""
    entries: list[Terms | None] = []
    for op, left, right, number in zip(*(column.tolist() for column in run.arrays[:4]), strict=True):
        found = _terms(op, left, number, entries, right)
        entries.append(None if found is None or max(map(sum, found), default=0) > MAX_DEGREE else found)
    rows = [entries[i] for i in run.roots.tolist()]
    return None if None in rows else tuple(row for row in rows if row is not None)


def _terms(op: int, left: int, number: float, entries: list[Terms | None], right: int) -> Terms | None:
    if op == NUM:
        return {(0, 0): Fraction(number)} if number - number == 0.0 else None
    if op == VAR:
        return {(1, 0): Fraction(1)} if left == 0 else {(0, 1): Fraction(1)} if left == 1 else {}
    first = entries[left]
    if first is None:
        return None
    if op == NEG:
        return {place: -v for place, v in first.items()}
    if op == POWI:
        return _raise_terms(first, number)
    second = entries[right]
    if second is None:
        return None
    if op in (ADD, SUB):
        sign = 1 if op == ADD else -1
        return {at: first.get(at, Fraction()) + sign * second.get(at, Fraction()) for at in {**first, **second}}
    if op == MUL:
        return _multiply_terms(first, second)
    constant = second.get((0, 0), Fraction())
    if op == DIV and constant and all(place == (0, 0) or not v for place, v in second.items()):
        return {place: v / constant for place, v in first.items()}
    return None


def _multiply_terms(first: Terms, second: Terms) -> Terms:
    found: Terms = {}
    for (i, j), v in first.items():
        for (k, m), w in second.items():
            found[i + k, j + m] = found.get((i + k, j + m), Fraction()) + v * w
    return found


def _raise_terms(base: Terms, exponent: float) -> Terms | None:
    if not 0.0 <= exponent <= MAX_DEGREE:
        return None
    found: Terms = {(0, 0): Fraction(1)}
    for _ in range(int(exponent)):
        found = _multiply_terms(found, base)
    return found
