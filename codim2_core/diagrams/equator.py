"""Limit directions along one parameter: where they meet, how their stability changes, and the closed equator."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..layer_problem.closed_equator import equator_cycle
from ..numerics.sign_changes import refine_roots, roots, sign_changes
from ..numerics.trigonometric import real_zeros, tangential_zeros
from ..words import say
from .critical import CHEBYSHEV_SAMPLES, OFF_CENTRE, ExistenceBorders
from .result import ClosedEquator, DirectionBranch, SpecialValue
from .test_functions import Plane, SystemPath, discriminant, equator_counts
from .theta_zeros import MultipleZero, lambda_rho, multiple_zeros, theta_slope, theta_value, theta_zeros

__all__ = ["equator_part", "link_zeros"]


_TAU = 2.0 * math.pi
_FLAT_SHARE = 1e-13
_MAX_TURN, MAX_HALVINGS = 0.15, 6  # zeros turn by at most this between samples, unless so many halvings are not enough
# Of a piece, where the exponent of a closed equator is computed: at its ends, where limit directions appear, it grows
# beyond all bounds, and may turn its sign just before
_HALF_SAMPLES = np.concatenate([np.geomspace(1e-9, 1e-3, 7), 0.5 * (1.0 - np.cos(np.pi * (np.arange(11) + 0.5) / 22))])
_PIECE_SAMPLES = np.concatenate([_HALF_SAMPLES, [0.5], 1.0 - _HALF_SAMPLES[::-1]])


def equator_part(
    path: SystemPath, grid: Array, exponent: int, cuts: ExistenceBorders
) -> tuple[list[DirectionBranch], list[ClosedEquator], list[SpecialValue]]:
    """Branches of equator equilibria, pieces with a closed equator, and special values."""
    plane = path(grid)
    span = (float(grid[0]), float(grid[-1]))
    values = discriminant(plane, exponent)
    size = sum((abs(np.ldexp(v, exponent)) for v in plane.arrays), np.full(len(grid), 1e-300))
    flat = abs(values) <= _FLAT_SHARE * size**6
    # a share of the span: where something was looked for again, samples crowd
    if plane.rigid or np.average(flat, weights=np.gradient(grid)) > 0.5:
        return _constant_zeros(path, grid, cuts)
    everywhere = _all_directions(path, grid, plane)
    found = _multiple_zeros(path, grid, values, flat, plane, exponent, span)
    width = span[1] - span[0]
    found = [m for m in found if all(abs(m.value - v) > 1e-5 * width for v in everywhere)]
    stops = sorted({m.value for m in found} | set(everywhere))
    special = [_special(path, m) for m in found]
    special += [_direction_change(v) for v in everywhere]
    branches: list[DirectionBranch] = []
    closed: list[ClosedEquator] = []
    edges = [span[0], *stops, span[1]]
    for low, high in pairwise(edges):
        if high - low <= 1e-12 * width:
            continue
        middle = path(np.array([low + OFF_CENTRE * (high - low)])).coefficients(0)
        count = len(tangential_zeros(*middle.plane).theta)
        if count:
            inner, theta = _sample_zeros(path, low, high, count)
            x = np.concatenate([[low], inner, [high]])
            theta = np.concatenate([
                _zeros_at_end(path, low, theta[:1], [m.theta for m in found if m.value == low]),
                theta,
                _zeros_at_end(path, high, theta[-1:], [m.theta for m in found if m.value == high]),
            ])  # fmt: skip
            branches += [part for j in range(count) for part in _split(path, x, theta[:, j], cuts)]
        else:
            pieces, neutral = _closed_pieces(path, low, high)
            closed += pieces
            special += neutral
    return branches, closed, special


def _multiple_zeros(
    path: SystemPath,
    grid: Array,
    values: Array,
    flat: NDArray[np.bool_],
    plane: Plane,
    exponent: int,
    span: tuple[float, float],
) -> list[MultipleZero]:
    """All multiple zeros of Theta along the path."""
    changes = sign_changes(values)
    size = abs(values)
    lowest = 1 + np.flatnonzero((size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:]))
    ends = [i for i in (0, len(grid) - 1) if size[i] <= 1e-9 * size.max()]
    starts = np.unique(np.concatenate([0.5 * (grid[changes] + grid[changes + 1]), grid[lowest], grid[ends]]))
    found = multiple_zeros(path, span, starts, 1.5 * float(np.diff(grid).max())) if len(starts) else []
    # every change of the number of zeros must have a meeting next to it; next to one rounding decides the number
    counts, solid = equator_counts(plane, exponent)[~flat], grid[~flat]
    missed = [
        i
        for i in np.flatnonzero(counts[1:] != counts[:-1])
        if not any(solid[i] - 1e-9 <= m.value <= solid[i + 1] + 1e-9 for m in found)
    ]
    if missed:
        at = np.array(missed)
        places, poles = refine_roots(lambda v: discriminant(path(v), exponent), solid[at], solid[at + 1])
        for value in places[~poles].tolist():
            q = path(np.array([value])).coefficients(0)
            still = real_zeros(0.0, -q.f1, -q.f2, q.d - q.a, 0.0).theta
            one = path(np.full(len(still), value))
            lowest_ = int(abs(theta_value(one, np.array(still))).argmin())
            found.append(MultipleZero("saddle-node", value, still[lowest_]))
    return sorted(found, key=lambda m: (m.value, m.theta))


def _all_directions(path: SystemPath, grid: Array, plane: Plane) -> list[float]:
    """Values at which a = d, b = 0 and f = 0."""

    def rows(p: Plane) -> Array:
        return np.stack([p.b, p.f1, p.f2, p.d - p.a], axis=1)

    size = np.linalg.norm(rows(plane), axis=1)
    most = max(float(abs(v).max()) for v in plane.arrays)
    found = []
    for i in np.flatnonzero(np.r_[True, size[1:] <= size[:-1]] & np.r_[size[:-1] <= size[1:], True]):
        v, step = float(grid[i]), 1e-3 * float(grid[-1] - grid[0])
        for _ in range(6):
            left, here, right = rows(path(np.clip(np.array([v - step, v, v + step]), grid[0], grid[-1])))
            span = min(v + step, grid[-1]) - max(v - step, grid[0])
            slope = (right - left) / span
            if not slope.any():
                break
            v = min(max(v - float(here @ slope) / float(slope @ slope), float(grid[0])), float(grid[-1]))
        if float(np.linalg.norm(rows(path(np.array([v])))[0])) <= 1e-12 * most:
            found.append(v)
    return sorted(set(found))


def _special(path: SystemPath, m: MultipleZero) -> SpecialValue:
    theta = (m.theta + float(path(np.array([m.value])).back[0])) % _TAU
    place = (math.cos(theta), math.sin(theta))
    at = f"θ = {theta:.4g}"
    if m.kind == "saddle-node":
        return SpecialValue("saddle-node", m.value, place, say("meet at", at=at))
    if m.kind == "exchange":
        return SpecialValue("exchange of limit directions", m.value, place, say("pass through", at=at))
    if m.kind == "touch":
        return SpecialValue("saddle-node", m.value, place, say("touch", at=at))
    q = path(np.array([m.value])).coefficients(0)
    size = 1e-10 * max(map(abs, q.plane))
    if abs(q.b) <= size and min(abs(q.f1), abs(q.f2)) <= size:
        return SpecialValue("pitchfork", m.value, place, say("splits, D2", at=at))
    return SpecialValue("cusp", m.value, place, say("passes a cusp", at=at))


def _sample_zeros(path: SystemPath, low: float, high: float, count: int) -> tuple[Array, Array]:
    """Values inside a piece and the zeros there, (k, count), more densely where these move fast."""
    x = low + (high - low) * CHEBYSHEV_SAMPLES
    for _ in range(MAX_HALVINGS):
        theta = link_zeros(theta_zeros(path(x), count))
        far = np.flatnonzero(abs(np.diff(theta, axis=0)).max(axis=1) > _MAX_TURN)
        if not len(far):
            break
        x = np.sort(np.concatenate([x, 0.5 * (x[far] + x[far + 1])]))
    return x, link_zeros(theta_zeros(path(x), count))


def link_zeros(theta: Array) -> Array:
    """Follow each zero from row to row: between meetings they keep their cyclic order."""
    k, count = theta.shape
    if k > 1:
        cost = np.stack(
            [
                abs(np.angle(np.exp(1j * (np.roll(theta[1:], -r, axis=1) - theta[:-1])))).sum(axis=1)
                for r in range(count)
            ]
        )
        shift = np.concatenate([[0], np.cumsum(cost.argmin(axis=0))])
        theta = np.take_along_axis(theta, (np.arange(count) + shift[:, None]) % count, axis=1)
    return np.unwrap(theta, axis=0)


def _zeros_at_end(path: SystemPath, value: float, theta: Array, meeting: list[float]) -> Array:
    """Zeros at the end of a piece, (1, count), from those next to it; the meeting's direction where they meet."""
    count = theta.shape[1]
    plane = path(np.full(count, value))
    t = theta[0].copy()
    with np.errstate(all="ignore"):
        for _ in range(12):
            step = theta_value(plane, t) / theta_slope(plane, t)
            t = t - np.clip(np.where(np.isfinite(step), step, 0.0), -0.1, 0.1)
    for at in meeting:
        turn = np.round((theta[0] - at) / _TAU) * _TAU
        # a zero that meets another comes nearer by half a step, one of three by a third
        t = np.where((abs(t - at - turn) < 0.02) | (abs(t - theta[0]) > 0.5), at + turn, t)
    return t[None]


