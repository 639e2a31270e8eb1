"""Loads that switch, pulse and ramp: nothing in a formula is stepped over. Friction is 1 where nothing else is said.

The right values are closed forms, or quadratures of one variable written here.
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from codim2_core import (
    Event,
    System,
    lyapunov_exponents,
    periodic_motion,
    psi,
    simulate,
    simulate_nonsmooth,
)
from codim2_core.motion.result import SimulationStatus

from ...words.recognition import recognise

PSI = psi.constant()


def _block(load, W=("x",), across="-s"):
    return System(U=(f"-c + {load}", across), W=W)


def _both(system, start, span, **options):
    """The same motion for eps > 0 and in the limit, with what the first may differ by."""
    regularised = simulate(system, PSI, start, span, eps=1e-7, rtol=1e-9, atol=1e-11, **options)
    limit = simulate_nonsmooth(system, start, span, PSI, **options)
    for run, error in ((regularised, 1e-4), (limit, 1e-7)):
        assert run.status is SimulationStatus.T_END, run.reason
        yield run, error


def _pushed(force, begins, ends):
    """Velocity and way of a slip from rest under a force less friction, until a time."""
    velocity = quad(lambda t: force(t) - 1.0, begins, ends, epsabs=1e-13)[0]
    way = quad(lambda t: (ends - t) * (force(t) - 1.0), begins, ends, epsabs=1e-13)[0]
    return velocity, way


def test_a_force_that_is_switched_on_as_a_ramp():
    """It exceeds friction at 3.5; then x = (t - 3.5)^2."""
    for run, error in _both(_block("2*max(0, t-3)"), (0.0, 0.0, 0.0), (0.0, 6.0)):
        assert [phase.kind for phase in run.phases] == ["slide", "slip"]
        assert run.phases[1].t_start == pytest.approx(3.5, abs=error)
        assert run.states[-1, [0, 2]] == pytest.approx([6.25, 2.5**3 / 3.0], abs=error)


@pytest.mark.parametrize(
    ("load", "expected"),
    [
        ("0.75*(1+sign(t-4))", (3.0, 9.0)),
        ("1.5*(t > 4)", (3.0, 9.0)),
        ("0.3 + 1.2*(t >= 4)", (3.0, 9.0)),
        ("1.5*min(1, floor(t/4))", (3.0, 9.0)),
        ("3*(t > 4)*(t < 5)", (0.0, 2.0 + 2.0)),  # slips for 1 with 2, and comes to rest in 2 more
        ("3*(mod(t, 8) > 4)*(t < 5)", (0.0, 4.0)),
    ],
)
def test_a_jump_of_the_load(load, expected):
    for run, error in _both(_block(load), (0.0, 0.0, 0.0), (0.0, 10.0)):
        if expected[0] == 0.0:
            way = 0.5 * 2.0 * 1.0 + 0.5 * 2.0 * 2.0
            assert run.states[-1, 2] == pytest.approx(way, abs=error)
        else:
            assert run.states[-1, [0, 2]] == pytest.approx(expected, abs=2.0 * error)


@pytest.mark.parametrize(
    ("system", "expected"),
    [
        (_block("0.3+0.75*(1+sign(t-1))"), 1.6),
        (System(U=("-0.5*(1-sign(t-1))*c+0.5", "-0.5*(1-sign(t-1))*s"), W=("x",)), 1.0),
        (System(U=("-c", "-s + 0.3 + 0.75*(1+sign(t-1))"), W=("y",)), 1.6),
    ],
)
def test_a_slip_that_begins_at_a_jump(system, expected):
    for run, error in _both(system, (0.0, 0.0, 0.0), (0.0, 3.0)):
        assert [phase.kind for phase in run.phases] == ["slide", "slip"]
        assert math.hypot(*run.states[-1, :2]) == pytest.approx(expected, abs=error)


def test_without_psi_a_jump_is_decided_where_all_agree():
    run = simulate_nonsmooth(_block("0.3+0.75*(1+sign(t-1))"), (0.0, 0.0, 0.0), (0.0, 3.0))
    assert run.states[-1, 0] == pytest.approx(1.6, abs=1e-9)


@pytest.mark.parametrize("width", [0.5, 0.05, 0.005])
def test_a_short_push(width):
    """The push 3 exp(-((t - 50)/w)^2), whose slip begins and ends where closed forms say."""
    force = lambda t: 3.0 * math.exp(-(((t - 50.0) / width) ** 2))
    begins = 50.0 - width * math.sqrt(math.log(3.0))
    ends = brentq(lambda t: _pushed(force, begins, t)[0], 50.0 + 1.1 * width, 50.0 + 20.0 * width, xtol=1e-14)
    way = _pushed(force, begins, ends)[1]
    if width == 0.5:
        assert (begins, ends, way) == pytest.approx((49.475926, 51.950813, 1.640510), abs=1e-5)
    system = _block(f"3*exp(-((t-50)/{width})^2)")
    for run, error in _both(system, (0.0, 0.0, 0.0), (0.0, 60.0)):
        slip = run.phases[1]
        assert (slip.kind, slip.t_start) == ("slip", pytest.approx(begins, abs=error))
        assert run.states[-1, 2] == pytest.approx(way, rel=1e-4, abs=10.0 * error * width)


#: Where a slip of 100 ends that a gust meets from the side at 50: once by SciPy's DOP853, in steps of 0.01 at most.
GUST = 94.0001736569642, 1.7537996811628562, 5820.000866559818, 17.631266458220612


def test_a_gust_across_a_slip():
    system = System(U=("-0.1*c", "-0.1*s + 20*exp(-((t-50)/0.05)^2)"), W=("x", "y"))

    for run, error in _both(system, (100.0, 0.0, 0.0, 0.0), (0.0, 60.0)):
        np.testing.assert_allclose(run.states[-1, :4], GUST, atol=100.0 * error, rtol=1e-8)


@pytest.mark.parametrize("search", [0.5, 5.0, 30.0])
def test_no_step_is_longer_than_max_step(search):
    system = System(U=("-c+0.2", "-s"), W=("c",))
    for run, _ in _both(system, (0.0, 0.0, 0.0), (0.0, 60.0), max_step=search):
        assert run.motion.lengths.max() <= search
    with pytest.raises(ValueError, match="max_step"):
        simulate(system, PSI, (0.0, 0.0, 0.0), (0.0, 60.0), eps=1e-3, max_step=-1.0)


def test_a_jump_that_leads_back_from_both_sides_is_refused():
    run = simulate_nonsmooth(System(U=("-c + 0.2", "-s"), W=("-sign(z1)",)), (0.0, 0.0, 0.5), (0.0, 2.0), PSI)
    assert run.status is SimulationStatus.NOT_UNIQUE
    assert run.times[-1] == pytest.approx(0.5, abs=1e-12)
    assert "does not jump" in run.reason


SQUARE = System(U=("-c+2*sign(sin(t))-4*z1", "-s"), W=("x",))


@pytest.mark.parametrize("eps", [None, 1e-6])
def test_a_square_wave_has_a_periodic_motion(eps):
    """From z = 0.3 it is at rest, then slips from -2 - 4 z = -3.2 by half a period of the spring, twice: z -> -0.7."""
    found = periodic_motion(SQUARE, (0.0, 0.0, 0.3), 2.0 * math.pi, PSI, eps)
    assert found.found
    assert found.state0[2] == pytest.approx(-0.7, abs=1e-5 if eps else 1e-9)
    exponents = lyapunov_exponents(SQUARE, (0.0, 0.0, 0.3), 2.0 * math.pi, PSI, eps, count=16, transient=2)
    assert exponents.values[0] == pytest.approx(0.0, abs=1e-4)


def test_a_leg_without_steps_has_a_derivative():
    system = System(U=("z1-z1**3-0.15*x-0.1*c+0.35*cos(z2)", "-s"), W=("x", "1"))
    found = lyapunov_exponents(system, (-0.5, 0.0, 0.3, 0.0), 2.0 * math.pi, PSI, count=32, transient=5)
    assert 0.08 < found.values[0] < 0.2


SLIDES = System(U=("-c+0.2", "-s"), W=("c",))


@pytest.mark.parametrize("event", [lambda t, _: math.sin(10.0 * t), "sin(10*t)"])
def test_no_zero_of_an_event_is_lost_in_a_long_step(event):
    for run, _ in _both(SLIDES, (0.0, 0.0, 0.0), (0.0, 60.0), events=[event]):
        np.testing.assert_allclose(run.events[0], math.pi / 10.0 * np.arange(1, 191), atol=1e-9)


def test_a_typed_event_of_a_thousandth_of_the_span_is_found():
    event = Event("exp(-((z - 6.6)/0.0006)^2) - 0.5", direction=1)
    for run, error in _both(SLIDES, (0.0, 0.0, 0.0), (0.0, 60.0), events=event):
        assert run.events[0] == pytest.approx([(6.6 - 6e-4 * math.sqrt(math.log(2.0))) / 0.2], abs=error)


@pytest.mark.parametrize(
    ("event", "message"),
    [
        (lambda _, s: s[2] > 30, r"s\[2\] - 30"),
        (lambda _, s: bool(s[2] > 30), "truth value"),
        ("z4 - 1", "z4"),
        ("q + 1", "q"),
    ],
)
def test_what_is_no_event_is_refused(event, message):
    with pytest.raises(ValueError, match=message):
        simulate_nonsmooth(SLIDES, (0.0, 0.0, 0.0), (0.0, 1.0), PSI, events=[event])


def test_where_a_varied_number_decides_a_jump_the_derivatives_end_there():
    system = System(U=("-c + 2*sign(sin(w*t))", "-s"), W=("x",), parameters={"w": 1.0})
    run = simulate(system, PSI, (0.1, 0.0, 0.0), (0.0, 4.0), eps=1e-3)
    assert not run.variation().reason
    assert "where a formula jumps" in run.variation("w").reason


def test_a_long_step_whose_dense_output_meets_a_lost_set_is_tried_again():
    """The slide ends at 10.09; a stage of its dense output lies in the push, where Newton's method finds no set."""
    rate = ("-0.5*c + 0.668*exp(-((z3 - 6.497)/0.1076)**2) - 0.198*min(2, max(0, 2.711*(z3 - 17.942)))",
            "-0.5*s + 1.036*exp(-((z3 - 10.107)/0.0212)**2) + 0.946*exp(-((z3 - 5.232)/0.0979)**2)")  # fmt: skip
    system = System(U=rate, W=("x", "y", "1"))
    run = simulate_nonsmooth(system, (-0.7100994773027869, -0.17704939802573616, 0.0, 0.0, 0.0), (0.0, 20.0))
    assert run.status.name == "T_END"
    push = lambda t: 1.036 * math.exp(-(((t - 10.107) / 0.0212) ** 2)) - 0.5
    slips = [phase for phase in run.phases if phase.kind == "slip"]
    assert slips[-1].t_start == pytest.approx(brentq(push, 10.05, 10.1), abs=1e-9)


