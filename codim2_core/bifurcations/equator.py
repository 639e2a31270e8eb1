"""Where limit cycles reach the equator, as curves in (f1, f2): its own change of stability, and loops of half-saddles.

Both functions are even in f (turn the picture by pi), so half of the plane is enough. Both kinds of curve begin where
the saddle-node curve touches the ellipse |A^-1 f| = 1, with lambda_rho = lambda_theta = 0: the closed equator's where
Theta has the sign of b beside that double zero, that of loops elsewhere.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from ..cycles.loop import gap, loops
from ..layer_problem.equator import equator_cycle
from ..layer_problem.linearisation import determinant_sign
from ..numerics.root_between import root_between
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..words import say
from .curve import Array, BifurcationCurve, SpecialPoint, frozen, matrix, place
from .geometry import Geometry

ANGLES, RADII = 24, 10  # of the half disc of critical sets in which changes of sign are looked for
COARSE, FINE = 1e-6, 1e-11  # tolerances there and on the curves
STEP, SHORTEST = 0.03, 1e-3  # of a curve in that disc
MOST = 400
NEAR = 0.03  # a curve that breaks off this close to a corner ends there

ROUNDS, DIFFERENCE, CLOSE, REACH = 12, 1e-6, 1e-9, 0.15  # of the search for a neutral loop, in that disc
FAILED = np.full(2, math.nan)

_NONE = say("no cycles at all")


def coefficients_at(a: float, b: float, d: float, f: Array) -> Coefficients:
    """Coefficients with numbers only."""
    return Coefficients(a, b, d, float(f[0]), float(f[1]), np.zeros((0, 2)), np.zeros(0))


def closed_equator(a: float, b: float, d: float) -> BifurcationCurve:
    """Where the closed equator changes its stability: a limit cycle is born from it, whatever Psi (thm:geneps0(c)).

    The exponent, d times the integral of cos^2/|Theta| plus a times that of sin^2/|Theta|, is zero.

    Parameters
    ----------
    a, b, d : float

    Returns
    -------
    BifurcationCurve
        kind "equator"; it ends where the saddle-node curve touches the ellipse.

    Raises
    ------
    ValueError
        A coefficient is not a finite number.
    """
    a, b, d = matrix(a, b, d)
    label = "thm:geneps0"
    if not a * d < 0.0 or determinant_sign(a, b, d) <= 0:
        return BifurcationCurve("equator", "closed equator: none", label, (), sentence=_NONE)
    plane = Geometry(a, b, d)
    touching = [np.array(plane.saddle_node_at(t)) for t in plane.touching]
    if a == -d:
        line = np.linspace(-1.0, 1.0, 161)[:, None]
        lines = [line * f for f in touching if f[1] > 0.0]
        lines = [f for f in lines if equator_cycle(coefficients_at(a, b, d, f[100])) is not None]
        return BifurcationCurve(
            "equator", "closed equator: reversible", label, frozen(lines),
            sentence=say("reversible, equator"),
        )  # fmt: skip

    A = np.array([[a, -b], [b, d]])
    corners = touching + [np.array(plane.saddle_node_at(pair[0])) for pair in plane.double]

    def exponent(e: Array) -> float:
        found = equator_cycle(coefficients_at(a, b, d, -A @ e))
        return math.nan if found is None else math.atan(found.exponent)

    branches = _curves(exponent, exponent, A, corners)
    sentence = say("equator turns") if branches else say("equator keeps")
    name = "closed equator" if branches else "closed equator: none"
    return BifurcationCurve("equator", name, label, frozen(branches), (), (), sentence)


def heteroclinic(a: float, b: float, d: float, psi: Psi) -> BifurcationCurve:
    """Heteroclinic cycles through the equator: loops of two half-saddles, from which limit cycles are born (sec:case3).

    A homoclinic orbit proper is not possible: the one critical set of an e-linear system lies inside every cycle
    (thm:lineps1, index). A limit cycle dies in a loop of an orbit from a half-saddle Q of the equator to another, P,
    and the arc of the equator from P to Q.

    Parameters
    ----------
    a, b, d : float
    psi : Psi

    Returns
    -------
    BifurcationCurve
        `values` holds the product of both saddles' ratios of eigenvalues: above 1 the loop attracts from inside.
        `special` has the points where it is 1 ("resonant loop": a fold of cycles ends there). A branch that ends where
        no corner is ends on the saddle-node curve, within 1e-3 in A^-1 f.

    Raises
    ------
    ValueError
        A coefficient is not a finite number, or psi is not a Psi.
    """
    a, b, d = matrix(a, b, d)
    if not isinstance(psi, Psi):
        raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
    label = "sec:case3"
    if not a * d < 0.0 or determinant_sign(a, b, d) <= 0:
        return BifurcationCurve("heteroclinic", "heteroclinic: none", label, (), sentence=_NONE)
    plane = Geometry(a, b, d)
    touching = [np.array(plane.saddle_node_at(t)) for t in plane.touching]

    A = np.array([[a, -b], [b, d]])

    def missing(rtol: float) -> Callable[[Array], float]:
        def miss(e: Array) -> float:
            coefficients = coefficients_at(a, b, d, -A @ e)
            arcs = loops(coefficients)
            return math.atan(gap(coefficients, psi, arcs[0], rtol)) if arcs else math.nan

        return miss

    branches = _curves(missing(FINE), missing(COARSE), A, touching)
    values, special = [], []
    for branch in branches:
        e = -np.linalg.solve(A, branch.T).T
        row = np.array([_ratio(a, b, d, f) for f in branch])
        good = np.flatnonzero(np.isfinite(row))
        row = np.interp(np.arange(len(row)), good, row[good])
        values.append(row)
        for i in np.flatnonzero((row[1:] > 1.0) != (row[:-1] > 1.0)):
            at = -A @ _between(missing(FINE), lambda v: _ratio(a, b, d, -A @ v) - 1.0, e[i], e[i + 1])
            text = say("neutral loop")
            special.append(SpecialPoint("resonant loop", place(at), text))
    sentence = say("loop through the equator") if branches else say("no loop")
    name = "heteroclinic cycle through the equator" if branches else "heteroclinic: none"
    return BifurcationCurve("heteroclinic", name, label, frozen(branches), tuple(special), frozen(values), sentence)


def neutral_loop(a: float, b: float, d: float, psi: Psi, f: Array) -> Array | None:
    """Find the loop through the equator nearby whose ratio is 1, where a fold of cycles ends; None if none is found.

    Newton's method for both conditions in A^-1 f.

    Parameters
    ----------
    a, b, d : float
    psi : Psi
    f : ndarray (2,)
        Where to begin.

    Returns
    -------
    ndarray (2,) or None
    """
    A = np.array([[a, -b], [b, d]])

    def misses(e: Array) -> Array:
        coefficients = coefficients_at(a, b, d, -A @ e)
        arcs = loops(coefficients) if float(e @ e) < 1.0 else ()
        return np.array([gap(coefficients, psi, arcs[0], FINE), math.log(arcs[0].ratio)]) if arcs else FAILED

    e, last = np.asarray(-np.linalg.solve(A, f), float), math.inf
    for _ in range(ROUNDS):
        here = misses(e)
        slopes = np.stack([(misses(e + DIFFERENCE * v) - here) / DIFFERENCE for v in np.eye(2)], axis=1)
        if not np.isfinite(slopes).all() or np.linalg.det(slopes) == 0.0:
            return None
        change = -np.asarray(np.linalg.solve(slopes, here), float)
        size = float(np.abs(change).max())
        if size > min(2.0 * last, REACH):
            return None
        e, last = e + change, size
        if size < CLOSE:
            return np.asarray(-A @ e, float)
    return None


def _ratio(a: float, b: float, d: float, f: Array) -> float:
    arcs = loops(coefficients_at(a, b, d, f))
    return arcs[0].ratio if arcs else math.nan


def _between(function: Callable[[Array], float], measure: Callable[[Array], float], one: Array, two: Array) -> Array:
    """Find the point of a curve between two neighbours on it where a measure of points is zero."""
    along = two - one
    normal = np.array([-along[1], along[0]])

    def point(t: float) -> Array:
        middle = one + t * along
        slope = (function(middle + 1e-4 * normal) - function(middle - 1e-4 * normal)) / 2e-4
        found = _crossing(function, middle, normal, slope, 1.0)
        return middle if found is None else found[0]

    return point(root_between(lambda t: measure(point(t)), 0.0, 1.0, 1e-10))


def _curves(
    function: Callable[[Array], float], rough: Callable[[Array], float], A: Array, corners: list[Array]
) -> list[Array]:
    """All curves through changes of sign seen in the disc of critical sets, in f, with their mirror images at -f.

    The functions are of e = -A^-1 f: in the disc all directions count alike, however narrow the ellipse is.
    """
    ends = [np.asarray(-np.linalg.solve(A, f), float) for f in corners]
    radii = np.sin(0.5 * math.pi * (np.arange(RADII) + 1.0) / (RADII + 1.0))
    found: list[Array] = []
    for angle in np.linspace(0.0, math.pi, ANGLES, endpoint=False):
        places = radii[:, None] * (math.cos(angle), math.sin(angle))
        values = [rough(e) for e in places]
        for i in range(len(places) - 1):
            if not values[i] * values[i + 1] < 0.0:
                continue
            low, along = places[i], places[i + 1] - places[i]
            e = low + root_between(lambda t, p=low, v=along: function(p + t * v), 0.0, 1.0, 1e-13) * along
            if any(_passes(curve, e) for curve in found):
                continue
            curve = _curve(function, e, ends)
            if curve is not None:
                found += [curve] if _passes(curve, -e) else [curve, -curve]
    return [-curve @ A.T for curve in found]


def _passes(curve: Array, e: Array) -> bool:
    start, along = curve[:-1], np.diff(curve, axis=0)
    part = np.clip(((e - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    return float(np.hypot(*(start + part[:, None] * along - e).T).min()) < 0.2 * STEP


def _curve(function: Callable[[Array], float], e: Array, ends: list[Array]) -> Array | None:
    """Follow the curve through a zero both ways."""
    h = 1e-5 * np.eye(2)
    slope = np.array([function(e + h[k]) - function(e - h[k]) for k in (0, 1)]) / 2e-5
    steep = math.hypot(*slope)
    if not 0.0 < steep < math.inf or abs(function(e)) > 1e-3:
        return None
    normal = slope / steep
    ahead, closed = _followed(function, e, normal, steep, ends)
    if closed:
        return np.array([e, *ahead, e])
    behind, _ = _followed(function, e, -normal, -steep, ends)
    return np.array([*behind[::-1], e, *ahead])


def _followed(
    function: Callable[[Array], float], start: Array, normal: Array, slope: float, ends: list[Array]
) -> tuple[list[Array], bool]:
    """Points from a start, to the right of `normal`, until the function is no longer defined; whether it came round."""
    tangent = np.array([normal[1], -normal[0]])
    points, step = [start], 0.2 * STEP
    while len(points) < MOST:
        here = points[-1]
        found = _crossing(function, here + step * tangent, np.array([-tangent[1], tangent[0]]), slope, step)
        after, steep = found or (here, slope)
        turn = (after - here) / max(math.hypot(*(after - here)), 1e-300)
        if float(turn @ tangent) < 0.95:
            step *= 0.5
            if step < SHORTEST:
                break
            continue
        tangent, slope = turn, steep
        points.append(after)
        if len(points) > 8 and math.hypot(*(after - start)) < 0.7 * step:
            return points[1:-1], True
        step = min(1.5 * step, STEP)
    end = min(ends, key=lambda t: math.hypot(*(t - points[-1])), default=None)
    if end is not None and math.hypot(*(end - points[-1])) < NEAR:
        points.append(end)
    return points[1:], False


def _crossing(
    function: Callable[[Array], float], middle: Array, normal: Array, slope: float, step: float
) -> tuple[Array, float] | None:
    """Zero on the line through `middle` along `normal`, and the slope there: the secant rule from a known slope."""
    t, value = 0.0, function(middle)
    for _ in range(8):
        change = -value / slope
        if not abs(t + change) < step:
            return None
        after = function(middle + (t + change) * normal)
        if not math.isfinite(after):
            return None
        if after != value and change != 0.0:
            slope = (after - value) / change
        t, value = t + change, after
        if abs(value) <= abs(slope) * 1e-11 or abs(change) < 1e-11:
            return middle + t * normal, slope
    return None
