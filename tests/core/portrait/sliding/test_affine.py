"""The plane of affine combinations of limit vectors and its point on Sigma, fig:whylinear."""

import numpy as np
import pytest
from hypothesis import given, settings

import codim2_core as c2
from codim2_core.portrait.sliding.filippov import affine_plane
from tests.core.strategies import coefficient, systems


@settings(max_examples=20)
@given(systems, coefficient, coefficient, coefficient)
def test_the_plane_holds_every_limit_vector_and_its_point_is_on_sigma(system, b1, b2, g):
    system = c2.ELinear(*system.at().plane[:3], system.at().plane[3:], B=((b1, b2),), g=(g,))
    at, plane = system.at((0.0,)), affine_plane(system, (0.0,))
    theta = np.linspace(0.0, 6.0, 7)
    e = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
    combined = e @ plane.matrix.T + plane.offset
    np.testing.assert_allclose(combined, np.concatenate([at.U(e), at.W(e)], axis=-1), rtol=0.0, atol=1e-12)
    if plane.place is None:
        return
    whole = plane.matrix @ plane.place + plane.offset
    scale = 1.0 + np.abs(plane.matrix).max() * (1.0 + np.abs(plane.place).max())
    assert np.abs(whole[:2]).max() <= 1e-12 * scale  # U = 0: tangent to Sigma
    assert whole[2:] == pytest.approx(plane.point, abs=1e-12 * scale)
    assert plane.convex == bool(c2.critical_sets(system, c2.psi.constant(), (0.0,))) or "between" in plane.sentence
    if plane.convex and "between" not in plane.sentence:
        assert plane.point == pytest.approx(c2.sliding_flow(system, (0.0,)), rel=1e-9, abs=1e-9 * scale)


@pytest.mark.parametrize(
    ("name", "convex", "words"),
    [("whylinear-slide", True, "there is sliding"), ("whylinear-cross", False, "there is crossing")],
)
def test_the_figures(name, convex, words):
    preset = c2.presets[name]
    plane = affine_plane(preset.system, preset.z or (0.0,))
    assert plane.convex is convex
    assert words in plane.sentence
    assert bool(np.hypot(*plane.place) < 1.0) is convex


def test_where_it_touches_the_circle_and_where_det_a_vanishes():
    on = affine_plane(c2.ELinear(-1.0, 0.0, -1.0, (1.0, 0.0), B=((1.0, 0.0),), g=(0.0,)), (0.0,))
    assert on.convex
    assert not any(array.flags.writeable for array in (on.matrix, on.offset, on.place, on.point))
    assert "between sliding and crossing" in on.sentence
    none = affine_plane(c2.ELinear(-1.0, 0.0, 0.0, (0.3, 0.2), B=((1.0, 0.0),), g=(0.0,)), (0.0,))
    assert none.point is None
    assert not none.convex
    assert none.sentence.startswith("det A = 0")
