"""Phases of a nonsmooth motion whose end is not known yet: they become a `Phase` once the motion is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...numerics.dense import Dense
from ...results.arrays import Array
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..delay import delay
from ..initial_value.field import field
from ..locations import Ascent, Leaving, Location, OfState, OnCycle, OnSet
from ..result import Phase
from .delay import DelayedExitPoint


@dataclass(frozen=True)
class PendingDelay:
    """A slide on a critical set that has lost its stability: since when the motion is on it, and when it leaves."""

    t_in: float
    way: DelayedExitPoint | None  # None if it does not while the slide lasts
    bifurcation: str = "Hopf"


@dataclass(frozen=True)
class PendingPhase:
    """A phase whose motion is under way: made a `Phase` when all of it is known."""

    phase: Phase
    times: list[float]
    ascent: Ascent | None
    e: Sequence[Array] = ()  # at `times`, while it slides
    p: Sequence[Array] = ()  # also, while it slides on a cycle of a general system
    theta: float | None = None  # in which a crossing leaves
    delaying: PendingDelay | None = None

    def placed(self, system: AnySystem, psi: Psi, motion: Dense) -> Phase:
        """Return the phase, which knows where it lies at any of its times."""
        phase, times = self.phase, np.array(self.times)
        e, p = (np.array(column[: len(times)]) for column in (self.e, self.p))
        times = times[: len(e)] if len(e) else times
        where: Location
        if self.theta is not None:
            where = Leaving(self.theta)
        elif phase.kind != "slide":
            where = OfState(motion, None, 0.0, phase.t_start, phase.t_end)
        elif len(p):
            where = OnCycle(times, e, p)
        else:
            where = OnSet(system, psi, motion, times, e)
        if self.delaying is not None and len(e) and phase.onto is not None:
            span, way = (self.delaying.t_in, phase.t_start, phase.t_end), self.delaying.way
            how, out = self.delaying.bifurcation, (way is not None, way and way.buffer)
            found = delay(field(system), motion, (times, e), phase.onto, span, *out, how)
            phase = replace(phase, delay=found)
        return phase.with_place(where, self.ascent)
