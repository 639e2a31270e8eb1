"""Contacts under loads that switch, pulse and ramp, against closed forms, and motions with steps of 10^-4."""

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.systems.mechanics import contacts

from ....words.recognition import recognise
from .plates import Blocks

EYE = ((1, 0), (0, 1))


def block(force, bound=1.0, side="0"):
    """Return a block of 1 kg; the state is (u, v, q, r, tm)."""
    return contacts(EYE, [(EYE, bound / 10.0, 10)], (force, side), ("u", "v"), {"q": "u", "r": "v", "tm": 1})


@pytest.mark.parametrize(
    ("force", "t_end", "changes", "u", "q"),
    [
        ("0.75*(1+sign(tm-10))", 60.0, [10.0], 25.0, 625.0),
        ("2*max(0,tm-3)", 6.0, [3.5], 6.25, 5.208333),
        ("0.3+0.75*(1+sign(tm-1))", 3.0, [1.0], 1.6, 1.6),
        ("0.75*(1+sign(tm-4))", 10.0, [4.0], 3.0, 9.0),
        ("0.75*(1+tanh(20*(tm-40)))", 60.0, [40.017329], 9.976131, 99.523373),
        ("3*exp(-((tm-50)/0.5)^2)", 60.0, [49.475926, 51.950813], 0.0, 1.640510),
        ("3*exp(-((tm-50)/0.05)^2)", 60.0, [49.947593, 50.195081], 0.0, 0.0164051),
        ("3*exp(-((tm-50.123)/0.003)^2)", 60.0, [50.119857, 50.134705], 0.0, 0.00005906),
        ("3*(abs(tm-50)<0.025)", 60.0, [49.975, 50.125], 0.0, 0.0075),
        ("0.5*floor(tm)", 4.0, [3.0], 0.5, 0.25),
        ("2*mod(tm,2)", 6.0, [0.5], 6.25, 15.458333),
        ("min(2,0.2*tm)", 12.0, [5.0], 4.5, 11.166667),
    ],
)
def test_a_contact_lets_go_when_the_load_passes_its_bound_however_short_that_is(force, t_end, changes, u, q):
    """A load of 1 is held. Where it is more, u' is what is more; the pulses of 0.5, 0.05 and 0.003 s scale."""
    run = block(force).simulate_nonsmooth((0.0,) * 5, (0.0, t_end))
    assert run.status.name == "T_END"
    assert [phase.t_start for phase in run.phases[1:]] == pytest.approx(changes, abs=1e-6)
    assert [phase.kinds for phase in run.phases] == [("stick",), ("slip",), ("stick",)][: len(run.phases)]
    assert run.states[-1, [0, 2]] == pytest.approx([u, q], rel=2e-6, abs=1e-8)
    creeping = block(force).simulate(psi.constant(), (0.0,) * 5, (0.0, t_end), eps=1e-6)
    assert creeping.states[-1, [0, 2]] == pytest.approx([u, q], abs=1e-3)
    assert creeping.states[-1, 2] == pytest.approx(q, rel=0.1)


@pytest.mark.parametrize("eps", [0.0, 1e-6])
def test_a_gust_on_a_block_that_slips_is_not_stepped_over(eps):
    """A push of 20 for 0.05 s across its way at u = 95: v = 20 (0.05 sqrt pi), less what friction takes."""
    whole, start, span = block("0", 0.1, "20*exp(-((tm-50)/0.05)^2)"), (100.0, 0.0, 0.0, 0.0, 0.0), (0.0, 60.0)
    run = whole.simulate(psi.constant(), start, span, eps=eps) if eps else whole.simulate_nonsmooth(start, span)
    assert run.states[-1, [1, 3]] == pytest.approx([1.753800, 17.63127], rel=1e-6)


def test_a_belt_that_stops_at_once_leaves_the_block_slipping():
    """The velocity of the other body jumps from 1 to 0 at 2: the block goes on, and friction 1 stops it at 3."""
    belt = contacts(EYE, [(EYE, 0.1, 10, ("tm < 2", "0"))], ("0", "0"), ("u", "v"), {"q": "u", "tm": 1})
    run = belt.simulate_nonsmooth((1.0, 0.0, 0.0, 0.0), (0.0, 5.0))
    assert [phase.kinds for phase in run.phases] == [("stick",), ("slip",), ("stick",)]
    assert [phase.t_start for phase in run.phases] == pytest.approx([0.0, 2.0, 3.0], abs=1e-9)
    assert run.states[-1, 2] == pytest.approx(2.5, abs=1e-9)


def test_a_bound_that_falls_at_once_lets_a_contact_go():
    """mu is 0.1 until 1 and 0.03 from there on: a load of 0.5 is held, and then u' = 0.2."""
    slippery = contacts(EYE, [(EYE, "0.1 - 0.07*(tm > 1)", 10)], ("0.5", "0"), ("u", "v"), {"tm": 1})
    run = slippery.simulate_nonsmooth((0.0, 0.0, 0.0), (0.0, 3.0))
    assert run.phases[1].t_start == pytest.approx(1.0, abs=1e-12)
    assert run.states[-1, 0] == pytest.approx(0.4, abs=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_two_blocks_under_random_loads_move_as_with_tiny_steps(seed):
    whole = Blocks.drawn(np.random.default_rng(seed))
    run = whole.contacts().simulate_nonsmooth((0.0,) * 6, (0.0, 4.0))
    assert run.status.name == "T_END"
    assert run.states[-1, :5] == pytest.approx(whole.tiny_steps(4.0), abs=2e-3)


def test_no_step_is_longer_than_max_step():
    whole, start = block("0.5"), (0.0,) * 5
    for run in (
        whole.simulate_nonsmooth(start, (0.0, 1.0), max_step=0.05),
        whole.simulate(psi.constant(), start, (0.0, 1.0), eps=1e-3, max_step=0.05),
    ):
        assert np.diff(run.times).max() <= 0.05 * (1.0 + 1e-12)
    with pytest.raises(ValueError, match="max_step is 0"):
        whole.simulate_nonsmooth(start, (0.0, 1.0), max_step=0)


@pytest.mark.parametrize("eps", [0.0, 1e-5])
def test_a_load_that_switches_back_at_once_is_named(eps):
    """The load is -1.5 for u > 0 and 2.5 for u < 0, more than friction holds: no motion goes on from u = 0."""
    whole, start, span = block("0.5 - 2*sign(u)"), (1.0, 0.0, 0.0, 0.0, 0.0), (0.0, 3.0)
    run = whole.simulate(psi.constant(), start, span, eps=eps) if eps else whole.simulate_nonsmooth(start, span)
    assert [key for key, _ in recognise(run.reason)] == ["step limit", "load switches back"]
    assert run.times[-1] == pytest.approx(0.4, abs=1e-4)


@pytest.mark.parametrize("eps", [0.0, 1e-5, 1e-8])
def test_a_pulse_is_not_lost_in_a_long_step_in_which_a_spring_hardly_moves(eps):
    """Positions of 1e-15, whose bounds decide nothing, used up what a step is looked at for. z by steps of 5e-5."""
    force, start, span = "2.138*exp(-((tm-5.243)/0.1075)^2) - 4*q", (0.0,) * 5, (0.0, 20.0)
    whole = block(force, 0.5)
    run = whole.simulate(psi.constant(), start, span, eps=eps) if eps else whole.simulate_nonsmooth(start, span)
    assert run.states[-1, 2] == pytest.approx(0.0744434, abs=3e-6 + 8.0 * eps)
