"""Every object that a caption of the paper names is drawn by its preset, where the core's numbers put it.

One row a preset: the objects of its figure, each with a check of what the page is sent.
"""

import math

import numpy as np
import pytest
from codim2_app.picture.draw.packing import INT16_STEP, unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2
from codim2_core.portrait.layer_problem.problem import LayerProblem
from codim2_core.portrait.nullcline.conics import conics_of
from codim2_core.portrait.sliding.filippov import affine_plane
from tests.app.panels.opening import settled

DIGITS = 3e-4  # of what is packed as whole numbers of the view


class Figure:
    """What the page of one preset has been sent, and the same from the core."""

    def __init__(self, key):
        frames = Frames(ExplorerState.from_values({"preset": key}))
        whole, self.blocks = unpack(frames.answer({"all": True}))
        self.sent = whole | settled(frames, all=True)
        self.layers = frames.values["layers"]
        self.preset = c2.presets[key]
        self.at = self.preset.system.at(self.preset.z)
        self.problem = LayerProblem(self.at, self.preset.psi)

    def points(self, part):
        assert f"{part}.xy" in self.blocks, f"{part} is not drawn"
        return np.reshape(self.blocks[f"{part}.xy"], (-1, 2)) * INT16_STEP


def limit_directions(figure):
    assert "equator" in figure.layers
    equator, found = figure.problem.equator, figure.sent["equator"]
    np.testing.assert_allclose(found["x"], np.cos(equator.theta), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found["y"], np.sin(equator.theta), rtol=0.0, atol=1e-12)
    assert found["filled"] == [int(v < 0) for v in equator.lambda_rho]
    assert len(found["x"])


def no_limit_directions(figure):
    assert figure.sent["equator"]["x"] == []
    assert figure.sent["cycle"] == pytest.approx(figure.problem.equator_cycle.exponent)
    assert len(figure.sent["sense"]) == 4  # arrows along the closed equator


def critical_sets(figure):
    assert "critical" in figure.layers
    sets, found = figure.problem.critical, figure.sent["critical"]
    np.testing.assert_allclose(np.transpose([found["x"], found["y"]]), [C.p for C in sets], rtol=0.0, atol=1e-12)
    assert found["kind"] == [C.kind for C in sets]
    assert sets


def no_critical_set(figure):
    assert figure.sent["critical"]["x"] == []
    assert not figure.problem.critical


def senses_of_the_slow_flow(figure):
    signs = ["⊙" if C.slow_flow[0] > 0 else "⊗" for C in figure.problem.critical]
    assert figure.sent["critical"]["sense"] == signs


def trajectories(figure):
    inside, outside = figure.points("inside"), figure.points("outside")
    assert (np.hypot(*inside.T) <= 1.0 + DIGITS).all()
    assert (np.hypot(*outside.T) >= 1.0 - DIGITS).all()


def nullclines(figure):
    for part, row in (("rho_outside", (np.cos, np.sin)), ("theta_outside", (lambda t: -np.sin(t), np.cos))):
        x, y = figure.points(part).T
        x, y = x[np.hypot(x, y) > 1.2], y[np.hypot(x, y) > 1.2]
        angle = np.arctan2(y, x)
        U = figure.at.U(np.stack([np.cos(angle), np.sin(angle)], axis=-1))
        assert np.abs(row[0](angle) * U[:, 0] + row[1](angle) * U[:, 1]).max(initial=0.0) <= 3e-3 * figure.at.size


def lines_of_u(figure):
    x, y = figure.points("lines_outside").T
    a, b, d, f1, f2 = figure.at.plane
    scale = figure.at.size * (1 + np.hypot(x, y))
    on = [np.abs(a * x - b * y + f1) / scale, np.abs(b * x + d * y + f2) / scale]  # errata: = -f1 and = -f2
    assert np.minimum(*on).max() <= DIGITS


def limit_cycle(figure):
    found = c2.limit_cycles(figure.preset.system, figure.preset.psi, figure.preset.z)
    assert figure.sent["cycles"]["kind"] == [cycle.kind for cycle in found]
    drawn = figure.points("cycles")
    for cycle in found:
        gaps = np.hypot(*(drawn[:, None] - cycle.points[None, ::20]).T).min(axis=-1)
        assert gaps.max() <= 0.02


