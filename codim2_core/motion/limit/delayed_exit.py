"""The delayed exit of a slide from a critical set that has lost its stability, and where the motion leaves to.

That is past a Hopf bifurcation, or an exchange of stability on a set that does not move.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...numerics.radau import Step
from ...results.arrays import Array
from ...results.words import say
from ...systems.psi.function import Psi
from ..initial_value.field import Field
from ..tracked_set import in_disc, jacobian
from .delay import DelayedExitPoint, cut_at_exit
from .sigma_decision import ORBITS_AROUND, START_DISTANCE
from .slide import Slide

ARRIVAL_DISTANCE = 1e-3  # from a set, in p, at which it is asked on which side a motion comes


@dataclass(frozen=True)
class DelayedExit:
    """The slide past the bifurcation, cut where the motion leaves; why it goes on; and the way out."""

    part: Slide
    reason: str
    way: DelayedExitPoint | None


def cut_at_delayed_exit(
    field: Field, psi: Psi, before: tuple[Sequence[Step], Sequence[Array]], part: Slide, C: str | None, how: str
) -> DelayedExit:
    """Cut a slide past the bifurcation where the motion leaves the set.

    Raises NotAnalyticError.
    """
    taken, places = before
    part, way = cut_at_exit(field, psi, taken, places, part)
    key = "Hopf, delayed"
    if way is not None:
        key = "Hopf, delayed until" if way.buffer is None else "Hopf, delayed until the buffer"
    return DelayedExit(part, say(key, C=C, how=how), way)


def exit_circle(psi: Psi, e: Array) -> Array:
    """Points (k, 2) of the projected disc around a critical set, from which orbits show where a motion leaves it to."""
    angle = math.tau * np.arange(ORBITS_AROUND) / ORBITS_AROUND
    return in_disc(psi, e) + START_DISTANCE * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def departure_point(field: Field, psi: Psi, e: Array, z: Sequence[Array], arrival: Array) -> Array | None:
    """Return the point (1, 2) of the disc to which a motion leaves a set at rest: on the side on which it came.

    A motion keeps the sign of its distance along the leading eigenvalue while that is real.

    None where no side is known: it began on the set, or an eigenvalue turns. Shapes: e (2,), z (m,), arrival (k, 2).
    """
    C, first, left = in_disc(psi, e), None, np.zeros(2)
    for at in z:
        values, vectors = np.linalg.eig(jacobian(field, psi, e, at).T)
        if np.iscomplexobj(values):
            return None
        n = vectors[:, int(np.argmax(values))]
        left = -n if n @ left < 0.0 else n
        first = left if first is None else first
    away = arrival - C
    far = np.flatnonzero(np.hypot(*away.T) > ARRIVAL_DISTANCE)
    if first is None or not len(far):
        return None
    values, vectors = np.linalg.eig(jacobian(field, psi, e, z[-1]))
    right = vectors[:, int(np.argmax(values))]
    side = math.copysign(1.0, float(first @ away[far[-1]]) * float(left @ right))
    return (C + side * START_DISTANCE * right)[None]
