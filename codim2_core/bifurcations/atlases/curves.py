"""All curves over two parameters, each once, and cut to where what they tell of happens."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from ...numerics.arclength import TracedLine, distance, feet, point_across, zero_between
from ...results.arrays import Array
from ...results.special_kinds import DETERMINANT, HOPF, SPECIAL_KINDS, SpecialKind
from ..families import conditions
from ..families.family import SystemFamily
from ..families.first_lyapunov import lyapunov
from . import codim_two_points, seed_net, tracing
from .codim_two_points import ZERO_VALUE, SpecialPlace
from .seed_net import NO_SEEDS, CurveSeeds, DegenerateLine
from .tracing import TracedCurve, TracedCurves

LAST_STEP = 0.04  # of the ranges: last step of the curve of a neutral equator, whose mean takes ever more angles
POINT_SIZE = 1e-7  # of the ranges: a curve that keeps within this is a point
SAME_CURVE_DISTANCE = 1e-6  # two curves of one kind that are as near as this everywhere are one
SINGULAR_DETERMINANT = 1e-9  # of det DU, all along a curve through the equator: there critical sets fill a line
#: Of the ranges, of a curve from another chart; how often its steps are halved.
MAX_CHART_STEP, MAX_CHART_HALVINGS = 0.06, 12
LINE_DETERMINANT = 1e-9  # of det DU, all along a curve of tr J = 0: there critical sets fill a line


def curves_of(
    family: SystemFamily, lines: Sequence[DegenerateLine], closed_form: bool, seeds: CurveSeeds = NO_SEEDS
) -> tuple[TracedCurves, list[SpecialPlace]]:
    """All curves, in unknowns of their own, and the special points along them; none that lies on a degenerate line.

    Of a symmetric family half are followed, and turned.

    They are begun in cells of the net, and from the seeds; borders in `closed_form` are those of `families.disc`.
    """
    cells = seed_net.interior_cells(family, lines)
    if closed_form:
        turning = seed_net.stability_steps(family)
        found, points = border_curves(family)
    else:
        on, through, turning = seed_net.on_equator(family, lines)
        found = _true(
            tracing.saddle_nodes(family, on, seeds.equator) + tracing.through_equator(family, through, seeds.equator),
            lines,
        )
        points = _points_along(family, found)
    corners = codim_two_points.corners(points)
    if family.symmetric:
        corners = [v for v in corners if v[-1] >= 0.5]
        cells = {kind: of[of[:, -1] >= 0.5 - seed_net.AFFINE_CELL[-1]] for kind, of in cells.items()}
        turning = turning[turning[..., -1].max(axis=1) >= 0.5]
    if closed_form:
        more = TracedCurves([])
    elif family.affine:
        kept = [one for one in found.curves if one.kind != "transcritical" or not _singular(family, one)]
        found = TracedCurves(kept, found.unfinished)
        singular = conditions.singular_matrix(family)
        more = tracing.in_the_plane("det A = 0", singular, seed_net.of_plane(singular))
    else:
        more = tracing.folds(family, cells[DETERMINANT.kind], seeds.within)
    for kind in SPECIAL_KINDS:
        if kind is not DETERMINANT:
            of_kind = tracing.of_kind(family, kind, cells[kind.kind], corners, seeds.within)
            real = [part for one in of_kind.curves for part in _where_it_holds(family, kind, one)]
            more += TracedCurves(real, of_kind.unfinished)
    meetings = codim_two_points.crossings([one for one in found.curves if one.kind == "saddle-node"], not closed_form)
    ends = [v[1:] for v in corners] + [one.plane for one in meetings]
    neutral = conditions.neutral_equator(family)
    turned = tracing.in_the_plane("neutral equator", neutral, seed_net.on_steps(neutral, turning))
    more += TracedCurves([_to_ends(one, ends) for one in turned.curves], turned.unfinished)
    more = _true(more, lines)
    own = _points_along(family, more)
    if family.symmetric:
        kept = list(more.curves)
        for image in map(_turn_curve, more.curves):
            kept += [] if any(_is_same_curve(image, one) for one in kept) else [image]
        more = TracedCurves(kept, more.unfinished)
        own += [replace(one, v=_turn_places(one.v)) for one in own]
    points += own
    points = _without_centres(family, more.curves, points)
    return found + more, [one for one in points if not any(line.holds(one.plane) for line in lines)]


def _turn_places(v: Array) -> Array:
    """Turn places (..., n) by half a turn of the square, and of the portrait."""
    return np.concatenate([-v[..., :-2], 1.0 - v[..., -2:]], axis=-1)


def _turn_curve(one: TracedCurve) -> TracedCurve:
    """Return the image of a curve over a symmetric family."""
    return replace(one, curve=replace(one.curve, points=_turn_places(one.points)))


def _is_same_curve(one: TracedCurve, other: TracedCurve) -> bool:
    """Whether points of one curve lie on another: exactly, and not only on its chords."""
    if one.kind != other.kind:
        return False
    for v in one.points[np.linspace(0, len(one.points) - 1, 5).astype(int)[1:-1]]:
        parts, places, gaps = feet(v, other.points)
        i = int(gaps.argmin())
        chord = other.points[i + 1] - other.points[i]
        length = math.sqrt(chord @ chord)
        if not 0.0 < parts[i] < 1.0 or gaps[i] > length or length == 0.0:
            return False
        at = point_across(other.condition, places[i], chord / length)
        if at is None or math.dist(at, v) > SAME_CURVE_DISTANCE:
            return False
    return True


def border_curves(family: SystemFamily) -> tuple[TracedCurves, list[SpecialPlace]]:
    """Return the borders that are known in closed form, and the special points along them."""
    return tracing.closed_form_borders(family), codim_two_points.closed_form_points(family)


def _points_along(family: SystemFamily, found: TracedCurves) -> list[SpecialPlace]:
    return [point for one in found.curves for point in codim_two_points.special_points_along(family, one)]


def _without_centres(
    family: SystemFamily, curves: Sequence[TracedCurve], points: list[SpecialPlace]
) -> list[SpecialPlace]:
    """Leave out generalised Hopf points on a curve of centres: no fold of cycles begins there."""
    lines = [
        one.plane for one in curves
        if one.kind == HOPF.kind and np.nanmax(np.abs(lyapunov(family, one.points)), initial=0.0) < ZERO_VALUE
    ]  # fmt: skip
    return [
        one for one in points
        if one.kind != "generalised Hopf" or not any(distance(one.plane, line) < POINT_SIZE for line in lines)
    ]  # fmt: skip


def _true(found: TracedCurves, lines: Sequence[DegenerateLine]) -> TracedCurves:
    """Leave out what keeps to one point or to a degenerate line, and what another one covers."""
    wide = [one for one in found.curves if np.ptp(one.plane, axis=0).max() > POINT_SIZE]
    own = [one for one in wide if not any(line.holds(one.plane).all() for line in lines)]
    return TracedCurves(_each_once(own), found.unfinished)


def _to_ends(one: TracedCurve, ends: list[Array]) -> TracedCurve:
    """Go on from where the equator all but has limit directions to where it has: at a corner, or two at once."""
    points = one.points
    for end, i in zip(one.curve.ends, (0, -1), strict=True):
        near = min(ends, key=lambda v, i=i: math.dist(v, points[i]), default=None)
        if end == "lost" and near is not None and math.dist(near, points[i]) < LAST_STEP:
            points = np.concatenate([near[None], points] if i == 0 else [points, near[None]])
    return TracedCurve(one.kind, one.condition, TracedLine(points, one.curve.closed, one.curve.ends))


def parts_within(one: TracedCurve, chart: SystemFamily, family: SystemFamily) -> list[TracedCurve]:
    """Return the parts of a curve over one chart of the plane that lie in the square of another, as finely as there."""

    def inset(points: Array) -> Array:
        place = family.units(chart.values(points[..., -2:]))
        return np.asarray(np.minimum(place.min(axis=-1), 1.0 - place.max(axis=-1)))

    points = _refine(one, lambda v: family.units(chart.values(v[..., -2:])))
    inside = inset(points) >= 0.0
    if inside.all():
        return [TracedCurve(one.kind, one.condition, TracedLine(points, one.curve.closed, one.curve.ends))]
    if one.curve.closed and inside[0]:  # begin outside
        first = int(np.argmin(inside))
        points = np.concatenate([points[first:], points[1 : first + 1] + (points[-1] - points[0])])
        inside = np.concatenate([inside[first:], inside[1 : first + 1]])
    found = []
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int))).reshape(-1, 2)
    for i, j in edges.tolist():
        part, ends = [*points[i:j]], list(one.curve.ends)
        if i > 0:
            part.insert(0, zero_between(one.condition, lambda v: float(inset(v)), points[i - 1], points[i]))
            ends[0] = "edge"
        if j < len(points):
            part.append(zero_between(one.condition, lambda v: float(inset(v)), points[j - 1], points[j]))
            ends[1] = "edge"
        found.append(TracedCurve(one.kind, one.condition, TracedLine(np.array(part), False, (ends[0], ends[1]))))
    return found


def _refine(one: TracedCurve, place: Callable[[Array], Array]) -> Array:
    """Return points along a curve, more of them where it crosses the unit square of places in long steps."""
    points = one.points
    for _ in range(MAX_CHART_HALVINGS):
        at = place(points)
        low, high = np.minimum(at[1:], at[:-1]), np.maximum(at[1:], at[:-1])
        met = (high >= 0.0).all(axis=1) & (low <= 1.0).all(axis=1)
        long = np.flatnonzero(met & (np.hypot(*(high - low).T) > MAX_CHART_STEP)).tolist()
        if not long:
            break
        chords = points[1:] - points[:-1]
        middles = [
            point_across(one.condition, points[i] + 0.5 * chords[i], chords[i] / math.sqrt(chords[i] @ chords[i]))
            for i in long
        ]
        kept = [(i + 1, v) for i, v in zip(long, middles, strict=True) if v is not None]
        if not kept:
            break
        points = np.insert(points, [i for i, _ in kept], [v for _, v in kept], axis=0)
    return points


def _singular(family: SystemFamily, one: TracedCurve) -> bool:
    return all(abs(conditions.EquatorEquations(family, v).determinant) < SINGULAR_DETERMINANT for v in one.points)


def _where_it_holds(family: SystemFamily, kind: SpecialKind, one: TracedCurve) -> list[TracedCurve]:
    """Parts of a curve along which det J has the sign of its kind, with the ends at which it is 0."""
    if kind.level:  # the square of tr J has it
        return [one]

    def determinant(v: Array) -> float:
        return conditions.InteriorEquations(family, v).determinant

    points = one.points
    value = np.array([determinant(v) for v in points])
    good = kind.holds(value)
    if good.all():
        return [one]
    if one.curve.closed and good[0]:  # begin where it has the other one
        first = int(np.argmin(good))
        points = np.concatenate([points[first:], points[1 : first + 1]])
        value = np.concatenate([value[first:], value[1 : first + 1]])
        good = kind.holds(value)
    found: list[TracedCurve] = []
    i = 0
    while i < len(points):
        if not good[i]:
            i += 1
            continue
        j = i
        while j + 1 < len(points) and good[j + 1]:
            j += 1
        part = list(points[i : j + 1])
        if i > 0:
            part.insert(0, zero_between(one.condition, determinant, points[i - 1], points[i]))
        if j + 1 < len(points):
            part.append(zero_between(one.condition, determinant, points[j], points[j + 1]))
        ends = ("det J = 0" if i > 0 else one.curve.ends[0], "det J = 0" if j + 1 < len(points) else one.curve.ends[1])
        if len(part) > 1 and np.abs(value[i : j + 1]).max() > LINE_DETERMINANT:
            found.append(TracedCurve(one.kind, one.condition, TracedLine(np.array(part), False, ends)))
        i = j + 1
    return found


def _each_once(found: list[TracedCurve]) -> list[TracedCurve]:
    """Leave out curves that lie on an earlier one of their kind: a symmetry makes them."""
    kept: list[TracedCurve] = []
    for one in found:
        if not any(one.kind == other.kind and _lies_on_line(one.plane, other.plane) for other in kept):
            kept.append(one)
    return kept


def _lies_on_line(points: Array, line: Array) -> bool:
    """Whether all points lie on a line but for its bends."""
    few = points[np.linspace(0, len(points) - 1, 9).astype(int)]
    bend = 0.02 * (np.diff(line, axis=0) ** 2).sum(axis=1).max()
    return bool((distance(few, line) < SAME_CURVE_DISTANCE + bend).all())