def _split(path: SystemPath, x: Array, theta: Array, cuts: ExistenceBorders) -> list[DirectionBranch]:
    """Cut one branch where lambda_rho changes sign: there the critical set is on it."""
    plane = path(x)
    rho, slope, told = lambda_rho(plane, theta), theta_slope(plane, theta), theta + plane.back
    size = sum(abs(v) for v in plane.arrays)
    inner = rho.copy()
    inner[abs(inner) <= 1e-13 * size] = 0.0
    if not inner.any():
        return [_direction_branch(x, told, 0.0 * rho, slope)]
    stops: list[float] = []
    for i in sign_changes(np.where(inner == 0.0, np.sign(np.roll(inner, 1)), inner)):
        slack = 1e-9 * (x[-1] - x[0])
        near = [v for v in cuts.all.tolist() if x[i] - slack <= v <= x[i + 1] + slack]
        guess = float(x[i] + (x[i + 1] - x[i]) * abs(rho[i]) / max(abs(rho[i]) + abs(rho[i + 1]), 1e-300))
        stops.append(min(near, key=lambda v: abs(v - guess)) if near else guess)
    out = []
    edges = [float(x[0]), *(v for v in stops if x[0] < v < x[-1]), float(x[-1])]
    t_edge, rho_edge, slope_edge = [told[0]], [rho[0]], [slope[0]]
    for v in edges[1:-1]:
        t = _zeros_at_end(path, v, np.array([[np.interp(v, x, theta)]]), [])[0]
        at = path(np.array([v]))
        t_edge.append(t[0] + at.back[0])
        rho_edge.append(0.0)
        slope_edge.append(theta_slope(at, t)[0])
    t_edge.append(told[-1])
    rho_edge.append(rho[-1])
    slope_edge.append(slope[-1])
    for k in range(len(edges) - 1):
        inside = (x > edges[k]) & (x < edges[k + 1])
        rows = (
            np.concatenate([[u[k]], v[inside], [u[k + 1]]])
            for u, v in ((edges, x), (t_edge, told), (rho_edge, rho), (slope_edge, slope))
        )
        out.append(_direction_branch(*rows))
    return out


