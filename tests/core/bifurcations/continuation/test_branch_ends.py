"""The value to which cycles with growing periods tend, on sequences of which it is known."""

import math
from types import SimpleNamespace

import pytest

from codim2_core.bifurcations.continuation.branch_ends import limit_value, slow_down_at, slow_sequence


def turns(*periods):
    """Cycles at v + C period^-r with v = 0.3, C = 0.7, r = 0.8."""
    return [SimpleNamespace(period=period, value=0.3 + 0.7 * abs(period) ** -0.8) for period in periods]


def test_three_periods_tell_the_limit():
    assert limit_value(slow_sequence(turns(1.0, 2.0, 4.0, 8.0, 16.0))) == pytest.approx(0.3, abs=1e-12)


def test_a_period_that_was_carried_too_far_tells_none():
    assert limit_value(slow_sequence(turns(-1.0, 4.0, 16.0))) is None


def test_the_law_of_a_saddle_node_is_told_from_that_of_a_loop():
    """ln T = 5 + 0.03/sqrt(v* - v) against T = (v* - v)^-1/0.8; and against a loop that lies before v*."""
    distances = (1e-2, 1e-3, 1e-4, 1e-5)
    slow = [SimpleNamespace(period=math.exp(5.0 + 0.03 / math.sqrt(d)), value=0.7 - d) for d in distances]
    loop = [SimpleNamespace(period=d ** (-1.0 / 0.8), value=0.7 - d) for d in distances]
    assert slow_down_at(slow_sequence(slow), 0.7)
    assert not slow_down_at(slow_sequence(loop), 0.7)
    assert not slow_down_at(slow_sequence(loop), 0.7 + 1e-5)
    assert not slow_down_at(slow_sequence(slow)[:2], 0.7)
