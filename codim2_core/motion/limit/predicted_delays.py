"""Delayed losses of stability that lie ahead of a motion which is on a critical set at a given z."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.dense import dense, gather_steps
from ...numerics.radau import truncate_step
from ...portrait.layer_problem.critical import CriticalSet, critical_sets
from ...results.arrays import Array
from ...results.result import Results
from ...systems.arguments import pair, short_repr
from ...systems.elinear import ELinear
from ...systems.kinds import takes_names
from ...systems.psi.function import Psi
from ...systems.reading import slow_axis, slow_values
from ...systems.typed import System
from ..delay import Delay, delay
from ..initial_value.field import Field, field
from .delay import REST_CHANGE, NotAnalyticError, cut_at_exit
from .fold_classification import classify_fold
from .slide import Slide, last_fraction, slide

RTOL, ATOL = 1e-10, 1e-12
MAX_SLIDE_STEPS = 4000  # steps of a slide
MAX_TIME_FACTOR = 100.0  # times as long as the ranges would take at the first rate is a motion followed


@takes_names
def delays(
    system: ELinear | System,
    psi: Psi,
    z: ArrayLike = (),
    ranges: Mapping[str, tuple[float, float]] | None = None,
) -> Results[Delay]:
    """Return where motions on an attracting critical set at z lose its stability, and where they leave it.

    Each is followed with the slow flow, (2.29), from z through a Hopf bifurcation (tr J = 0 < det J), or through an
    exchange of stability (transcritical, pitchfork; det J = 0) on a set that does not move. In the limit
    eps -> 0, where the formulas are analytic and nothing disturbs it, it stays near the critical set until it is
    repelled as much as it was attracted, or to the buffer point before.

    Parameters
    ----------
    system : ELinear or System
        With m >= 1 slow variables.
    psi : Psi
    z : (m,) floats
        Where the motions come to Sigma.
    ranges : mapping, optional
        Such as ``{"z1": (low, high)}``: within these they are followed; slow variables left out have no bounds.

    Returns
    -------
    Results of Delay
        One for each attracting critical set on which a motion comes to such a place within the ranges, and whose
        eigenvalues are smooth in time: without that the delay is not known. Times are counted from z.

    Raises
    ------
    ValueError
        z is not m numbers, or a range is empty or does not hold z.

    Examples
    --------
    It comes at z = -0.6, is attracted till z = 0, and leaves at z = 0.6:

    >>> from codim2_core import System, delays, psi
    >>> turning = System(U=("z*c - s", "c + z*s"), W=("1",))
    >>> [delay] = delays(turning, psi.constant(), (-0.6,), {"z1": (-1, 1)})
    >>> print(f"leaves at z = {delay.z_out[0]:.6f}, {delay.z_out[0] - delay.z_hopf[0]:.6f} past the Hopf point")
    leaves at z = 0.600000, 0.600000 past the Hopf point
    """
    formulas = field(system)
    start = np.array(slow_values(z, formulas.m))
    bounds = np.full((formulas.m, 2), (-math.inf, math.inf))
    if ranges is not None and not isinstance(ranges, Mapping):
        raise ValueError(f'ranges is {short_repr(ranges)}; give them by name, such as {{"z1": (-1, 1)}}.')
    for name, span in (ranges or {}).items():
        bounds[slow_axis("ranges", name, formulas.m)] = pair(f"ranges[{name!r}]", span)
    if not ((bounds[:, 0] < bounds[:, 1]) & (bounds[:, 0] <= start) & (start <= bounds[:, 1])).all():
        raise ValueError(
            f"ranges is {short_repr(ranges)} and z is {start.tolist()}; "
            "give (low, high) with low <= z <= high for each z."
        )
    sets = critical_sets(system, psi, start)
    names = ["C"] if len(sets) == 1 else [f"C{i + 1}" for i in range(len(sets))]
    found = [_predict_delay(formulas, psi, C, name, start, bounds) for C, name in zip(sets, names, strict=True)]
    return Results(one for one in found if one is not None)


def _predict_delay(formulas: Field, psi: Psi, C: CriticalSet, name: str, z: Array, ranges: Array) -> Delay | None:
    """Return the delay ahead on one critical set, None if there is none or it is not known."""
    rate = np.abs(C.slow_flow)
    if not C.kind.startswith("stable") or not rate.any():
        return None
    width = np.where(np.isfinite(ranges).all(axis=1), ranges[:, 1] - ranges[:, 0], 1.0)
    long = MAX_TIME_FACTOR * float(np.min(width[rate > 0.0] / rate[rate > 0.0]))
    options: dict[str, Any] = {"rtol": RTOL, "atol": ATOL, "most": MAX_SLIDE_STEPS}
    before = _restrict_slide(slide(formulas, psi, np.array(C.e), 0.0, z, long, **options), ranges)
    if before.end not in ("hopf", "fold"):
        return None
    hopf = before.taken[-1]
    how = "Hopf" if before.end == "hopf" else classify_fold(formulas, before.e, hopf.last[2:], name, "fold").exchange
    if not how or (how != "Hopf" and np.ptp(before.places, axis=0).max() > REST_CHANGE):
        return None
    options |= {"delayed": True, "resting": how != "Hopf"}
    after = slide(formulas, psi, before.e, hopf.end, hopf.last[2:], hopf.end + long, **options)
    try:
        after, way = cut_at_exit(formulas, psi, before.taken, before.places, _restrict_slide(after, ranges))
    except NotAnalyticError:
        return None
    if not after.taken:
        return None
    taken = [*before.taken, *after.taken]
    motion = dense(0.0, taken[0].first, [gather_steps(taken, len(taken[0].first))])
    known = np.array([hopf.end, *(step.end for step in after.taken)]), np.array(after.places)
    times = 0.0, float(known[0][0]), float(known[0][-1])
    return delay(formulas, motion, known, name, times, way is not None, way and way.buffer, how)


def _restrict_slide(part: Slide, ranges: Array) -> Slide:
    """Cut a slide where z leaves the ranges."""
    inside = lambda z: bool(((ranges[:, 0] <= z) & (z <= ranges[:, 1])).all())
    for k, step in enumerate(part.taken):
        if not inside(step.at(1.0)[2:]):
            taken = [*part.taken[:k], truncate_step(step, last_fraction(inside, step, 50))]
            return replace(part, taken=taken, end="range", e=part.places[k], places=part.places[: k + 2])
    return part