def _direction_branch(x: Array, theta: Array, rho: Array, slope: Array) -> DirectionBranch:
    # by the sign in most places: the ends may be zero
    radial = np.sign(rho).sum()
    angular = np.sign(slope).sum()
    first = "radially attracting" if radial < 0 else "radially repelling" if radial > 0 else "radially non-hyperbolic"
    then = (
        "angularly attracting" if angular < 0 else "angularly repelling" if angular > 0 else "angularly non-hyperbolic"
    )
    for array in (x, theta, rho, slope):
        array.flags.writeable = False
    return DirectionBranch(x, theta, rho, slope, f"{first}, {then}")


def _closed_pieces(path: SystemPath, low: float, high: float) -> tuple[list[ClosedEquator], list[SpecialValue]]:
    """Exponent of the closed equator on a piece, cut where it changes sign."""

    def exponent(v: float) -> float:
        cycle = equator_cycle(path(np.array([v])).coefficients(0))
        return cycle.exponent if cycle is not None else math.nan

    x = low + (high - low) * _PIECE_SAMPLES
    y = np.array([exponent(v) for v in x.tolist()])
    x, y = x[np.isfinite(y)], y[np.isfinite(y)]  # at its ends Θ may vanish within rounding: no closed orbit is seen
    if not y.any():
        return [_closed_branch(x, y)], []
    found = roots(lambda values: np.array([exponent(v) for v in values.tolist()]), [x], [y]).zeros[0]
    stops = [v for v in found.tolist() if low < v < high]
    special = [SpecialValue("neutral equator", v, (0.0, 0.0), say("equator neutral, a cycle may leave")) for v in stops]
    edges = [-math.inf, *stops, math.inf]
    out = []
    for u, v in pairwise(edges):
        inside = (x > u) & (x < v)
        values = np.array([*([u] if u > -math.inf else []), *x[inside], *([v] if v < math.inf else [])])
        numbers = np.array([*([0.0] if u > -math.inf else []), *y[inside], *([0.0] if v < math.inf else [])])
        out.append(_closed_branch(values, numbers))
    return out, special


