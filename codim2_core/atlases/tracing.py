"""All curves of one kind: from cells of the net to points on them by Newton's method, and from there both ways."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..curves.arclength import Edge, Steps, Traced, square_edges, tangent, trace_curve
from ..curves.newton import Condition, newton
from . import conditions, starts
from .family import NEAR, Family

Array = NDArray[np.float64]

EQUATOR = Steps(0.08, 0.12, 1500, 2.0 * math.pi)
WITHIN = Steps(0.05, 0.12, 1500)
PLANE = Steps(0.03, 0.12, 1500)
REACH = 1.5  # cells that Newton's method may go
MOST_FAILED = 100  # cells of a kind from which nothing is found
SAME = 4e-3  # nearer to a curve than this a point lies on it: its chords are
BESIDE = 0.75  # cells on either side of a curve within which no other one is looked for,
BESIDE_FORK = 2.0  # and of a pitchfork: on its branches Theta and Theta' all but vanish
LEFT = 1e-9  # of Theta, or U, on a pitchfork
INWARD = 1e-4  # 1 - |e|^2 where curves that end at a corner are looked for
NEUTRAL = 1e-9  # of tr J, where a node-focus curve ends
LAST = 0.1  # step to the equator


@dataclass(frozen=True, eq=False)
class Followed:
    """A curve of one kind, in (theta, u, v) or (c, s, u, v).

    Attributes
    ----------
    kind : str
    condition : callable
    curve : Traced
    """

    kind: str
    condition: Condition
    curve: Traced

    @property
    def points(self) -> Array:
        """All unknowns, (m, n)."""
        return self.curve.points

    @property
    def plane(self) -> Array:
        """Places in the unit square, (m, 2)."""
        return self.curve.points[:, -2:]


@dataclass(frozen=True, eq=False)
class Found:
    """All curves of some kinds that were found.

    Attributes
    ----------
    curves : list of Followed
    unfinished : tuple of str
        Kinds that were given up: from `MOST_FAILED` cells none was reached.
    """

    curves: list[Followed]
    unfinished: tuple[str, ...] = ()

    def __add__(self, other: Found) -> Found:
        return Found(self.curves + other.curves, self.unfinished + other.unfinished)


@dataclass(frozen=True)
class Sought:
    """A kind of curve.

    Attributes
    ----------
    kind : str
    condition : callable
    edges : sequence of Edge
    true : callable
        Whether a point at which the condition is met is one of the curve.
    beside : float
        Cells on either side of such a curve within which no other one is looked for.
    """

    kind: str
    condition: Condition
    edges: Sequence[Edge]
    true: Callable[[Array], bool] = lambda _: True
    beside: float = BESIDE


def saddle_nodes(family: Family, cells: Array, seeds: Sequence[Array] = ()) -> Found:
    """Curves on which limit directions meet: saddle-nodes, and where a symmetry holds, pitchforks."""
    plain = Sought("saddle-node", conditions.saddle_node(family), _edges(3))
    forked = Sought(
        "pitchfork",
        conditions.pitchfork(family),
        _edges(3),
        lambda v: abs(conditions.OnEquator(family, v).turning) < LEFT,
        BESIDE_FORK,
    )
    return _curves((plain, forked), cells, starts.EQUATOR_CELL, EQUATOR, seeds)


def through_equator(family: Family, cells: Array, seeds: Sequence[Array] = ()) -> Found:
    """Curves on which a critical set comes to the equator."""
    sought = Sought("transcritical", conditions.through_equator(family), _edges(3))
    return _curves((sought,), cells, starts.EQUATOR_CELL, EQUATOR, seeds)


def folds(family: Family, cells: Array, seeds: Sequence[Array] = ()) -> Found:
    """Curves on which critical sets meet: folds, and where a symmetry holds, pitchforks."""
    plain = Sought("fold of critical sets", conditions.fold(family), _edges(4, 1.0))
    forked = Sought(
        "pitchfork of critical sets",
        conditions.pitchfork_of_sets(family),
        _edges(4, 1.0),
        lambda v: math.hypot(*conditions.Within(family, v).U) < LEFT,
        BESIDE_FORK,
    )
    return _curves((plain, forked), cells, starts.CELL, WITHIN, seeds)


def hopfs(family: Family, cells: Array, corners: Sequence[Array], seeds: Sequence[Array] = ()) -> Found:
    """Curves on which tr J = 0, of saddles too."""
    sought = Sought("Hopf", conditions.hopf(family), _edges(4, NEAR))
    sure = [*(_seed_beside_corner(family, v, 0.0) for v in corners), *seeds]
    return _all_to_equator(family, _curves((sought,), cells, starts.cell_within(family), WITHIN, sure))


def node_foci(family: Family, cells: Array, corners: Sequence[Array], seeds: Sequence[Array] = ()) -> Found:
    """Curves on which tr(J)^2 = 4 det J; they end where both are zero."""

    def edge(v: Array, sign: float) -> tuple[float, Array]:
        ratio = family.ratio(float(v[:2] @ v[:2]), v[2:])
        at = conditions.Within(family, v)
        return -sign * at.trace(ratio.bend), -sign * np.array(at.trace_slopes(*ratio))

    condition = conditions.node_focus(family)
    both = [
        Sought(
            "node-focus", condition, [*_edges(4, NEAR), Edge("tr J = 0", lambda v, sign=sign: edge(v, sign))],
            lambda v, sign=sign: edge(v, sign)[0] < NEUTRAL,
        )
        for sign in (1.0, -1.0)
    ]  # fmt: skip
    sure = [*(_seed_beside_corner(family, v, sign) for v in corners for sign in (2.0, -2.0)), *seeds]
    return _all_to_equator(family, _curves(both, cells, starts.cell_within(family), WITHIN, sure))


def _seed_beside_corner(family: Family, corner: Array, level: float) -> Array | None:
    """Find the place (4,) with T = level sqrt(sigma det DU) a little within a corner."""
    theta, *place = corner.tolist()
    size = math.sqrt(1.0 - INWARD)
    start = np.array([size * math.cos(theta), size * math.sin(theta), *place])
    ratio = family.ratio(1.0 - INWARD, start[2:])
    det = conditions.Within(family, start).determinant
    if det <= 0.0:
        return None
    target = level * math.sqrt((1.0 - ratio.bend * (1.0 - INWARD)) * det)

    def condition(v: Array) -> tuple[Array, Array]:
        at = conditions.Within(family, v)
        value = [*at.U, at.trace(ratio.bend) - target, v[0] ** 2 + v[1] ** 2 - 1.0 + INWARD]
        rows = [*at.U_slopes, at.trace_slopes(ratio.bend, 0.0, (0.0, 0.0)), (2.0 * v[0], 2.0 * v[1], 0.0, 0.0)]
        return np.array(value), np.array(rows)

    return newton(condition, start, LAST)


def in_the_plane(kind: str, condition: Condition, cells: Array) -> Found:
    """Curves of a function of both parameters alone."""
    return _curves((Sought(kind, condition, _edges(2)),), cells, starts.PLANE_CELL, PLANE)


def _edges(n: int, inner: float = math.inf) -> list[Edge]:
    """Edges of the unit square, the last two of n unknowns, and for the first two of |e|^2 up to `inner`."""
    found = square_edges(n)
    if inner < math.inf:
        found.append(Edge("equator", lambda v: (float(v[:2] @ v[:2]) - inner, np.append(2.0 * v[:2], (0.0, 0.0)))))
    return found


def _all_to_equator(family: Family, found: Found) -> Found:
    return Found([_to_equator(family, one) for one in found.curves], found.unfinished)


def _to_equator(family: Family, one: Followed) -> Followed:
    """Go on from |e|^2 = NEAR to the equator, where sigma = 0 and with it Theta' = 0."""
    corner, points = conditions.equator_corner(family), one.points
    for end, i in zip(one.curve.ends, (0, -1), strict=True):
        if end == "equator":
            c, s, *place = points[i].tolist()
            found = newton(corner, np.array([math.atan2(s, c), *place]), LAST)
            if found is not None:
                last = np.array([[math.cos(found[0]), math.sin(found[0]), *found[1:]]])
                points = np.concatenate([last, points] if i == 0 else [points, last])
    return Followed(one.kind, one.condition, Traced(points, one.curve.closed, one.curve.ends))


