"""Seeds of curves: cells of a net in which all of a curve's equations change their signs.

On the equator the net is over (theta, u, v), within it over (c, s, u, v). A curve that keeps within one cell may be
missed: it is looked for once more from seeds, next to places whose portrait is not that of their region.

Left out are lines on which every direction is a limit direction, where a zero along a curve means nothing: an
edge on which friction is gone (mu = 0), or a value of one parameter at which U has no part across e.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.arclength import Condition
from ...numerics.sign_changes import root_between
from ...portrait.layer_problem.critical import critical_sets
from ...results.arrays import Array
from ...results.special_kinds import DETERMINANT, SPECIAL_KINDS
from ...systems.psi.constructors import many
from ..diagrams.classes import classes_over
from ..families.family import MAX_RADIUS_SQUARED, MIN_RADIUS_SQUARED, SystemFamily

#: Of directions, and places along a line, that have no symmetry.
PROBE_ANGLES = 2.0 * np.pi * (np.arange(7) + 0.37) / 7.0
LINE_SAMPLES = np.array([0.031, 0.217, 0.431, 0.677, 0.913])
SPAN_STEPS = 24  # steps in which such a value is looked for; between them it is where Theta changes its sign everywhere
ZERO_SHARE = 1e-11  # of the largest, |Theta| and |U| that count as zero
ON_LINE_DISTANCE = 1e-6  # of the ranges: what is as near as this to a line lies on it


class DegenerateLine(NamedTuple):
    """A degenerate line."""

    axis: int  # 0: one value across, 1: one value up
    at: float  # that value, in the unit square
    still: bool  # u is zero there

    @property
    def points(self) -> Array:
        """Its ends, (2, 2)."""
        ends = np.array([[0.0, 0.0], [1.0, 1.0]])
        ends[:, self.axis] = self.at
        return ends

    def holds(self, plane: Array, reach: float = ON_LINE_DISTANCE) -> NDArray[np.bool_]:
        """Whether places (..., 2) of the square lie on it."""
        return np.asarray(np.abs(plane[..., self.axis] - self.at) <= reach)


def degenerate_lines(family: SystemFamily) -> tuple[DegenerateLine, ...]:
    """All degenerate lines; none where the whole plane is degenerate."""
    return tuple(line for axis in (0, 1) for line in _lines_along(family, axis))


def drop_touching(cells: Array, lines: Sequence[DegenerateLine], half: float) -> Array:
    """Leave out cells (k, n), of so wide a half, that touch one of some lines."""
    for line in lines:
        cells = cells[~line.holds(cells[:, -2:], half + ON_LINE_DISTANCE)]
    return cells


def _lines_along(family: SystemFamily, axis: int) -> list[DegenerateLine]:
    def speeds(t: float) -> tuple[Array, Array]:
        """Theta and lambda_rho, of all angles and places along the line."""
        place = np.full((2, len(LINE_SAMPLES)), t)
        place[1 - axis] = LINE_SAMPLES
        c, s = np.cos(PROBE_ANGLES)[:, None], np.sin(PROBE_ANGLES)[:, None]
        U, V = family.speed_on_net(c, s, *place)
        return (c * V - s * U).ravel(), (c * U + s * V).ravel()

    side = np.linspace(0.0, 1.0, SPAN_STEPS + 1).tolist()
    every = np.array([speeds(t) for t in side])  # (SPAN_STEPS + 1, 2, many)
    turning, size = every[:, 0], float(np.abs(np.nan_to_num(every, posinf=0.0, neginf=0.0)).max())
    flat = np.all(np.abs(turning) <= ZERO_SHARE * size, axis=1).tolist()
    if all(flat):
        return []
    places = [t for t, zero in zip(side, flat, strict=True) if zero]
    turned = (np.sign(turning[1:]) * np.sign(turning[:-1]) < 0.0).all(axis=1)
    for i in np.flatnonzero(turned).tolist():
        at = root_between(lambda t: float(speeds(t)[0][0]), side[i], side[i + 1], 1e-15)
        if (np.abs(speeds(at)[0]) <= ZERO_SHARE * size).all():
            places.append(at)
    return [DegenerateLine(axis, t, bool((np.abs(speeds(t)[1]) <= ZERO_SHARE * size).all())) for t in sorted(places)]


EQUATOR_CELLS, PARAMETER_CELLS = 64, 24  # cells round the equator, and along both parameters next to them
INTERIOR_CELLS = 16  # cells along each of c, s, u and v
#: Cells along u and v where U is affine in e: its one zero is known; how often they are halved.
AFFINE_CELLS, MAX_HALVINGS = 32, 4
MAX_E = 100.0  # e beyond this counts as this
CELL_CORNERS = np.array([[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]])
NEUTRAL_SHARE = 1e-12  # of the mean of |lambda_rho/Theta|: less is zero, as where a symmetry keeps it
SEED_SHARE = 0.03  # of such a step, to which it is found
MAX_NEUTRAL_STEPS = 32  # on which the curve of a neutral equator is looked for
TRIAL_SUMS = 12  # of functions that are tried in a cell
MIN_SUM_SHARE = 0.1  # of what a sum of them changes by in a cell: so far from zero it has none there
#: Of a cell: the net of e lies next to round numbers, on which degenerate systems like to lie.
NET_OFFSET, UP_OFFSET = 0.37, 0.21

MAX_PLACES = 8  # from which curves are looked for
MAX_WAY = 0.5  # of the ranges, along each axis
MAX_BISECTIONS = 24
SEED_ANGLES = 720
MAX_SEEDS = 12  # of each kind at a place

EQUATOR_CELL = np.array([2.0 * math.pi / EQUATOR_CELLS, 1.0 / PARAMETER_CELLS, 1.0 / PARAMETER_CELLS])
PLANE_CELL = EQUATOR_CELL[1:]
CELL = np.array([2.0 / INTERIOR_CELLS, 2.0 / INTERIOR_CELLS, 1.0 / INTERIOR_CELLS, 1.0 / INTERIOR_CELLS])
AFFINE_CELL = np.array([2.0 / INTERIOR_CELLS, 2.0 / INTERIOR_CELLS, 1.0 / AFFINE_CELLS, 1.0 / AFFINE_CELLS])


def on_equator(family: SystemFamily, lines: Sequence[DegenerateLine] = ()) -> tuple[Array, Array, Array]:
    """Cells in which Theta and Theta' come to zero, and those in which U does, (k, 3) each; and `stability_steps`."""
    theta = (np.arange(EQUATOR_CELLS + 1) + NET_OFFSET) * EQUATOR_CELL[0]
    side = np.linspace(0.0, 1.0, PARAMETER_CELLS + 1)
    c, s = np.cos(theta)[:, None, None], np.sin(theta)[:, None, None]
    (U, V), ((a, b), (p, q)) = _on_net(family, c, s, side[:, None], side)
    turning, radial = c * V - s * U, c * U + s * V
    slope = s * s * a - s * c * (b + p) + c * c * q - radial
    grids = theta, side, side
    on, through = (drop_touching(_cells(of, grids), lines, 0.5 / PARAMETER_CELLS) for of in ((turning, slope), (U, V)))
    return on, through, _drop_degenerate(_stability_changes(turning[:-1], radial[:-1], side, side), lines)


