"""Whole compiled motions that take few steps, so that they take little time as Python too (`tests.mutation`)."""

import math
from functools import partial

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import ELinear, System, simulate_nonsmooth
from codim2_core import psi as families
from codim2_core.initial_value import compiled_hybrid, motion_steps
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.hybrid_run import LEAVE, SLIDE, SLIP, WHOLE
from codim2_core.initial_value.kernels.motion import BLOWN_UP, FINISHED, LIMIT, SHORT
from codim2_core.initial_value.line import invariant_line
from tests.core.ways import follow

TANH = families.tanh()
TURNS = System(U=("-2*c + 1.5*c*s + 2.4*sin(z1) + 0.3*x", "-s + 0.9*cos(z1)"), W=("1 + c*y - 0.3*s",))


def _followed(system, psi, eps, first, span, rtol=1e-6, most=1000):
    first, own = np.atleast_2d(np.array(first, float)), field(system)
    lines = [invariant_line(own, state) for state in first]
    return motion_steps.integrate_compiled(own, psi, eps, lines, first, span, rtol, 0.01, most)


def test_a_slip_is_what_scipy_finds():
    first, span = [(0.8, -0.5, 0.3), (-0.4, 0.9, 1.0)], (0.5, 1.3)
    F = partial(motion_steps.rate_at, field(TURNS), TANH, 0.3, None)
    for start, one in zip(first, _followed(TURNS, TANH, 0.3, first, span), strict=True):
        exact = solve_ivp(lambda t, y: F(y), span, start, "DOP853", rtol=1e-11, atol=1e-12, dense_output=True)
        assert (one.code, one.t) == (FINISHED, 1.3)
        assert one.motion.times[0] == 0.5
        assert one.motion.times[-1] == pytest.approx(1.3, abs=1e-15)
        np.testing.assert_array_equal(one.motion.states[0], start)
        np.testing.assert_allclose(one.motion.states[-1], exact.y[:, -1], atol=2e-6)
        at = np.linspace(0.5, 1.3, 17)
        np.testing.assert_allclose(one.motion(at), exact.sol(at).T, atol=2e-6)
        np.testing.assert_allclose(np.diff(one.motion.times), one.motion.lengths, atol=1e-15)
        steps = len(one.motion.lengths)
        assert 15 * steps <= one.evaluations <= 15 * steps + 2 + 11 * 3  # a few that were not taken
        assert steps <= 16


def test_after_a_slide_it_goes_on_explicitly():
    """It leaves along (1, 0) after z = 0.5, and is then a slip for long."""
    leaves = System(U=("2*z1 - c", "-s"), W=("1",))
    (one,) = _followed(leaves, TANH, 1e-4, (0.01, 0.02, -0.3), (0.0, 30.0))
    assert one.code == FINISHED
    assert len(one.motion.lengths) < 90
    # x' = 2 z - 1 from z = 0.5 on
    assert one.motion.states[-1, 0] == pytest.approx(29.2**2, rel=1e-3)
    late = one.motion.times[:-1] > 2.0
    assert late.any()
    assert one.motion.polynomials[np.flatnonzero(late)[-1]][0, 1] != 0.0
    assert late.sum() <= 12


def test_motions_end_as_they_have_to():
    grows = System(U=("x**2 - c", "-s"))
    (one,) = _followed(grows, families.constant(), 1e-2, (2.0, 0.0), (0.0, 20.0))
    assert one.code == BLOWN_UP
    assert one.t == pytest.approx(0.5 * math.log(3.0), rel=1e-3)
    (one,) = _followed(TURNS, TANH, 0.3, (0.8, -0.5, 0.3), (0.0, 9.0), most=4)
    assert one.code == LIMIT
    assert len(one.motion.lengths) <= 4
    assert 0.0 < one.t < 9.0
    ends = System(U=("-c", "-s"), W=("-1/(2*z)",))  # z = sqrt(1 - t)
    (one,) = _followed(ends, TANH, 0.5, (1.0, 0.4, 1.0), (0.0, 3.0), most=150)
    assert one.code in (SHORT, LIMIT)
    assert one.t == pytest.approx(1.0, abs=1e-5)


PUSHED = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))
STIFF = System(U=("c*(-1) + 0.4*sin(z1)", "-s + 0.3*z2"), W=("1", "200*(cos(z1) - z2) + c"))
CASES = {
    "slides that end": (PUSHED, (0.3, 0.2, 0.0), 4.5, [SLIP, SLIDE, LEAVE, SLIDE]),
    "typed": (TURNS, (0.3, 0.2, 0.0), 3.0, None),
    "no z": (ELinear(-1.0, 0.4, -2.0, f=(0.2, 0.1)), (0.3, 0.2), 3.0, [SLIP, SLIDE]),
    "in a line": (ELinear(-1.0, 0.0, -2.0, f=("1.3*sin(z1)", 0.0), B=((0.2, 0.0),), g=(1.0,)), (-0.3, 0.0, 0.0), 3.0,
                  [SLIP, SLIDE, LEAVE]),
    "late": (PUSHED, (0.9, 0.7, 2.0), 0.3, [SLIP]),
}  # fmt: skip


