import math

import numpy as np
import pytest
from codim2_app.picture.draw import glyphs
from codim2_app.picture.draw.lines.arrowheads import MIN_LINE_LENGTH, STRETCH, arrowheads
from codim2_app.picture.draw.packing import PACKING_PIXEL, WINDOW

LINE = np.column_stack([np.linspace(0, 1, 11), np.zeros(11)])


def place(*pieces, pixel=PACKING_PIXEL, window=WINDOW):
    return arrowheads(*glyphs.join(pieces), pixel, window)


def test_an_arrowhead_sits_in_the_middle_and_points_with_time():
    heads = place(LINE, LINE[::-1] + np.array([0, 2]), LINE[:, ::-1] - np.array([2, 1]))
    assert heads == pytest.approx(np.array([[0.5, 0, 0], [0.5, 2, math.pi], [-2, -0.5, math.pi / 2]]))


def test_short_empty_and_resting_curves_have_none():
    short = LINE * 0.9 * MIN_LINE_LENGTH * PACKING_PIXEL
    rest, none, single = np.ones((4, 2)), np.zeros((0, 2)), np.ones((1, 2))
    assert place(none, short, single, LINE, rest, none)[:, 0].tolist() == pytest.approx([0.5])
    assert place().shape == (0, 3)


def test_a_long_curve_has_one_for_each_stretch():
    length = 3 * STRETCH * PACKING_PIXEL
    heads = place(np.column_stack([np.linspace(0, length, 50) - length / 2, np.zeros(50)]), window=(-9, 9, -9, 9))
    assert heads[:, 0].tolist() == pytest.approx([-length / 3, 0, length / 3])


def test_only_what_is_seen_carries_arrowheads():
    heads = place(LINE, window=(0.55, 1, -1, 1))
    assert heads[:, 0].tolist() == pytest.approx([0.64])
    assert len(place(LINE + 5)) == 0