def stability_steps(family: SystemFamily) -> Array:
    """Return steps (k, 2, 2) of a net, from closed equators, on which the mean of lambda_rho/|Theta| changes its sign.

    Of a symmetric family: the net lies next to the lines on which a symmetry keeps that zero.
    """
    theta = (np.arange(EQUATOR_CELLS) + NET_OFFSET) * EQUATOR_CELL[0]
    across, up = ((np.arange(PARAMETER_CELLS + 2) - offset) / PARAMETER_CELLS for offset in (NET_OFFSET, UP_OFFSET))
    c, s = np.cos(theta)[:, None, None], np.sin(theta)[:, None, None]
    (U, V), _ = _on_net(family, c, s, across[:, None], up)
    return _stability_changes(c * V - s * U, c * U + s * V, across, up)


def _drop_degenerate(steps: Array, lines: Sequence[DegenerateLine]) -> Array:
    """Leave out steps (k, 2, 2) that come to a degenerate line."""
    for line in lines:
        away = steps[..., line.axis] - line.at
        steps = steps[(away.min(axis=1) > ON_LINE_DISTANCE) | (away.max(axis=1) < -ON_LINE_DISTANCE)]
    return steps


def _stability_changes(turning: Array, radial: Array, across: Array, up: Array) -> Array:
    """Find the steps of the net, from closed equators, on which these change their stability.

    Where Theta gets a zero the mean goes to infinity, with the sign of lambda_rho there.
    """
    way = np.sign(turning.mean(axis=0))
    closed = (turning * way > 0.0).all(axis=0)
    mean = (radial / np.where(closed, turning * way, 1.0)).mean(axis=0)
    there = np.take_along_axis(radial, (turning * way).argmin(axis=0)[None], axis=0)[0]
    size = np.abs(radial / np.where(closed, turning * way, 1.0)).mean(axis=0)
    value = np.where(closed, np.where(np.abs(mean) > NEUTRAL_SHARE * size, mean, 0.0), there)
    place = np.stack(np.meshgrid(across, up, indexing="ij"), axis=-1)
    found = []
    for one, other in (((slice(1, None),), (slice(-1),)), ((slice(None), slice(1, None)), (slice(None), slice(-1)))):
        turned = value[one] * value[other] < 0.0
        forward, back = turned & closed[one], turned & closed[other] & ~closed[one]
        found.append(np.stack([place[one][forward], place[other][forward]], axis=1))
        found.append(np.stack([place[other][back], place[one][back]], axis=1))
    return np.concatenate(found)


