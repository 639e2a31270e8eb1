"""Steps of a variation, one after the other, and how well their product is known."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...formulas.switches import jump_names
from ...results.arrays import Array
from ...results.words import say
from ..initial_value.slopes import Slopes
from .result import Variation


def past_jumps(
    fine: Array, coarse: Array, times: Array, jumps: Mapping[float, bool], slopes: Slopes
) -> tuple[Array, Array, str]:
    """Pass the jumps of a load: what time alone decides changes nothing but what comes from a change of the clock.

    fine, coarse: The steps that are known; changes of a clock end at a jump, as columns of zeros; reason: Why no more
    are. Shapes: fine, coarse (k, N, N), times (k + 1,).
    """
    names = {name for name, _ in slopes.kept}
    for t, by_time in jumps.items():
        step = int(np.searchsorted(times[:-1], t, side="left"))
        if step >= len(fine):
            continue
        if not by_time or not names.isdisjoint(jump_names(slopes.rows)):
            return fine[:step], coarse[:step], say("variation at a jump", t=t)
        for i, row in enumerate(slopes.rows[2:]):
            if row.constant is not None:
                fine[step, :, 2 + i] = coarse[step, :, 2 + i] = 0.0
    return fine, coarse, ""


def chain_propagators(
    names: tuple[str, ...],
    times: Array,
    fine: Array,
    coarse: Array,
    rate: Array,
    reason: str = "",
    within: Array | None = None,
) -> Variation:
    """Make the result of the steps' propagators, up to the first that is undefined.

    Shapes: times (k + 1,), fine, coarse (k, N, N), rate (n,), within (n, k).
    """
    undefined = np.flatnonzero(~np.isfinite(fine).all(axis=(1, 2)))
    if len(undefined):
        first = int(undefined[0])
        fine, coarse, times = fine[:first], coarse[:first], times[: first + 1]
        reason, rate = say("variation undefined", t=float(times[-1])), np.full(len(rate), np.nan)
    one, two = np.eye(fine.shape[1]), np.eye(fine.shape[1])
    with np.errstate(over="ignore", invalid="ignore"):
        for step, longer in zip(fine, coarse, strict=True):
            two, one = step @ two, longer @ one
        error = np.abs(two - one)[: len(rate)]
    times, steps = times.copy(), fine.copy()
    for array in (times, steps, error, rate, *([] if within is None else [within])):
        array.flags.writeable = False
    return Variation(names, times, steps, error, rate, reason, within)
