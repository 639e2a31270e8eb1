"""Events: all zeros in a step, directions, terminal ones, in both kinds of motion, and functions that are none."""

import math

import numpy as np
import pytest

from codim2_core import Event, System, examples, simulate, simulate_nonsmooth
from codim2_core import psi as families

TURNS = System(U=("-z1", "-z2"), W=("x", "y"))  # x'' = -x whatever e


def motion(which, system, state0, t, **options):
    if which == "limit":
        return simulate_nonsmooth(system, state0, (0.0, t), families.constant(), **options)
    return simulate(system, families.constant(), state0, (0.0, t), eps=1e-6, **options)


@pytest.mark.parametrize("which", ["smooth", "limit"])
@pytest.mark.parametrize("level", [0.999, 0.9, 1.0 - 1e-7])
def test_two_zeros_in_one_step_are_both_found(which, level):
    run = motion(which, TURNS, (1.0, 0.1, 0.0, 0.3), 62.0, rtol=1e-3, events=(lambda t, q: q[2] - level,))
    exact = motion(which, TURNS, (1.0, 0.1, 0.0, 0.3), 62.0, rtol=1e-12)
    assert len(exact.times) > len(run.times)
    if level < 0.9995:  # beyond that the coarse motion itself decides
        assert len(run.events[0]) == 20
        expected = np.sort(np.concatenate([np.arange(10) * math.tau + side for side in (
            math.asin(level), math.pi - math.asin(level))]))  # fmt: skip
        np.testing.assert_allclose(run.events[0], expected, atol=0.05)


@pytest.mark.parametrize("which", ["smooth", "limit"])
def test_rising_falling_and_terminal(which):
    def height(t, q):
        return q[2] - 0.5

    rises, falls = Event(height, direction=1), Event(height, direction=-1)
    run = motion(which, TURNS, (1.0, 0.1, 0.0, 0.3), 13.0, rtol=1e-9, events=(rises, falls))
    first = math.asin(0.5)
    np.testing.assert_allclose(run.events[0], [first, first + math.tau], atol=1e-6)
    np.testing.assert_allclose(run.events[1], [math.pi - first, 3.0 * math.pi - first], atol=1e-6)
    stop = Event(height, -1, True)
    run = motion(which, TURNS, (1.0, 0.1, 0.0, 0.3), 13.0, rtol=1e-9, events=(stop, height))
    assert run.status.name == "EVENT"
    assert run.times[-1] == pytest.approx(math.pi - first, abs=1e-6)
    assert run.phases[-1].t_end == run.times[-1]
    assert len(run.events[1]) == 2  # also what happens at that moment


def test_events_of_the_limit_are_found_in_every_phase():
    ball = examples.ball_in_pool(K=2.0)
    limit = simulate_nonsmooth(
        ball, (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), events=(lambda t, q: q[2] - 1.0, Event(lambda t, q: t - 2.5))
    )
    slide = limit.phases[-1]
    z = limit.dense(slide.t_start)[2:]
    assert slide.kind == "slide"
    assert limit.events[0][-1] == pytest.approx(slide.t_start + math.log(z[0]) * 7.0 / 10.0, abs=1e-7)
    assert limit.events[1].tolist() == pytest.approx([2.5])
    ended = simulate_nonsmooth(
        ball, (-1.0, 0.3, 10.0, 0.0), (0.0, 3.0), events=Event(lambda t, q: q[2] - 1.0, terminal=True)
    )
    assert ended.times[-1] == limit.events[0][-1]
    assert [phase.kind for phase in ended.phases] == ["slip", "slide"]


@pytest.mark.parametrize("which", ["smooth", "limit"])
@pytest.mark.parametrize(
    ("events", "message"),
    [
        ((lambda t, q: math.nan,), "returned nan"),
        ((lambda t, q: math.nan if t > 0.5 else 1.0,), "returned nan at t"),
        ((lambda t, q: q,), r"array of shape \(4,\)"),
        ((lambda t, q: "high",), "return a number"),
        (3.0, "sequence of Event"),
        ((3.0,), "callable"),
    ],
)
def test_functions_that_are_no_events_say_so(which, events, message):
    with pytest.raises(ValueError, match=message):
        motion(which, TURNS, (1.0, 0.1, 0.0, 0.3), 2.0, events=events)
    with pytest.raises(ValueError, match="direction"):
        Event(lambda t, q: t, direction=True + 1)
    with pytest.raises(ValueError, match="terminal is 'x'; give True or False"):
        Event(lambda t, q: t, terminal="x")


def test_one_event_alone_and_arrays_of_one_number_are_taken():
    run = simulate(
        TURNS, families.constant(), (1.0, 0.1, 0.0, 0.3), (0.0, 3.0), eps=1e-3, events=lambda t, q: q[2:3] - 0.5
    )
    assert len(run.events) == 1
    assert len(run.events[0]) == 2


def test_a_corner_is_found():
    run = simulate(TURNS, families.constant(), (1.0, 0.1, 0.0, 0.3), (0.0, 3.0), eps=1e-3,
                   events=lambda t, q: abs(q[2] - 0.5) - 0.25)  # fmt: skip
    expected = sorted([math.asin(0.25), math.asin(0.75), math.pi - math.asin(0.75), math.pi - math.asin(0.25)])
    np.testing.assert_allclose(run.events[0], expected, atol=1e-5)
