"""Points of codimension two: where one more thing is zero along a curve, and where two curves cross.

Along a curve there are its places on the portrait, and one number for each kind.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...numerics.arclength import newton, zero_between
from ...results.arrays import Array
from ...results.special_kinds import HOPF, NODE_FOCUS, SPECIAL_KINDS
from ...results.words import say
from ...systems.psi.constructors import many
from ..families import conditions
from ..families.conditions import EquatorEquations, InteriorEquations
from ..families.disc import border_points
from ..families.family import SystemFamily
from ..families.first_lyapunov import lyapunov
from .tracing import TracedCurve


def places(family: SystemFamily, curve: TracedCurve) -> Array:
    """Points (m, 2) of the projected hemisphere."""
    v = curve.points
    if v.shape[1] == 2:
        return np.full((len(v), 2), math.nan)
    p = np.stack([np.cos(v[:, 0]), np.sin(v[:, 0])], axis=-1) if v.shape[1] == 3 else _places_on_portrait(family, v)
    if family.turns:
        angles = [family.frozen(at[-2:]).turn for at in v]
        c, s = np.cos(angles), np.sin(angles)
        p = np.stack([c * p[:, 0] - s * p[:, 1], s * p[:, 0] + c * p[:, 1]], axis=-1)
    return p


def _places_on_portrait(family: SystemFamily, v: Array) -> Array:
    """Return places (m, 2) of the projected hemisphere from (c, s, u, v); on and beyond the equator (c, s)."""
    e, modulus = v[:, :2], np.hypot(v[:, 0], v[:, 1])
    complement = (1.0 - modulus) * (1.0 + modulus)
    inner = (modulus > 0.0) & (complement > 0.0)
    psi = family.psi
    if any(family.of_psi):
        psi = many(psi, family.values(v[inner, 2:])[:, family.of_psi.index(True)])
    zeta = psi.radius(modulus[inner], complement[inner])
    p = e.copy()
    p[inner] *= (zeta / np.hypot(1.0, zeta) / modulus[inner])[:, None]
    return p


def curve_numbers(family: SystemFamily, curve: TracedCurve) -> Array:
    """One number a point, see `AtlasCurve`."""
    v = curve.points
    if curve.kind in ("saddle-node", "pitchfork"):
        return np.array([conditions.EquatorEquations(family, at).radial for at in v])
    if curve.kind == "transcritical":
        return np.array([conditions.EquatorEquations(family, at).slope for at in v])
    if curve.kind in (
        "fold of critical sets",
        "pitchfork of critical sets",
        *(one.kind for one in SPECIAL_KINDS if one.level),
    ):
        return np.array([math.copysign(1.0, trace(family, at)) for at in v])
    if curve.kind == HOPF.kind:
        return lyapunov(family, v)
    return np.zeros(0)


def trace(family: SystemFamily, at: Array) -> float:
    """Return T at (c, s, u, v)."""
    return conditions.InteriorEquations(family, at).trace(family.ratio(float(at[:2] @ at[:2]), at[2:]).bend)


SAME_POINT_DISTANCE = 1e-6  # of the ranges: points of one kind nearer to each other are one
CORNER_DISTANCE = 1e-5  # and so near to a saddle-node on the equator nothing crosses
MIN_END_DISTANCE = 1e-7  # and so far from an end of both curves they cross
MAX_CORRECTION = 0.05  # that Newton's method may go from where two polylines cross
ZERO_VALUE = 1e-9  # of a function along a curve, in units of the largest |U|: less is zero
UNREPORTED_KINDS = (NODE_FOCUS.kind, "det A = 0")  # kinds whose crossings are no news


@dataclass(frozen=True, eq=False)
class SpecialPlace:
    """A point of codimension two."""

    kind: str
    sentence: str
    v: Array  # (n,) Its place on the curve, (theta, u, v) or (c, s, u, v), or its place (u, v) alone

    @property
    def plane(self) -> Array:
        """Its place in the unit square."""
        return self.v[-2:]


def special_points_along(family: SystemFamily, curve: TracedCurve) -> list[SpecialPlace]:
    """Find the special points along one curve."""
    if curve.kind in ("saddle-node", "pitchfork"):
        found = _zeros(curve, lambda v: EquatorEquations(family, v).radial, _corner)
        if curve.kind == "saddle-node":
            found += _zeros(curve, lambda v: EquatorEquations(family, v).curvature, _cusp)
        return found
    if curve.kind == "transcritical":
        found = _zeros(curve, lambda v: EquatorEquations(family, v).slope, _corner)
        return (
            found if family.affine else found + _zeros(curve, lambda v: EquatorEquations(family, v).determinant, _fold)
        )
    if curve.kind == "fold of critical sets":
        return _zeros(curve, lambda v: trace(family, v), _takens) + _cusps_of_sets(family, curve)
    if curve.kind == "pitchfork of critical sets":
        return _zeros(curve, lambda v: trace(family, v), _takens)
    if curve.kind == HOPF.kind:
        ends = [
            _takens(curve.points[i]) for end, i in zip(curve.curve.ends, (0, -1), strict=True) if end == "det J = 0"
        ]
        return ends + _zeros(
            curve, lambda v: float(lyapunov(family, v[None])[0]), _bautin, lyapunov(family, curve.points)
        )
    return []


def closed_form_points(family: SystemFamily) -> list[SpecialPlace]:
    """Return the cusps and corners of borders that are known in closed form."""
    tips, touching = border_points(family)
    return [*(_cusp(v) for v in tips), *(_corner(v) for v in touching)]


def _corner(v: Array) -> SpecialPlace:
    return SpecialPlace("saddle-node on the equator", say("two borders touch", theta=_angle(v)), v)


def _cusp(v: Array) -> SpecialPlace:
    return SpecialPlace("cusp", say("cusp of directions", theta=_angle(v)), v)


def _fold(v: Array) -> SpecialPlace:
    return SpecialPlace("fold on the equator", say("fold on the equator", theta=_angle(v)), v)


def _takens(v: Array) -> SpecialPlace:
    return SpecialPlace("Bogdanov–Takens", say("both eigenvalues zero"), v)


def _bautin(v: Array) -> SpecialPlace:
    return SpecialPlace("generalised Hopf", say("Lyapunov turns"), v)


def _angle(v: Array) -> float:
    return float(v[0]) % (2.0 * math.pi)


def _zeros(
    curve: TracedCurve,
    test: Callable[[Array], float],
    make: Callable[[Array], SpecialPlace],
    values: Array | None = None,
) -> list[SpecialPlace]:
    """Points between neighbours at which a function, of values at all points, changes its sign."""
    points = curve.points
    values = np.array([test(v) for v in points]) if values is None else values
    known = np.isfinite(values)
    if not np.abs(values[known]).max(initial=0.0) > ZERO_VALUE:  # zero all along, and rounding
        return []
    turned = known[1:] & known[:-1] & (np.sign(values[1:]) * np.sign(values[:-1]) < 0.0)
    rows = np.flatnonzero(turned).tolist()
    return [make(zero_between(curve.condition, test, points[i], points[i + 1])) for i in rows]


def _cusps_of_sets(family: SystemFamily, curve: TracedCurve) -> list[SpecialPlace]:
    """Find where det J = 0 keeps its place to first order along its own null vector."""
    found = []
    points = curve.points
    for i in range(len(points) - 1):
        row = InteriorEquations(family, points[i]).larger_row

        def along_null(v: Array, row: int = row) -> float:
            return InteriorEquations(family, v).along_null(row)

        if along_null(points[i]) * along_null(points[i + 1]) < 0.0:
            v = zero_between(curve.condition, along_null, points[i], points[i + 1])
            found.append(SpecialPlace("cusp", say("cusp of sets"), v))
    return found


def crossings(curves: Sequence[TracedCurve], bounded: bool = True) -> list[SpecialPlace]:
    """Find where two curves cross, or one itself, at two places of the portrait; in the unit square if bounded."""
    found = []
    reported = [one for one in curves if one.kind not in UNREPORTED_KINDS]
    for i, one in enumerate(reported):
        for other in reported[i:]:
            for j, k in _crossing_pieces(one, other):
                at = _solve_crossing(one, other, j, k)
                if at is not None and not (bounded and _is_outside(at)):
                    kinds = sorted((one.kind, other.kind))
                    found.append(SpecialPlace("crossing", say("two at once", one=kinds[0], other=kinds[1]), at))
    return found


def _crossing_pieces(one: TracedCurve, other: TracedCurve) -> list[tuple[int, int]]:
    """Pieces of two polylines that cross."""
    p, q = one.plane, other.plane
    r, s = np.diff(p, axis=0), np.diff(q, axis=0)
    away = q[None, :-1] - p[:-1, None]
    across = r[:, None, 0] * s[None, :, 1] - r[:, None, 1] * s[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        t = (away[..., 0] * s[None, :, 1] - away[..., 1] * s[None, :, 0]) / across
        w = (away[..., 0] * r[:, None, 1] - away[..., 1] * r[:, None, 0]) / across
    met = (t >= 0.0) & (t < 1.0) & (w >= 0.0) & (w < 1.0)
    if one is other:
        m = len(r)
        i, j = np.arange(m)[:, None], np.arange(m)
        met &= (j > i + 1) & ~(one.curve.closed & (i == 0) & (j == m - 1))
    return [(int(i), int(j)) for i, j in np.argwhere(met)]


def _solve_crossing(one: TracedCurve, other: TracedCurve, j: int, k: int) -> Array | None:
    """Solve both curves' equations at one place of the square, from two pieces that cross."""
    n, m = one.points.shape[1], other.points.shape[1]

    def both(x: Array) -> tuple[Array, Array]:
        place = x[-2:]
        (first, rows), (second, more) = (
            one.condition(np.append(x[: n - 2], place)),
            other.condition(np.append(x[n - 2 : -2], place)),
        )
        slopes = np.zeros((len(first) + len(second), len(x)))
        slopes[: len(first), : n - 2], slopes[: len(first), -2:] = rows[:, :-2], rows[:, -2:]
        slopes[len(first) :, n - 2 : -2], slopes[len(first) :, -2:] = more[:, :-2], more[:, -2:]
        return np.append(first, second), slopes

    start = np.concatenate([one.points[j, : n - 2], other.points[k, : m - 2], one.plane[j]])
    found = newton(both, start, MAX_CORRECTION * 10.0)
    if found is None:
        return None
    if (
        n == m
        and np.abs(_distances(found[: n - 2] - found[n - 2 : -2], n)).max(initial=0.0) < SAME_POINT_DISTANCE
        and n > 2
    ):
        return None  # one place: what happens there is a point along one of them
    return found[-2:]


