"""Fixed points of the return map on a global section; see `cycles` for the section.

The section is ``e = e_C + r u``, ``r = R/(1 + exp(-xi))`` with R where it meets the equator; xi is a parameter of
it that resolves both ends. A point is measured by ``q = ln u.(x2 - x2_C)``, which increases along the section, and
the displacement is ``q(after one turn) - q``: -inf where the orbit goes to C, +inf where it goes to the equator.
"""

from __future__ import annotations

import math

import numpy as np

from .section import COARSE, FINE, INNER, Array, Crossing, Section

ROUNDS, POINTS = 8, 31  # of refinement
CLOSE = 1e-3  # width at which a jump from -inf to +inf is left to the map backward in time
MOST, UNDECIDED = 96, 0.25  # samples added in a round; share of undecided ones at which looking closer is in vain
NOISE = 1e-8  # displacement that COARSE cannot tell from zero
FINE_NOISE = 1e-11  # and FINE
NEAR_LOOP = 1e-3
MEASURED, SMALLEST = 2.0, 1e-8  # where the expansion at C is measured, in INNER; the smallest cycle, in r/R


def _between(low: float, high: float, count: int) -> Array:
    return low + (high - low) * np.arange(1, count + 1) / (count + 1)


def _settled(shift: Array, inner: int, step: int) -> bool:
    """Whether the displacement has all but reached its limit where orbits stop returning, well away from zero.

    Past a saddle it converges like a power of the distance; over the last samples that distance fell fourfold.
    """
    last = 3 * step + inner
    if not 0 <= last < len(shift):
        return False
    y, before = shift[inner], shift[last]
    return bool(np.isfinite(before) and abs(y) > 8.0 * abs(y - before))


def _wanted(xi: Array, shift: Array) -> list[Array]:
    """Where to look closer: ends of the interval that returns, and places where the displacement nearly vanishes."""
    new = []
    finite = np.isfinite(shift)
    for i in range(len(xi) - 1):
        width = xi[i + 1] - xi[i]
        if width <= 1e-12 * max(1.0, abs(xi[i])):
            continue
        if finite[i] != finite[i + 1]:
            # Where it returns next to where it leaves: a fixed point may hide in the gap, before the displacement
            # jumps to +inf; to -inf, on C, it goes continuously.
            inner, outer, step = (i, i + 1, -1) if finite[i] else (i + 1, i, 1)
            hidden = shift[outer] > 0.0 or (np.isinf(shift[outer]) and shift[inner] > 0.0)
            if hidden and not (width < 0.05 and _settled(shift, inner, step)):
                new.append(_between(xi[i], xi[i + 1], POINTS))
        elif width > CLOSE and np.isinf(shift[i]) and shift[i + 1] == -shift[i]:
            new.append(_between(xi[i], xi[i + 1], POINTS))
    for i in range(1, len(xi) - 1):
        y0, y1, y2 = shift[i - 1 : i + 2]
        if not (finite[i - 1] and finite[i] and finite[i + 1]) or y1 == 0.0:
            continue
        s = math.copysign(1.0, y1)
        y0, y1, y2 = s * y0, s * y1, s * y2
        if not (0.0 < y1 <= y0 and y1 <= y2):
            continue
        # An extremum towards zero: could it reach zero between the samples?
        depth = max(y0, y2) - y1
        if y1 < depth + NOISE and xi[i + 1] - xi[i - 1] > 1e-6:
            new += [_between(xi[i - 1], xi[i], 5), _between(xi[i], xi[i + 1], 5)]
    return new


def _sampled(section: Section, backward: bool) -> tuple[Array, Array]:
    xi = section.grid()
    shift = section.displacement(xi, backward=backward)
    for _ in range(ROUNDS):
        new = _wanted(xi, shift)
        if not new or np.isnan(shift).mean() > UNDECIDED:
            break
        more = np.concatenate(new)[:MOST]
        xi = np.concatenate([xi, more])
        shift = np.concatenate([shift, section.displacement(more, backward=backward)])
        order = np.argsort(xi, kind="stable")
        xi, shift = xi[order], shift[order]
    return xi, shift


