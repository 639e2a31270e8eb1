"""Trajectories: where they end and why, each by itself, and what is refused."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import psi
from codim2_core.portrait.orbits.trajectories import Status, concatenate, trajectories
from codim2_core.systems.elinear import ELinear

from .seeds import CASE_I, FAMILIES, PIXEL, only, ring, sunflower

coefficient = st.floats(-3.0, 3.0).map(lambda v: round(v, 3))


@settings(max_examples=20, deadline=None)
@given(st.tuples(*[coefficient] * 5), st.sampled_from(FAMILIES), st.booleans())
def test_states_stay_on_the_sphere_and_lines_in_the_picture(values, p, backward):
    a, b, d, f1, f2 = values
    seeds = np.concatenate([sunflower(10), ring(10, 1.5), ring(4, 1.0)])
    result = trajectories(ELinear(a, b, d, (f1, f2)), p, seeds, backward=backward)
    inside = result.ends[:10]
    assert np.abs((inside**2).sum(axis=1) - 1.0).max() < 1e-14
    assert np.abs(np.hypot(*result.ends[10:, :2].T) - 1.0).max() < 1e-14
    assert np.isfinite(result.buffer).all()
    for k, (line, time, seed) in enumerate(zip(result.points, result.times, seeds, strict=True)):
        assert np.abs(line[0] - seed).max() < 1e-15 * 4
        assert time[0] == 0.0
        assert (np.diff(time) < 0.0).all() if backward else (np.diff(time) > 0.0).all()
        r = np.hypot(*line.T)
        assert (r < 1.0 + 1e-5).all() if k < 10 else (r > 1.0 - 1e-9).all()
        if result.status[k] is Status.LEFT_VIEW:
            assert abs(np.abs(line[-1]).max() - 2.0) <= 0.25 * PIXEL
    assert result.evaluations < len(seeds) * 15 * 2000


def test_each_trajectory_is_its_own_whatever_runs_next_to_it():
    seeds = np.concatenate([sunflower(70), ring(30, 1.4)])
    together = trajectories(CASE_I, psi.tanh(), seeds)
    for k in (0, 31, 32, 69, 70, 99):
        alone = trajectories(CASE_I, psi.tanh(), seeds[k : k + 1])
        assert np.array_equal(alone.points[0], together.points[k])
        assert alone.status[0] is together.status[k]


def test_status_of_each_kind():
    one = psi.constant()
    node = ELinear(-2.0, 0.0, -1.0, (-0.5, 0.2))
    result = trajectories(node, one, sunflower(20), t_max=100.0)
    assert only(result) is Status.EQUILIBRIUM
    assert np.abs(result.ends[:, :2] - (-0.25, 0.2)).max() < 2e-6
    assert only(trajectories(node, one, sunflower(20, 0.9), t_max=0.01)) is Status.T_MAX
    outside = trajectories(ELinear(1.0, 0.3, 1.0), one, ring(20, 1.2), t_max=100.0)
    assert only(outside) is Status.LEFT_VIEW
    edge = np.array([np.abs(line[-1]).max() for line in outside.points])
    assert np.abs(edge - 2.0).max() < 1e-9
    assert only(trajectories(node, one, ring(20, 1.4), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(2.0, 0.0, 1.0), one, sunflower(20, 0.9), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(1.0, 2.0, 1.0), one, sunflower(20, 0.9), t_max=100.0)) is Status.SPIRALLED
    assert only(trajectories(ELinear(-1.0, 2.0, -1.0), one, ring(20, 1.4), t_max=100.0)) is Status.SPIRALLED
    assert only(trajectories(ELinear(-1.0, 0.0, -1.0), one, ring(20, 1.4), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(0.0, 1.0, 0.0), one, sunflower(5), t_max=1e6)) is Status.STEP_LIMIT
    assert only(trajectories(node, one, ring(20, 1.0), t_max=100.0)) is Status.ON_EQUATOR
    assert all(isinstance(s.value, str) and s.value.endswith(".") for s in Status)


def test_a_slow_passage_ends_nothing():
    # Past the ghost of a saddle-node on the equator, past a saddle, and round a centre.
    one = psi.constant()
    ghost = ELinear(0.0, 1.0, 0.0, (0.9999999, 0.0))
    assert only(trajectories(ghost, one, [(0.0, 1.3)], capture=1e-3, view=100.0)) is Status.T_MAX
    saddle = ELinear(-1.0, 0.0, 1.0)
    result = trajectories(saddle, one, [(0.5, 1e-5), (0.5, -1e-5)], capture=1e-3, t_max=40.0)
    assert only(result) is Status.ARRIVED
    assert result.ends[0, 1] > 0.99
    assert result.ends[1, 1] < -0.99
    centre = trajectories(ELinear(0.0, 1.0, 0.0), one, [(1e-4, 0.0)], capture=1e-3)
    assert only(centre) is Status.T_MAX


@pytest.mark.parametrize("scale", [1e-149, 1e-20, 1.0, 1e20, 1e149])
def test_any_scale_of_the_coefficients_ends_soon(scale):
    system = ELinear(*(scale * v for v in (-2.0, 0.5, -1.0)), (-0.5 * scale, 0.2 * scale))
    seeds = np.concatenate([sunflower(20), ring(20, 1.5)])
    for p in FAMILIES:
        result = trajectories(system, p, seeds, t_max=8.0)
        assert result.evaluations < 40 * 15 * 500
        assert np.isfinite(result.buffer).all()
    same = trajectories(system, psi.constant(), seeds, t_max=8.0 / scale)
    assert np.abs(same.ends - trajectories(CASE_I, psi.constant(), seeds).ends).max() < 1e-7


def test_nothing_moves_without_a_field():
    result = trajectories(ELinear(0.0, 0.0, 0.0), psi.constant(), sunflower(5))
    assert only(result) is Status.EQUILIBRIUM
    assert np.abs(result.ends[:, :2] - sunflower(5)).max() < 1e-15


def test_results_are_read_only_views_and_join():
    result = trajectories(CASE_I, psi.constant(), sunflower(64))
    assert len(result) == 64
    assert all(line.base is result.buffer for line in result.points)
    both = concatenate([result, trajectories(CASE_I, psi.constant(), [], backward=True), result])
    assert len(both) == 128
    assert np.array_equal(both.points[70], result.points[6])
    assert both.status == result.status * 2
    assert len(concatenate([])) == 0
    assert trajectories(CASE_I, psi.constant(), []).points == []


def test_a_seed_too_far_to_draw_from_is_refused_and_its_end_is_not():
    """To a quarter of a pixel the arc had 1e50 points: the call did not come back."""
    for far in (1e7, 1e99):
        with pytest.raises(ValueError, match="at most 1e\\+06 away"):
            trajectories(CASE_I, psi.constant(), [[0.1, 0.2], [far, 0.5 * far]], t_max=1.0)
    assert len(trajectories(CASE_I, psi.constant(), [[1e7, 5e6]], t_max=1.0, samples="ends")) == 1
    assert len(trajectories(CASE_I, psi.constant(), [[9e5, 5e5]], t_max=1.0).buffer) < 300_000
