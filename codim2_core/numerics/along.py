"""Formulas along a path of polynomials: their zeros, and whether a step solves its equations all along; compiled.

Over a part of the path each variable has bounds, and so has its derivative along it; a part is halved until what is
asked is decided by the bounds. Nothing between two samples is missed, however narrow it is.
"""

from __future__ import annotations

import math

import numpy as np

from ..formulas.interpreter import gradients
from ..formulas.jit import held_kernel, kernel, spliced_kernel
from .enclosure import enclose_over

MAX_DEPTH = 45  # halvings of a step in which a zero is sought: to the rounding of the time
MAX_ZEROS = 4096  # of one formula along one step
MAX_ZERO_PARTS = 100_000  # parts that are looked at for zeros, of one step
MAX_DEFECT_DEPTH = 16
MAX_DEFECT_PARTS = 160  # parts that are looked at, of one step
UNDECIDED_SAMPLES = 128  # places of one that bounds do not decide
ROOT_ITERATIONS = 100
EXACT = 1e-15  # of a step
ZERO_BOUND = 1e-290  # bounds of what is 0 all along, but for rounding outwards

NONE, UNDECIDED, DEFECT = range(3)


@kernel
def _shift(path, middle, moved):
    """Write the polynomials (V, d) in powers of u - middle."""
    V, d = path.shape
    for v in range(V):
        for k in range(d):
            moved[v, k] = path[v, k]
        for i in range(d - 1):
            for k in range(d - 2, i - 1, -1):
                moved[v, k] += middle * moved[v, k + 1]


@kernel
def _fill_box(moved, half, box):
    """Write bounds of the variables and of their derivatives within `half` of the middle."""
    V, d = moved.shape
    for v in range(V):
        spread, bend, power = 0.0, 0.0, 1.0
        for k in range(1, d):
            if k > 1:
                bend += k * abs(moved[v, k]) * power
            power *= half
            spread += abs(moved[v, k]) * power
        box[v, 0], box[v, 1] = moved[v, 0] - spread, moved[v, 0] + spread
        box[v, 2], box[v, 3] = moved[v, 1] - bend, moved[v, 1] + bend


@kernel
def _at_middle(op, left, right, number, roots, moved, seed, work, rows):
    """Write the rows (r, 3) and their derivatives along the path at the middle."""
    for v in range(len(moved)):
        seed[v, 0], seed[v, 1], seed[v, 2] = moved[v, 0], moved[v, 1], 0.0
    gradients(op, left, right, number, roots, seed, work, rows)


@kernel
def _value(op, left, right, number, roots, path, u, moved, seed, work, rows, r):
    _shift(path, u, moved)
    _at_middle(op, left, right, number, roots, moved, seed, work, rows)
    return rows[r, 0]


@kernel
def _root(op, left, right, number, roots, path, low, high, before, after, moved, seed, work, rows, r):
    """Fraction at which row r, of opposite signs at both ends, vanishes: on the side of the later end (Illinois)."""
    kept = 0
    for _ in range(ROOT_ITERATIONS):
        if high - low < EXACT:
            break
        u = low + (high - low) * before / (before - after)
        if not low < u < high:
            u = 0.5 * (low + high)
        value = _value(op, left, right, number, roots, path, u, moved, seed, work, rows, r)
        if value == 0.0:
            return u
        if (value > 0.0) == (before > 0.0):
            low, before = u, value
            after = 0.5 * after if kept == 1 else after
            kept = 1
        else:
            high, after = u, value
            before = 0.5 * before if kept == -1 else before
            kept = -1
    return high


@held_kernel
def zeros_along(op, left, right, number, roots, path, r, only_first_fall, found):
    """Find where row r changes its sign along a path, found (k, 2), and how many; -1 where the parts ran out."""
    V, d = path.shape
    moved, box, seed = np.empty((V, d)), np.zeros((V, 6)), np.zeros((V, 3))
    bounds, work = np.empty((len(op), 6)), np.empty((len(op), 3))
    out, rows = np.empty((len(roots), 6)), np.empty((len(roots), 3))
    stack, count, open_parts, looked = np.empty((2 * MAX_DEPTH + 4, 2)), 0, 1, 0
    stack[0, 0], stack[0, 1] = 0.0, 1.0
    while open_parts > 0 and count < len(found):
        open_parts -= 1
        low, width = stack[open_parts, 0], stack[open_parts, 1]
        half, high = 0.5 * width, low + width
        looked += 1
        if looked > MAX_ZERO_PARTS:
            return -1
        _shift(path, low + half, moved)
        _fill_box(moved, half, box)
        enclose_over(op, left, right, number, roots, box, bounds, out)
        if out[r, 0] > 0.0 or max(-out[r, 0], out[r, 1]) <= ZERO_BOUND:
            continue
        if out[r, 1] < 0.0:
            if only_first_fall:
                found[0, 0], found[0, 1] = low, -1.0
                return 1
            continue
        is_monotone = out[r, 2] > 0.0 or out[r, 3] < 0.0
        if not is_monotone and width > 0.5**MAX_DEPTH:
            stack[open_parts, 0], stack[open_parts, 1] = low + half, half
            stack[open_parts + 1, 0], stack[open_parts + 1, 1] = low, half
            open_parts += 2
            continue
        before = _value(op, left, right, number, roots, path, low, moved, seed, work, rows, r)
        after = _value(op, left, right, number, roots, path, high, moved, seed, work, rows, r)
        if only_first_fall:
            if after >= 0.0:
                continue
            u = low
            if before > 0.0:
                u = _root(op, left, right, number, roots, path, low, high, before, after, moved, seed, work, rows, r)
            found[0, 0], found[0, 1] = u, -1.0
            return 1
        if before < 0.0 <= after or before > 0.0 >= after:
            u = high
            if after != 0.0:
                u = _root(op, left, right, number, roots, path, low, high, before, after, moved, seed, work, rows, r)
            found[count, 0], found[count, 1] = u, 1.0 if before < 0.0 else -1.0
            count += 1
    return count


