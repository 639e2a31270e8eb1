"""Curves in (f1, f2) on which limit cycles reach the equator: its change of stability, and loops of half-saddles.

The equator is closed where sign(b) Theta > 0 at all theta, and Theta is affine in f: for f in a convex set. On its
border, a part of the saddle-node curve, the exponent is infinite, with the sign of lambda_rho at the double zero of
Theta: a curve of neutral equators ends at each place of the border where that sign changes, which it does where the
saddle-node curve touches the ellipse |A^-1 f| = 1, lambda_rho = lambda_theta = 0, and may do where it crosses itself,
in a corner. The curves of loops begin where it touches the ellipse elsewhere. Their function is even in f (turn the
picture by pi), so half of the plane is enough.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ..curves.arclength import StepBounds, trace_curve, zero_between
from ..curves.newton import finite_differences, newton
from ..curves.polyline import distance
from ..cycles.heteroclinic_arcs import HeteroclinicArc, heteroclinic_arcs
from ..cycles.heteroclinic_cycle import loop_gap
from ..layer_problem.equator import equator_cycle
from ..layer_problem.linearisation import determinant_sign
from ..layer_problem.problem import LayerProblem
from ..numerics.root_between import root_between
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear
from ..words import say
from .curve import Array, BifurcationCurve, SpecialPoint, matrix, plain_point, read_only_lines
from .geometry import Geometry

BORDER_TANGENTS, THETA_ANGLES = (
    1440,
    256,
)  # tangents to the border of closed equators, and angles at which Theta is looked at
CHORD_SPREADS = (
    30,
    10,
    3,
    0,
)  # tangents between which a chord of that border is drawn, on either side of a change of sign
CHORD_INSET = 1e-6  # part of a chord of that border, from its ends, within which the exponent is not computed
NET_ANGLES, NET_RADII = 24, 10  # of the half disc of critical sets in which loops are looked for by changes of sign
COARSE_RTOL, FINE_RTOL = 1e-6, 1e-11  # tolerances there and on the curves
CURVE_STEP = 0.03  # of a curve in that disc
EQUATOR_STEP_BOUNDS = StepBounds(CURVE_STEP, 0.12, 400, close=1e-10, least=1e-5)
LOOP_STEP_BOUNDS = StepBounds(CURVE_STEP, 0.3, 400, close=1e-9, least=1e-3)
CORNER_DISTANCE = 0.03  # a curve that breaks off this close to a corner ends there

DIFFERENCE_STEP, LOOP_TOLERANCE, MAX_SEED_ERROR = 1e-6, 1e-9, 0.15  # of the search for a neutral loop, in that disc
FAILED = np.full(2, math.nan)

_NONE = say("no cycles at all")


def coefficients_at(a: float, b: float, d: float, f: Sequence[float] | Array) -> Coefficients:
    """Coefficients with numbers only."""
    return Coefficients(a, b, d, float(f[0]), float(f[1]), np.zeros((0, 2)), np.zeros(0))


def closed_equator(system: ELinear | Coefficients, z: ArrayLike = ()) -> BifurcationCurve:
    """Return the curve on which the closed equator changes stability and emits a limit cycle (Theorem 3.1(c)).

    The exponent, d times the integral of cos^2/|Theta| plus a times that of sin^2/|Theta|, is zero.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        kind "equator"; it ends where the saddle-node curve touches the ellipse.

    Raises
    ------
    ValueError
        z does not fit the system.

    Examples
    --------
    >>> from codim2_core import ELinear, bifurcations
    >>> curve = bifurcations.closed_equator(ELinear(-1, 2, 1))
    >>> curve.name
    'closed equator: reversible'
    """
    a, b, d = matrix(system, z)
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
            "equator", "closed equator: reversible", label, read_only_lines(lines),
            sentence=say("reversible, equator"),
        )  # fmt: skip

    A = np.array([[a, -b], [b, d]])
    corners = touching + [np.array(plane.saddle_node_at(pair[0])) for pair in plane.double]

    def mean(e: Array) -> float:
        """Mean of lambda_rho over the time of a turn."""
        found = equator_cycle(coefficients_at(a, b, d, -A @ e))
        return math.nan if found is None else found.exponent / found.period

    branches = _border_curves(mean, EQUATOR_STEP_BOUNDS, _on_border(plane, mean, A), A, corners)
    sentence = say("equator turns") if branches else say("equator keeps")
    name = "closed equator" if branches else "closed equator: none"
    return BifurcationCurve("equator", name, label, read_only_lines(branches), (), (), sentence)


def heteroclinic(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> BifurcationCurve:
    """Heteroclinic cycles through the equator: loops of two half-saddles, which bear limit cycles (Section 4.3.3).

    A homoclinic orbit proper is not possible: the one critical set of an e-linear system lies inside every cycle
    (Theorem 4.1, index). A limit cycle dies in a loop of an orbit from a half-saddle Q of the equator to another, P,
    and the arc of the equator from P to Q.

    Parameters
    ----------
    system : ELinear, or Coefficients
        Its f does not matter.
    psi : Psi
    z : (m,) floats

    Returns
    -------
    BifurcationCurve
        `values` holds the product of both saddles' ratios of eigenvalues: above 1 the loop attracts from inside.
        `special` has the points where it is 1 ("resonant loop": a fold of cycles ends there). A branch that ends where
        no corner is ends on the saddle-node curve, within 1e-3 in A^-1 f.

    Raises
    ------
    ValueError
        z does not fit the system, or psi is not a Psi.

    Examples
    --------
    >>> from codim2_core import bifurcations
    >>> bifurcations.heteroclinic("case1-cm4").name
    'heteroclinic: none'
    """
    a, b, d = matrix(system, z)
    if not isinstance(psi, Psi):
        raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
    label = "sec:case3"
    if not a * d < 0.0 or determinant_sign(a, b, d) <= 0:
        return BifurcationCurve("heteroclinic", "heteroclinic: none", label, (), sentence=_NONE)
    plane = Geometry(a, b, d)
    touching = [np.array(plane.saddle_node_at(t)) for t in plane.touching]

    A = np.array([[a, -b], [b, d]])

    def gap_function(rtol: float) -> Callable[[Array], float]:
        def miss(e: Array) -> float:
            problem = LayerProblem(coefficients_at(a, b, d, -A @ e), psi)
            arc = _loop_arc(problem)
            return math.nan if arc is None else math.atan(loop_gap(problem, problem.critical[0], arc, rtol))

        return miss

    sought = _sign_changes(gap_function(COARSE_RTOL), gap_function(FINE_RTOL))
    branches = _border_curves(gap_function(FINE_RTOL), LOOP_STEP_BOUNDS, sought, A, touching)
    condition = finite_differences(gap_function(FINE_RTOL), DIFFERENCE_STEP)
    values, special = [], []
    for branch in branches:
        e = -np.linalg.solve(A, branch.T).T
        row = np.array([_ratio(a, b, d, f, psi) for f in branch])
        good = np.flatnonzero(np.isfinite(row))
        row = np.interp(np.arange(len(row)), good, row[good])
        values.append(row)
        for i in np.flatnonzero((row[1:] > 1.0) != (row[:-1] > 1.0)):
            at = -A @ zero_between(condition, lambda v: _ratio(a, b, d, -A @ v, psi) - 1.0, e[i], e[i + 1])
            text = say("neutral loop")
            special.append(SpecialPoint("resonant loop", plain_point(at), text))
    sentence = say("loop through the equator") if branches else say("no loop")
    name = "heteroclinic cycle through the equator" if branches else "heteroclinic: none"
    return BifurcationCurve(
        "heteroclinic", name, label, read_only_lines(branches), tuple(special), read_only_lines(values), sentence
    )


def neutral_loop(a: float, b: float, d: float, psi: Psi, f: Array) -> Array | None:
    """Find the loop through the equator nearby whose ratio is 1, where a fold of cycles ends; None if none is found.

    Newton's method for both conditions in A^-1 f.

    Shapes: z (m,), f (2,).
    """
    A = np.array([[a, -b], [b, d]])

    def misses(e: Array) -> Array:
        problem = LayerProblem(coefficients_at(a, b, d, -A @ e), psi)
        arc = _loop_arc(problem) if float(e @ e) < 1.0 else None
        if arc is None:
            return FAILED
        return np.array([loop_gap(problem, problem.critical[0], arc, FINE_RTOL), math.log(arc.ratio)])

    def both(e: Array) -> tuple[Array, Array]:
        here = misses(e)
        return here, np.stack([(misses(e + DIFFERENCE_STEP * v) - here) / DIFFERENCE_STEP for v in np.eye(2)], axis=1)

    e = newton(both, np.asarray(-np.linalg.solve(A, f), float), MAX_SEED_ERROR, LOOP_TOLERANCE)
    return None if e is None else np.asarray(-A @ e, float)


def _ratio(a: float, b: float, d: float, f: Array, psi: Psi) -> float:
    arc = _loop_arc(LayerProblem(coefficients_at(a, b, d, f), psi))
    return math.nan if arc is None else arc.ratio


def _loop_arc(problem: LayerProblem) -> HeteroclinicArc | None:
    """Return the arc of a loop about the critical set, about which orbits turn in the sense of b; None without any."""
    form, arcs = problem.at.normal_form, heteroclinic_arcs(problem) if problem.critical else ()
    sense = 1 if form is not None and form.b > 0.0 else -1
    return next((arc for arc in arcs if arc.sense == sense), None)


def _on_border(plane: Geometry, mean: Callable[[Array], float], A: Array) -> Iterator[Array]:
    """Places e = -A^-1 f on the curves of neutral equators, each beside one of their ends."""
    theta = 2.0 * math.pi * (np.arange(BORDER_TANGENTS) + 0.37) / BORDER_TANGENTS
    turn = 2.0 * math.pi * np.arange(THETA_ANGLES) / THETA_ANGLES
    c, s = np.cos(turn), np.sin(turn)
    f = plane.saddle_node(theta)
    turning = (plane.b - plane.k * s * c + f[:, 1:] * c - f[:, :1] * s) * math.copysign(1.0, plane.b)
    rows = np.flatnonzero(turning.min(axis=1) > -1e-9 * plane.size)
    radial = plane.d * np.cos(theta) ** 2 + plane.a * np.sin(theta) ** 2
    e = -np.linalg.solve(A, f.T).T
    for k in range(len(rows)):
        # the longest chord about a change of sign that cuts off no other
        for wide in CHORD_SPREADS:
            i, *between, j = np.take(rows, range(k - wide, k + 2 + wide), mode="wrap").tolist()
            signs = np.sign(radial[[i, *between, j]])
            if (signs[: wide + 1] == signs[0]).all() and (signs[wide + 1 :] == -signs[0]).all():
                low, along = e[i] + CHORD_INSET * (e[j] - e[i]), (1.0 - 2.0 * CHORD_INSET) * (e[j] - e[i])
                yield low + root_between(lambda t, p=low, v=along: mean(p + t * v), 0.0, 1.0, 1e-13) * along
                break


def _sign_changes(rough: Callable[[Array], float], function: Callable[[Array], float]) -> Iterator[Array]:
    """Zeros in half of the disc of critical sets, on the rays on which a rough function changes its sign."""
    radii = np.sin(0.5 * math.pi * (np.arange(NET_RADII) + 1.0) / (NET_RADII + 1.0))
    for angle in np.linspace(0.0, math.pi, NET_ANGLES, endpoint=False):
        places = radii[:, None] * (math.cos(angle), math.sin(angle))
        values = [rough(e) for e in places]
        for i in range(len(places) - 1):
            if values[i] * values[i + 1] < 0.0:
                low, along = places[i], places[i + 1] - places[i]
                yield low + root_between(lambda t, p=low, v=along: function(p + t * v), 0.0, 1.0, 1e-13) * along


def _border_curves(
    function: Callable[[Array], float], steps: StepBounds, starts: Iterator[Array], A: Array, corners: list[Array]
) -> list[Array]:
    """All curves through some zeros, in f, with their mirror images at -f.

    The functions are of e = -A^-1 f: in the disc all directions count alike, however narrow the ellipse is.
    """
    ends = [np.asarray(-np.linalg.solve(A, f), float) for f in corners]
    condition = finite_differences(function, DIFFERENCE_STEP)
    found: list[Array] = []
    for e in starts:
        if any(_passes_point(curve, e) for curve in found):
            continue
        curve = trace_curve(condition, e, (), steps) if abs(function(e)) < 1e-3 else None
        if curve is not None:
            line = curve.points if curve.closed else _to_ends(curve.points, ends)
            found += [line] if _passes_point(line, -e) else [line, -line]
    return [-curve @ A.T for curve in found]


def _to_ends(line: Array, ends: list[Array]) -> Array:
    """Return a line, drawn on to the corners beside which it breaks off."""
    for i in (0, -1):
        end = min(ends, key=lambda t, i=i: math.dist(t, line[i]), default=None)
        if end is not None and 0.0 < math.dist(end, line[i]) < CORNER_DISTANCE:
            line = np.concatenate([end[None], line] if i == 0 else [line, end[None]])
    return line


def _passes_point(curve: Array, e: Array) -> bool:
    return bool(distance(e, curve) < 0.2 * CURVE_STEP)
