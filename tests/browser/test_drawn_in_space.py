"""What is drawn in space, against the core's numbers, at two settings without any symmetry."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait.sliding.along_z import slow_portrait

from .asymmetric import PSI, at, equator, system
from .drawn import SCRIPTS, colour, numbers


def seen(points, azimuth, elevation):
    """Right and up of points in space (z up): a turn about z, then looked at from above by the elevation."""
    points = np.asarray(points, dtype=float).reshape(-1, 3)
    turn = np.array([[np.cos(azimuth), -np.sin(azimuth), 0], [np.sin(azimuth), np.cos(azimuth), 0], [0, 0, 1]])
    right, away, up = turn @ points.T
    return np.column_stack([right, np.cos(elevation) * up + np.sin(elevation) * away])


@pytest.fixture
def painted(opened):
    """Open a picture in space, turn it by 0.1, and give its canvas and what was painted on it."""

    def make(**more):
        page = opened("solid", **more)
        canvas = page.find("canvas.solid")
        canvas.evaluate(SCRIPTS["record"])
        canvas.press("ArrowRight")
        page.painted()
        return canvas, canvas.evaluate("(it) => it.drawn")

    return make


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


def test_limit_directions_along_z_in_space(painted, setting):
    canvas, drawn = painted(solid="stack")
    drawn = [it for it in drawn if it["name"] == "fillRect"]
    look = {name: canvas.evaluate(SCRIPTS["property"], name) for name in ("attr", "rep")}
    groups = {
        name: np.array([it["all"][:2] for it in drawn if it["fill"] == shade]).reshape(-1, 2) + 1.2
        for name, shade in look.items()
    }
    low, high, tall = -4.0, 4.0, 2.6
    wanted = {"attr": [], "rep": []}
    for z in np.linspace(low, high, 121):
        q = equator(setting, z=z)
        for theta, rho in zip(q.theta, q.lambda_rho, strict=True):
            wanted["attr" if rho < 0 else "rep"].append([np.cos(theta), np.sin(theta), tall * (z - low) / (high - low)])
    box = canvas.bounding_box()
    scale = min(box["width"] / 2.5, box["height"] / (tall * np.cos(0.5) + 2.3 * np.sin(0.5) + 0.5))
    middle = np.array([box["width"], box["height"] + scale * np.cos(0.5) * tall]) / 2
    for name, points in wanted.items():
        assert abs(len(points) - len(groups[name])) <= 2
        if len(points) < 5:
            continue
        places = seen(points, -0.7, 0.5) * [1, -1] * scale + middle
        gaps = [np.min(np.hypot(*(groups[name] - one).T)) for one in places]
        assert np.quantile(gaps, 0.97) < 3


def test_the_slow_flow_along_z_in_space(painted, setting):
    _, drawn = painted(solid="stack")
    turns = [it["all"][0] for it in drawn if it["name"] == "rotate"]
    found = slow_portrait(system(setting), PSI, "z1", (-4.0, 4.0))
    assert turns
    assert len(turns) == len([branch for branch in found.branches if len(branch.z) > 4])
    for turn, branch in zip(turns, found.branches, strict=False):
        i = len(branch.z) // 2
        steps = []
        for k in (i - 1, i + 1):
            (C, *_) = c2.critical_sets(system(setting), PSI, (float(branch.z[k]),))
            place = np.array(C.x2) / np.sqrt(1 + np.sum(np.square(C.x2)))
            steps.append(seen([*place, 2.6 * (branch.z[k] + 4) / 8], -0.7, 0.5)[0])
        along = (steps[1] - steps[0]) * np.sign(branch.flow[i, 0])
        way = np.array([np.cos(turn), -np.sin(turn)])  # pixels run down
        assert way @ along / np.hypot(*along) > 0.9
