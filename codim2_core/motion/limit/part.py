"""A phase of a nonsmooth motion while the motion is under way."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...numerics.dense import Dense
from ...psi.function import Psi
from ...systems.kinds import AnySystem
from ..places import Ascent, Leaving, OfState, OnCycle, OnSet, Place
from ..result import Phase

Array = NDArray[np.float64]


@dataclass(frozen=True)
class MotionPart:
    """A phase whose motion is under way: made a `Phase` when all of it is known."""

    phase: Phase
    times: list[float]
    ascent: Ascent | None
    e: Sequence[Array] = ()  # at `times`, while it slides
    p: Sequence[Array] = ()  # also, while it slides on a cycle of a general system
    theta: float | None = None  # in which a crossing leaves

    def placed(self, system: AnySystem, psi: Psi, motion: Dense) -> Phase:
        """Return the phase, which knows where it lies at any of its times."""
        phase, times = self.phase, np.array(self.times)
        e, p = (np.array(column[: len(times)]) for column in (self.e, self.p))
        times = times[: len(e)] if len(e) else times
        where: Place
        if self.theta is not None:
            where = Leaving(self.theta)
        elif phase.kind != "slide":
            where = OfState(motion, None, 0.0, phase.t_start, phase.t_end)
        elif len(p):
            where = OnCycle(times, e, p)
        else:
            where = OnSet(system, psi, motion, times, e)
        return phase.placed(where, self.ascent)