def cell_within(family: SystemFamily) -> Array:
    """Width (4,) of the cells of `interior_cells`."""
    return AFFINE_CELL if family.affine else CELL


def interior_cells(family: SystemFamily, lines: Sequence[DegenerateLine] = ()) -> dict[str, Array]:
    """Cells in which U comes to zero, and with it the function of a row of `special_kinds`: centres (k, 4) by kind."""
    if family.affine:
        return _within_affine(family, lines)
    place = (np.arange(INTERIOR_CELLS + 2) - NET_OFFSET) * CELL[0] - 1.0
    side = np.linspace(0.0, 1.0, INTERIOR_CELLS + 1)
    c, s = place[:, None, None, None], place[:, None, None]
    (U, V), ((a, b), (p, q)) = _on_net(family, c, s, side[:, None], side)
    det, square = a * q - b * p, c * c + s * s
    bend = _bends(family, square[..., 0, 0], side)
    trace = a + q - bend * (c * c * a + c * s * (b + p) + s * s * q)
    scaled = (1.0 - bend * np.minimum(square, MAX_RADIUS_SQUARED)) * det
    grids = place, place, side, side
    still = [line for line in lines if line.still]
    found = {}
    for kind in SPECIAL_KINDS:
        third = det if kind is DETERMINANT else kind.function(trace, scaled)
        cells = drop_touching(_cells((U, V, third), grids), still, 0.5 / INTERIOR_CELLS)
        found[kind.kind] = cells[np.hypot(*cells[:, :2].T) < 1.0 + CELL[0]]
    return found


def _within_affine(family: SystemFamily, lines: Sequence[DegenerateLine]) -> dict[str, Array]:
    """Cells of the plane in which functions of rows of the one critical set change signs; halved where it goes far."""
    side = (np.arange(AFFINE_CELLS) + 0.5) / AFFINE_CELLS
    cells = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)
    found: dict[str, list[Array]] = {kind.kind: [np.zeros((0, 4))] for kind in SPECIAL_KINDS}
    for level in range(MAX_HALVINGS + 1):
        half = 0.5 / (AFFINE_CELLS << level)
        e, functions = _of_set(family, cells[:, None] + half * CELL_CORNERS)
        middle, spread = e.mean(axis=1), np.ptp(e, axis=1).max(axis=1)
        near = (np.hypot(*middle.T) < 1.0 + CELL[0] + spread) & ((level < MAX_HALVINGS) | (spread < 1.0))
        wide = near & (spread > CELL[0]) & (level < MAX_HALVINGS)
        for kind, values in functions.items():
            mixed = near & ~wide & (values.min(axis=1) <= 0.0) & (values.max(axis=1) >= 0.0)
            found[kind].append(np.concatenate([middle[mixed], cells[mixed]], axis=1))
        cells = (cells[wide][:, None] + 0.5 * half * CELL_CORNERS).reshape(-1, 2)
    still = [line for line in lines if line.still]
    return {kind: drop_touching(np.concatenate(kept), still, 0.5 / AFFINE_CELLS) for kind, kept in found.items()}