def _course(system, first, t_end, rtol=1e-5, psi=TANH, most=1000):
    first, own = np.atleast_2d(np.array(first, float)), field(system)
    lines = [invariant_line(own, state) for state in first]
    return compiled_hybrid.run_hybrid(own, psi, lines, first, (0.0, t_end), rtol, 0.01, most)


def _by_phase(monkeypatch, system, first, t_end, psi=TANH, rtol=1e-8):
    follow(monkeypatch, "called back")
    return simulate_nonsmooth(system, first, (0.0, t_end), psi, rtol=rtol, atol=0.01 * rtol)


@pytest.mark.parametrize("case", CASES)
def test_a_motion_in_the_limit_is_the_one_phase_by_phase(monkeypatch, case):
    system, first, t_end, kinds = CASES[case]
    (found,) = _course(system, first, t_end)
    own = _by_phase(monkeypatch, system, first, t_end)
    legs = found.legs
    if kinds is not None:
        assert [leg.kind for leg in legs][: len(kinds)] == kinds
    assert ["slide" if leg.kind == SLIDE else "slip" for leg in legs] == [phase.kind for phase in own.phases]
    assert found.onward == WHOLE
    np.testing.assert_allclose(own.motion.times[:-1] + own.motion.lengths, own.motion.times[1:], atol=1e-13)
    times = found.motion.times
    np.testing.assert_allclose([times[leg.last] for leg in legs], [p.t_end for p in own.phases], atol=2e-5)
    np.testing.assert_allclose(found.motion.states[-1], own.states[-1], atol=5e-5)
    at = np.linspace(0.0, t_end, 23)[1:-1]
    np.testing.assert_allclose(found.motion(at), own.dense(at), atol=1e-4)
    assert (np.diff(times) >= 0.0).all()
    assert times[-1] == pytest.approx(t_end, abs=1e-15)
    for leg, phase in zip(legs, own.phases, strict=True):
        steps = leg.last - leg.first
        assert 0 < steps <= (120 if leg.kind == LEAVE else 40)  # from 1e-9 of the time on
        if leg.kind == SLIDE:
            assert not found.motion.states[leg.first : leg.last + 1, :2].any()
            mid = (leg.first + leg.last) // 2
            np.testing.assert_allclose(
                found.sets[mid], system_set(system, found.motion.states[mid, 2:]), atol=1e-7, err_msg=str(phase)
            )
    assert 12 * len(found.motion.lengths) < found.evaluations < 28 * len(found.motion.lengths) + 60 * len(legs)


def system_set(system, z):
    """The critical set by Newton's method with differences."""
    own, e = field(system), np.zeros(2)
    for _ in range(40):
        U = np.array(own.value(*e, 0.0, 0.0, *z)[:2])
        e = e - 0.7 * np.linalg.solve(own.jacobian(*e, 0.0, 0.0, list(z))[:2, :2], U)
    return e


def test_a_motion_of_many_phases_goes_on_as_long_as_it_is_asked_for():
    """U has the period 2 pi in z = t, and where a slide begins only z counts: four phases later all is the same."""
    (one,) = _course(PUSHED, (0.3, 0.2, 0.0), 30.0, most=20_000)
    ends = np.array([one.motion.times[leg.last] for leg in one.legs])
    assert len(ends) > 18
    assert ends[-1] == pytest.approx(30.0, abs=1e-12)
    np.testing.assert_allclose(ends[5:-1] - ends[1:-5], math.tau, atol=2e-4)
    assert [leg.kind for leg in one.legs[1:]] == [SLIDE, LEAVE] * ((len(ends) - 1) // 2)


def test_a_stiff_slow_flow_takes_few_steps():
    (one,) = _course(STIFF, (0.1, 0.05, 0.2, 0.3), 3.0)
    assert [leg.kind for leg in one.legs] == [SLIP, SLIDE]
    slide = one.legs[1]
    assert slide.last - slide.first < 40
    z1, z2 = one.motion.states[-1, 2:]
    c = 0.4 * math.sin(z1)
    assert z2 == pytest.approx(math.cos(z1) + (c + math.sin(z1)) / 200.0, abs=1e-4)


@pytest.mark.parametrize("rtol", [1e-2, 1e-6])
def test_a_straight_fall_arrives_when_and_where_it_does(rtol):
    """U = -e, W = (2, -3): by a last step that is as long as the rest of the way, whatever the tolerance."""
    falls = ELinear(-1.0, 0.0, -1.0, B=((0.0, 0.0),) * 2, g=(2.0, -3.0))
    (one,) = _course(falls, (0.6, -0.8, 0.5, 0.25), 1.5, rtol)
    slip = one.legs[0]
    assert one.motion.times[slip.last] == pytest.approx(1.0, abs=1e-13)
    np.testing.assert_allclose(one.motion.states[slip.last], [0.0, 0.0, 2.5, -2.75], atol=1e-13)
    assert abs(math.remainder(one.legs[1].theta - math.atan2(-0.8, 0.6), math.tau)) < 50.0 * rtol
    np.testing.assert_allclose(one.motion(0.999999), [6e-7, -8e-7, 2.499998, -2.749997], atol=1e-5 * rtol + 1e-13)
    np.testing.assert_allclose(one.motion.states[-1], [0.0, 0.0, 3.5, -4.25], atol=1e-13)
