"""All curves of one kind: from cells of the net to points on them by Newton's method, and from there both ways."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import (
    Condition,
    CurveEdge,
    StepBounds,
    TracedLine,
    newton,
    square_edges,
    tangent,
    trace_curve,
)
from ...results.arrays import Array
from ...results.special_kinds import SpecialKind
from ..families import conditions
from ..families.disc import borders
from ..families.family import MAX_RADIUS_SQUARED, SystemFamily
from . import seed_net

EQUATOR_STEPS = StepBounds(0.08, 0.12, 1500, 2.0 * math.pi)
INTERIOR_STEPS = StepBounds(0.05, 0.12, 1500)
PLANE_STEPS = StepBounds(0.03, 0.12, 1500)
MAX_SEED_CELLS = 1.5  # cells that Newton's method may go
MAX_FAILED_CELLS = 100  # cells of a kind from which nothing is found
ON_CURVE_DISTANCE = 4e-3  # nearer to a curve than this a point lies on it: its chords are
COVERED_CELLS = 0.75  # cells on either side of a curve within which no other one is looked for,
COVERED_FORK_CELLS = 2.0  # and of a pitchfork: on its branches Theta and Theta' all but vanish
FORK_RESIDUAL = 1e-9  # of Theta, or U, on a pitchfork
CORNER_INSET = 1e-4  # 1 - |e|^2 where curves that end at a corner are looked for
NEUTRAL_TRACE = 1e-9  # of tr J, where a curve of another level ends
MIN_SLOPE = 1e-9  # of such a function, of what is of size 1
LAST_STEP = 0.1  # step to the equator


@dataclass(frozen=True, eq=False)
class TracedCurve:
    """A curve of one kind, in (theta, u, v) or (c, s, u, v)."""

    kind: str
    condition: Condition
    curve: TracedLine

    @property
    def points(self) -> Array:
        """All unknowns, (m, n)."""
        return self.curve.points

    @property
    def plane(self) -> Array:
        """Places in the unit square, (m, 2)."""
        return self.curve.points[:, -2:]


@dataclass(frozen=True, eq=False)
class TracedCurves:
    """All curves of some kinds that were found."""

    curves: list[TracedCurve]
    unfinished: tuple[str, ...] = ()  # kinds that were given up: from `MAX_FAILED_CELLS` cells none was reached

    def __add__(self, other: TracedCurves) -> TracedCurves:
        return TracedCurves(self.curves + other.curves, self.unfinished + other.unfinished)


@dataclass(frozen=True)
class CurveKind:
    """A kind of curve."""

    kind: str
    condition: Condition
    edges: Sequence[CurveEdge]
    true: Callable[[Array], bool] = lambda _: True  # whether a point at which the condition is met is one of the curve
    covered: float = COVERED_CELLS  # cells on either side of such a curve within which no other one is looked for


def saddle_nodes(family: SystemFamily, cells: Array, seeds: Sequence[Array] = ()) -> TracedCurves:
    """Curves on which limit directions meet: saddle-nodes, and where a symmetry holds, pitchforks."""
    plain = CurveKind("saddle-node", conditions.saddle_node(family), _square_edges(3))
    forked = CurveKind(
        "pitchfork",
        conditions.pitchfork(family),
        _square_edges(3),
        lambda v: abs(conditions.EquatorEquations(family, v).turning) < FORK_RESIDUAL,
        COVERED_FORK_CELLS,
    )
    return _trace_curves((plain, forked), cells, seed_net.EQUATOR_CELL, EQUATOR_STEPS, seeds)


def closed_form_borders(family: SystemFamily) -> TracedCurves:
    """Curves of saddle-nodes, and of a critical set at the equator, over a family of `disc_family`."""
    kinds = ("saddle-node", conditions.saddle_node(family)), ("transcritical", conditions.through_equator(family))
    lines = zip(kinds, borders(family), strict=True)
    return TracedCurves([
        TracedCurve(kind, condition, TracedLine(line, True, ("", "")))
        for (kind, condition), line in lines if len(line)
    ])  # fmt: skip


def through_equator(family: SystemFamily, cells: Array, seeds: Sequence[Array] = ()) -> TracedCurves:
    """Curves on which a critical set comes to the equator."""
    sought = CurveKind("transcritical", conditions.through_equator(family), _square_edges(3))
    return _trace_curves((sought,), cells, seed_net.EQUATOR_CELL, EQUATOR_STEPS, seeds)


def folds(family: SystemFamily, cells: Array, seeds: Sequence[Array] = ()) -> TracedCurves:
    """Curves on which critical sets meet: folds, and where a symmetry holds, pitchforks."""
    plain = CurveKind("fold of critical sets", conditions.fold(family), _square_edges(4, 1.0))
    forked = CurveKind(
        "pitchfork of critical sets",
        conditions.pitchfork_of_sets(family),
        _square_edges(4, 1.0),
        lambda v: math.hypot(*conditions.InteriorEquations(family, v).U) < FORK_RESIDUAL,
        COVERED_FORK_CELLS,
    )
    return _trace_curves((plain, forked), cells, seed_net.CELL, INTERIOR_STEPS, seeds)


def of_kind(
    family: SystemFamily, kind: SpecialKind, cells: Array, corners: Sequence[Array], seeds: Sequence[Array] = ()
) -> TracedCurves:
    """Curves of a row of `special_kinds`, of any det J; one with tr J not 0 ends where tr J = 0."""

    def edge(v: Array, sign: float) -> tuple[float, Array]:
        ratio = family.ratio(float(v[:2] @ v[:2]), v[2:])
        at = conditions.InteriorEquations(family, v)
        return -sign * at.trace(ratio.bend), -sign * np.array(at.trace_slopes(*ratio))

    condition, edges = conditions.of_kind(family, kind), _square_edges(4, MAX_RADIUS_SQUARED)
    signs = (1.0, -1.0) if kind.level else ()
    sought = [
        CurveKind(
            kind.kind, condition, [*edges, CurveEdge("tr J = 0", lambda v, sign=sign: edge(v, sign))],
            lambda v, sign=sign: edge(v, sign)[0] < NEUTRAL_TRACE,
        )
        for sign in signs
    ] or [CurveKind(kind.kind, condition, edges)]  # fmt: skip
    levels = [sign * kind.level for sign in signs] or [0.0]
    sure = [*(_seed_near_corner(family, v, level) for v in corners for level in levels), *seeds]
    return _all_to_equator(family, _trace_curves(sought, cells, seed_net.cell_within(family), INTERIOR_STEPS, sure))


def _seed_near_corner(family: SystemFamily, corner: Array, level: float) -> Array | None:
    """Find the place (4,) with T = level sqrt(sigma det DU) a little within a corner."""
    theta, *place = corner.tolist()
    size = math.sqrt(1.0 - CORNER_INSET)
    start = np.array([size * math.cos(theta), size * math.sin(theta), *place])
    ratio = family.ratio(1.0 - CORNER_INSET, start[2:])
    det = conditions.InteriorEquations(family, start).determinant
    if det <= 0.0:
        return None
    target = level * math.sqrt((1.0 - ratio.bend * (1.0 - CORNER_INSET)) * det)

    def condition(v: Array) -> tuple[Array, Array]:
        at = conditions.InteriorEquations(family, v)
        value = [*at.U, at.trace(ratio.bend) - target, v[0] ** 2 + v[1] ** 2 - 1.0 + CORNER_INSET]
        rows = [*at.U_slopes, at.trace_slopes(ratio.bend, 0.0, (0.0, 0.0)), (2.0 * v[0], 2.0 * v[1], 0.0, 0.0)]
        return np.array(value), np.array(rows)

    return newton(condition, start, LAST_STEP)


def in_the_plane(kind: str, condition: Condition, cells: Array) -> TracedCurves:
    """Curves of a function of both parameters alone; none where it is zero all about, and its slope is rounding's."""
    if len(cells) and np.abs(condition(cells[len(cells) // 2])[1]).max() < MIN_SLOPE:
        return TracedCurves([])
    return _trace_curves((CurveKind(kind, condition, _square_edges(2)),), cells, seed_net.PLANE_CELL, PLANE_STEPS)


def _square_edges(n: int, inner: float = math.inf) -> list[CurveEdge]:
    """Edges of the unit square, the last two of n unknowns, and for the first two of |e|^2 up to `inner`."""
    found = square_edges(n)
    if inner < math.inf:
        found.append(CurveEdge("equator", lambda v: (float(v[:2] @ v[:2]) - inner, np.append(2.0 * v[:2], (0.0, 0.0)))))
    return found


def _all_to_equator(family: SystemFamily, found: TracedCurves) -> TracedCurves:
    return TracedCurves([_to_equator(family, one) for one in found.curves], found.unfinished)


def _to_equator(family: SystemFamily, one: TracedCurve) -> TracedCurve:
    """Go on from |e|^2 = NEAR to the equator, where sigma = 0 and with it Theta' = 0."""
    corner, points = conditions.equator_corner(family), one.points
    for end, i in zip(one.curve.ends, (0, -1), strict=True):
        if end == "equator":
            c, s, *place = points[i].tolist()
            found = newton(corner, np.array([math.atan2(s, c), *place]), LAST_STEP)
            if found is not None:
                last = np.array([[math.cos(found[0]), math.sin(found[0]), *found[1:]]])
                points = np.concatenate([last, points] if i == 0 else [points, last])
    return TracedCurve(one.kind, one.condition, TracedLine(points, one.curve.closed, one.curve.ends))


def _trace_curves(
    sought: Sequence[CurveKind], cells: Array, cell: Array, steps: StepBounds, sure: Sequence[Array | None] = ()
) -> TracedCurves:
    """Curves through places that are `sure` to lie next to one, and through some cells.

    Where the first kind has no regular point the next one is looked for. Cells come in any order: what fails often
    lies side by side.
    """
    found: list[tuple[CurveKind, TracedCurve]] = []
    left, failed = np.ones(len(cells), bool), 0
    reach = MAX_SEED_CELLS * math.sqrt(cell @ cell)

    def follow(start: Array) -> bool:
        """Whether a start led to a curve, or to one that is known."""
        at, one = next(((v, one) for one in sought if (v := _regular(one, start, reach)) is not None), (None, None))
        if at is None or one is None:
            return False
        if any(edge.of(at)[0] > 0.0 for edge in one.edges) or _lies_on([c for o, c in found if o is one], at, steps):
            return True
        curve = trace_curve(one.condition, at, one.edges, steps)
        if curve is None or len(curve.points) < 2 or not all(one.true(v) for v in curve.points):
            return False
        found.append((one, TracedCurve(one.kind, one.condition, curve)))
        left[_near_curve(curve.points, cells, cell * one.covered, steps)] = False
        return True

    for place in sure:
        if place is not None:
            follow(place)
    for i in np.random.default_rng(0).permutation(len(cells)).tolist():
        if left[i] and failed < MAX_FAILED_CELLS:
            failed += not follow(cells[i])
    kinds = dict.fromkeys(one.kind for one in sought) if failed == MAX_FAILED_CELLS else ()
    return TracedCurves([curve for _, curve in found], tuple(kinds))


def _near_curve(points: Array, cells: Array, reach: Array, steps: StepBounds) -> NDArray[np.bool_]:
    """Return which cells (k, n) are as near to a curve as `reach` (n,), in each unknown."""
    along = np.diff(points, axis=0)
    parts = np.ceil(np.abs(along / reach).max(axis=1)).astype(int)
    dense = [at + np.arange(n + 1)[:, None] / max(n, 1) * way for at, way, n in zip(points, along, parts, strict=False)]
    places, found = np.concatenate(dense), np.zeros(len(cells), bool)
    for part in np.array_split(places, -(-len(places) // 64)):
        found |= (np.abs(steps.apart(part[:, None], cells)) < reach).all(axis=2).any(axis=0)
    return found


def _regular(one: CurveKind, start: Array, reach: float) -> Array | None:
    """Find a regular point of a kind of curve."""
    found = newton(one.condition, start, reach)
    if found is None or tangent(one.condition, found) is None or not one.true(found):
        return None
    return found


def _lies_on(found: Sequence[TracedCurve], at: Array, steps: StepBounds) -> bool:
    for one in found:
        start = steps.apart(one.points[:-1], at)
        along = np.diff(one.points, axis=0)
        part = np.clip((start * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
        if ((start - part[:, None] * along) ** 2).sum(axis=1).min() < ON_CURVE_DISTANCE**2:
            return True
    return False
