"""Every object that a caption of the paper names is in what the page of its preset is sent, where the core puts it."""

import numpy as np
import pytest
from codim2_app.picture.draw.packing import INT16_STEP, unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2
from codim2_core.portrait.layer_problem.problem import LayerProblem
from tests.app.panels.opening import settled

LINES = "inside outside "  # orbits
CASE1 = LINES + "rho_outside theta_outside lines_outside "
#: For each preset, the curves and the entries of panels that its caption names, besides limit directions and C.
NAMED = {
    "case1-cm0": LINES, "case1-cm2": CASE1, "case1-cm2-paper": CASE1, "case1-cm4": CASE1, "case1-ncm2": CASE1,
    "case1-ncm4": CASE1, "case2-saddle": CASE1 + "separatrices_unstable", "case2-ncm2": CASE1, "case2-ncm4": CASE1,
    "case3-n1": LINES + "planes", "case3-n2": LINES + "planes", "case3-n3": LINES + "planes cycles",
    "case3-cycle": LINES + "cycles", "case3-n4": LINES + "planes cycles",
    "pitchfork-before": LINES, "pitchfork-at": LINES, "pitchfork-after": LINES,
    "saddle-node-before": LINES, "saddle-node-at": LINES + "separatrices_unstable",
    "saddle-node-after": LINES + "separatrices_unstable",
    "transcritical-before": LINES, "transcritical-at": LINES, "transcritical-after": LINES,
    "conics-0": "conics", "conics-2": "conics", "conics-4": "conics",
    "ellipse-in": "atlas_of", "ellipse-out": "atlas_of", "ball-dynamic": LINES,
    "ball-stick": LINES + "stack", "ball-critical": LINES + "stack", "ball-slip": LINES + "stack",
    "attracting-repelling": LINES + "outcomes", "nonunique-sliding": LINES + "outcomes",
    "nonunique-sliding-outside": LINES, "spinning-disc": LINES, "blowup": LINES, "blowup-stack": "stack",
    "regularisation": "psi_curves", "sliding-nonuniqueness": "filippov", "whylinear-slide": "filippov",
    "whylinear-cross": "filippov",
}  # fmt: skip


def test_every_preset_has_its_row():
    assert NAMED.keys() == c2.presets.keys()


@pytest.mark.parametrize("key", NAMED)
def test_the_objects_of_the_figure_are_drawn(key):
    frames = Frames(ExplorerState.from_values({"preset": key}))
    sent, blocks = unpack(frames.answer({"all": True}))
    sent |= settled(frames, all=True)
    for name in NAMED[key].split():
        found = blocks[f"{name}.xy"] if f"{name}.xy" in blocks else sent[name]
        assert len(found) or name == "rho_outside"  # of three portraits it is inside alone
    preset = c2.presets[key]
    at = preset.system.at(preset.z)
    problem = LayerProblem(at, preset.psi)
    equator, drawn = problem.equator, sent["equator"]
    np.testing.assert_allclose(drawn["x"], np.cos(equator.theta), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(drawn["y"], np.sin(equator.theta), rtol=0.0, atol=1e-12)
    assert drawn["filled"] == [int(v < 0) for v in equator.lambda_rho]
    if not len(equator):
        assert sent["cycle"] == pytest.approx(problem.equator_cycle.exponent)
        assert len(sent["sense"]) == 4  # arrows along the closed equator
    places = np.transpose([sent["critical"]["x"], sent["critical"]["y"]]).reshape(-1, 2)
    np.testing.assert_allclose(places, np.reshape([C.p for C in problem.critical], (-1, 2)), rtol=0.0, atol=1e-12)
    assert sent["critical"]["kind"] == [C.kind for C in problem.critical]
    if key.startswith("nonunique-sliding"):
        assert sent["critical"]["sense"] == ["⊙" if C.slow_flow[0] > 0 else "⊗" for C in problem.critical]
    if "lines_outside" in NAMED[key]:  # U1 = 0 and U2 = 0 beyond the circle; errata: = -f1 and = -f2
        x, y = np.reshape(blocks["lines_outside.xy"], (-1, 2)).T * INT16_STEP
        a, b, d, f1, f2 = at.plane
        scale = at.size * (1 + np.hypot(x, y))
        assert np.minimum(abs(a * x - b * y + f1) / scale, abs(b * x + d * y + f2) / scale).max() <= 3e-4
    if "filippov" in NAMED[key]:
        assert len(sent["filippov"]["selected"]) == len(problem.critical)