def _is_outside(at: Array) -> bool:
    return bool(at.min() < -MIN_END_DISTANCE or at.max() > 1.0 + MIN_END_DISTANCE)


def _distances(away: Array, n: int) -> Array:
    return away - 2.0 * math.pi * np.round(away / (2.0 * math.pi)) if n == 3 else away


def corners(found: Sequence[SpecialPlace]) -> list[Array]:
    """Places (theta, u, v) at which Hopf and node-focus curves, and that of a neutral equator, end on the equator."""
    kept: list[Array] = []
    for one in found:
        if one.kind == "saddle-node on the equator" and not any(_is_same_place(one.v, other) for other in kept):
            kept.append(one.v)
    return kept


def _is_same_place(one: Array, other: Array) -> bool:
    return bool(np.abs(_distances(one - other, 3)).max() < SAME_POINT_DISTANCE)


def away_from(corners: Sequence[SpecialPlace], met: Sequence[SpecialPlace]) -> list[SpecialPlace]:
    """Leave out crossings at a saddle-node on the equator: there curves meet, or end, at one place of the portrait."""
    places = [one.plane for one in corners if one.kind == "saddle-node on the equator"]
    return [one for one in met if not any(np.abs(one.plane - at).max() < CORNER_DISTANCE for at in places)]


def each_once(found: Sequence[SpecialPlace]) -> list[SpecialPlace]:
    """Leave out points of one kind and sentence at one place."""
    kept: list[SpecialPlace] = []
    for one in found:
        if not any(one.kind == other.kind and one.sentence == other.sentence and
                   np.abs(one.plane - other.plane).max() < SAME_POINT_DISTANCE for other in kept):  # fmt: skip
            kept.append(one)
    return kept
