"""Evenly spaced orbits, against distances that are computed between all pairs."""

import numpy as np
import pytest
from codim2_app.picture.draw.lines.spacing import EQUATOR_GUARD, MIN_PIECE, SEPARATION, evenly
from codim2_app.picture.draw.packing import PACKING_PIXEL, WINDOW
from scipy.spatial import cKDTree

import codim2_core as c2
from tests.app.near import gaps


def dense(offsets, points, step):
    """Each piece, with a place at every step at most."""
    finer = []
    for piece in np.split(points, offsets[1:-1]):
        at = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(piece, axis=0).T))])
        t = np.linspace(0.0, at[-1], 2 + int(at[-1] / step))
        finer.append(np.column_stack([np.interp(t, at, piece[:, 0]), np.interp(t, at, piece[:, 1])]))
    return finer


@pytest.mark.parametrize(
    ("name", "layer", "pixel"),
    [
        ("case1-cm4", "inside", PACKING_PIXEL),
        ("case3-n3", "inside", PACKING_PIXEL),
        ("case1-cm0", "outside", PACKING_PIXEL / 4),
    ],
)
def test_no_two_are_near_and_each_lies_on_one_that_was_there(name, layer, pixel):
    preset = c2.presets[name]
    scene = c2.Scene(preset.system, preset.psi, preset.z)
    before, cycles = scene[layer], scene["closed_orbits"].cycles
    guards = None if not cycles else (np.array([0, len(cycles[0].points)]), cycles[0].points)
    offsets, points = evenly(before.offsets, before.buffer, pixel, WINDOW, guards)
    apart = SEPARATION * pixel
    pieces = dense(offsets, points, apart / 2)
    assert len(pieces) > 5
    of = np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces])
    places = np.concatenate(pieces)
    distance, other = cKDTree(places).query(places, k=12)
    # places are half the distance apart, so what lies between them is at most a quarter nearer
    assert distance[of[other] != of[:, None]].min() > 0.7 * apart
    for guard in (EQUATOR_GUARD[1], *(cycle.points for cycle in cycles)):
        assert gaps(places[::7], [guard]).min() > 0.7 * apart
    for piece in pieces:
        assert np.hypot(*np.diff(piece, axis=0).T).sum() >= 0.99 * MIN_PIECE * pixel
    assert gaps(points[:: max(1, len(points) // 200)], before.points).max() < 1e-9


def test_curves_that_are_far_apart_stay_whole_and_what_is_beyond_the_window_is_left_out():
    offsets, points = np.array([0, 2, 4]), np.array([[-0.5, 0.0], [0.5, 0.0], [1.2, 0.5], [4.0, 0.5]])
    left, kept = evenly(offsets, points, PACKING_PIXEL, WINDOW)
    assert left.tolist() == [0, 2, 4]
    assert kept[:3].tolist() == points[:3].tolist()
    assert 2.0 < kept[3, 0] <= WINDOW[1]
    empty = evenly(np.array([0]), np.zeros((0, 2)), PACKING_PIXEL, WINDOW)
    assert empty[0].tolist() == [0]
    assert empty[1].shape == (0, 2)
