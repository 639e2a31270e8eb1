"""Curves of the plane of parameters as they are sent: in units of its size, and with no more points than are seen."""

import math

import numpy as np
import pytest
from codim2_app.picture.draw import plane_curves


def curve(*branches):
    return type("Curve", (), {"branches": branches})()


def test_curves_of_the_plane_travel_over_their_largest_coordinate():
    line = np.array([[0.5, -4.0], [1.0, 2.0], [3.0, 1.0]])
    assert plane_curves.size_of([curve(line), curve(0.5 * line)]) == 4.0
    assert plane_curves.size_of([curve(np.zeros((1, 2)))]) == 1.0
    assert plane_curves.size_of([]) == 1.0
    offsets, points = plane_curves.curve_lines(curve(line, line[:1]), 4.0)
    assert offsets.tolist() == [0, 3, 4]
    assert points == pytest.approx(np.concatenate([line, line[:1]]) / 4.0)
    region = type("Region", (), {"name": "CM4", "inside": (1.0, -2.0), "bounded": True, "boundary": [line, line[:3]]})
    told = plane_curves.region_columns([region], 4.0)
    assert told == {"name": ["CM4"], "inside": [[0.25, -0.5]], "bounded": [True], "loops": [2], "size": 4.0}
    assert plane_curves.region_lines([region], 4.0)[0].tolist() == [0, 3, 6]


def test_thinning_keeps_ends_corners_and_what_a_pixel_would_show():
    turn = np.linspace(0.0, 1.5 * math.pi, 2001)
    arc = np.column_stack([np.cos(turn), np.sin(turn)]) * 5.0
    offsets, points = plane_curves.thin([arc, arc + 20.0], 5.0)
    one = points[: offsets[1]]
    assert 95 < len(one) < 105  # one for each tenth of a radian, and one for each 0.09 of the size
    assert len(points) == 2 * len(one)
    assert one[[0, -1]] == pytest.approx(arc[[0, -1]] / 5.0)
    assert points[offsets[1]] == pytest.approx(arc[0] / 5.0 + 4.0)
    middles = 0.5 * (one[1:] + one[:-1])
    assert 1.0 - np.hypot(*middles.T).min() < 0.0004  # the sag of a chord
    assert np.hypot(*np.diff(one, axis=0).T).max() < 0.055
    straight = np.column_stack([np.linspace(0.0, 1.0, 1001), np.zeros(1001)])
    kept = plane_curves.thin([straight], 1.0)[1]
    assert 11 <= len(kept) <= 14
    corner = np.concatenate([straight, np.column_stack([np.ones(1000), np.linspace(0.001, 1.0, 1000)])])
    assert (plane_curves.thin([corner], 1.0)[1] == [1.0, 0.0]).all(axis=1).any()
