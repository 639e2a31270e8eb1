"""What is drawn in space, against the core's numbers, at two settings without any symmetry."""

import numpy as np
import pytest

from .asymmetric import at, equator
from .drawn import colour, numbers


def seen(points, azimuth, elevation):
    """Right and up of points in space (z up): a turn about z, then looked at from above by the elevation."""
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    turn = np.array([[np.cos(azimuth), -np.sin(azimuth), 0], [np.sin(azimuth), np.cos(azimuth), 0], [0, 0, 1]])
    right, away, up = turn @ points.T
    return np.column_stack([right, np.cos(elevation) * up + np.sin(elevation) * away])


PIXELS = """(canvas, places) => {
    const flat = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height})
    const pen = flat.getContext('2d', {willReadFrequently: true}), ratio = canvas.width / canvas.clientWidth
    pen.drawImage(canvas, 0, 0)
    return places.map(([x, y]) => [...pen.getImageData(Math.round(ratio * x), Math.round(ratio * y), 1, 1).data])
}"""


def test_hemisphere_in_space(opened, setting):
    page = opened("solid")
    canvas = page.find("canvas.solid")
    canvas.press("ArrowRight")  # a turn by 0.1
    page.painted()
    box = canvas.bounding_box()
    q, sets = equator(setting), at(setting)
    x2 = np.array([C.x2 for C in sets])
    flat = x2 / np.sqrt(1 + np.sum(x2**2, axis=1, keepdims=True))
    height = np.sqrt(1 - np.sum(flat**2, axis=1))
    points = np.vstack(
        [np.column_stack([np.cos(q.theta), np.sin(q.theta), 0 * q.theta]), np.column_stack([flat, height])]
    )
    away = np.sin(-0.7) * points[:, 0] + np.cos(-0.7) * points[:, 1]
    front = np.cos(0.5) * away - np.sin(0.5) * points[:, 2] < 0
    scale = min(box["width"] / 2.84, box["height"] / (np.cos(0.5) + 2.84 * np.sin(0.5)))
    middle = np.array([box["width"], box["height"] + 0.6 * scale * np.cos(0.5)]) / 2
    places = middle + scale * seen(points, -0.7, 0.5) * [1, -1]
    hollow, attracting, critical = (colour(page, name) for name in ("page", "attr", "crit"))
    fills = [attracting if rho < 0 else hollow for rho in q.lambda_rho]
    fills += [critical for C in sets]  # a full square, or the middle of a cross; the scaling chart lies over them
    found = canvas.evaluate(PIXELS, places.tolist())
    assert front.sum() >= 2
    for i, (near, wanted, pixel) in enumerate(zip(front, fills, found, strict=True)):
        if near:
            assert pixel[:3] == pytest.approx(numbers(wanted)[:3], abs=2 if i < len(q.theta) else 25)
