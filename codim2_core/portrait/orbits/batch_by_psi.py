"""Trajectories of one system under several Psi, side by side in the lanes: each Psi has lanes of its own."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from ...results.arrays import Array
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from .options import Stepping
from .result import Trajectories
from .trajectories import in_lanes, integrate_explicitly


def batch_by_psi(
    at: FrozenSystem, psis: Sequence[Psi], states: Sequence[Array], options: Stepping
) -> list[Trajectories]:
    """Follow states of the hemisphere under several Psi side by side, explicitly.

    One alone, and typed ones, of which the field is compiled for the picture, are followed by themselves.

    Those of each Psi. Shapes: states (k, 3).
    """
    every = range(len(psis))
    some = [i for i in every if not psis[i].record.typed]
    if len(some) < 2:
        some = []
    found = {
        i: integrate_explicitly(at, psis[i], states[i], _is_inside_disc(states[i]), options)
        for i in every
        if i not in some
    }
    if some:
        lines = _blocks(at, [psis[i] for i in some], [states[i] for i in some], options)
        found.update(zip(some, lines, strict=True))
    return [found[i] for i in every]


def states_at(points: Array) -> Array:
    """States (k, 3) of points (k, 2) of the hemisphere."""
    from ..stepping.layout import states_of

    return states_of(np.array(points, order="C"))[0]


def _is_inside_disc(states: Array) -> Array:
    return np.full(len(states), -1.0)


def _blocks(at: FrozenSystem, psis: Sequence[Psi], states: Sequence[Array], options: Stepping) -> list[Trajectories]:
    from ..stepping.layout import BLOCKS
    from ..stepping.right_hand_side import problems

    found: list[Trajectories] = []
    for first in range(0, len(psis), BLOCKS):
        some = slice(first, first + BLOCKS)
        every = np.concatenate(states[some])
        until = list(itertools.accumulate(map(len, states[some])))
        found += in_lanes(at, problems(at, psis[some], options.backward), every, _is_inside_disc(every), until, options)
    return found
