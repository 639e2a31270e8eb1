"""Limit cycles of the layer problem of any system, by the first turn of orbits about its critical sets.

A closed orbit surrounds critical sets whose indices add up to 1, so at least one that is no saddle. From each of these
a ray runs to the equator. The angle about its foot grows by 2 pi along a closed orbit around it, so the orbit has a
point on the ray from which it has first turned by 2 pi exactly when it is back: a fixed point of the map that takes a
point of the ray to where its orbit is after its first turn. Conversely, every fixed point is a closed orbit.

The map is sampled, forward and backward in time, and closer where its displacement changes sign, comes near zero, jumps
(on an orbit that meets a saddle) or ends. Two cycles so close together that no sample falls between them, nor shows
them near, can be missed: the result says so.
"""

from __future__ import annotations

import numpy as np

from ..layer_problem.critical import critical_sets
from ..psi.function import Psi
from ..systems.frozen import AtZ
from .orbit import Orbit, orbit
from .section import FINE, Crossing
from .turn_section import Array, TurnSection

BAND = 1e-9  # |ln multiplier| at which a closed orbit is one of a band
CLOSED = 1e-7  # distance on the sphere between start and end at which an orbit is closed
SAME = 1e-5  # distance in the disc between cycles found twice
ON = 1e-7  # distance in the disc from a cycle of a fixed point that belongs to it
FINER, ROUNDS, MOST = 15, 5, 12  # samples between two, rounds, and places in a round, of looking closer
NARROW, NARROW_SMOOTH = 1e-7, 1e-3  # and the widths at which that ends
TOUCHING = 1e-7  # displacement at an extremum that is a cycle touched: a fold, within resolution
MOST_ROUNDS = 40  # of narrowing one place
JUMP = 4.0  # times the steps beside it: a step of the displacement that is a jump
SMOOTH = 1e-6  # displacement left at a fixed point that is none but a jump
MOST_FEET = 12

BAND_NOTE = "Closed orbits fill a band (a centre): those are not counted as limit cycles."
HOW = (
    "from the first turn of orbits about {}, sampled and refined on a ray to the equator; cycles closer together than "
    "the samples can be missed."
)
NO_CRITICAL_SET = (
    "No limit cycle: no critical set lies on the hemisphere, and a closed orbit would have to surround one (index)."
)
ONLY_SADDLES = (
    "No limit cycle: all critical sets are saddles, and the equilibria inside a closed orbit have indices that add up "
    "to 1."
)


def find(at: AtZ, psi: Psi) -> tuple[list[tuple[Crossing, Orbit, int]], str, tuple[str, ...]]:
    """Search for limit cycles.

    Parameters
    ----------
    at : Frozen
    psi : Psi

    Returns
    -------
    cycles : list of (Crossing, Orbit, sense)
        sense is +1 anticlockwise, -1 clockwise.
    reason : str
        Why there is none, or how those there are were found.
    notes : tuple of str
    """
    critical = critical_sets(at, psi)
    if not critical:
        return [], NO_CRITICAL_SET, ()
    feet = [C for C in critical if C.kind != "saddle"]
    if not feet:
        return [], ONLY_SADDLES, ()
    found: list[tuple[Crossing, Orbit, int]] = []
    notes: list[str] = []
    if len(feet) > MOST_FEET:
        notes.append(
            f"Searched about {MOST_FEET} of {len(feet)} critical sets only: cycles around others may be missing."
        )
        feet = sorted(feet, key=lambda C: C.discriminant)[:MOST_FEET]  # where orbits turn fastest
    for C in feet:
        section = TurnSection(at, psi, C, critical)
        crossings, said = _searched(section)
        notes += said
        for crossing in crossings:
            if any(_on(section, crossing, other) for _, other, _ in found):
                continue
            closed = orbit(section, crossing)
            if closed is None or closed.closure > CLOSED:
                notes.append("A fixed point of the first turn was found whose orbit could not be closed.")
            elif abs(closed.divergence) < BAND and not crossing.touching:
                notes.append(BAND_NOTE)
            elif not any(_same(closed, other) for _, other, _ in found):
                found.append((crossing, closed, _sense(closed.points)))
    count = f"{len(found)} limit cycle{'' if len(found) == 1 else 's'}" if found else "No limit cycle found"
    names = "the critical set" if len(critical) == 1 else "the critical sets that are no saddles"
    return found, f"{count}, {HOW.format(names)}", tuple(dict.fromkeys(notes))


def _searched(section: TurnSection) -> tuple[list[Crossing], list[str]]:
    """Find fixed points on one ray, innermost first, and what is nearly degenerate."""
    xi, shift = _resolved(section, False)
    finite, notes = np.isfinite(shift), []
    if finite.sum() >= 8 and not shift[finite].any():
        return [], [BAND_NOTE]
    if np.isnan(shift).any():
        notes.append("Some orbits were not followed to a decision: they pass an equilibrium too slowly.")
    C = section.critical
    if finite[0] and C.discriminant < 0.0 and shift[0] * C.trace < 0.0:
        notes.append("A cycle too small to resolve surrounds a critical set: it was just born in a Hopf bifurcation.")
    vertices = [_vertex(xi, shift, i) for i in _extrema(shift)]
    touching = np.abs(section.displacement(np.array(vertices), FINE)) < TOUCHING if vertices else []
    out = [Crossing(at, touching=True) for at, touches in zip(vertices, touching, strict=True) if touches]
    for backward in (False, True):
        if backward:
            xi, shift = _resolved(section, True)
        for i in _brackets(shift, attracting=True):
            out += [Crossing(at, backward) for at in _narrowed(section, float(xi[i]), float(xi[i + 1]), backward)]
    return sorted(out, key=lambda crossing: crossing.xi), notes


