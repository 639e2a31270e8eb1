"""The saddle-node curve and the ellipse, on which limit directions and the critical set come and go."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, bifurcations, classify, critical_sets, equator_equilibria, psi
from codim2_core.bifurcations.families.disc import cusps, saddle_node_force
from codim2_core.bifurcations.plane.curve import border_reach, critical_lines, saddle_node_lines
from codim2_core.portrait.layer_problem.linearisation import determinant_sign
from tests.core.strategies import coefficient

matrices = st.tuples(coefficient, coefficient, coefficient)


@given(matrices, st.floats(0.0, 1.0))
def test_across_the_saddle_node_curve_the_number_of_directions_changes_by_two(abd, u):
    a, b, d = abd
    curve = bifurcations.saddle_node(ELinear(*abd))
    branch = curve.branches[int(u * (len(curve) - 1e-9))]
    assume(len(branch) > 3)
    i = 1 + int(u * (len(branch) - 4))
    f, along = branch[i], branch[i + 1] - branch[i - 1]
    size, length = max(map(abs, abd)), float(np.hypot(*along))
    assume(length > 1e-4 * size)
    across = 1e-5 * size * np.array([-along[1], along[0]]) / length
    counts = [len(equator_equilibria(ELinear(a, b, d, tuple(f + sign * across)))) for sign in (-1, 1)]
    near_other = any(np.hypot(*(f - p.place)) < 1e-2 * size for p in curve.special)
    if not near_other and not (a == d == 0.0):
        assert abs(counts[0] - counts[1]) == 2


@given(matrices)
def test_cusps_are_triple_zeros(abd):
    a, b, d = abd
    for point in bifurcations.saddle_node(ELinear(*abd)).special:
        if point.type not in ("cusp", "pitchfork"):
            continue
        # Theta, Theta' and Theta'' vanish at the angle that the three equations give
        A = np.array([[a, -b], [b, d]])
        theta = min(cusps(A), key=lambda t: math.dist(saddle_node_force(A, np.array(t)), point.place))
        c, s = math.cos(theta), math.sin(theta)
        f1, f2, k, size = *point.place, a - d, max(map(abs, abd))
        assert -k * s * c + f2 * c - f1 * s + b == pytest.approx(0.0, abs=1e-14 * size)
        assert -k * (c * c - s * s) - f2 * s - f1 * c == pytest.approx(0.0, abs=1e-14 * size)
        assert 4 * k * s * c - f2 * c + f1 * s == pytest.approx(0.0, abs=1e-7 * size)


def test_pitchforks_of_the_astroid_are_where_d2_says():
    curve = bifurcations.saddle_node(ELinear(-1, 0, -1.5))
    assert {p.type for p in curve.special} == {"pitchfork"}
    places = sorted(np.round(p.place, 12).tolist() for p in curve.special)
    assert places == [[-0.5, 0.0], [0.0, -0.5], [0.0, 0.5], [0.5, 0.0]]
    for point in curve.special:
        found = classify(ELinear(-1, 0, -1.5, tuple(np.round(point.place, 12))), psi.constant())
        assert [d.name for d in found.degeneracies] == ["pitchfork"]


@pytest.mark.parametrize(
    ("abd", "types"),
    [
        ((-1, 0.3, -2), ["cusp"] * 4), ((-1, 0.5, -2), ["cusp"] * 4),
        ((-1, 0.8, -2), ["cusp"] * 4 + ["double saddle-node"] * 2),
        ((-1, -1.4, -2), ["cusp"] * 4 + ["double saddle-node"] * 2), ((-1, 1.5, -2), ["quadruple zero"] * 2),
        ((-1, 1.6, -2), []), ((-1, 1, -1), []), ((-1, 0, -1), ["all directions"]), ((0, 0, 0), ["all directions"]),
    ],
)  # fmt: skip
def test_special_points_by_b_over_k(abd, types):
    curve = bifurcations.saddle_node(ELinear(*abd))
    assert sorted(p.type for p in curve.special) == sorted(types)
    for p in curve.special:
        if p.type == "double saddle-node":
            # around it each double zero splits or vanishes
            counts = set()
            for t in np.linspace(0, 2 * np.pi, 24, endpoint=False):
                f = np.array(p.place) + 1e-3 * np.array([np.cos(t), np.sin(t)])
                counts.add(len(equator_equilibria(ELinear(*abd, tuple(f)))))
            assert counts == {0, 2, 4}


def test_degenerate_curves_are_named():
    circle = bifurcations.saddle_node(ELinear(-1, 0.5, -1))
    np.testing.assert_allclose(np.hypot(*circle.branches[0].T), 0.5, rtol=1e-14)
    assert "circle" in circle.name
    assert bifurcations.saddle_node(ELinear(2, 0, 2)).branches[0].tolist() == [[0.0, 0.0]]
    segment = bifurcations.critical_boundary(ELinear(1, 2, -4))
    assert "segment" in segment.name
    ends = segment.branches[0]
    A = np.array([[1.0, -2.0], [2.0, -4.0]])
    assert np.hypot(*ends[1]) == pytest.approx(np.linalg.norm(A, 2))
    assert np.linalg.matrix_rank(np.column_stack([A, ends[1]]), tol=1e-12) == 1
    assert bifurcations.critical_boundary(ELinear(0, 0, 0)).branches[0].tolist() == [[0.0, 0.0]]
    assert "also" in bifurcations.critical_boundary(ELinear(0, 1, 0)).name


@settings(max_examples=20)
@given(matrices)
def test_ellipse_is_where_the_critical_set_leaves(abd):
    assume(determinant_sign(*abd) != 0)
    A = np.array([[abd[0], -abd[1]], [abd[1], abd[2]]])
    assume(np.linalg.cond(A) < 1e6)
    (branch,) = bifurcations.critical_boundary(ELinear(*abd)).branches
    np.testing.assert_allclose(np.hypot(*np.linalg.solve(A, branch.T)), 1.0, rtol=1e-9)
    for f in branch[::90]:
        counts = [len(critical_sets(ELinear(*abd, tuple(f * r)), psi.constant())) for r in (1 - 1e-7, 1 + 1e-7)]
        assert counts == [1, 0]


@given(matrices)
def test_the_reach_of_the_borders_is_their_largest_coordinate(abd):
    lines = [*saddle_node_lines(abd), *critical_lines(abd)]
    largest = max(float(np.abs(line).max()) for line in lines) or 1.0
    assert border_reach(abd) == pytest.approx(largest, rel=1e-4)  # of lines that turn by a degree a step
