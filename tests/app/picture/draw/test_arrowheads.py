import math

import numpy as np
import pytest
from codim2_app.picture.draw import glyphs
from codim2_app.picture.draw.lines.arrowheads import MIN_LINE_LENGTH, STRETCH, _place_arrowheads, arrowheads
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


def one_by_one(pieces, pixel, window):
    """The same places, each held against all that are there: 24 px apart, one for 300 px, none on less than 16 px."""
    left, right, bottom, top = window
    heads = []
    for points in pieces:
        steps = np.diff(points, axis=0)
        travelled = np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])
        total = travelled[-1] if len(points) > 1 else 0.0
        if total <= 16 * pixel:
            continue
        slots = max(1, math.floor(total / (300 * pixel) + 0.5))
        for slot in range(slots):
            for part in (0.5, 0.64, 0.36, 0.78, 0.22, 0.9, 0.1):
                target = total * (slot + part) / slots
                step = int(np.searchsorted(travelled[1:-1], target))
                share = (target - travelled[step]) / (travelled[step + 1] - travelled[step])
                x, y = points[step] + share * steps[step]
                seen = left <= x <= right and bottom <= y <= top
                if seen and all(math.hypot(x - u, y - v) >= 24 * pixel for u, v, _ in heads):
                    heads.append((x, y, math.atan2(steps[step][1], steps[step][0])))
                    break
    return heads


@pytest.mark.parametrize("seed", range(6))
def test_near_heads_are_found_cell_by_cell_as_by_trying_all(seed):
    rng = np.random.default_rng(seed)
    pixel, window = (0.004, (-0.9, 1.3, -0.4, 1.1)) if seed % 2 else (0.013, (-2.0, 1.0, -1.5, 2.5))
    middle = np.array([window[0] + window[1], window[2] + window[3]]) / 2
    pieces = [
        middle + rng.normal(0, 60 * pixel, 2) + np.cumsum(rng.normal(0, 9 * pixel, (rng.integers(2, 90), 2)), axis=0)
        for _ in range(60)
    ]
    heads = place(*pieces, pixel=pixel, window=window)
    expected = one_by_one(pieces, pixel, window)
    assert len(expected) > 25
    assert heads == pytest.approx(np.array(expected), abs=1e-12)


def test_at_the_edges_of_what_is_seen_the_grid_has_room():
    window = (-1.0, 1.0, -0.5, 0.75)
    corners = [(x, y) for x in window[:2] for y in window[2:]]
    lines = [np.array([[x - 0.2, y], [x + 0.2, y]]) for x, y in corners]
    assert place(*lines, pixel=0.005, window=window)[:, :2].tolist() == [list(corner) for corner in corners]
    moved = [line + np.array([0, 0.05]) for line in lines]  # 10 px above: two are beyond, two find room beside
    assert len(place(*lines, *moved, pixel=0.005, window=window)) == 6


def test_one_compilation_does_for_arrays_of_all_kinds():
    offsets, points = np.array([0, 2]), np.array([(0.0, 0.0), (0.0, 0.0), (0.5, 0.5), (1.0, 1.0)])
    found = []
    for frozen in (False, True):
        one, other = offsets.astype(np.int32 if frozen else np.int64), points[::2].copy()
        one.flags.writeable = other.flags.writeable = not frozen
        found.append(arrowheads(one, other, 0.01, (-1.0, 1.0, -1.0, 1.0)))
        assert other.flags.writeable is not frozen  # what was given stays as it was
    np.testing.assert_array_equal(*found)
    assert len(_place_arrowheads.signatures) == 1
