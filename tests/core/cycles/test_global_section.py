"""Sections and their return maps: geometry by its definition, maps where x2' = A x2 is solved in closed form."""

import math

import mpmath
import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles.global_section import COARSE_RTOL, FINE_RTOL, INNER_RADIUS, Section, rays
from codim2_core.cycles.global_section_kernel import OUTWARD, RETURNED, TO_CRITICAL_SET
from codim2_core.cycles.ray_section import TurnSection
from codim2_core.stepping.layout import LANES

PSIS = [c2.psi.constant(), c2.psi.rational(), c2.psi.tanh(), c2.psi.hill(3)]
EVERY = pytest.mark.parametrize("psi", PSIS, ids=lambda p: p.text)
XI = np.array([-9.0, -3.0, 0.0, 1.0, 4.0])


def section(psi, f=(0.4, -0.3), ray=None, a=1.0, b=3.0, d=-2.0):
    at = c2.ELinear(a, b, d, f).at()
    return Section(at, psi, c2.critical_sets(at, psi)[0], ray)


@pytest.mark.parametrize("e", [(0.0, 0.0), (0.3, -0.2), (-0.9, 0.4), (0.0, 0.999999)])
def test_rays_are_where_no_term_of_a_and_d_is_left_and_end_on_the_equator(e):
    for a, d in ((1.0, -2.0), (-0.3, 5.0)):
        found = rays(a, d, e, 1.0 - e[0] ** 2 - e[1] ** 2)
        assert len({(u[0] > 0.0, u[1] > 0.0) for *_, u in found}) == 4
        for reach, other, u in found:
            assert a * u[0] ** 2 + d * u[1] ** 2 == pytest.approx(0.0, abs=1e-14)
            assert math.hypot(*u) == pytest.approx(1.0)
            assert min(reach, other) > 0.0
            for r in (0.0, 0.4, reach):
                assert (e[0] + r * u[0]) ** 2 + (e[1] + r * u[1]) ** 2 - 1.0 == pytest.approx(
                    (r - reach) * (r + other), abs=1e-12
                )


@EVERY
def test_states_lie_on_the_ray_in_e(psi):
    one = section(psi)
    assert one.ray == max(range(4), key=lambda i: section(psi, ray=i).reach)
    for own in (one, section(psi, ray=(one.ray + 1) % 4)):
        states, q = own.states(XI)
        np.testing.assert_allclose((states**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
        r = own.reach / (1.0 + np.exp(-XI))
        np.testing.assert_allclose(
            c2.hemisphere.e_psi(psi, states[:, :2]), own.e + r[:, None] * own.u, rtol=0.0, atol=1e-12
        )
        x2 = states[:, :2] / states[:, 2:]
        np.testing.assert_allclose(np.exp(q), (x2 - own.critical.x2) @ own.u, rtol=1e-6)
        near = np.array([math.log(INNER_RADIUS / (1.0 - INNER_RADIUS))])
        away = own.states(near)[0]
        assert np.hypot(*(away[0, :2] / away[0, 2] - own.critical.x2)) == pytest.approx(own.inner, rel=0.5)
        assert (away[0, :2] / away[0, 2] - own.critical.x2) @ own.u == pytest.approx(own.inner, rel=1e-3)
        far = np.array([20.0, 100.0])
        there = own.states(own.xi_at_radius(far))[0]
        np.testing.assert_allclose(np.hypot(*there[:, :2].T) / there[:, 2], far, rtol=0.1)
        grid = own.grid()
        assert (np.diff(grid) > 0.0).all()
        assert grid[0] == pytest.approx(math.log(INNER_RADIUS))
        assert grid[-1] <= 600.0
        assert len(grid) <= 2 * LANES  # one more would be followed alone
        zeta = 1.0 / own.states(grid[grid >= math.log(9.0) - 1e-9])[0][:, 2]
        assert (zeta[1:] / zeta[:-1]).max() < 4.0  # no gap between the samples near C and those far out


@EVERY
@pytest.mark.parametrize("b", [3.0, -3.0])
@pytest.mark.parametrize("swap", [1.0, -1.0])
def test_without_f_a_turn_multiplies_x2(psi, b, swap):
    """A focus with trace -1: exp(-pi/omega) once round, omega^2 = det A - 1/4, whatever Psi is; T dtau = ebar dT."""
    own = section(psi, (0.0, 0.0), a=swap, b=b, d=-2.0 * swap)
    expected = -swap * math.pi / math.sqrt(7.0 - 0.25)
    for backward, sign in ((False, 1.0), (True, -1.0)):
        np.testing.assert_allclose(own.displacement(XI, FINE_RTOL, backward), sign * expected, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(own.displacement(XI, COARSE_RTOL), expected, rtol=0.0, atol=1e-6)
    ends, times, codes, _ = own.turn(own.states(XI)[0], FINE_RTOL)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose((ends**2).sum(axis=1), 1.0, rtol=0.0, atol=1e-13)
    assert (times > 0.0).all()
    zeta = np.hypot(*(own.states(XI[:1])[0][0, :2]))  # near C: T = tau
    assert times[0] / own.rate == pytest.approx(2.0 * math.pi / math.sqrt(6.75), rel=max(1e-3, 10.0 * zeta))


@EVERY
@pytest.mark.parametrize("f", [(0.0, 0.0), (0.02, -0.01)])
def test_orbits_that_do_not_return_are_told(psi, f):
    """A node, and outside a cycle's region the equator: inwards and outwards."""
    node = section(psi, f, a=-9.0, b=3.05, d=1.0)
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
    sets = c2.critical_sets(at, psi)
    return TurnSection(at, psi, sets[0], sets), math.sqrt(1.0 - 0.3**2)


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
    (C,) = c2.critical_sets(at, psi)
    own = TurnSection(at, psi, C, (C,))
    with mpmath.workdps(40):
        x2, u = mpmath.matrix(C.x2.tolist()), mpmath.matrix(own.u.tolist())
        gap = 1 / (1 + x2[0] ** 2 + x2[1] ** 2)
        along = (x2[0] * u[0] + x2[1] * u[1]) * mpmath.sqrt(gap)
        reach = mpmath.sqrt(along**2 + gap) - along
    assert along > 0.9
    assert own.reach < 1e-6
    assert own.reach == pytest.approx(float(reach), rel=1e-13, abs=0.0)
    assert own.other == pytest.approx(float(gap / reach), rel=1e-13)
