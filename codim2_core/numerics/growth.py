"""Steps of a motion as long as it exists: where it grows beyond all bounds, no step more is spent on it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Array
from ..words import say
from .radau import Problem, Step, StepsTooShortError, TooManyStepsError

BOUND = 1e200
GROWN = 8.0  # times its size, within the spacing of doubles in time
GROWTH_STEPS = 100.0  # of the shortest: what grows by its own size within these has no later time
RATE = 1e-12  # of the time: what grows by its own size in less ends there


class BlowUpError(TooManyStepsError):
    """The motion grows beyond all bounds; the message says near which time."""


def until_blow_up(problem: Problem, steps: Iterator[Step], shortest: float = 0.0) -> Iterator[Step]:
    """Hand on steps until the state grows beyond all bounds in no time.

    Close to Sigma steps are short too, but the state does not grow there. `shortest` is the step at which they stop.

    Raises
    ------
    BlowUpError
    TooManyStepsError
        As raised by `steps`.
    """
    largest, last = 0.0, None
    try:
        for step in steps:
            size = float(np.abs(step.last).max())
            if last is None:
                largest = max(1.0, float(np.abs(step.first).max()))
            if step.end > step.start:
                largest = max(largest, size)
            last = step
            if size > BOUND or size > GROWN * largest:
                raise BlowUpError(say("blow-up time", t=step.end))
            yield step
    except StepsTooShortError as error:
        if last is not None:
            raise too_short(problem, last.end, last.last, shortest) from error
        raise


def too_short(problem: Problem, t: float, state: Array, shortest: float = 0.0) -> TooManyStepsError:
    """Say why steps became too short at a state: it blows up, or its formulas end."""
    size, rate = np.abs(state), np.abs(problem.F(state))
    if (rate * max(RATE * abs(t), GROWTH_STEPS * shortest) > 1.0 + size).any():
        return BlowUpError(say("blow-up time", t=t))
    return StepsTooShortError(say("undefined from", t=t))
