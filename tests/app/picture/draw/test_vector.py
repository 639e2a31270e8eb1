"""Hatches, marks and labels of a drawing: where they stand at any zoom and size."""

import math
import re

import numpy as np
import pytest
from codim2_app.picture.draw.theme import RING
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
