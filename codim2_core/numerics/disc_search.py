"""All zeros of U in the disc |e| <= 1, by cutting boxes in four until each is decided; compiled.

A box is dropped when an enclosure of U over it (`enclosure`), plain or preconditioned by the inverse Jacobian
at its middle, does not contain 0. A zero found by Newton's method is proven by Krawczyk's test, which also gives a box
around it in which U is injective: what lies inside that box has no other zero. So the list is complete where no box
is left over; boxes shrink for ever only at degenerate zeros, and where a formula is undefined.
"""

from __future__ import annotations

import math

import numpy as np

from ..formulas.interpreter import gradients
from ..formulas.jit import kernel, spliced_kernel
from .enclosure import enclose

# A square around the disc, off centre so that zeros on the axes lie inside boxes and not on their borders.
SQUARE_LEFT, BELOW, SQUARE_SIDE = -1.0137, -1.0211, 2.047
FIRST_BOXES = 8  # boxes along each side
CAPACITY = 256  # zeros


@kernel
def _newton(op, left, right, number, roots, c, s, reach, work, seed, rows):
    """Newton's method from (c, s), to rounding; (ok, c, s), not ok beyond `reach` or where it does not converge."""
    c0, s0 = c, s
    for turn in range(12):
        seed[0, 0], seed[1, 0] = c, s
        gradients(op, left, right, number, roots, seed, work, rows)
        det = rows[0, 1] * rows[1, 2] - rows[0, 2] * rows[1, 1]
        dc = (rows[0, 0] * rows[1, 2] - rows[1, 0] * rows[0, 2]) / det
        ds = (rows[1, 0] * rows[0, 1] - rows[0, 0] * rows[1, 1]) / det
        c, s = c - dc, s - ds
        if not (abs(c - c0) <= reach and abs(s - s0) <= reach):
            return False, c, s
        if abs(dc) + abs(ds) < 1e-12 and turn > 0:
            # one more step changes nothing but rounding; the derivative there is in `rows`
            return True, c, s
    return False, c, s


@kernel
def _contraction(out, y00, y01, y10, y11):
    """Bound of |I - Y D| (largest row sum) over the enclosures of D = (rows' derivatives); inf if there is none."""
    worst = 0.0
    for i in range(2):
        yi0, yi1 = (y00, y01) if i == 0 else (y10, y11)
        total = 0.0
        for j in range(2):
            lo0, hi0, lo1, hi1 = out[0, 2 + 2 * j], out[0, 3 + 2 * j], out[1, 2 + 2 * j], out[1, 3 + 2 * j]
            middle = yi0 * 0.5 * (lo0 + hi0) + yi1 * 0.5 * (lo1 + hi1)
            spread = abs(yi0) * 0.5 * (hi0 - lo0) + abs(yi1) * 0.5 * (hi1 - lo1)
            total += abs((1.0 if i == j else 0.0) - middle) + spread
        if not total <= worst:
            worst = total
    return worst if worst == worst else math.inf


@kernel
def _empty(out, rows, half):
    """Whether U has no zero in a box: enclosures `out` over it, values and derivatives `rows` at its middle."""
    for i in range(2):
        if out[i, 0] > 0.0 or out[i, 1] < 0.0:
            return True
        slope = max(abs(out[i, 2]), abs(out[i, 3])) + max(abs(out[i, 4]), abs(out[i, 5]))
        if abs(rows[i, 0]) > slope * half * (1.0 + 1e-14) + 1e-15 * abs(rows[i, 0]):
            return True
    det = rows[0, 1] * rows[1, 2] - rows[0, 2] * rows[1, 1]
    if not (det != 0.0 and math.isfinite(det)):
        return False
    y00, y01, y10, y11 = rows[1, 2] / det, -rows[0, 2] / det, -rows[1, 1] / det, rows[0, 1] / det
    q = _contraction(out, y00, y01, y10, y11)
    if not math.isfinite(q):
        return False
    k0 = abs(y00 * rows[0, 0] + y01 * rows[1, 0])
    k1 = abs(y10 * rows[0, 0] + y11 * rows[1, 0])
    return max(k0, k1) > (1.0 + q) * half * (1.0 + 1e-12)


