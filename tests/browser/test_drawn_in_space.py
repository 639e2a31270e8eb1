"""What is drawn in space, against the core's numbers, at two settings without any symmetry."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.sliding.along import slow_portrait

from .asymmetric import PSI, at, equator, system
from .drawn import SCRIPTS


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


def test_hemisphere_in_space(painted, setting):
    canvas, drawn = painted()
    q = equator(setting)
    sets = at(setting)
    circles = np.array([it["all"][:2] for it in drawn if it["name"] == "arc" and it["all"][2] == 4])
    boxes = np.array([it["all"] for it in drawn if it["name"] == "rect"])
    squares = boxes[:, :2] + boxes[:, 2:] / 2
    x2 = np.array([C.x2 for C in sets])
    flat = x2 / np.sqrt(1 + np.sum(x2**2, axis=1, keepdims=True))
    height = np.sqrt(1 - np.sum(flat**2, axis=1))
    rim = np.column_stack([np.cos(q.theta), np.sin(q.theta), 0 * q.theta])
    wanted = seen(np.concatenate([rim, np.column_stack([flat, height])]), -0.7, 0.5)
    places = np.concatenate([circles, squares])
    assert len(places) == len(wanted)
    # one size and one middle for all: x to the right, y down
    scale = np.linalg.norm(places - places.mean(0)) / np.linalg.norm(wanted - wanted.mean(0))
    flipped = wanted * [1, -1]
    np.testing.assert_allclose(places - places.mean(0), scale * (flipped - flipped.mean(0)), atol=0.02 * scale)
    page_colour, attracting, repelling, critical = (
        canvas.evaluate(SCRIPTS["property"], name) for name in ("page", "attr", "rep", "crit")
    )
    rims = [it for it in drawn if it["name"] == "arc" and it["all"][2] == 4]
    for it, rho in zip(rims, q.lambda_rho, strict=True):
        assert it["stroke"] == (attracting if rho < 0 else repelling)
        assert it["fill"] in ((attracting,) if rho < 0 else (page_colour, "#ffffff"))
    for it, C in zip([it for it in drawn if it["name"] == "rect"], sets, strict=True):
        assert it["stroke"] == critical
        assert (it["fill"] == critical) == C.kind.startswith("stable")


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
    found = slow_portrait(system(setting), PSI, (-4.0, 4.0))
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
