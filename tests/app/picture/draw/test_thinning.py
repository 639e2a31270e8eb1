"""Curves of a chart as they are sent: with no more points than are seen."""

import math

import numpy as np
import pytest
from codim2_app.picture.draw.thinning import thin


def test_thinning_keeps_ends_corners_and_what_a_pixel_would_show():
    turn = np.linspace(0.0, 1.5 * math.pi, 2001)
    arc = np.column_stack([np.cos(turn), np.sin(turn)]) * 5.0
    offsets, points = thin([arc / 5.0, arc / 5.0 + 4.0])
    one = points[: offsets[1]]
    assert 95 < len(one) < 105  # one for each tenth of a radian, and one for each 0.09 of the size
    assert len(points) == 2 * len(one)
    assert one[[0, -1]] == pytest.approx(arc[[0, -1]] / 5.0)
    assert points[offsets[1]] == pytest.approx(arc[0] / 5.0 + 4.0)
    middles = 0.5 * (one[1:] + one[:-1])
    assert 1.0 - np.hypot(*middles.T).min() < 0.0004  # the sag of a chord
    assert np.hypot(*np.diff(one, axis=0).T).max() < 0.055
    straight = np.column_stack([np.linspace(0.0, 1.0, 1001), np.zeros(1001)])
    kept = thin([straight])[1]
    assert 11 <= len(kept) <= 14
    corner = np.concatenate([straight, np.column_stack([np.ones(1000), np.linspace(0.001, 1.0, 1000)])])
    assert (thin([corner])[1] == [1.0, 0.0]).all(axis=1).any()