def test_a_load_that_switches_on_a_limit_cycle_of_a_general_system_is_refused():
    system = System(
        U=("c - s - 2*c*(c**2 + s**2) + 0.05*sign(z - 0.2)", "c + s - 2*s*(c**2 + s**2)"), W=("1",)
    )  # fmt: skip
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, 0.5), PSI)
    assert run.status is SimulationStatus.NOT_UNIQUE
    assert "load switches on a cycle" in [key for key, _ in recognise(run.reason)]


def test_steps_that_no_bound_decides_are_counted():
    """The denominator is 2, which bounds over a long step do not see where z is large."""
    system = System(U=("-c + 0.2/(1 + (z+1)**2 - z*(z+2))", "-s"), W=("1",))
    start, span = (0.0, 0.0, 1e5), (0.0, 1e4)
    for run in (simulate_nonsmooth(system, start, span, PSI), simulate(system, PSI, start, span, eps=1e-4)):
        assert run.status is SimulationStatus.T_END
        assert "not bounded" in [key for key, _ in recognise(run.message)]
        assert run.states[-1, :2] == pytest.approx([0.0, 0.0], abs=1.1e-5)


@pytest.mark.parametrize(
    ("load", "x", "z"),
    [  # x = int (load - 1) while it slips, z = int x: by quadrature
        ("1.5*sqrt(abs(t-4))", 10.180340, 41.060683),
        ("2 + sqrt(abs(t-4))", 21.7868933, 94.8738),
        ("2 + abs(t-4)^1.5", 44.1606798, 173.0153),
        ("0.5 + 0.3*sqrt(abs(t-4))", 0.19903094, 0.2502978),  # it rests from t = 2.36 to 6.78
    ],
)
def test_a_load_with_a_root_at_its_switch_is_followed_through_it(load, x, z):
    """No step can pass it: the formula of either side is undefined on the other."""
    system = System(U=(f"-c + {load}", "-s"), W=("x",))
    for run in (
        simulate(system, PSI, (0.0, 0.0, 0.0), (0.0, 9.0), eps=1e-9),
        simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, 9.0)),
    ):
        assert run.status is SimulationStatus.T_END
        assert run.states[-1, [0, 2]] == pytest.approx([x, z], rel=3e-6)


