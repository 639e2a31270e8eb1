"""Curves of zeros, against curves that are known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.numerics.arclength import CurveEdge, StepBounds, tangent, trace_curve

STEPS = StepBounds(0.1, 0.2, 500)


def circle(v):
    return np.array([v @ v - 1.0]), 2.0 * v[None]


def below(level):
    return CurveEdge("top", lambda v: (float(v[1]) - level, np.array([0.0, 1.0])))


def test_a_closed_curve_ends_where_it_began():
    found = trace_curve(circle, np.array([1.0, 0.0]), (), STEPS)
    assert found.closed
    assert found.ends == ("", "")
    assert np.allclose(np.hypot(*found.points.T), 1.0, rtol=0.0, atol=1e-12)
    assert np.array_equal(found.points[0], found.points[-1])
    angles = np.unwrap(np.arctan2(*found.points.T[::-1]))
    assert abs(angles[-1] - angles[0]) == pytest.approx(2.0 * math.pi)


@settings(max_examples=20)
@given(st.floats(-0.99, 0.99))
def test_it_ends_on_an_edge(level):
    found = trace_curve(circle, np.array([0.0, -1.0]), [below(level)], STEPS)
    assert not found.closed
    assert found.ends == ("top", "top")
    assert np.allclose(found.points[[0, -1], 1], level, rtol=0.0, atol=1e-12)


def test_a_crossing_is_no_regular_point():
    def cross(v):
        return np.array([v[0] * v[1]]), np.array([[v[1], v[0]]])

    assert tangent(cross, np.zeros(2)) is None
    assert trace_curve(cross, np.zeros(2), (), STEPS) is None
