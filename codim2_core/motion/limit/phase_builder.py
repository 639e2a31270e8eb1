"""Phases of a motion in the limit that was followed compiled; what is said of them is made when it is read."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, partial

from ...arrays import Array
from ...initial_value.compiled_hybrid import DecidedMotion, Segment
from ...initial_value.kernels.hybrid_run import LEAVE, SLIDE, WHOLE
from ...initial_value.line import InvariantLine
from ...numerics.dense import Dense
from ...psi.constructors import constant
from ...psi.function import Psi
from ...systems.kinds import AnySystem
from ...words import say
from ..locations import Ascent
from ..result import Phase
from ..tracked_set import in_disc
from .decide import Decision, critical_name, decide_arrival
from .phase_under_way import MotionPart


@dataclass(frozen=True, eq=False)
class PhaseBuilder:
    """Consecutive parts of a motion, and their system.

    Attributes
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi or None
    line : InvariantLine or None
        The invariant line that the motion stays in.
    found : Followed
    """

    system: AnySystem
    psi: Psi | None
    line: InvariantLine | None
    found: DecidedMotion

    @property
    def whole(self) -> bool:
        """Whether that was all of it."""
        return self.found.onward == WHOLE

    @cached_property
    def parts(self) -> list[MotionPart]:
        """The phases, in order."""
        return [self._part(i, leg) for i, leg in enumerate(self.found.legs)]

    def phases(self, motion: Dense) -> tuple[Phase, ...]:
        """Return them where the motion is known, of which they are a part."""
        own = constant() if self.psi is None else self.psi
        return tuple(part.placed(self.system, own, motion) for part in self.parts)

    def onward(self) -> Decision:
        """Return what follows where the motion was handed over, by the exact path."""
        found, row = self.found, len(self.found.motion.lengths)
        if found.onward == LEAVE:
            return Decision("leave", self._end(len(found.legs), found.theta)[0], theta=found.theta)
        reason, onto = self._arrival(row, found.theta)
        return Decision("slide", reason, found.sets[row].copy(), onto=onto)

    def ascent(self, row: int, theta: float) -> Ascent:
        """Return the orbit up the hemisphere from an arrival at theta, at the beginning of a step."""
        own, z, e = (
            constant() if self.psi is None else self.psi,
            self.found.motion.states[row, 2:],
            self.found.sets[row],
        )
        if self.line is None:
            return Ascent(self.system, own, z, theta)
        return Ascent(self.system, own, z, along=(in_disc(own, self._entry(self.line, theta)), in_disc(own, e)))

    @staticmethod
    def _entry(line: InvariantLine, theta: float) -> Array:
        along = float(line.n @ [math.cos(theta), math.sin(theta)])
        return math.copysign(1.0, along) * line.n

    def _part(self, i: int, leg: Segment) -> MotionPart:
        times = self.found.motion.times
        span = float(times[leg.first]), float(times[leg.last])
        if leg.kind == SLIDE:
            phase = Phase.told_later("slide", *span, partial(self._arrival, leg.first, leg.theta))
            at = slice(leg.first, leg.last + 1)
            return MotionPart(phase, times[at].tolist(), self.ascent(leg.first, leg.theta), list(self.found.sets[at]))
        if leg.kind == LEAVE:
            return MotionPart(Phase.told_later("slip", *span, partial(self._end, i, leg.theta)), [], None)
        return MotionPart(Phase("slip", *span, say("starts outside")), [], None)

    def _arrival(self, row: int, theta: float) -> tuple[str, str | None]:
        """Say why it slides from the beginning of a step on, and on what."""
        z = self.found.motion.states[row, 2:]
        if self.line is None:
            decision = decide_arrival(self.system, self.psi, z, theta)
            return decision.reason, decision.onto
        onto = critical_name(self.system, constant() if self.psi is None else self.psi, z, self.found.sets[row])
        return f"{say('arrives in a line')} {say('slides in a line', onto=onto)}", onto

    def _end(self, i: int, theta: float) -> tuple[str, None]:
        """Say why the slide before phase i has ended."""
        return say("ends at the equator", C=self.parts[i - 1].phase.onto, theta=theta), None