@spliced_kernel
def _is_small(defect, time, allowed_rate, allowed_change, both):
    """Whether a defect of the rate over a time is allowed: as a rate, or as the change that it makes, or as both."""
    rate, change = defect <= allowed_rate, defect * time <= allowed_change
    return (rate and change) if both else (rate or change)


@kernel
def _first_defect(op, left, right, number, roots, own_rows, path, h, rates, changes, both, scratch, stack):
    """Look along one step; see `first_defect`."""
    moved, box, seed, bounds, work, out, rows = scratch
    d = path.shape[1]
    open_parts, looked, undecided = 1, 0, False
    stack[0, 0], stack[0, 1] = 0.0, 1.0
    while open_parts > 0:
        open_parts -= 1
        low, width = stack[open_parts, 0], stack[open_parts, 1]
        half = 0.5 * width
        looked += 1
        _shift(path, low + half, moved)
        _at_middle(op, left, right, number, roots, moved, seed, work, rows)
        _fill_box(moved, half, box)
        enclose_over(op, left, right, number, roots, box, bounds, out)
        sure = True
        for r in range(len(roots)):
            own = own_rows[r]
            defect = abs(rows[r, 0] - moved[own, 1] / h)
            if not _is_small(defect, width * h, rates[r], changes[r], both[r] != 0.0) and math.isfinite(defect):
                return DEFECT, low, width
            bend, power = 0.0, 1.0  # of the rate of the polynomial, about its value 2 a_2 in the middle
            for k in range(3, d):
                power *= half
                bend += k * (k - 1) * abs(moved[own, k]) * power
            lo = out[r, 2] - (2.0 * moved[own, 2] + bend) / h
            hi = out[r, 3] - (2.0 * moved[own, 2] - bend) / h
            defect += half * max(abs(lo), abs(hi))
            bound = max(out[r, 1] - box[own, 2] / h, box[own, 3] / h - out[r, 0])  # where a slope has none, as sqrt
            if not defect <= bound:
                defect = bound
            sure = sure and _is_small(defect, width * h, rates[r], changes[r], both[r] != 0.0)
        if sure:
            continue
        if width < 0.5**MAX_DEFECT_DEPTH or looked > MAX_DEFECT_PARTS:
            undecided = True
            continue
        stack[open_parts, 0], stack[open_parts, 1] = low + half, half
        stack[open_parts + 1, 0], stack[open_parts + 1, 1] = low, half
        open_parts += 2
    if not undecided:
        return NONE, 1.0, 1.0
    for i in range(UNDECIDED_SAMPLES):  # what the parts that bounds do not decide have left no room for
        _shift(path, (i + 0.5) / UNDECIDED_SAMPLES, moved)
        _at_middle(op, left, right, number, roots, moved, seed, work, rows)
        for r in range(len(roots)):
            defect = abs(rows[r, 0] - moved[own_rows[r], 1] / h)
            if not _is_small(defect, h / UNDECIDED_SAMPLES, rates[r], changes[r], both[r] != 0.0) and math.isfinite(
                defect
            ):
                return DEFECT, i / UNDECIDED_SAMPLES, 1.0 / UNDECIDED_SAMPLES
    return UNDECIDED, 1.0, 1.0


@held_kernel
def first_defect(op, left, right, number, roots, own_rows, paths, lengths, rates, changes, both, defect):
    """Find the first of some steps that does not solve its equations all along.

    Steps before it: k if there is none. Each row is the rate of one of the variables.

    Shapes: own_rows (rows,), paths (k, V, d), lengths (k,), rates, changes, both (k, rows).
    """
    V, d = paths.shape[1], paths.shape[2]
    scratch = (
        np.empty((V, d)), np.zeros((V, 6)), np.zeros((V, 3)), np.empty((len(op), 6)), np.empty((len(op), 3)),
        np.empty((len(roots), 6)), np.empty((len(roots), 3)),
    )  # fmt: skip
    stack = np.empty((MAX_DEFECT_DEPTH + 4, 2))
    defect[:] = 0.0
    for k in range(len(lengths)):
        code, low, width = _first_defect(
            op,
            left,
            right,
            number,
            roots,
            own_rows,
            paths[k],
            lengths[k],
            rates[k],
            changes[k],
            both[k],
            scratch,
            stack,
        )
        if code == DEFECT:
            defect[0], defect[1], defect[2] = low, width, DEFECT
            return k
        defect[3] += code == UNDECIDED
    return len(lengths)
