"""The value to which cycles with growing periods tend, on sequences of which it is known."""

from types import SimpleNamespace

import pytest

from codim2_core.continuation.typed.typed_ends import limit_value


def turns(*periods):
    """Cycles at v + C period^-r with v = 0.3, C = 0.7, r = 0.8."""
    return [SimpleNamespace(period=period, value=0.3 + 0.7 * abs(period) ** -0.8) for period in periods]


def test_three_periods_tell_the_limit():
    assert limit_value(turns(1.0, 2.0, 4.0, 8.0, 16.0)) == pytest.approx(0.3, abs=1e-12)


def test_a_period_that_was_carried_too_far_tells_none():
    assert limit_value(turns(-1.0, 4.0, 16.0)) is None