def _polished(section: Section, low: float, high: float, backward: bool) -> float:
    """Find the fixed point between two samples of opposite sign: rounds of samples, then interpolation."""
    for _ in range(8):
        xi = np.concatenate([[low], _between(low, high, 30), [high]])
        shift = section.displacement(xi, COARSE, backward)
        changes = np.flatnonzero((shift[1:] < 0.0) != (shift[:-1] < 0.0))
        i = int(changes[0]) if len(changes) else len(xi) // 2
        low, high = float(xi[i]), float(xi[i + 1])
        if high - low < 1e-3 and np.isfinite(shift[max(i - 2, 0) : i + 4]).all():
            break
    width = high - low
    x = low + width * np.array([-2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
    y = section.displacement(x, FINE, backward)
    if not np.isfinite(y).all() or len(np.unique(y)) < len(y):
        return 0.5 * (low + high)
    # Lagrange's polynomial for the parameter as a function of the displacement, at zero.
    guess = sum(
        float(x[j]) * math.prod(float(-y[k] / (y[j] - y[k])) for k in range(len(y)) if k != j) for j in range(len(y))
    )
    return guess if low - width <= guess <= high + width else 0.5 * (low + high)


def _newborn(section: Section) -> Crossing | None:
    """Place a cycle below the innermost sample: ``displacement = 2 pi mu/omega + c r^2``, its first term exact.

    c is measured well outside the cycle, where rounding (1e-16/r) does not matter yet; what is left is of order r^2.
    None below `SMALLEST`, where the trace of J has lost its digits.
    """
    C = section.critical
    linear = 2.0 * math.pi * C.trace / math.sqrt(-C.discriminant)
    r = INNER * MEASURED * np.array([1.0, 2.0, 4.0])
    parts = (section.displacement(np.log(r / (1.0 - r)), FINE) - linear) / r**2
    square = float(parts @ (8.0, -6.0, 1.0)) / 3.0  # takes out the next two powers of r
    if not square * linear < 0.0:
        return None
    size = math.sqrt(-linear / square)
    if not SMALLEST <= size < 2.0 * INNER:
        return None
    return Crossing(math.log(size / (1.0 - size)), square > 0.0, born=True)


def search(section: Section) -> tuple[tuple[Crossing, ...], tuple[str, ...]]:
    """All fixed points, innermost first, and notes on what is nearly degenerate.

    Parameters
    ----------
    section : Section
    """
    found: list[Crossing] = []
    notes: list[str] = []
    xi, shift = _sampled(section, backward=False)
    finite = np.isfinite(shift)
    if finite.sum() >= 8 and np.abs(shift[finite]).max() < NOISE:
        return (), ("The return map is the identity within resolution: closed orbits fill a band (a centre).",)
    if np.isnan(shift).any():
        notes.append("Some orbits were not followed to a decision: they pass an equilibrium too slowly.")
    known = ~np.isnan(shift)
    xi, shift, finite = xi[known], shift[known], finite[known]
    doubtful = finite & (np.abs(shift) < NOISE)
    if doubtful.any():
        shift[doubtful] = section.displacement(xi[doubtful], FINE)
    for i in range(len(xi) - 1):
        y, after = float(shift[i]), float(shift[i + 1])
        if (y < 0.0) == (after < 0.0):
            continue
        low, high = float(xi[i]), float(xi[i + 1])
        repelling = y < 0.0  # then it attracts backward, and is found and followed backward
        both = finite[i] and finite[i + 1]
        if not both and repelling:
            # It may be so repelling that forward no sample beside it returns.
            back = section.displacement(np.array([low, high]), backward=True)
            both = bool(back[0] > 0.0 > back[1])
        if both:
            found.append(Crossing(_polished(section, low, high, repelling), repelling))
    last = shift[:-1][finite[:-1] & (shift[1:] == np.inf)]
    notes += [
        f"Near a loop through the equator: the last orbit that returns misses its start by {y:.1e} in ln|x₂ − C|; "
        "beyond it orbits go to the equator."
        for y in last.tolist()
        if abs(y) < NEAR_LOOP
    ]
    for i in range(1, len(xi) - 1):
        y0, y1, y2 = (float(v) for v in shift[i - 1 : i + 2])
        if not np.isfinite([y0, y1, y2]).all() or (y0 < 0.0) != (y1 < 0.0) or (y1 < 0.0) != (y2 < 0.0):
            continue
        if abs(y1) <= min(abs(y0), abs(y2)) and abs(y1) < FINE_NOISE and float(xi[i]) > math.log(100.0 * INNER):
            found.append(Crossing(float(xi[i]), touching=True))
    trace = section.critical.trace
    if finite.any() and finite[0] and section.critical.discriminant < 0.0 and shift[0] * trace < 0.0:
        newborn = _newborn(section)
        if newborn is not None:
            found.append(newborn)
        else:
            notes.append("A cycle too small to resolve surrounds C: it was just born in a Hopf bifurcation.")
    return tuple(sorted(found, key=lambda crossing: crossing.xi)), tuple(notes)