def _of_set(family: SystemFamily, place: Array) -> tuple[Array, dict[str, Array]]:
    """Find the critical set e (..., 2) of an affine U, and the functions of rows, at places (..., 2) of the square."""
    zero = np.zeros(place.shape[:-1])
    (U, V), ((a, b), (p, q)) = _on_net(family, zero, zero, *np.moveaxis(place, -1, 0))
    det = a * q - b * p
    det = np.where(det == 0.0, 1e-300, det)
    with np.errstate(over="ignore", invalid="ignore"):
        c, s = (np.clip(v / det, -MAX_E, MAX_E) for v in (b * V - q * U, p * U - a * V))
    square = np.clip(c * c + s * s, MIN_RADIUS_SQUARED, MAX_RADIUS_SQUARED)
    bend = _bend_on_net(family, square, place)
    trace = a + q - bend * (c * c * a + c * s * (b + p) + s * s * q)
    scaled = (1.0 - bend * square) * det
    functions = {kind.kind: kind.function(trace, scaled) for kind in SPECIAL_KINDS if kind is not DETERMINANT}
    return np.stack([c, s], axis=-1), functions


def _bend_on_net(family: SystemFamily, square: Array, place: Array) -> Array:
    """``Ratio.bend`` where |e|^2 is `square` (...), at places (..., 2) of the unit square."""
    psi, modulus = family.psi, np.sqrt(square).ravel()
    if any(family.of_psi):
        psi = many(psi, family.values(place)[..., family.of_psi.index(True)].ravel())
    k = psi.steepness(psi.radius(modulus, (1.0 - modulus) * (1.0 + modulus))).reshape(square.shape)
    return 1.0 + k - k / square


def of_plane(condition: Condition) -> Array:
    """Cells of the unit square in which a function of both parameters comes to zero: centres (k, 2)."""
    side = np.linspace(0.0, 1.0, PARAMETER_CELLS + 1)
    values = np.array([[condition(np.array([u, v]))[0][0] for v in side] for u in side])
    return _cells((values,), (side, side))


def on_steps(condition: Condition, steps: Array) -> Array:
    """Places (k, 2) on some steps, from where a function is known, at which it changes its sign or is known no more."""
    few = steps[np.linspace(0, len(steps) - 1, min(len(steps), MAX_NEUTRAL_STEPS)).astype(int)]
    found = []
    for start, end in few:
        sign = condition(start)[0][0] > 0.0

        def value(t: float, start: Array = start, end: Array = end, sign: bool = sign) -> float:
            here = condition(start + t * (end - start))[0][0]
            return float(here) if math.isfinite(here) else -1.0 if sign else 1.0

        found.append(start + root_between(value, 0.0, 1.0, SEED_SHARE) * (end - start))
    return np.array(found).reshape(-1, 2)


def _on_net(family: SystemFamily, c: Array, s: Array, u: Array, v: Array) -> tuple[Array, Array]:
    """U (2, ...) and its derivatives by e (2, 2, ...), NaN where one is not finite: no cell is begun from there."""
    shape = np.broadcast_shapes(c.shape, s.shape, u.shape, v.shape)
    U, D = family.on_net(c, s, u, v)
    speeds, slopes = np.broadcast_to(U, (2, *shape)), np.broadcast_to(D, (2, 2, *shape))
    return np.where(np.isfinite(speeds), speeds, np.nan), np.where(np.isfinite(slopes), slopes, np.nan)


def _bends(family: SystemFamily, square: Array, side: Array) -> Array:
    """``Ratio.bend`` for each |e|^2 (n, n) and place along the parameter of Psi, (n, n, ..., ...)."""
    kinds, where = np.unique(np.clip(square, MIN_RADIUS_SQUARED, MAX_RADIUS_SQUARED), return_inverse=True)
    places = [np.zeros(2)]
    if any(family.of_psi):
        places = [np.where(family.of_psi, t, 0.0) for t in side]
    table = np.array([[family.ratio(q, u).bend for u in places] for q in kinds.tolist()])
    found = table[where.reshape(square.shape)]  # (n, n, places)
    return found[..., None] if family.of_psi[0] else found[..., None, :]


