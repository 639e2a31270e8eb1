"""Hatches, marks and labels of a drawing: where they stand at any zoom and size."""

import math
import re

import numpy as np
import pytest
from codim2_app.picture.draw.theme import HALF_VIEW, RING
from codim2_app.picture.draw.vector import parts as vector
from codim2_app.picture.draw.vector.parts import VIEWBOX_SIDE, Placement


@pytest.mark.parametrize(("hatch", "strokes"), [("/", 1), ("x", 2), (".", 1), ("", 0)])
def test_hatches_lie_on_the_ring_as_far_apart_on_any_screen(hatch, strokes):
    inner, outer = RING
    middle = (inner + outer) / 2
    for place in (Placement(), Placement(side=500.0, unit=500 / 700), Placement(unit=VIEWBOX_SIDE / 350)):
        found = vector._hatching(0.5, 2.0, hatch, place)
        step = vector.HATCH * place.unit / (middle * place.scale)  # of the angle
        assert len(found) == strokes * math.floor(1.5 / step + 0.5)
        for i, ((x, y), (u, v)) in enumerate(found):
            angle = 0.5 + (i // max(strokes, 1) + 0.5) * step
            one, other = math.atan2(y, x) - angle, math.atan2(v, u) - angle
            assert one == pytest.approx(-other)
            lean = (outer - inner) / middle / 2
            if hatch == ".":
                assert (math.hypot(x, y), math.hypot(u, v)) == pytest.approx((middle, middle))
                assert other == pytest.approx(lean / 4)
            else:
                assert (math.hypot(x, y), math.hypot(u, v)) == pytest.approx((inner, outer))
                assert other == pytest.approx(lean if i % strokes == 0 else -lean)  # at 45 degrees


def test_no_label_stands_over_the_core_of_a_mark():
    columns = {
        "x": [0.5, 9.0], "y": [-0.25, 0.0], "shape": ["circle"] * 2, "size": [14, 14], "colour": ["attr"] * 2,
        "filled": [1, 1],
    }  # fmt: skip
    for place in (Placement(), Placement(unit=3.0)):
        taken = []
        assert len(vector.marks(columns, place, taken)) == 1  # the other is not seen
        [box] = taken
        [(u, v)] = place.points([(0.5, -0.25)]).tolist()
        assert (box.x + box.width / 2, box.y + box.height / 2) == pytest.approx((u, v))
        assert box.width == box.height == pytest.approx(vector.CORE * 14 * place.unit)
        assert 0.5 * 14 * place.unit < box.width < 14 * place.unit


def test_zoomed_in_a_label_stands_as_near_to_its_mark():
    columns = {"x": [0.6], "y": [0.8], "label": ["Q₁"], "label_x": [0.75], "label_y": [0.95]}
    offsets = []
    for seen in ((-HALF_VIEW, HALF_VIEW, -HALF_VIEW, HALF_VIEW), (0.1, 1.1, 0.3, 1.3), (-7.0, 7.0, -7.0, 7.0)):
        place = Placement(seen)
        [text] = vector.labels(columns, place, [], False)
        [(u, v)] = place.points([(0.6, 0.8)]).tolist()
        x, y = (float(re.search(rf' {name}="([^"]*)"', text)[1]) for name in "xy")
        offsets.append((x - u, y - 0.34 * place.text - v))
    scale = VIEWBOX_SIDE / (2 * HALF_VIEW)
    assert offsets[0] == pytest.approx((0.15 * scale, -0.15 * scale), abs=0.6)
    assert offsets[1] == pytest.approx(offsets[0], abs=1.1)
    smaller = 0.15 * VIEWBOX_SIDE / 14  # with all else
    assert offsets[2] == pytest.approx((smaller, -smaller), abs=1.1)


@pytest.mark.parametrize("seen", [(-1.75, 1.75, -1.75, 1.75), (-0.5, 0.7, -0.3, 0.9)])
def test_basins_lie_where_their_cells_are(seen):
    """Cells in rows from below, each from the left, over a part of the disc; 0 is drawn as nothing."""
    cells, box = np.random.default_rng(4).choice(3, (8, 8), p=(0.3, 0.4, 0.3)), (-0.6, 1.0, -0.2, 1.4)
    flat = cells.ravel()
    starts = np.concatenate([[0], np.flatnonzero(np.diff(flat)) + 1])
    runs = np.column_stack([np.diff(np.append(starts, 64)), flat[starts]]).ravel()
    place = Placement(seen)
    header = {"cells": 8, "box": box, "colours": ["", "basin-1", "basin-2"]}
    drawn = "".join(vector.basins(header, {"basins": runs}, place))
    found = np.zeros((8, 8), int)
    centres = box[0] + 0.2 * (np.arange(8) + 0.5), box[2] + 0.2 * (np.arange(8) + 0.5)
    for path, which in re.findall(r'<path d="([^"]*)" fill="var\(--basin-(\d)\)"', drawn):
        for x, y, wide, tall in re.findall(r"M([-\d.]+) ([-\d.]+)h([-\d.]+)v([-\d.]+)h", path):
            for row, v in enumerate(centres[1]):
                for column, u in enumerate(centres[0]):
                    px, py = (u - seen[0]) * place.scale, (seen[3] - v) * place.scale
                    if 0 < px - float(x) < float(wide) and 0 < py - float(y) < float(tall):
                        found[row, column] += int(which)
    np.testing.assert_array_equal(found, cells)
