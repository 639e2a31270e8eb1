"""Formulas as arrays that compiled code interprets, so that a new system is evaluated fast without compiling it.

The rows of U share one tape: equal sub-formulas are one entry. Numbers of the system (parameters, slow variables)
are put in, and what then is constant is folded, in about a microsecond: a slider move costs no more than that.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from .expressions import Expression
from .general import PLANE, number_names

Array = NDArray[np.floating[Any]]
Key = tuple[tuple[Expression, ...], tuple[float, ...]]  # `Frozen.key`: rows of U, and the numbers that they read

NUM, VAR, NEG, ADD, SUB, MUL, DIV, POW, POWI, SLOT = range(10)
SIN, COS, TAN, EXP, LOG, SQRT, TANH, SINH, COSH, ATAN, ABS = range(10, 21)
_CODES = {
    **{"neg": NEG, "+": ADD, "-": SUB, "*": MUL, "/": DIV, "**": POW, "abs": ABS, "atan": ATAN},
    **{"sin": SIN, "cos": COS, "tan": TAN, "exp": EXP, "log": LOG, "sqrt": SQRT},
    **{"tanh": TANH, "sinh": SINH, "cosh": COSH},
}

# What `gradients` starts from where c and s are the variables themselves and x = y = 0.
PLAIN = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
PLAIN.flags.writeable = False


@dataclass(frozen=True, eq=False)
class Program:
    """Formulas with numbers put in: what the compiled interpreters run.

    Attributes
    ----------
    op, left, right : ndarray of int (n,)
        Operation of each entry and the entries it acts on (`left` of a variable: 0 … 3 for c, s, x, y).
    number : ndarray (n,)
        Value of a constant entry, and exponent of an integer power.
    roots : ndarray of int (rows,)
        Entries of the rows.
    """

    op: NDArray[np.int64]
    left: NDArray[np.int64]
    right: NDArray[np.int64]
    number: Array
    roots: NDArray[np.int64]

    @property
    def arrays(self) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64], Array, NDArray[np.int64]]:
        """The five arrays, as the kernels take them."""
        return self.op, self.left, self.right, self.number, self.roots

    def at(self, points: Array) -> Array:
        """Rows and their exact partial derivatives by c and s on Sigma.

        Parameters
        ----------
        points : ndarray (k, 2)

        Returns
        -------
        ndarray (k, rows, 3)
            Value, derivative by c, derivative by s.
        """
        out = np.empty((len(points), len(self.roots), 3))
        _batch(*self.arrays, np.ascontiguousarray(points), out)
        return out


@lru_cache(maxsize=64)
def _encoded(rows: tuple[Expression, ...]) -> Program:
    names = {name: slot for slot, name in enumerate(number_names(rows))}
    where: dict[tuple[Any, ...], int] = {}
    nodes: list[tuple[int, int, int, float]] = []
    roots = []
    for row in rows:
        at: list[int] = []
        for op, *args in row._tape:
            if op == "num":
                node: tuple[int, int, int, float] = (NUM, 0, 0, float(args[0]))
            elif op == "name":
                name = args[0]
                node = (VAR, PLANE.index(name), 0, 0.0) if name in PLANE else (SLOT, names[name], 0, 0.0)
            else:
                node = (_CODES[op], at[args[0]], at[args[-1]], 0.0)
            if node not in where:
                where[node] = len(nodes)
                nodes.append(node)
            at.append(where[node])
        roots.append(at[-1])
    op, left, right, number = zip(*nodes, strict=True)
    first, second, third = (np.array(v, np.int64) for v in (op, left, right))
    return Program(first, second, third, np.array(number, float), np.array(roots, np.int64))


@lru_cache(maxsize=32)
def program(key: Hashable) -> Program:
    """Return the tape of the formulas of `Frozen.key` with its numbers put in."""
    rows, numbers = key  # type: ignore[misc]
    template = _encoded(rows)
    op, right, number = template.op.copy(), template.right.copy(), template.number.copy()
    _specialise(op, template.left, right, number, np.array(numbers, float))
    return Program(op, template.left, right, number, template.roots)


def polynomial_degree(rows: tuple[Expression, ...]) -> int | None:
    """Total degree in c and s of formulas that are polynomials in them on Sigma, or None if one is not."""
    degrees = [_degree(row) for row in rows]
    return None if None in degrees else max(d for d in degrees if d is not None)


@lru_cache(maxsize=256)
def _degree(row: Expression) -> int | None:
    found: list[int | None] = []
    for op, *args in row._tape:
        if op in ("num", "name"):
            found.append(1 if op == "name" and args[0] in ("c", "s") else 0)
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
        elif op == "**" and row._tape[args[1]][0] == "num" and float(row._tape[args[1]][1]) in range(1, 65):
            found.append(first * int(row._tape[args[1]][1]))
        else:
            found.append(None)
    return found[-1]


@njit(cache=True, nogil=True, error_model="numpy")
def _value(k, a, b):
    """Value of operation k on a (and b)."""
    if k == ADD:
        return a + b
    if k == SUB:
        return a - b
    if k == MUL:
        return a * b
    if k == DIV:
        return a / b
    if k == NEG:
        return -a
    if k == POWI:
        return a * a if b == 2.0 else math.pow(a, b)
    if k == POW:
        return math.pow(a, b)
    if k == SIN:
        return math.sin(a)
    if k == COS:
        return math.cos(a)
    if k == TAN:
        return math.tan(a)
    if k == EXP:
        return math.exp(a)
    if k == LOG:
        return math.log(a)
    if k == SQRT:
        return math.sqrt(a)
    if k == TANH:
        return math.tanh(a)
    if k == SINH:
        return math.sinh(a)
    if k == COSH:
        return math.cosh(a)
    if k == ATAN:
        return math.atan(a)
    return abs(a)


@njit(cache=True, nogil=True, error_model="numpy")
def _specialise(op, left, right, number, numbers):
    """Put the numbers in, fold constants, and mark integer powers."""
    for i in range(len(op)):
        k = op[i]
        if k == SLOT:
            op[i], number[i] = NUM, numbers[left[i]]
        elif k > VAR and op[left[i]] == NUM and op[right[i]] == NUM:
            op[i], number[i] = NUM, _value(k, number[left[i]], number[right[i]])
        elif k == POW and op[right[i]] == NUM:
            exponent = number[right[i]]
            if exponent == math.floor(exponent) and abs(exponent) <= 1000.0:
                op[i], number[i], right[i] = POWI, exponent, left[i]


@njit(cache=True, nogil=True, error_model="numpy")
def gradients(op, left, right, number, roots, seed, work, out):
    """Rows and their exact derivatives at one point, by the chain rule forwards.

    seed : (4, 3), value and two derivatives of each of c, s, x, y; work : (n, 3), scratch; out : (rows, 3).
    """
    for i in range(len(op)):
        k = op[i]
        if k == NUM:
            work[i, 0], work[i, 1], work[i, 2] = number[i], 0.0, 0.0
            continue
        if k == VAR:
            work[i, 0], work[i, 1], work[i, 2] = seed[left[i], 0], seed[left[i], 1], seed[left[i], 2]
            continue
        a, a1, a2 = work[left[i], 0], work[left[i], 1], work[left[i], 2]
        b, b1, b2 = work[right[i], 0], work[right[i], 1], work[right[i], 2]
        if k == POWI:
            b = number[i]
        v = _value(k, a, b)
        p, q = 0.0, 0.0  # derivatives of v by a and by b
        if k == ADD:
            p, q = 1.0, 1.0
        elif k == SUB:
            p, q = 1.0, -1.0
        elif k == MUL:
            p, q = b, a
        elif k == DIV:
            p, q = 1.0 / b, -v / b
        elif k == NEG:
            p = -1.0
        elif k == POWI:
            p = 2.0 * a if b == 2.0 else b * math.pow(a, b - 1.0)
        elif k == POW:
            p = b * math.pow(a, b - 1.0)
            q = v * math.log(a) if b1 != 0.0 or b2 != 0.0 else 0.0
        elif k == SIN:
            p = math.cos(a)
        elif k == COS:
            p = -math.sin(a)
        elif k == TAN:
            p = 1.0 + v * v
        elif k == EXP:
            p = v
        elif k == LOG:
            p = 1.0 / a
        elif k == SQRT:
            p = 0.5 / v
        elif k == TANH:
            p = 1.0 / math.cosh(a) ** 2
        elif k == SINH:
            p = math.cosh(a)
        elif k == COSH:
            p = math.sinh(a)
        elif k == ATAN:
            p = 1.0 / (1.0 + a * a)
        else:
            p = 1.0 if a >= 0.0 else -1.0
        # a factor 0 stays 0 beside an infinite slope: sqrt of a constant 0 has no slope
        work[i, 0] = v
        work[i, 1] = (p * a1 if a1 != 0.0 else 0.0) + (q * b1 if q != 0.0 else 0.0)
        work[i, 2] = (p * a2 if a2 != 0.0 else 0.0) + (q * b2 if q != 0.0 else 0.0)
    for r in range(len(roots)):
        for j in range(3):
            out[r, j] = work[roots[r], j]


@njit(cache=True, nogil=True, error_model="numpy")
def _batch(op, left, right, number, roots, points, out):
    work = np.empty((len(op), 3))
    seed = np.zeros((4, 3))
    seed[0, 1] = seed[1, 2] = 1.0
    for i in range(len(points)):
        seed[0, 0], seed[1, 0] = points[i, 0], points[i, 1]
        gradients(op, left, right, number, roots, seed, work, out[i])
