"""A portrait shows where its orbits end, at any ratio of coefficients."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.portrait.orbits.trajectories import MAX_DURATION, MIN_DURATION, Status, drawn_duration


def ends(scene):
    return np.array([points[-1] for points in scene["inside"].forward.points])


@pytest.mark.parametrize("ratio", [1.0, 30.0, 120.0, 900.0, 1e4, 1e6])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e4])
def test_all_orbits_end_at_the_node_of_case_one(ratio, unit):
    scene = c2.Scene(c2.ELinear(-unit, 0.3 * unit, -ratio * unit, (-0.5 * unit, 0.1 * unit)), psi.tanh(), count=24)
    (C,) = scene["critical"]
    assert np.hypot(*(ends(scene) - C.p).T).max() < 2.0 / 180.0
    assert Status.T_MAX not in scene["inside"].forward.status


def test_the_time_is_bounded_where_something_never_ends():
    for system in (c2.ELinear(0, 1, 0), c2.ELinear(-1e-9, 1, -1e-9), c2.ELinear(0, 0, 0), c2.ELinear(-1, 0, -1)):
        at = system.at()
        longest = drawn_duration(at, c2.equator_equilibria(at), c2.critical_sets(at, psi.constant()))
        assert MIN_DURATION <= longest * (at.size or 1.0) <= MAX_DURATION * (1.0 + 1e-15)


STIFF = [
    (c2.ELinear(-1, 0.3, -1e3, (-0.5, 0.1)), psi.tanh()),
    (c2.ELinear(-1e4, 20.0, -1, (300.0, -0.2)), psi.hill(3)),
    (c2.ELinear(-1, 0.0, -1e6, (-0.5, 1e5)), psi.constant()),
    (c2.ELinear(-1, 10.0, -1e4, (-0.9, 8e3)), psi.exponential()),  # entered from the side
    (c2.ELinear(-1, 0.2, -1e4, (-1.5, 30.0)), psi.rational()),  # no critical set: all leave
    (c2.ELinear(1, 0.2, -1e4, (0.3, 30.0)), psi.rational()),  # a saddle
    (c2.System(U=("-c + 0.2*s**2", "-3e4*(s - 0.3*c)")), psi.tanh()),
]


@pytest.mark.parametrize(("system", "family"), STIFF)
@pytest.mark.parametrize("backward", [False, True])
def test_every_orbit_of_a_stiff_portrait_ends_where_it_ends(system, family, backward):
    """And no half asks for more than 12 000 evaluations, whatever the ratio of the rates."""
    if backward:
        minus = lambda v: f"-({v})" if isinstance(v, str) else -v
        if isinstance(system, c2.System):
            system = c2.System(U=tuple(minus(u.text) for u in system.U))
        else:
            system = c2.ELinear(minus(system.a), minus(system.b), minus(system.d), tuple(map(minus, system.f)))
    scene = c2.Scene(system, family, count=32)
    places = [C.p for C in scene["critical"]]
    for orbits in (scene["inside"], scene["outside"]):
        for half in (orbits.forward, orbits.backward):
            assert not {Status.STEP_LIMIT, Status.T_MAX} & set(half.status)
            assert half.evaluations <= 12_000 * max(len(half), 1)
            for end, status in zip(half.ends, half.status, strict=True):
                if status is Status.EQUILIBRIUM:
                    assert min(np.hypot(*(end[:2] - p)) for p in places) < 1.0 / 180.0
                if status is Status.ARRIVED:
                    assert end[2] < 0.02
