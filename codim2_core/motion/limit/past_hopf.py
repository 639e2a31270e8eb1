"""Past a Hopf bifurcation: the slide on a critical set that has lost its stability, while the loss is delayed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...initial_value.field import Field
from ...numerics.radau import Step
from ...psi.function import Psi
from ...words import say
from ..followed import in_disc
from .decide import AROUND, BESIDE
from .delay import WayOut, delayed
from .slide import Slide

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stay:
    """The slide past the bifurcation, cut where the motion leaves; why it goes on; and the way out."""

    part: Slide
    reason: str
    way: WayOut | None


def stay(field: Field, psi: Psi, before: tuple[Sequence[Step], Sequence[Array]], part: Slide, C: str | None) -> Stay:
    """Cut a slide past the bifurcation where the motion leaves the set.

    Parameters
    ----------
    field : Field
    psi : Psi
    before : (steps, places)
        Of the slide to the bifurcation, and e at its start and at the end of each step.
    part : Slide
        How the slow flow goes on from there.
    C : str or None
        Name of the set.

    Raises
    ------
    NotAnalyticError
    """
    taken, places = before
    part, way = delayed(field, psi, taken, places, part)
    key = "Hopf, delayed"
    if way is not None:
        key = "Hopf, delayed until" if way.buffer is None else "Hopf, delayed until the buffer"
    return Stay(part, say(key, C=C), way)


def ring(psi: Psi, e: Array) -> Array:
    """Points (k, 2) of the projected disc around a critical set, from which orbits show where a motion leaves it to."""
    angle = math.tau * np.arange(AROUND) / AROUND
    return in_disc(psi, e) + BESIDE * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
