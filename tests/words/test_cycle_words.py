"""Where the words say that there is no limit cycle no orbit ends on one; where they count, orbits wind onto as many."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.results.words import ROOMS

from .recognition import recognise

ONE = psi.constant()


def wandering(system, family):
    """Return how many of some orbits still move, away from the equator, after a long time."""
    t = np.linspace(0.2, 6.2, 4)
    seeds = np.concatenate([r * np.stack([np.cos(t), np.sin(t)], axis=-1) for r in (0.3, 0.8)])
    size = system.at((0.0,) * system.m).size
    moving = 0
    for backward in (False, True):
        lines = c2.trajectories(system, family, seeds, t_max=150.0 / size, backward=backward).points
        for line in lines:
            late = line[len(line) * 3 // 4 :]
            spread = float(np.hypot(*np.ptp(late, axis=0)))
            moving += bool(spread > 0.05 and np.hypot(*late.T).max() < 0.999 and len(line) > 200)
    return moving


def around(system, family):
    """Return whether orbits about C close, all of them: a band."""
    C = c2.critical_sets(system, family)[0].p
    seeds = C + np.array([[0.1, 0.0], [0.15, 0.0]])
    for line in c2.trajectories(system, family, seeds, t_max=200.0 / system.at(()).size).points:
        turned = np.unwrap(np.arctan2(*(line - C).T[::-1]))
        distance = np.hypot(*(line - C).T)
        if abs(np.interp(math.tau, np.abs(turned - turned[0]), distance) - distance[0]) > 0.02 * distance[0]:
            return False
    return True


NONE = {
    "no set to surround": ELinear(-1, 0.5, -1, (3, 0)),
    "only a saddle": ELinear(1, 0.3, -1.5, (0.2, 0.1)),
    "only saddles": System(U=("c + c**3", "-s")),
    "Bendixson": ELinear(-1, 3, -1.5, (0.3, 0.1)),
    "linear orbits": ELinear(1, 3, -2),
    "preserves area": ELinear(0, 2, 0, (0.3, 0.1)),
    "reversible": ELinear(-1, 3, 1, (0.5, 0.5)),
}


@pytest.mark.parametrize("key", NONE)
def test_where_there_is_none(key):
    system = NONE[key]
    said = c2.limit_cycles(system, ONE).reason
    keys = [found for found, _ in recognise(said)]
    assert keys == [key]
    assert key in ROOMS["cycles"]
    if key in ("preserves area", "reversible"):
        assert around(system, ONE)
    else:
        assert wandering(system, ONE) == 0