def _cells(functions: Sequence[Array], grids: Sequence[Array]) -> Array:
    """Centres of the cells at whose corners all functions, and all sums of them, have both signs or come near to it."""
    mixed = np.ones([len(grid) - 1 for grid in grids], bool)
    for values in functions:
        low = high = values
        for axis in range(len(grids)):
            one, other = (slice(None),) * axis + (slice(1, None),), (slice(None),) * axis + (slice(None, -1),)
            low, high = np.minimum(low[one], low[other]), np.maximum(high[one], high[other])
        mixed &= (low <= 0.0) & (high >= 0.0)
    index = np.nonzero(mixed)
    corners = [
        np.stack([values[tuple(i + k for i, k in zip(index, corner, strict=True))] for values in functions], axis=-1)
        for corner in np.ndindex(*(2,) * len(grids))
    ]
    centres = np.stack([0.5 * (grid[i] + grid[i + 1]) for grid, i in zip(grids, index, strict=True)], axis=-1)
    return centres[~_on_one_side(np.stack(corners, axis=1))]


def _on_one_side(corners: Array) -> NDArray[np.bool_]:
    """Whether a sum of functions, of values (k, corners, n), is of one sign at all corners, and well away from zero.

    Each alone has both signs in many cells along the other's zeros: where two curves of zeros run side by side, as
    next to a pitchfork, such cells hold none of both. The sum is looked for by Gilbert's algorithm: the point of the
    corners' convex hull that is nearest to zero, or one so near to it that its direction is known.
    """
    size = np.abs(corners).max(axis=1, keepdims=True)
    unit = corners / np.where(size > 0.0, size, 1.0)
    nearest = unit.mean(axis=1)
    apart = np.zeros(len(unit), bool)
    rows = np.arange(len(unit))
    for _ in range(TRIAL_SUMS):
        along = np.einsum("kij,kj->ki", unit, nearest)
        least = along.argmin(axis=1)
        low = along[rows, least]
        apart |= low > MIN_SUM_SHARE * (along.max(axis=1) - low)
        step = unit[rows, least] - nearest
        part = -(nearest * step).sum(axis=1) / np.maximum((step * step).sum(axis=1), 1e-300)
        nearest = nearest + np.clip(part, 0.0, 1.0)[:, None] * step
    return apart


class CurveSeeds(NamedTuple):
    """Places at which curves are begun: (theta, u, v) on the equator, (c, s, u, v) within it."""

    equator: tuple[Array, ...]
    within: tuple[Array, ...]


NO_SEEDS = CurveSeeds((), ())


def seeds_near(family: SystemFamily, places: Sequence[tuple[float, float]]) -> CurveSeeds:
    """Return seeds next to places at which the portrait is not that of the region around: where the class changes."""
    classes = classes_over(family.system, family.psi, family.z, family.names, family.ranges)

    def class_at(u: Array) -> int:
        return int(classes.decided(family.values(u)[None])[0])

    equator: list[Array] = []
    within: list[Array] = []
    for place in places[:MAX_PLACES]:
        start = family.units(np.array(place))
        own = class_at(start)
        for way in (*np.eye(2), *-np.eye(2)):
            length = 1e-3
            while length < MAX_WAY and _in_square(start + length * way) and class_at(start + length * way) == own:
                length *= 2.0
            if not (length < MAX_WAY and _in_square(start + length * way)):
                continue
            low, high = 0.0, length
            for _ in range(MAX_BISECTIONS):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if class_at(start + middle * way) == own else (low, middle)
            equator += _equator_seeds(family, start + high * way)
            for at in (low, high):
                within += _interior_seeds(family, start + at * way)
    return CurveSeeds(tuple(equator), tuple(within))


def _in_square(u: Array) -> bool:
    return bool((u >= 0.0).all() and (u <= 1.0).all())


def _equator_seeds(family: SystemFamily, u: Array) -> list[Array]:
    """Angles at which Theta, or U, is locally least in size, the least first."""
    theta = 2.0 * math.pi * np.arange(SEED_ANGLES) / SEED_ANGLES
    c, s = np.cos(theta), np.sin(theta)
    U, V = family.speed_on_net(c, s, *(np.full(SEED_ANGLES, v) for v in u.tolist()))
    found: list[Array] = []
    for size in (np.abs(c * V - s * U), np.hypot(U, V)):
        least = np.flatnonzero((size <= np.roll(size, 1)) & (size < np.roll(size, -1)))
        found += [np.array([theta[i], *u]) for i in least[np.argsort(size[least])][:MAX_SEEDS]]
    return found


def _interior_seeds(family: SystemFamily, u: Array) -> list[Array]:
    system, psi, z = family.at(u)
    sets = sorted(critical_sets(system, psi, z), key=lambda C: abs(C.determinant))
    return [np.array([*C.e, *u]) for C in sets[:MAX_SEEDS]]