@pytest.mark.parametrize("eps", [0.0, 1e-7])
def test_two_switches_at_one_time(eps):
    """The floor switches where the minimum does, and then reads a number: its guard is gone."""
    block = System(U=("-c + 0.35*floor(min(t, 8)/2)", "-s"), W=("x",))
    run = simulate(block, psi.constant(), (0.0, 0.0, 0.0), (0.0, 10.0), eps=eps)
    assert run.status is SimulationStatus.T_END
    assert run.states[-1, [0, 2]] == pytest.approx([0.9, 1.1], abs=1e-8 + 20.0 * eps**0.8)  # it departs once


@pytest.mark.parametrize("eps", [0.0, 1e-7])
def test_a_load_that_jumps_to_exactly_what_friction_can_hold(eps):
    block = System(U=("-0.5*c + 0.5*(t > 2)", "-0.5*s - 0.2*(t > 5)"), W=("x", "y"))
    run = simulate(block, psi.constant(), (0.0, 0.0, 0.0, 0.0), (0.0, 10.0), eps=eps)
    force = np.array([0.5, -0.2])
    expected = 5.0 * (1.0 - 0.5 / np.hypot(*force)) * force
    assert run.states[-1, :2] == pytest.approx(expected, abs=5e-5)


def test_an_event_that_is_zero_while_nothing_moves_counts_where_it_changes():
    """z = 0.025 t^2 is exactly 0 in the first step, and the bounds of sin(8 z) are 0 but for rounding."""
    run = simulate_nonsmooth(
        System(U=("-c + 1.5", "-s"), W=("0.1*x",)), (0.0, 0.0, 0.0), (0.0, 20.0), PSI, events="sin(8*z)"
    )
    zeros = np.sqrt(np.arange(1, 26) * np.pi / (8.0 * 0.025))
    assert run.events[0] == pytest.approx(zeros[zeros < 20.0], abs=1e-6)
