"""Turns of general systems: their derivatives against differences, and feet that follow critical sets."""

import math
from functools import lru_cache

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.continuation.typed.family import VariedRay
from codim2_core.continuation.typed.foot import Foot
from codim2_core.continuation.typed.ray import crossing
from codim2_core.layer_problem.vary import varied

SYSTEM = c2.System(
    U=("m*c - s + 0.3*c**2 - 2*c*(c**2 + s**2) + 0.1", "c + m*s - 0.2*c*s - 2*s*(c**2 + s**2)"), parameters={"m": 0.3}
)


def family(system, psi, name, value, u):
    @lru_cache(None)
    def at(v):
        changed, member, z = varied(system, psi, (), name, v)
        return changed.at(z), member

    foot = Foot(at, value, c2.critical_sets(system, psi)[0].e)
    return VariedRay(at, 1.0, (-1e3, 1e3), foot, foot, np.array(u))


@pytest.mark.parametrize(("name", "value"), [("m", 0.3), ("n", 2.5)])
@pytest.mark.parametrize("u", [(1.0, 0.0), (-0.6, 0.8)])
@pytest.mark.parametrize("backward", [False, True])
def test_derivatives_are_those_of_differences(name, value, u, backward):
    rays, h = family(SYSTEM, c2.psi.hill(2.5), name, value, u), 1e-4
    for xi in (-2.0, -1.0):
        turn = rays.course(xi, value, backward).turn
        by_xi = rays.course(xi + h, value, backward).turn.shift - rays.course(xi - h, value, backward).turn.shift
        by_value = rays.course(xi, value + h, backward).turn.shift - rays.course(xi, value - h, backward).turn.shift
        assert turn.by_xi == pytest.approx(by_xi / (2 * h), abs=1e-6)
        assert turn.by_value == pytest.approx(by_value / (2 * h), abs=1e-6)


def test_a_foot_follows_its_critical_set_and_stays_where_that_ceases_to_be():
    folding = c2.System(U=("c**2 - p", "-s"), parameters={"p": 0.25})

    def at(v):
        return folding.evolve(p=v).at(), c2.psi.constant()

    foot = Foot(at, 0.25, np.array([0.5, 0.0]))
    for p in (0.36, 0.04, 0.5, 1e-3):
        assert foot.e(p) == pytest.approx([math.sqrt(p), 0.0], abs=1e-12)
    last = foot.e(-0.2)
    assert last[0] == pytest.approx(0.0, abs=2e-2)
    assert np.array_equal(foot.e(-0.3), last)
    assert foot.e(0.36) == pytest.approx([0.6, 0.0], abs=1e-12)


def test_a_ray_crosses_a_bent_cycle_where_no_earlier_point_is_as_far_round():
    t = np.linspace(0.0, 2.0 * np.pi, 400)
    r = 0.3 + 0.2 * np.cos(t)
    spiral = 0.2 * np.exp(1j * (t + 0.9 * np.sin(3.0 * t))) * (1.0 + r)  # goes back on its way three times
    points = np.column_stack([spiral.real, spiral.imag])
    points[-1] = points[0]

    class Middle:
        p = np.zeros(2)

    quality, i = crossing(points, Middle)
    assert quality > 0.1
    angle = np.unwrap(np.angle(spiral))
    assert angle[i] > angle[:i].max(initial=-9.0)
    assert angle[i] > (angle[i + 1 : -1] - 2.0 * np.pi).max(initial=-9.0)

    class Outside:
        p = np.array([0.9, 0.0])

    assert crossing(points, Outside)[0] < 0.0