@kernel
def _injective_radius(op, left, right, number, roots, c, s, rows, smallest, boxes, out):
    """Half-width of a box around the zero (c, s) in which Krawczyk's test proves it and no other; 0 if none.

    It is proved where the rounding of U at (c, s), over its slopes, keeps within the box: a U that is 0 in all digits
    next to a double zero has no zero there.
    """
    det = rows[0, 1] * rows[1, 2] - rows[0, 2] * rows[1, 1]
    y00, y01, y10, y11 = rows[1, 2] / det, -rows[0, 2] / det, -rows[1, 1] / det, rows[0, 1] / det
    enclose(op, left, right, number, roots, c, c, s, s, boxes, out)
    first, second = max(abs(out[0, 0]), abs(out[0, 1])), max(abs(out[1, 0]), abs(out[1, 1]))
    step = max(abs(y00) * first + abs(y01) * second, abs(y10) * first + abs(y11) * second)
    radius = 1.0
    while radius > smallest:
        enclose(op, left, right, number, roots, c - radius, c + radius, s - radius, s + radius, boxes, out)
        contraction = _contraction(out, y00, y01, y10, y11)
        if contraction < 0.9:
            return radius if step <= (1.0 - contraction) * radius else 0.0
        radius *= 0.5
    return 0.0


@spliced_kernel
def _cover(now):
    """Write the middles of the boxes with which the search starts; their number and half-width."""
    half = 0.5 * SQUARE_SIDE / FIRST_BOXES
    count = 0
    for i in range(FIRST_BOXES):
        for j in range(FIRST_BOXES):
            now[count, 0], now[count, 1] = SQUARE_LEFT + (2 * i + 1) * half, BELOW + (2 * j + 1) * half
            count += 1
    return count, half


@spliced_kernel
def _quarter(rest, kept, half, now):
    """Write the middles of the quarters, of this half-width, of the boxes that stay undecided; their number."""
    count = 0
    for k in range(kept):
        for i in (-1.0, 1.0):
            for j in (-1.0, 1.0):
                now[count, 0], now[count, 1] = rest[k, 0] + i * half, rest[k, 1] + j * half
                count += 1
    return count


@spliced_kernel
def _is_outside(c, s, half):
    """Whether a box lies outside the disc."""
    gap_c, gap_s = max(abs(c) - half, 0.0), max(abs(s) - half, 0.0)
    return gap_c * gap_c + gap_s * gap_s > 1.0 + 1e-12


@spliced_kernel
def _is_known(found, zeros, c, s, half):
    """Whether all of a box lies where a zero that is found is the only one."""
    known = False
    for i in range(zeros):
        distance = max(abs(found[i, 0] - c), abs(found[i, 1] - s))
        known |= distance + half <= found[i, 2]
    return known


@kernel
def search(op, left, right, number, roots, levels, most, budget, found, rest):
    """Find all zeros of U in the closed disc and a little beyond it; undecided boxes are in `rest` (most, 2)."""
    boxes = np.empty((len(op), 6))
    work = np.empty((len(op), 3))
    seed = np.zeros((4, 3))
    seed[0, 1] = seed[1, 2] = 1.0
    out = np.empty((2, 6))
    rows = np.empty((2, 3))
    at_zero = np.empty((2, 3))
    now = np.empty((4 * most, 2))
    count, half = _cover(now)
    zeros, evaluated = 0, 0
    for level in range(levels):
        kept = 0
        for k in range(count):
            c, s = now[k, 0], now[k, 1]
            if _is_outside(c, s, half) or _is_known(found, zeros, c, s, half):
                continue
            evaluated += 1
            wide = half * (1.0 + 1e-12)
            enclose(op, left, right, number, roots, c - wide, c + wide, s - wide, s + wide, boxes, out)
            seed[0, 0], seed[1, 0] = c, s
            gradients(op, left, right, number, roots, seed, work, rows)
            if _empty(out, rows, wide):
                continue
            ok, zc, zs = _newton(op, left, right, number, roots, c, s, 4.0 * half, work, seed, at_zero)
            if ok:
                new = True
                for i in range(zeros):
                    new &= max(abs(found[i, 0] - zc), abs(found[i, 1] - zs)) > found[i, 2]
                if new:
                    radius = _injective_radius(op, left, right, number, roots, zc, zs, at_zero, 0.1 * half, boxes, out)
                    if radius > 0.0:
                        found[zeros, 0], found[zeros, 1], found[zeros, 2] = zc, zs, radius
                        zeros += 1
                        if max(abs(zc - c), abs(zs - s)) + half <= radius:
                            continue
            rest[kept, 0], rest[kept, 1] = c, s
            kept += 1
            if kept == most or evaluated >= budget or zeros == CAPACITY:
                return zeros, kept, half, False
        if kept == 0 or level == levels - 1:
            return zeros, kept, half, True
        half *= 0.5
        count = _quarter(rest, kept, half, now)
    return zeros, 0, half, True