def _closed_branch(x: Array, y: Array) -> ClosedEquator:
    total = np.sign(y).sum()
    kind = "attracting from outside" if total < 0 else "repelling from outside" if total > 0 else "neutral"
    x.flags.writeable = y.flags.writeable = False
    return ClosedEquator(x, y, kind)


def _constant_zeros(
    path: SystemPath, grid: Array, cuts: ExistenceBorders
) -> tuple[list[DirectionBranch], list[ClosedEquator], list[SpecialValue]]:
    """Zeros of Theta that stay as they are, or stay multiple, along the whole path: the exact answer at each value."""
    plane = path(grid)
    everywhere = [] if plane.rigid else _all_directions(path, grid, plane)
    special = [_direction_change(v) for v in everywhere]
    branches: list[DirectionBranch] = []
    closed: list[ClosedEquator] = []
    for low, high in pairwise([float(grid[0]), *everywhere, float(grid[-1])]):
        x = np.linspace(low, high, 2 if plane.rigid else 33)
        at = path(x)
        rows = [tangential_zeros(*(float(v[i]) for v in at.arrays)) for i in range(len(x))]
        count = len(rows[len(x) // 2].theta)
        good = np.array([len(row.theta) == count for row in rows])
        if count and good.sum() > 1:
            theta = link_zeros(np.array([row.theta for row, ok in zip(rows, good, strict=True) if ok]))
            branches += [part for j in range(count) for part in _split(path, x[good], theta[:, j], cuts)]
        elif not count and not rows[len(x) // 2].identically_zero:
            pieces, more = _closed_pieces(path, low, high)
            closed += pieces
            special += more
    return branches, closed, special


def _direction_change(value: float) -> SpecialValue:
    return SpecialValue("all directions", value, (0.0, 0.0), say("nothing turns at f = 0"))