def _curves(
    sought: Sequence[Sought], cells: Array, cell: Array, steps: Steps, sure: Sequence[Array | None] = ()
) -> Found:
    """Curves through places that are `sure` to lie beside one, and through some cells.

    Where the first kind has no regular point the next one is looked for. Cells come in any order: what fails often
    lies side by side.
    """
    found: list[tuple[Sought, Followed]] = []
    left, failed = np.ones(len(cells), bool), 0
    reach = REACH * math.sqrt(cell @ cell)

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
        found.append((one, Followed(one.kind, one.condition, curve)))
        left[_beside_curve(curve.points, cells, cell * one.beside, steps)] = False
        return True

    for place in sure:
        if place is not None:
            follow(place)
    for i in np.random.default_rng(0).permutation(len(cells)).tolist():
        if left[i] and failed < MOST_FAILED:
            failed += not follow(cells[i])
    kinds = dict.fromkeys(one.kind for one in sought) if failed == MOST_FAILED else ()
    return Found([curve for _, curve in found], tuple(kinds))


def _beside_curve(points: Array, cells: Array, reach: Array, steps: Steps) -> NDArray[np.bool_]:
    """Return which cells (k, n) are as near to a curve as `reach` (n,), in each unknown."""
    along = np.diff(points, axis=0)
    parts = np.ceil(np.abs(along / reach).max(axis=1)).astype(int)
    dense = [at + np.arange(n + 1)[:, None] / max(n, 1) * way for at, way, n in zip(points, along, parts, strict=False)]
    places, found = np.concatenate(dense), np.zeros(len(cells), bool)
    for part in np.array_split(places, -(-len(places) // 64)):
        found |= (np.abs(steps.apart(part[:, None], cells)) < reach).all(axis=2).any(axis=0)
    return found


def _regular(one: Sought, start: Array, reach: float) -> Array | None:
    """Find a regular point of a kind of curve."""
    found = newton(one.condition, start, reach)
    if found is None or tangent(one.condition, found) is None or not one.true(found):
        return None
    return found


def _lies_on(found: Sequence[Followed], at: Array, steps: Steps) -> bool:
    for one in found:
        start = steps.apart(one.points[:-1], at)
        along = np.diff(one.points, axis=0)
        part = np.clip((start * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
        if ((start - part[:, None] * along) ** 2).sum(axis=1).min() < SAME**2:
            return True
    return False
