"""Rays and their maps of first turns: geometry by its definition, maps where x2' = A x2 is solved in closed form."""

import math

import mpmath
import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.cycles.ray_section import COARSE_RTOL, FINE_RTOL, Ray, TurnSection
from codim2_core.portrait.cycles.ray_section_kernel import OUTWARD, RETURNED, TO_CRITICAL_SET
from codim2_core.portrait.layer_problem.problem import LayerProblem

PSIS = [c2.psi.constant(), c2.psi.rational(), c2.psi.tanh(), c2.psi.hill(3)]
EVERY = pytest.mark.parametrize("psi", PSIS, ids=lambda p: p.text)
XI = np.array([-9.0, -3.0, 0.0, 1.0, 4.0])


@EVERY
@pytest.mark.parametrize("f", [(0.0, 0.0), (0.02, -0.01)])
def test_orbits_that_do_not_return_are_told(psi, f):
    """A node: orbits come to it, or leave for the equator."""
    problem = LayerProblem(c2.ELinear(-9.0, 3.05, 1.0, f).at(), psi)
    node = TurnSection(problem, problem.critical[0])
    shift = node.displacement(node.grid()[::8], COARSE_RTOL)
    assert not np.isnan(shift).any()
    codes = node.turn(node.states(node.grid()[::8])[0], COARSE_RTOL)[2]
    assert (np.isinf(shift) == (codes != RETURNED)).all()
    assert (shift[codes == TO_CRITICAL_SET] == -np.inf).all()
    assert (shift[codes == OUTWARD] == np.inf).all()
    assert (codes != RETURNED).any()


def turned(psi, trace, U=None):
    """The ray of a typed system, U = A e with a focus of this trace."""
    a, d = 0.5 * trace + 0.3, 0.5 * trace - 0.3
    system = c2.System(U=U or (f"{a!r}*c - s + 0*c**2", f"c + {d!r}*s"), W=())
    at = system.at()
    problem = LayerProblem(at, psi)
    return TurnSection(problem, problem.critical[0]), math.sqrt(1.0 - 0.3**2)


@EVERY
@pytest.mark.parametrize("trace", [-0.2, 0.3])
def test_first_turns_of_a_general_system_without_f(psi, trace):
    own, omega = turned(psi, trace)
    states, q = own.states(XI)
    np.testing.assert_allclose((states**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
    np.testing.assert_array_equal(q, XI)
    np.testing.assert_allclose(own.coordinate(states), XI, rtol=0.0, atol=1e-10)
    r = own.reach / (1.0 + np.exp(-XI))
    np.testing.assert_allclose(states[:, :2], own.critical.p + r[:, None] * own.u, rtol=0.0, atol=1e-14)
    for backward, sign in ((False, 1.0), (True, -1.0)):
        x2 = math.exp(sign * math.pi * trace / omega) * r / np.sqrt(1.0 - r * r)
        p = x2 / np.hypot(1.0, x2)
        rest = 1.0 / (np.hypot(1.0, x2) * (np.hypot(1.0, x2) + x2))  # 1 - p
        np.testing.assert_allclose(
            own.displacement(XI, FINE_RTOL, backward), np.log(p / rest) - XI, rtol=0.0, atol=1e-6
        )


def test_a_ray_that_starts_just_inside_the_equator_has_all_its_digits():
    """C = (1 - 1e-7, 0), and the ray leads outward: |p + r u| = 1 with 40 digits."""
    at, psi = c2.System(U=("-(c - 0.9999999) - 2*s", "2*(c - 0.9999999) - s")).at(), c2.psi.constant()
    problem = LayerProblem(at, psi)
    (C,) = problem.critical
    own = Ray(problem, C, np.array([0.8, 0.6]))
    with mpmath.workdps(40):
        x2, u = mpmath.matrix(C.x2.tolist()), mpmath.matrix(own.u.tolist())
        gap = 1 / (1 + x2[0] ** 2 + x2[1] ** 2)
        along = (x2[0] * u[0] + x2[1] * u[1]) * mpmath.sqrt(gap)
        reach = mpmath.sqrt(along**2 + gap) - along
    assert along > 0.5
    assert own.reach < 1e-6
    assert own.reach == pytest.approx(float(reach), rel=1e-13, abs=0.0)
    assert own.other == pytest.approx(float(gap / reach), rel=1e-13)
