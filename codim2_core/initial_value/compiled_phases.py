"""Phases of a nonsmooth motion, compiled: for systems whose formulas are compiled already or are long asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from dataclasses import field as made_with
from typing import TYPE_CHECKING

from ..arrays import Array
from ..numerics.radau import Problem, Step
from ..psi.constructors import constant
from .field import Field
from .line import InvariantLine

if TYPE_CHECKING:
    from .compiled_motion import CompiledMotion
    from .compiled_slow import CompiledSlow


#: Of rtol, asked of the steps of a slip: explicit ones use up what is allowed, implicit ones leave most of it. So a
#: slip is as accurate as the same one in Python, for a tenth more steps.
OF_SLIPS = 0.5


@dataclass
class CompiledPhases:
    """Makes the steps of slips and slides.

    Attributes
    ----------
    problem : Problem
        `plane_problem` with eps = 0, in Python.
    field : Field
    line : InvariantLine or None
    rtol, floor : float
        As in `initial_value.compiled_motion.CompiledMotion`.
    """

    problem: Problem
    field: Field
    line: InvariantLine | None
    rtol: float
    floor: float
    _begun: list[CompiledMotion] = made_with(default_factory=list)

    @property
    def evaluations(self) -> int:
        """Return the number of evaluations of the field so far."""
        return sum(motion.evaluations for motion in self._begun)

    def slip(self, t: float, t_end: float, state: Array, h: float, most: int, farthest: float) -> Iterator[Step]:
        """Step until the motion is as close to Sigma as `slip` asks for, or to t_end.

        Raises
        ------
        BlowUpError, TooManyStepsError
            As `bounded` does.
        """
        from .compiled_motion import CompiledMotion  # loads the compiler

        own = (self.problem, self.field, constant(), 0.0, self.line)
        motion = CompiledMotion(*own, t, t_end, state, OF_SLIPS * self.rtol, self.floor, h, most, farthest)
        self._begun.append(motion)
        for part in motion.chunks():
            yield from part

    def slide(
        self, problem: Problem, e: Array, t: float, t_end: float, z: Array, h: float, most: int, shortest: float
    ) -> CompiledSlow:
        """Begin a slide on the critical set that is e at z; `problem` is its slow flow in Python."""
        from .compiled_slow import CompiledSlow  # loads the compiler

        own = (problem, self.field, e, self.line, t, t_end, z, self.rtol, self.floor)
        motion = CompiledSlow(*own, h, most, shortest)
        self._begun.append(motion)
        return motion
