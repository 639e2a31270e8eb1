"""A motion as a DataFrame holds what the motion does."""

import sys

import numpy as np
import pytest

from codim2_core import examples, psi, simulate, simulate_nonsmooth

BALL = examples.ball_in_pool(K=0.5, mu=0.25)
START = (1.0, 0.2, 1.0, 0.5)


@pytest.mark.parametrize("eps", [0.0, 1e-3])
def test_a_row_is_a_time_with_its_state_and_phase(eps):
    span = (0.0, 0.6)
    run = simulate(BALL, psi.constant(), START, span, eps=eps) if eps else simulate_nonsmooth(BALL, START, span)
    frame = run.to_frame()
    assert list(frame.columns) == ["t", "x", "y", "z1", "z2", "phase", "onto"]
    np.testing.assert_array_equal(frame["t"], run.times)
    np.testing.assert_array_equal(frame[["x", "y", "z1", "z2"]], run.states)
    t = np.linspace(0.0, 0.6, 37)
    even = run.to_frame(t)
    np.testing.assert_array_equal(even[["x", "y", "z1", "z2"]], run.dense(t))
    phases = [run.phase_at(one) for one in t]
    assert even["phase"].tolist() == [phase.kind for phase in phases]
    assert even["onto"].replace({np.nan: None}).tolist() == [phase.onto for phase in phases]
    assert {"slip", "slide"} == set(even["phase"])


def test_what_cannot_be_is_told(monkeypatch):
    run = simulate_nonsmooth(BALL, START, (0.0, 0.6))
    with pytest.raises(ValueError, match="this motion is known for"):
        run.to_frame([0.1, 0.7])
    with pytest.raises(ValueError, match=r"t has shape \(\); give a list of times"):
        run.to_frame(0.1)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ValueError, match="pandas is not installed"):
        run.to_frame()
