"""Periodic motions of unknown period, and searches that find none."""

import math

import pytest
from scipy.integrate import solve_ivp

from codim2_core import PeriodicStatus, System, periodic_motion, psi

from ....words.recognition import recognise
from .closed_forms import BELT, CIRCLE, StickSlip

RING = System(U=("-y + x*(1 - x**2 - y**2)", "x + y*(1 - x**2 - y**2)"))  # r = 1; next to it (r - 1)' = -2 (r - 1)


def keys(found):
    return [key for key, _ in recognise(found.reason)]


@pytest.mark.parametrize("eps", [0.0, 0.1])
def test_a_limit_cycle_in_the_plane(eps):
    found = periodic_motion(RING, (0.8, 0.2), 5.5, psi.constant(), eps)
    assert found.period == pytest.approx(math.tau, abs=1e-8)
    assert found.period_error < 1e-6
    assert math.hypot(*found.state0) == pytest.approx(1.0, abs=1e-8)
    assert found.multipliers[0] == pytest.approx(math.exp(-2.0 * math.tau), abs=1e-9)
    assert (len(found.multipliers), found.stability, found.forced) == (1, "stable", False)


@pytest.mark.parametrize("start", [(0.0, 0.0, 0.9, 0.0), (-2.0, 0.02, 0.1, 0.01)])
def test_stick_slip_on_a_belt(start):
    exact = StickSlip(1.0, 0.1, 1.0)
    found = periodic_motion(BELT, start, 6.3)
    assert found.period == pytest.approx(exact.period, abs=1e-8)
    assert keys(found) == ["repeats", "start is lost", "periodic stable"]
    assert found.multipliers[1:].tolist() == [0.0, 0.0]
    assert found.multipliers[0].real == pytest.approx(across(exact), abs=1e-6)
    slips = [phase.t_end - phase.t_start for phase in found.run.phases if phase.kind == "slip"]
    assert sum(slips) == pytest.approx(exact.slips, abs=1e-7)


def across(exact):
    """How a deviation p across the belt comes back: p' = y and y' = -p + k y - mu y/|x| along the slip.

    As it begins x is small, and friction holds y = x p/mu.
    """

    def rate(t, state):
        slip = exact.v - exact.slip(t)[1]
        return [state[1], -state[0] + exact.k * state[1] - exact.mu * state[1] / slip]

    t = 1e-4
    run = solve_ivp(
        rate, (t, exact.slips - 1e-9), [1.0, -(exact.v - exact.slip(t)[1])], "Radau", rtol=1e-10, atol=1e-13
    )
    return run.y[0, -1]


def test_with_psi_it_tends_to_the_limit():
    exact = StickSlip(1.0, 0.1, 1.0)
    off = []
    for eps in (1e-3, 1e-5):
        found = periodic_motion(BELT, (-2.0, 0.02, 0.1, 0.01), 6.4, psi.constant(), eps)
        assert found.stability == "stable"
        off.append(abs(found.period - exact.period))
    assert off[0] < 0.05
    assert off[1] < 0.2 * off[0]


def test_an_angle_is_on_by_a_turn():
    # It sticks, and z' = 1 + 0.3 cos z goes round in 2 pi/sqrt(1 - 0.09); then (x, y) is lost, and the shift left out
    system = System(U=("-c", "-s"), W=("1 + 0.3*cos(z)", "-0.5*z2"))
    found = periodic_motion(system, (0.0, 0.0, 0.0, 0.1), 6.0, advance=(math.tau, 0.0))
    assert found.period == pytest.approx(math.tau / math.sqrt(0.91), abs=1e-8)
    assert found.multipliers.tolist() == pytest.approx([math.exp(-0.5 * found.period), 0.0, 0.0], abs=1e-9)
    assert found.state0[3] == pytest.approx(0.0, abs=1e-9)


def test_what_was_come_to_stands_still():
    system = System(U=("-c", "-s"), W=("-z1 - z2", "z1 - z2"))
    found = periodic_motion(system, (0.0, 0.0, 1e-9, 0.0), 6.0)
    assert found.status is PeriodicStatus.STANDS_STILL
    assert keys(found) == ["comes to rest"]
    assert not found.found
    assert found.multipliers.size == 0
    assert found.stability == "undecided"


def test_where_there_is_none_none_is_found():
    drifting = System(U=("-c", "-s"), W=("1 + 0.5*z2*z2", "-z2 + 0.1"))
    found = periodic_motion(drifting, (0.0, 0.0, 0.0, 0.2), 3.0)
    assert found.status is PeriodicStatus.NO_CONVERGENCE
    assert keys(found) == ["no periodic motion"]
    assert found.residual > 0.1
    assert found.period >= 1.0  # where it is short all motions seem to return


def test_a_motion_that_ends_before():
    system = System(U=("x**2 - c", "-s"), W=("1",))
    found = periodic_motion(system, (2.0, 0.0, 0.0), 3.0)
    assert found.status is PeriodicStatus.MOTION_ENDS
    assert keys(found)[0] == "motion ends early"
    assert "infinite in finite time" in found.reason


def test_where_no_derivative_exists():
    fold = System(U=("-(c**2) + cos(z)", "-s"), W=("1",))  # C at c = sqrt(cos z) is gone at z = pi/2
    found = periodic_motion(fold, (0.3, 0.0, 0.0), math.tau, psi.constant())
    assert found.status is PeriodicStatus.NO_DERIVATIVE
    assert keys(found)[0] == "no derivative"
    assert "ends away from the equator" in found.reason


def test_unstable_is_told():
    backwards = System(U=("y - 0.1*x*(1 - x**2 - y**2)", "-x - 0.1*y*(1 - x**2 - y**2)"))
    found = periodic_motion(backwards, (0.95, 0.1), 6.0)
    assert keys(found) == ["repeats", "periodic unstable"]
    assert found.multipliers[0].real == pytest.approx(math.exp(0.2 * math.tau), rel=1e-6)


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"period": 2.0}, "do not repeat themselves"),
        ({"period": -1.0}, "period is -1.0"),
        ({"eps": 1e-20}, "eps is"),
        ({"eps": 0.1}, "psi is None"),
        ({"advance": (0.0, 0.0, 3.0)}, r"advance\[2\] is 3.0; z3 moves on by 3.14159"),
        ({"advance": (0.0, 0.0)}, "give 3 finite numbers"),
        ({"state0": (0.0, 1.0)}, "state0 has shape"),
        ({"rtol": 1.0}, "rtol is"),
    ],
)
def test_what_cannot_be_is_refused(change, told):
    with pytest.raises(ValueError, match=told):
        periodic_motion(**{"system": CIRCLE, "state0": (0.1, 0.1, 0.1, 0.1, 0.0), "period": math.pi, **change})
