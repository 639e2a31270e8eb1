"""Curves of zeros, against curves that are known."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core.bifurcations.implicit_curve import Edge, Steps, between, solved, tangent, traced, zero_between

STEPS = Steps(0.1, 0.2, 500)


def circle(v):
    return np.array([v @ v - 1.0]), 2.0 * v[None]


def helix(v):
    """Along an angle: x = cos, y = sin, so that it comes round after 2 pi."""
    t, x, y = v
    rows = np.array([[math.sin(t), 1.0, 0.0], [-math.cos(t), 0.0, 1.0]])
    return np.array([x - math.cos(t), y - math.sin(t)]), rows


def below(level):
    return Edge("top", lambda v: (float(v[1]) - level, np.array([0.0, 1.0])))


def test_a_closed_curve_ends_where_it_began():
    found = traced(circle, np.array([1.0, 0.0]), (), STEPS)
    assert found.closed
    assert found.ends == ("", "")
    assert np.allclose(np.hypot(*found.points.T), 1.0, rtol=0.0, atol=1e-12)
    assert np.array_equal(found.points[0], found.points[-1])
    angles = np.unwrap(np.arctan2(*found.points.T[::-1]))
    assert abs(angles[-1] - angles[0]) == pytest.approx(2.0 * math.pi)


def test_a_curve_with_a_period_comes_round():
    found = traced(helix, np.array([0.3, math.cos(0.3), math.sin(0.3)]), (), Steps(0.1, 0.3, 500, 2.0 * math.pi))
    assert found.closed
    assert abs(found.points[-1, 0] - found.points[0, 0]) == pytest.approx(2.0 * math.pi, abs=1e-12)


@settings(max_examples=20)
@given(st.floats(-0.99, 0.99))
def test_it_ends_on_an_edge(level):
    found = traced(circle, np.array([0.0, -1.0]), [below(level)], STEPS)
    assert not found.closed
    assert found.ends == ("top", "top")
    assert np.allclose(found.points[[0, -1], 1], level, rtol=0.0, atol=1e-12)


def test_too_many_points_are_cut():
    found = traced(circle, np.array([1.0, 0.0]), (), Steps(0.01, 0.2, 20))
    assert found.ends == ("many", "many")
    assert len(found.points) == 41


def test_a_crossing_is_no_regular_point():
    def cross(v):
        return np.array([v[0] * v[1]]), np.array([[v[1], v[0]]])

    assert tangent(cross, np.zeros(2)) is None
    assert traced(cross, np.zeros(2), (), STEPS) is None


@given(st.floats(-1.5, 1.5), st.floats(0.5, 1.5))
def test_the_nearest_zero_is_found(angle, radius):
    start = radius * np.array([math.cos(angle), math.sin(angle)])
    found = solved(circle, start)
    assert np.allclose(found, start / radius, rtol=0.0, atol=1e-9)
    assert solved(circle, start, 0.5 * abs(radius - 1.0)) is None or abs(radius - 1.0) < 1e-6


def test_no_zero_is_none():
    assert solved(lambda v: (np.array([v @ v + 1.0]), 2.0 * v[None]), np.array([1.0, 0.2])) is None
    assert solved(lambda v: (np.array([math.nan]), 2.0 * v[None]), np.array([1.0, 0.2])) is None


@given(st.floats(0.05, 0.95))
def test_a_change_of_sign_between_neighbours(part):
    one, other = np.array([1.0, 0.0]), np.array([math.cos(0.2), math.sin(0.2)])
    at = 0.2 * part
    found = zero_between(circle, lambda v: math.atan2(v[1], v[0]) - at, one, other)
    assert np.allclose(found, (math.cos(at), math.sin(at)), rtol=0.0, atol=1e-11)
    middle = between(circle, one, other, 0.5)
    assert np.allclose(middle, (math.cos(0.1), math.sin(0.1)), rtol=0.0, atol=1e-12)
