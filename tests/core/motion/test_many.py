"""Many motions at once are those one by one; motions that end within a rounding of their span."""

from __future__ import annotations

import math

import pytest

from codim2_core import ELinear, Event, examples, psi, simulate_nonsmooth
from codim2_core.motion.result import SimulationStatus
from tests.core.ways import WAYS, follow

SPAN = (0.0, 6.0)
PUSHED = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))


def test_few_rows_and_events_are_followed_one_by_one():
    up = Event(lambda t, state: state[2] - 0.5)
    states = [(0.3, 0.2, 0.0), (0.1, -0.4, 0.2)]
    found = simulate_nonsmooth(PUSHED, states, SPAN, psi.constant(), events=up)
    assert [run.events[0][0] for run in found] == pytest.approx([0.5, 0.3])
    with pytest.raises(ValueError, match="state0"):
        simulate_nonsmooth(PUSHED, [(0.3, 0.2, 0.0), (math.nan, 1.0, 0.0)], SPAN)


@pytest.mark.parametrize("way", WAYS)
def test_a_span_that_ends_at_the_arrival_is_whole(monkeypatch, way):
    """So near Sigma that the rest of the way is straight, and yet it is not reached in time."""
    follow(monkeypatch, way)
    ball, t_end = examples.ball_in_pool(K=0.0, mu=0.25, g=8.0), 1.0 / 7.0 * (1.0 - 4e-15)
    own = Event(lambda t, state: 1.0)
    for events in ((), own):
        run = simulate_nonsmooth(ball, (1.0, 0.0, 1.0, 0.0), (0.0, t_end), psi.constant(), events=events)
        assert run.status is SimulationStatus.T_END
        assert run.times[-1] == t_end
        assert [phase.kind for phase in run.phases] == ["slip"]


def test_a_slide_whose_end_is_a_rounding_away_has_ended(monkeypatch):
    """Found at random: 2e-16 are left, and a step of that length is taken for the end of the set."""
    follow(monkeypatch, "compiled")
    state, t_end = (-0.4955759740468772, -0.0663660602076763, 0.16035802925580112), 1.7266351098640789
    options = {"rtol": 1e-3, "atol": 1e-3, "events": Event(lambda t, state: 1.0)}
    run = simulate_nonsmooth(examples.tilting_block(), state, (0.0, t_end), psi.constant(), **options)
    assert run.status is SimulationStatus.T_END
    assert run.times[-1] == pytest.approx(t_end, rel=1e-15)