def planes_and_psi(figure):
    found = figure.sent["planes"]
    named = [i for i, text in enumerate(found["text"]) if text]
    assert [found["text"][i] for i in named] == ["n = 1", "n = 2", "n = 3", "n = 4"]
    assert [found["trace"][i] for i in named] == pytest.approx([-71 + 32.25 * n for n in range(1, 5)])  # errata
    assert [found["determinant"][i] for i in named] == pytest.approx([147 + 36.75 * n for n in range(1, 5)])
    s = np.array(found["s"])
    assert [text for text, _ in found["psis"]] == ["n = 1", "n = 2", "n = 3", "n = 4"]
    for n, (_, values) in enumerate(found["psis"], start=1):
        np.testing.assert_allclose(values, 3 / (3 + (4 * s) ** n), atol=1e-4)
    x, y = figure.sent["critical"]["x2"][0]
    assert x * x + y * y == pytest.approx(0.25)  # where the gradients differ, and the values do not


def conics(figure):
    drawn, expected = figure.points("conics"), conics_of(figure.problem)
    assert len(expected.pieces) == 2
    a, b, d, f1, f2 = figure.at.plane
    x, y = drawn.T
    assert np.abs((d - a) * x * y + f2 * x - f1 * y + b).max() <= 3e-3
    meeting = np.transpose([figure.sent["equator"]["x"], figure.sent["equator"]["y"]]).reshape(-1, 2)
    np.testing.assert_allclose(meeting, expected.meeting, rtol=0.0, atol=1e-12)


def ellipse_and_f(figure):
    assert figure.sent["atlas_of"] == [
        "f1",
        "f2",
        True,
    ]  # the panel Atlas is open: its curves are the ellipse and the saddle-nodes
    ellipse = np.concatenate(c2.bifurcations.critical_boundary(c2.ELinear(*figure.at.plane[:3])).branches)
    size = np.hypot(*np.linalg.solve(figure.at.A, ellipse.T))
    np.testing.assert_allclose(size, 1.0, rtol=0.0, atol=1e-9)


def connections(figure):
    drawn = figure.points("separatrices_unstable")
    C = figure.problem.critical[0].p
    Q = figure.problem.equator
    assert np.hypot(*(drawn - C).T).min() <= 0.01
    assert min(np.hypot(*(drawn - (math.cos(t), math.sin(t))).T).min() for t in Q.theta) <= 0.01


def hemisphere(figure):
    assert len(figure.points("inside"))  # the panel lifts the picture
    assert len(figure.points("outside"))


