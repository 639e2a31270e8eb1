"""Any system in which one parameter varies, with its ray; `continuation.corrector` asks it for turns."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..parameter_family import TurnRequest
from ..turns import ReturnMapPoint
from .ray import Ray, room
from .section_base import Array, At, SectionBase
from .typed_turn import FiniteDifference, TurnOrbit, turn

DIFFERENCE_STEP = 1e-5  # of the span, of the differences for derivatives: they tell the way, not the place


class VariedRay:
    """A ray from a foot in a fixed direction, at each value of the parameter.

    Parameters
    ----------
    at : callable
        value -> (system frozen at it, Psi).
    scale : float
        Size of changes of the value.
    bounds : (float, float)
        What the parameter may be.
    foot, centre : SectionBase
        From where the ray starts; from where amplitudes are measured.
    u : ndarray (2,)
        Its direction.
    """

    def __init__(
        self, at: At, scale: float, bounds: tuple[float, float], foot: SectionBase, centre: SectionBase, u: Array
    ) -> None:
        self.at, self.scale, self.bounds, self.foot, self.centre, self.u = at, scale, bounds, foot, centre, u

    def ray(self, value: float) -> Ray:
        """Return the ray at one value."""
        return Ray(*self.at(value), self.foot.place(value), self.u)

    def course(self, xi: float, value: float, backward: bool) -> TurnOrbit | None:
        """Follow one turn; None if it does not return, or the value is not allowed."""
        low, high = self.bounds
        if not (math.isfinite(xi) and low <= value <= high):
            return None
        before, after = max(value - DIFFERENCE_STEP * self.scale, low), min(value + DIFFERENCE_STEP * self.scale, high)
        try:
            ends, centre = [self.foot.place(v) for v in (before, after)], self.centre.place(value)
            width, reaches = after - before, [room(end, self.u)[0] for end in ends]
            moved, widened = (ends[1].p - ends[0].p) / width, (reaches[1] - reaches[0]) / width
            beside = FiniteDifference(self.at(before), self.at(after), width, moved, widened)
            return turn(self.ray(value), xi, value, beside, centre, backward)
        except ValueError:  # beyond the span, where the system ends
            return None

    def answer(self, question: TurnRequest) -> list[ReturnMapPoint | None]:
        """Follow the turns that are asked for."""
        asked = zip(question.xi, question.values, question.backward, strict=True)
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            found = [self.course(xi, value, backward) for xi, value, backward in asked]
        return [None if one is None else one.turn for one in found]


def run_typed_batch(questions: Sequence[TurnRequest]) -> list[list[ReturnMapPoint | None]]:
    """Follow the turns of several questions."""
    return [question.family.answer(question) for question in questions]
