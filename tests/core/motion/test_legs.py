"""Motions in the limit followed compiled are those followed phase by phase; many at once are those one by one."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from codim2_core import ELinear, Event, System, examples, psi, simulate_nonsmooth
from codim2_core.motion import nonsmooth
from codim2_core.motion.limit import compiled_run_phases
from codim2_core.motion.result import Phase, SimulationStatus
from tests.core.ways import WAYS, follow

SPAN = (0.0, 6.0)
PUSHED = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))
TYPED = System(U=("-2*c + 1.5*c*s + 2.4*sin(z1)", "-s + 0.9*cos(z1)"), W=("1",))
WITHOUT_Z = ELinear(-1.0, 2.0, -2.0, f=(0.2, 0.1))
CASES = {
    "ball": (examples.ball_in_pool(K=2.0), (-1.0, 0.3, 10.0, 0.0), True),
    "ball in a line": (examples.ball_in_pool(K=2.0), (1.0, 0.0, 3.0, 0.0), True),
    "slides that end": (PUSHED, (0.3, 0.2, 0.0), True),
    "typed": (TYPED, (0.3, 0.2, 0.0), True),
    "no z, round and round": (WITHOUT_Z, (0.3, 0.2), True),
    "round and round": (ELinear(-1.0, 3.0, -1.5, f=(0.1, 0.2), B=((0.0, 0.0),), g=(1.0,)), (0.3, 0.2, 0.0), True),
    "crosses": (ELinear(-1.0, 0.0, -4.0, f=(-1.5, 0.2)), (0.3, 0.05), False),
    "starts on Sigma": (PUSHED, (0.0, 0.0, 0.0), False),
    "Case III": (ELinear(-2.0, 1.5, 0.4, f=(0.1, 0.3), B=((0.3, 0.1),), g=(0.5,)), (0.3, 0.2, 0.0), False),
}

ROUND = "round and round"  # onto the closed equator


@pytest.fixture
def by_phase(monkeypatch):
    """The same, phase by phase: what is decided by safe signs is taken for undecided."""

    def run(system, state, rtol, own):
        with monkeypatch.context() as only:
            follow(only, "compiled")
            only.setattr(nonsmooth, "_run_motions", lambda asked, states: iter([asked.one(states[0])]))
            return simulate_nonsmooth(system, state, SPAN, own, rtol=rtol, atol=rtol)

    return run


def _told(phase: Phase) -> tuple[str, str | None, str]:
    return phase.kind, phase.onto, re.sub(r"\d+\.\d+", "#", phase.reason)


@pytest.mark.parametrize(
    ("case", "own"), [*((case, psi.tanh()) for case in CASES), ("typed", None), ("crosses", None), ("Case III", None)]
)
def test_it_is_the_motion_phase_by_phase(monkeypatch, by_phase, case, own):
    system, state, is_decided = CASES[case]
    follow(monkeypatch, "compiled")
    steps, count = [], nonsmooth.run_hybrid
    monkeypatch.setattr(nonsmooth, "run_hybrid", lambda *given: steps.append(count(*given)) or steps[-1])
    rtol = 1e-8
    found, other = (
        simulate_nonsmooth(system, state, SPAN, own, rtol=rtol, atol=rtol),
        by_phase(system, state, rtol, own),
    )
    if own is not None:
        assert [one.onward for (one,) in steps] == ([-1] if is_decided else [0] * len(steps))
    assert [_told(phase) for phase in found.phases] == [_told(phase) for phase in other.phases]
    assert found.status is other.status
    np.testing.assert_allclose([p.t_end for p in found.phases], [p.t_end for p in other.phases], rtol=1e-6)
    at = np.linspace(0.0, found.times[-1], 40)[:-1]
    np.testing.assert_allclose(found.dense(at), other.dense(at), rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(found.states[-1], other.states[-1], rtol=1e-6, atol=1e-6)
    for phase, same in zip(found.phases, other.phases, strict=True):
        middle = 0.5 * (phase.t_start + phase.t_end)
        np.testing.assert_allclose(phase.p(middle), same.p(middle), atol=1e-6)
        assert bool(len(phase.ascent)) is bool(len(same.ascent))
        if not case.endswith(ROUND):  # at which angle it is said to arrive is then a matter of the last steps
            np.testing.assert_allclose(phase.ascent[-1:], same.ascent[-1:], atol=0.01)


def test_it_is_handed_over_where_the_next_phase_is_not_sure(monkeypatch, by_phase):
    """The slide ends where a saddle meets C, at z = 0.09: what follows a fold is decided by orbits."""
    folds = System(U=("z1 - c**2 - 0.09", "-s"), W=("-1",))
    state = (0.3, 0.1, 0.5)
    follow(monkeypatch, "compiled")
    handed, own = [], compiled_run_phases.PhaseBuilder.onward
    monkeypatch.setattr(compiled_run_phases.PhaseBuilder, "onward", lambda one: handed.append(one) or own(one))
    found, other = (run(folds, state, 1e-8, psi.constant()) for run in (_as_it_is, by_phase))
    assert [part.phase.kind for part in handed[0].parts] == ["slip"]
    assert [_told(phase) for phase in found.phases] == [_told(phase) for phase in other.phases]
    assert found.phases[1].kind == "slide"
    assert found.phases[1].t_end == pytest.approx(0.41, abs=1e-6)
    np.testing.assert_allclose(found.states[-1], other.states[-1], rtol=1e-6, atol=1e-6)


def _as_it_is(system, state, rtol, own):
    return simulate_nonsmooth(system, state, SPAN, own, rtol=rtol, atol=rtol)


def test_the_steps_of_many_are_those_of_one():
    rng = np.random.default_rng(3)
    states = rng.normal(size=(40, 3)) * 0.5
    states[7, :2] = 0.0  # on Sigma
    found = simulate_nonsmooth(PUSHED, states, SPAN, psi.constant(), rtol=1e-6, atol=1e-6)
    assert len(found) == len(states)
    for state, run in zip(states, found, strict=True):
        own = simulate_nonsmooth(PUSHED, state, SPAN, psi.constant(), rtol=1e-6, atol=1e-6)
        np.testing.assert_array_equal(run.times, own.times)
        np.testing.assert_array_equal(run.states, own.states)
        assert run.phases == own.phases
        assert run.evaluations == own.evaluations
        assert run.reason == own.reason


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