def hemispheres_along_z(figure):
    stack = figure.sent["stack"]
    assert len(stack["discs"]) >= 3
    low, high = stack["span"]
    heights = np.array([row[0] for row in stack["directions"]])
    assert heights.min() < 0.05
    assert heights.max() > 0.95
    for row in stack["sets"]:
        for x, y, share in row["points"][:: max(1, len(row["points"]) // 5)]:
            z = (low + share * (high - low), *figure.preset.z[1:])
            near = [np.hypot(*(C.p - (x, y))) for C in c2.critical_sets(figure.preset.system, figure.preset.psi, z)]
            assert min(near, default=math.hypot(x, y) - 0.98) <= 0.02
    assert stack["sets"]


def step_and_psi(figure):
    found = figure.sent["psi_curves"]
    np.testing.assert_allclose(found["modulus"], np.tanh(found["zeta"]), atol=1e-4)  # L = tanh(l/eps)


def candidates(figure):
    found = figure.sent["filippov"]
    ends = c2.filippov_sliding(figure.preset.system, figure.preset.z).vertices[:, 0]
    assert sorted(found["candidates"]) == pytest.approx(sorted(ends))
    assert len(found["combined"]) == len(ends)
    assert [value for value, _ in found["selected"]] == pytest.approx([C.slow_flow[0] for C in figure.problem.critical])


def plane_and_cross(figure):
    found, plane = figure.sent["filippov"], affine_plane(figure.preset.system, figure.preset.z or (0.0,))
    assert len(found["plane"]) == 4
    normal = np.cross(*plane.matrix.T)
    for corner in (*found["plane"], (0.0, 0.0, found["cross"]), *found["curve"]):
        assert abs(normal @ (np.array(corner) - plane.offset)) <= 2e-3 * np.abs(corner).max() * np.linalg.norm(normal)
    assert found["cross"] == pytest.approx(float(plane.point[0]), abs=1e-3)
    assert plane.convex == bool(figure.problem.critical)


def outcomes(figure):
    rows = {row[0]: row[1] for row in figure.sent["outcomes"]["rows"]}
    assert rows
    assert "outcomes" in figure.layers
    assert "basins" in figure.layers


CASE1 = (trajectories, nullclines, lines_of_u)
CASE3 = (limit_directions, critical_sets, trajectories, planes_and_psi)
BALL = (limit_directions, trajectories, hemispheres_along_z)
OBJECTS = {
    "case1-cm0": (*CASE1[:1], no_limit_directions, critical_sets),
    "case1-cm2": (*CASE1, limit_directions, critical_sets),
    "case1-cm2-paper": (*CASE1, limit_directions, critical_sets),
    "case1-cm4": (*CASE1, limit_directions, critical_sets),
    "case1-ncm2": (*CASE1, limit_directions, no_critical_set),
    "case1-ncm4": (*CASE1, limit_directions, no_critical_set),
    "case2-saddle": (*CASE1, limit_directions, critical_sets, connections),
    "case2-ncm2": (*CASE1, limit_directions, no_critical_set),
    "case2-ncm4": (*CASE1, limit_directions, no_critical_set),
    "case3-n1": CASE3,
    "case3-n2": CASE3,
    "case3-n3": (*CASE3, limit_cycle),
    "case3-cycle": (no_limit_directions, critical_sets, trajectories, limit_cycle),
    "case3-n4": (*CASE3, limit_cycle),
    "pitchfork-before": (limit_directions, critical_sets, trajectories),
    "pitchfork-at": (limit_directions, critical_sets, trajectories),
    "pitchfork-after": (limit_directions, critical_sets, trajectories),
    "saddle-node-before": (no_limit_directions, critical_sets, trajectories),
    "saddle-node-at": (limit_directions, critical_sets, trajectories, connections),
    "saddle-node-after": (limit_directions, critical_sets, trajectories, connections),
    "transcritical-before": (limit_directions, critical_sets, trajectories),
    "transcritical-at": (limit_directions, no_critical_set, trajectories),
    "transcritical-after": (limit_directions, no_critical_set, trajectories),
    "conics-0": (conics,),
    "conics-2": (conics, limit_directions),
    "conics-4": (conics, limit_directions),
    "ellipse-in": (ellipse_and_f, critical_sets),
    "ellipse-out": (ellipse_and_f, no_critical_set),
    "ball-stick": (*BALL, critical_sets),
    "ball-critical": (*BALL, no_critical_set),
    "ball-slip": (*BALL, no_critical_set),
    "ball-dynamic": (limit_directions, trajectories),
    "attracting-repelling": (limit_directions, critical_sets, trajectories, outcomes),
    "nonunique-sliding": (limit_directions, critical_sets, trajectories, senses_of_the_slow_flow, outcomes),
    "nonunique-sliding-outside": (limit_directions, critical_sets, trajectories, senses_of_the_slow_flow),
    "spinning-disc": (limit_directions, critical_sets, trajectories),
    "blowup": (hemisphere, limit_directions, critical_sets),
    "blowup-stack": (hemispheres_along_z, limit_directions, critical_sets),
    "regularisation": (step_and_psi,),
    "sliding-nonuniqueness": (candidates,),
    "whylinear-slide": (plane_and_cross, candidates),
    "whylinear-cross": (plane_and_cross, no_critical_set),
}


def test_every_preset_has_its_row():
    assert OBJECTS.keys() == c2.presets.keys()


@pytest.mark.parametrize("key", OBJECTS)
def test_the_objects_of_the_figure_are_drawn(key):
    figure = Figure(key)
    for check in OBJECTS[key]:
        check(figure)