def _brackets(shift: Array, attracting: bool) -> list[int]:
    """Places i where the displacement changes sign (downwards: attracting) between samples i and i + 1."""
    finite = np.isfinite(shift[1:]) & np.isfinite(shift[:-1])
    down, up = (shift[:-1] > 0.0) & (shift[1:] <= 0.0), (shift[:-1] <= 0.0) & (shift[1:] > 0.0)
    return np.flatnonzero(finite & (down if attracting else down | up)).tolist()


def _jumps(xi: Array, shift: Array) -> list[int]:
    """Places i where the displacement jumps, or ends, between samples i and i + 1."""
    finite = np.isfinite(shift)
    step = np.abs(np.diff(np.where(finite, shift, 0.0)))
    step[~(finite[1:] & finite[:-1])] = 0.0
    slope = step / np.diff(xi)
    beside = np.maximum(np.r_[0.0, slope[:-1]], np.r_[slope[1:], 0.0])
    return np.flatnonzero((finite[1:] != finite[:-1]) | ((slope > JUMP * beside) & (step > 1e-3))).tolist()


def _extrema(shift: Array) -> list[int]:
    """Places i where the displacement comes near zero and turns back."""
    finite = np.isfinite(shift)
    known = np.where(finite, shift, 0.0)
    left, here, right = np.abs(known[:-2]), np.abs(known[1:-1]), np.abs(known[2:])
    near = finite[:-2] & finite[1:-1] & finite[2:] & (known[:-2] * known[2:] >= 0.0)
    near &= (here <= np.minimum(left, right)) & (2.0 * here <= np.maximum(left, right) + TOUCHING)
    near &= here < np.maximum(left, right)
    return (np.flatnonzero(near) + 1).tolist()


def _vertex(xi: Array, shift: Array, i: int) -> float:
    """Place of the extremum of the parabola through samples i - 1, i, i + 1."""
    before, after = xi[i - 1] - xi[i], xi[i + 1] - xi[i]
    left, right = (shift[i - 1] - shift[i]) / before, (shift[i + 1] - shift[i]) / after
    curvature = (right - left) / (after - before)
    return float(xi[i] - 0.5 * (left - curvature * before) / curvature) if curvature != 0.0 else float(xi[i])


def _resolved(section: TurnSection, backward: bool) -> tuple[Array, Array]:
    """Sample the displacement, closer where it changes sign, comes near zero, jumps or ends."""
    xi = section.grid()
    shift = section.displacement(xi, backward=backward)
    for _ in range(ROUNDS):
        smooth = [*_brackets(shift, attracting=False), *(k for i in _extrema(shift) for k in (i - 1, i))]
        places = {i for i in smooth if xi[i + 1] - xi[i] > NARROW_SMOOTH}
        places |= {i for i in _jumps(xi, shift) if xi[i + 1] - xi[i] > NARROW}
        places = sorted(places)[:MOST]
        if not places:
            break
        new = np.concatenate([np.linspace(xi[i], xi[i + 1], FINER + 2)[1:-1] for i in places])
        xi = np.concatenate([xi, new])
        shift = np.concatenate([shift, section.displacement(new, backward=backward)])
        order = np.argsort(xi, kind="stable")
        xi, shift = xi[order], shift[order]
    return xi, shift


def _narrowed(section: TurnSection, low: float, high: float, backward: bool) -> list[float]:
    """Find the fixed points between two samples, apart from jumps of the displacement through zero."""
    found: list[float] = []
    width = high - low  # the two tolerances need not agree on where it is: look a little beyond
    open_ = [(low - 0.5 * width, high + 0.5 * width)]
    for _ in range(MOST_ROUNDS):
        if not open_:
            break
        low, high = open_.pop()
        xi = np.linspace(low, high, 32)
        shift = section.displacement(xi, FINE, backward)
        for i in _brackets(shift, attracting=True):
            left, right = float(shift[i]), float(shift[i + 1])
            if right == 0.0:
                found.append(float(xi[i + 1]))
            elif xi[i + 1] - xi[i] > 1e-13 * max(1.0, abs(high)):
                open_.append((float(xi[i]), float(xi[i + 1])))
            elif left - right < SMOOTH:
                found.append(float(xi[i] + (xi[i + 1] - xi[i]) * left / (left - right)))
    return found


def _on(section: TurnSection, crossing: Crossing, other: Orbit) -> bool:
    """Whether a fixed point lies on a cycle that is known."""
    p = section.states(np.array([crossing.xi]))[0][0, :2]
    start, along = other.points[:-1], np.diff(other.points, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-300)
    part = np.clip(((p - start) * along).sum(axis=1) / length, 0.0, 1.0)
    return bool(np.hypot(*(start + part[:, None] * along - p).T).min() < ON)


def _sense(points: Array) -> int:
    x, y = points[:-1].T
    return 1 if float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0.0 else -1


def _same(one: Orbit, other: Orbit) -> bool:
    if abs(one.period - other.period) > 1e-6 * one.period:
        return False
    gaps = np.hypot(*(one.points[:1] - other.points).T)
    spacing = np.hypot(*np.diff(other.points, axis=0).T).max()
    return bool(gaps.min() < SAME + spacing)
