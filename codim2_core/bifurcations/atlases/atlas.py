"""`atlas`: all curves on which the portrait of any system changes over any two parameters, by continuation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...portrait.layer_problem.vary import check_name, limits, value_of
from ...portrait.layer_problem.vary import names as names_of
from ...results.arrays import Array, read_only
from ...systems.arguments import short_repr
from ...systems.kinds import AnySystem, as_elinear, in_axes_of, takes_names
from ...systems.psi.function import Psi
from ..families.disc import disc_family, force_matrix
from ..families.family import Ranges, SystemFamily
from .class_borders import class_borders, undefined_borders
from .codim_two_points import SpecialPlace, away_from, crossings, curve_numbers, each_once, places
from .connections.connection_curves import KINDS, connection_curves
from .curves import border_curves, curves_of, parts_within
from .cycles.cycle_curves import KIND, NEUTRAL_LOOP, cycle_curves
from .disc_atlas import clip_curve, curves_with_images, family_around_disc, is_in_range, points_with_images
from .regions import regions_of
from .result import Atlas, AtlasCurve, AtlasPoint
from .seed_net import NO_SEEDS, CurveSeeds, DegenerateLine, degenerate_lines, seeds_near
from .tracing import TracedCurves

#: Where U is tried, in the unit square.
TRIAL_PLACES = (0.5, 0.5), (0.21, 0.33), (0.83, 0.27), (0.29, 0.79), (0.71, 0.89)
MAX_UNLIKE_SHARE = (
    0.25  # of the places looked at: where more are in the wrong region no border is followed by bisection
)
DEFAULT_HALF_RANGE = (
    2.0  # range on either side of a parameter's value where none is given, or the value if that is more
)


@takes_names
def atlas(
    system: AnySystem,
    psi: Psi,
    ranges: Mapping[str, tuple[float, float] | None] | Sequence[str],
    z: ArrayLike = (),
    *,
    with_cycles: bool = False,
) -> Atlas:
    """All curves over two parameters on which the portrait changes, where they meet, and the regions between.

    Each curve is the set of zeros of equations in the two parameters and a place, an angle of the equator or a point
    within it, and is followed by pseudo-arclength; its points are zeros to the last digits. Where to begin is looked
    for on a net: 64 angles by 24 x 24 values of the parameters on the equator, 16 in each direction within. A curve
    that keeps within one cell may be missed; what no equation of a regular curve has, as a change where U has a corner,
    is followed by bisection as far as that leads; the result says of which kinds some may be missing, and at how many
    places its regions were looked at and found to be others. The regions are the faces into which the curves cut the
    plane, each named by the portrait at a place well inside it.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi
    ranges : mapping, or two names
        What is varied, across and then up, and how far, such as ``{"f1": (-2, 2), "f2": (-2, 2)}``: two of a, b, d,
        f1, f2 as far as they are numbers, the system's own parameters, z1 to zm (z is z1), and the parameter of Psi,
        such as n. Two names, or None for a range: about the present values.
    z : (m,) floats
    with_cycles : bool
        Also what limit cycles are born from and die in, which takes some seconds: see `with_folds_of_cycles` and
        `with_connections`.

    Returns
    -------
    Atlas

    Raises
    ------
    ValueError
        A name cannot be varied or is given twice, a range is empty or beyond what is allowed, z does not fit, or U has
        no value in the middle nor at four places about it.

    Examples
    --------
    >>> import codim2_core as c2
    >>> found = c2.atlas(c2.ELinear(-2, 0, -1), c2.psi.constant(), ("f1", "f2"))
    >>> sorted({curve.kind for curve in found.curves})
    ['saddle-node', 'transcritical']
    >>> sorted({region.name for region in found.regions})
    ['CM2, stable node', 'CM4, stable node', 'NCM2']
    """
    found = with_regions(system, psi, curves_over(system, psi, *_names_and_ranges(ranges), z), z)
    return with_bifurcations_of_cycles(system, psi, found, z) if with_cycles else found


def curves_over(system: Any, psi: Psi, across: str, up: str, ranges: Any = None, z: ArrayLike = ()) -> Atlas:
    """Curves and points of an atlas, without its regions: of two names, and the range of each."""
    return _curves_over(family_over(system, psi, z, across, up, ranges))


def borders_over(family: SystemFamily) -> Atlas:
    """Return the curves and points of a plane that are known in closed form: of a family with `force_matrix`."""
    chart = disc_family(family) or family
    return _atlas_of(family, chart, *border_curves(chart), (), True)


def _curves_over(family: SystemFamily, seeds: CurveSeeds = NO_SEEDS) -> Atlas:
    chart = disc_family(family) or family
    closed_form = force_matrix(family) is not None
    lines = () if closed_form else degenerate_lines(family)
    return _atlas_of(family, chart, *curves_of(chart, lines, closed_form, seeds), lines, closed_form)


def _atlas_of(
    family: SystemFamily,
    chart: SystemFamily,
    found: TracedCurves,
    special: Sequence[SpecialPlace],
    lines: Sequence[DegenerateLine],
    closed_form: bool,
) -> Atlas:
    """Return an atlas of curves and special points that were found over a chart."""
    kept = [part for one in found.curves for part in parts_within(one, chart, family)] if closed_form else found.curves
    curves = [
        AtlasCurve(one.kind, read_only(chart.values(one.plane)),
                   read_only(places(chart, one)), read_only(curve_numbers(chart, one)))
        for one in kept
    ]  # fmt: skip
    curves += [_nowhere(family, "degenerate", line.points) for line in lines]
    curves += [_nowhere(family, "undefined", line) for line in undefined_borders(family)]
    met = [one for one in crossings(found.curves, not closed_form) if not any(line.holds(one.plane) for line in lines)]
    points = [
        AtlasPoint(one.kind, (float(at[0]), float(at[1])), one.sentence)
        for one in each_once([*special, *away_from(special, met)])
        for at in [chart.values(one.plane)]
        if not closed_form or is_in_range(family, at)
    ]
    degenerate = tuple((family.names[line.axis], float(family.values(line.points)[0, line.axis])) for line in lines)
    kinds = tuple(dict.fromkeys(found.unfinished))
    (across, up), (first, second) = family.names, family.ranges
    return Atlas((across, up), (first, second), tuple(curves), tuple(points), (), kinds, degenerate)


def _nowhere(family: SystemFamily, kind: str, plane: Array) -> AtlasCurve:
    """Return a curve that belongs to no place of the portrait."""
    places = read_only(np.full((len(plane), 2), math.nan))
    return AtlasCurve(kind, read_only(family.values(plane)), places, read_only(np.zeros(0)))


def with_regions(system: Any, psi: Psi, found: Atlas, z: ArrayLike = ()) -> Atlas:
    """Return an atlas with the regions between its curves, of the same system, psi and z.

    Where a portrait is not that of its region, curves are looked for once more, from there.
    """
    family = family_over(system, psi, z, *found.names, found.ranges)
    whole = _with_regions(family, found)
    if whole.looked.unlike and (seeds := seeds_near(disc_family(family) or family, whole.looked.unlike)) != NO_SEEDS:
        again = _with_regions(family, _curves_over(family, seeds))
        if len(again.looked.unlike) < len(whole.looked.unlike):
            whole = again
    if 0 < len(whole.looked.unlike) < MAX_UNLIKE_SHARE * whole.looked.places:
        known = [family.units(one.points) for one in whole.curves]
        lines = class_borders(family, whole.looked.unlike, known)
        more = tuple(_nowhere(family, "change of critical sets", line) for line in lines)
        again = _with_regions(family, replace(whole, curves=whole.curves + more))
        if len(again.looked.unlike) < len(whole.looked.unlike):
            return again
    return whole


def _with_regions(family: SystemFamily, found: Atlas) -> Atlas:
    # a neutral equator is in no name of an e-linear portrait, and of a reversible one it lies on the Hopf curve
    uncut = (KIND, *KINDS, *(("neutral equator",) if as_elinear(family.system) is not None else ()))
    still = [one.points for one in found.curves if one.kind not in uncut]
    regions, looked = regions_of(family, still, [one.place for one in found.points])
    return replace(found, regions=regions, looked=looked)


def with_folds_of_cycles(system: Any, psi: Psi, found: Atlas, z: ArrayLike = ()) -> Atlas:
    """Return an atlas with its folds of limit cycles, of the same system, psi and z; they cut no region.

    They are begun at generalised Hopf points, and at the folds on branches of cycles along some lines each way: one
    that meets none of these is missed, and where branches see no cycle no fold is seen.
    """
    return _with_more(family_over(system, psi, z, *found.names, found.ranges), found, _folds)


def with_connections(system: Any, psi: Psi, found: Atlas, z: ArrayLike = ()) -> Atlas:
    """Return an atlas with the connections of its saddles, of the same system, psi and z; they cut no region.

    Those are loops of critical sets that are saddles, heteroclinic cycles through the equator, and single connections.
    They are begun where the branches of two saddles change sides on some lines across the plane, and next to
    Bogdanov-Takens points and saddle-nodes on the equator: a curve that meets none of these is missed, and so is an
    orbit that winds about on its way.
    """
    return _with_more(family_over(system, psi, z, *found.names, found.ranges), found, _connections)


def with_bifurcations_of_cycles(system: Any, psi: Psi, found: Atlas, z: ArrayLike = ()) -> Atlas:
    """Return an atlas with the connections of saddles, and folds of the limit cycles that are born from them."""
    family = family_over(system, psi, z, *found.names, found.ranges)
    return _with_more(family, found, _connections, _folds)


More = Callable[[SystemFamily, Atlas], Atlas]


def _folds(family: SystemFamily, found: Atlas) -> Atlas:
    curves, points = cycle_curves(family, found.curves, found.points)
    return replace(found, curves=found.curves + tuple(curves), points=found.points + tuple(points))


def _connections(family: SystemFamily, found: Atlas) -> Atlas:
    curves, points, missed = connection_curves(family, found.curves, found.points)
    return replace(
        found, curves=found.curves + tuple(curves), points=found.points + tuple(points),
        unfinished=tuple(dict.fromkeys(found.unfinished + missed)),
    )  # fmt: skip


def _with_more(family: SystemFamily, found: Atlas, *steps: More) -> Atlas:
    """Return an atlas with what some steps find: over the disc of critical sets, where the family has that chart."""
    chart = disc_family(family)
    if chart is None:
        for step in steps:
            found = step(family, found)
        return found
    known = _curves_over(family_around_disc(chart))
    loops = tuple(one for one in found.points if one.kind == NEUTRAL_LOOP)  # of an earlier step
    whole = known = replace(known, points=known.points + loops)
    for step in steps:
        whole = step(chart, whole)
    both = curves_with_images(chart, whole.curves[len(known.curves) :])
    curves = [part for one in both for part in clip_curve(one, family)]
    imaged = points_with_images(chart, whole.points[len(known.points) :])
    points = [one for one in imaged if is_in_range(family, np.array(one.place))]
    return replace(
        found, curves=found.curves + tuple(curves), points=found.points + tuple(points),
        unfinished=tuple(dict.fromkeys(found.unfinished + whole.unfinished)),
    )  # fmt: skip


def family_over(system: Any, psi: Psi, z: ArrayLike, across: str, up: str, ranges: Any) -> SystemFamily:
    """Check what `atlas` is given, and return what all of it is computed from."""
    slow = tuple(np.ravel(np.asarray(z, float)).tolist())
    system = in_axes_of(system, across, up)
    for name in (across, up):
        check_name(system, psi, slow, "ranges", name)
    there = names_of(system, psi, slow)
    first, second = ("z1" if name == "z" and "z" not in there else name for name in (across, up))
    both = first, second
    if both[0] == both[1]:
        raise ValueError(f"ranges are both of {both[0]!r}; choose two different names.")
    family = SystemFamily(system, psi, slow, both, _ranges(system, psi, slow, both, ranges))
    _check_somewhere(family)
    return family


def _names_and_ranges(ranges: object) -> tuple[str, str, object]:
    """Return the two names that an atlas is over, and their ranges, as they are given."""
    if isinstance(ranges, Mapping | Sequence) and not isinstance(ranges, str | bytes) and len(ranges) == 2:
        across, up = ranges
        if isinstance(across, str) and isinstance(up, str):
            return across, up, tuple(ranges.values()) if isinstance(ranges, Mapping) else None
    raise ValueError(f'ranges are {short_repr(ranges)}; give two, such as {{"f1": (-2, 2), "f2": (-2, 2)}}.')


def _check_somewhere(family: SystemFamily) -> None:
    """Say what is wrong if U has no value at any of a few places."""
    wrong: ValueError | None = None
    for place in TRIAL_PLACES:
        try:
            at, _, slow = family.at(np.array(place))
            at.at(slow)
        except ValueError as error:
            wrong = wrong or error
        else:
            return
    if wrong is not None:
        raise wrong


def _ranges(system: Any, psi: Psi, z: Sequence[float], names: Sequence[str], given: Any) -> Ranges:
    found = []
    for i, name in enumerate(names):
        least, most = limits(system, psi, name)
        if given is None or given[i] is None:
            value = value_of(system, psi, z, name)
            reach = max(DEFAULT_HALF_RANGE, abs(value))
            found.append((max(value - reach, least), min(value + reach, most)))
            continue
        try:
            low, high = (float(v) for v in given[i])
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"ranges are {short_repr(given)}; give two numbers (low, high) for {name}.") from None
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise ValueError(f"ranges are {short_repr(given)}; give (low, high) with low < high for {name}.")
        if not least <= low < high <= most:
            raise ValueError(f"ranges are {short_repr(given)}; of {name} from {least:g} to {most:g} is allowed.")
        found.append((low, high))
    return found[0], found[1]
