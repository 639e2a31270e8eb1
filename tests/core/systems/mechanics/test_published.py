"""Mechanisms with dry friction whose motions are known in closed form, or published."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.systems.mechanics import Mechanism


def oscillator(force=("F*cos(om*t)", 0.0), surface=(0.0, 0.0), **parameters):
    """A block of 1 kg on two springs of 1 N/m, whose friction is f, in newtons; in the plane, time next to it."""
    return Mechanism(
        M=np.eye(2), J=np.eye(2), force=(f"{force[0]} - q1", f"{force[1]} - q2"), mu="f", normal=1,
        velocities=("v1", "v2"), slow=("q1", "q2", "t"), rates={"q1": "v1", "q2": "v2", "t": 1.0}, surface=surface,
        parameters={"f": 0.1, "F": 0.0, "om": 1.0, **parameters},
    )  # fmt: skip


def test_a_free_oscillation_loses_two_f_each_half_turn_and_stops_within_f():
    """Along a line (y = 0): x_(n+1) = -(x_n - 2 f), each after the time pi; it stops where |x| < f."""
    block = oscillator(f=0.1)
    run = c2.simulate_nonsmooth(block.system, (0.0, 0.0, 0.75, 0.0, 0.0), (0.0, 20.0))
    named = block.named(np.array([run.dense(math.pi * n) for n in range(6)]))
    assert named["q1"] == pytest.approx([0.75, -0.55, 0.35, -0.15, -0.05, -0.05], abs=1e-7)
    assert run.phases[-1].kind == "slide"
    assert run.phases[-1].t_start == pytest.approx(4.0 * math.pi, abs=1e-6)


def shaken(eta):
    """A block on a table that is shaken: velocity sin(t), friction eta of what would carry it along."""
    return Mechanism(
        M=np.eye(2), J=np.eye(2), force=(0, 0), mu="eta", normal=1, velocities=("v1", "v2"), slow=("t",),
        rates={"t": 1.0}, surface=("sin(t)", 0), parameters={"eta": eta},
    )  # fmt: skip


@pytest.mark.parametrize(("eta", "sticks"), [(1.01, "always"), (0.99, "twice"), (0.55, "twice"), (0.53, "never")])
def test_a_block_on_a_shaken_table_sticks_never_twice_a_turn_or_always(eta, sticks):
    """B. Westermo, F. Udwadia, Earthquake Engng Struct. Dyn. 11 (1983) 135-146: 1 and 1/sqrt(1 + pi^2/4) = 0.537."""
    turns = 2.0 * math.pi
    run = c2.simulate_nonsmooth(shaken(eta).system, (0.0, 0.0, 0.0), (0.0, 12.0 * turns))
    late = [phase for phase in run.phases if phase.t_end > 10.0 * turns]
    stuck = sum(phase.t_end - max(phase.t_start, 10.0 * turns) for phase in late if phase.kind == "slide")
    if sticks == "always":
        assert stuck == pytest.approx(2.0 * turns)
    elif sticks == "never":
        assert stuck == pytest.approx(0.0, abs=1e-9)
    else:
        # it slips from sin t' = eta on, until eta t' - and what carried it have the same speed again
        assert 0.0 < stuck < 2.0 * turns
        assert len([phase for phase in late if phase.kind == "slip"]) in (4, 5)


def test_friction_of_a_belt_damps_what_moves_across_it():
    """On a belt at the speed V friction is viscous across: y'' + f/V y' + y = 0 while y' is small next to V."""
    block = oscillator(force=(0.0, 0.0), surface=("V", 0.0), f=0.2, V=2.0)
    start = block.state(v1=0.0, v2=0.0, q1=0.2, q2=1e-4, t=0.0)
    run = c2.simulate_nonsmooth(block.system, start, (0.0, 12.0))
    times, half = np.linspace(0.0, 12.0, 25), 0.05
    turn = math.sqrt(1.0 - half**2)
    expected = 1e-4 * np.exp(-half * times) * (np.cos(turn * times) + half / turn * np.sin(turn * times))
    named = block.named(np.array([run.dense(t) for t in times]))
    assert named["q2"] == pytest.approx(expected, abs=1e-9)
    assert named["q1"] == pytest.approx(0.2, abs=1e-8)
