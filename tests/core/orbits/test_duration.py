"""A portrait shows where its orbits end, at any ratio of coefficients."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.orbits.duration import LEAST, MOST, drawn_duration
from codim2_core.orbits.trajectories import Status

CASE_III = c2.ELinear(172, 186, -200, f=(-86, -93))


def ends(scene):
    return np.array([points[-1] for points in scene["inside"].forward.points])


def test_trajectories_of_case_three_reach_the_stable_focus():
    """The focus turns in 0.43; trajectories were cut off at T = 0.2."""
    scene = c2.Scene(CASE_III, psi.hill(2))
    (C,) = scene["critical"]
    assert C.kind == "stable focus"
    assert (np.hypot(*(ends(scene) - C.p).T) < 1.5e-3).sum() >= 16


@pytest.mark.parametrize("ratio", [1.0, 30.0, 120.0])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e4])
def test_all_orbits_end_at_the_node_of_case_one(ratio, unit):
    scene = c2.Scene(c2.ELinear(-unit, 0.3 * unit, -ratio * unit, (-0.5 * unit, 0.1 * unit)), psi.tanh(), count=24)
    (C,) = scene["critical"]
    assert np.hypot(*(ends(scene) - C.p).T).max() < 2.0 / 180.0
    assert Status.T_MAX not in scene["inside"].forward.status


@pytest.mark.parametrize("key", ["case1-cm0", "case1-cm4", "case2-ncm4", "case3-n1", "case3-n3"])
def test_no_half_is_cut_off_by_its_time(key):
    preset = c2.presets[key]
    scene = c2.Scene(preset.system, preset.psi, preset.z)
    for halves in (scene["inside"], scene["outside"]):
        for half in (halves.forward, halves.backward):
            assert list(half.status).count(Status.T_MAX) <= len(half) // 20


def test_the_time_is_bounded_where_something_never_ends():
    for system in (c2.ELinear(0, 1, 0), c2.ELinear(-1e-9, 1, -1e-9), c2.ELinear(0, 0, 0), c2.ELinear(-1, 0, -1)):
        at = system.at()
        longest = drawn_duration(at, c2.equator_equilibria(at), c2.critical_sets(at, psi.constant()))
        assert LEAST <= longest * (at.size or 1.0) <= MOST * (1.0 + 1e-15)
