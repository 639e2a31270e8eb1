"""Steps of a variation, one after the other, and how well their product is known."""

from __future__ import annotations

import numpy as np

from ...arrays import Array
from ...words import say
from .result import Variation


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

    Parameters
    ----------
    names : tuple of str
    times : ndarray (k + 1,)
    fine, coarse : ndarray (k, N, N)
    rate : ndarray (n,)
        Of the state at the last of the times; NaN where that is not asked for.
    reason : str
        Why there are no more steps.
    within : ndarray (n, k), optional
        Basis of the changes that are not left out, if not all.
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
