"""The end of a motion whose steps become too short: it grows beyond all bounds, or its formulas end."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..words import say
from .radau import StepsTooShortError, TooManyStepsError

GROWTH_STEPS = 100.0  # of the shortest: what grows by its own size within these has no later time
RATE = 1e-12  # of the time: what grows by its own size in less ends there


class BlowUpError(TooManyStepsError):
    """The motion grows beyond all bounds; the message says near which time."""


def too_short(state: Array, rate: Array, t: float, shortest: float = 0.0) -> TooManyStepsError:
    """Say why steps became too short at a state: it blows up, or its formulas end."""
    if (np.abs(rate) * max(RATE * abs(t), GROWTH_STEPS * shortest) > 1.0 + np.abs(state)).any():
        return BlowUpError(say("blow-up time", t=t))
    return StepsTooShortError(say("undefined from", t=t))
