"""The slip of the nonsmooth system, compiled, for systems whose formulas are compiled already or are long asked for."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..initial_value.field import Field
from ..initial_value.line import Line
from ..numerics.radau import Problem, Step
from ..psi.constructors import constant

Array = NDArray[np.float64]


@dataclass
class CompiledSlip:
    """Steps to Sigma, compiled.

    Attributes
    ----------
    problem : Problem
        The same in Python.
    field : Field
    line : Line or None
    rtol, floor : float
        As in `initial_value.compiled.Compiled`.
    evaluations : int
        Of the field, so far.
    """

    problem: Problem
    field: Field
    line: Line | None
    rtol: float
    floor: float
    evaluations: int = 0

    def steps(self, t: float, t_end: float, state: Array, h: float, most: int, farthest: float) -> Iterator[Step]:
        """Step until the motion is as close to Sigma as `slip` asks for, or to t_end.

        Raises
        ------
        BlowUpError, TooManyStepsError
            As `bounded` does.
        """
        from ..initial_value.compiled import Compiled  # loads the compiler

        own = (self.problem, self.field, constant(), 0.0, self.line)
        motion = Compiled(*own, t, t_end, state, self.rtol, self.floor, h, most, farthest)
        try:
            for part in motion.chunks():
                yield from part
        finally:
            self.evaluations += motion.evaluations
