"""Filippov candidates against closed forms and a blunt linear programme over many directions."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.portrait.sliding.filippov import filippov_sliding

numbers = st.floats(-2.0, 2.0).map(lambda v: round(v, 3))


@pytest.mark.parametrize("z", [0.0, 0.3, 0.7, 0.84, -1.3])
def test_nonunique_sliding_has_the_flows_of_c1_and_c3_as_its_extremes(z):
    """On the circle U = (phi(c), -s/2) with the cubic phi: the hull of (c, phi) meets phi = 0 in |c| <= chi/2."""
    chi = (1.0 + 2.0 * z * z) / (1.0 + z * z)
    found = filippov_sliding(c2.examples.nonunique_sliding(), z)
    assert not found.unique
    assert sorted(found.vertices.ravel()) == pytest.approx([0.25 - chi, 0.25 + chi], abs=1e-12)


@settings(max_examples=20)
@given(numbers, numbers, numbers, numbers, numbers)
def test_e_linear_systems_have_a_candidate_iff_they_have_a_critical_set(a, b, d, f1, f2):
    det = a * d + b * b
    n = math.hypot(d * f1 + b * f2, a * f2 - b * f1)
    if abs(n - abs(det)) < 1e-3 * (1.0 + abs(det)) or abs(det) < 1e-2:
        return  # on the border it is a matter of rounding
    system = c2.ELinear(a, b, d, (f1, f2), B=((1.0, -0.5),), g=(0.25,))
    found = filippov_sliding(system, (0.0,))
    flow = c2.sliding_flow(system, (0.0,))
    assert (len(found) == 1) == (flow is not None)
    if flow is not None:
        assert found.vertices[0, 0] == pytest.approx(flow[0], abs=1e-9)


@pytest.mark.parametrize("square", ["c^2", "2*c^2"])
def test_a_set_that_only_touches_the_hull_is_a_result_and_no_error(square):
    """U2 is nowhere negative and vanishes where c = 0: only combinations of these two directions are tangent."""
    found = filippov_sliding(c2.System(U=("0.5*c*s", square), W=("s",)), 0.0)
    assert len(found) in (0, 1, 2)
    if len(found):
        assert np.abs(found.vertices).max() <= 1.0
    else:
        assert "touches" in found.sentence or "No convex combination" in found.sentence


@pytest.mark.parametrize("turn", [0.0, 0.4, math.pi / 2, 2.5])
@pytest.mark.parametrize("slope", [(0.0, 0.0), (5.0, -3.0)])
def test_extremes_have_all_digits_and_their_directions(turn, slope):
    """U = e and W = cos 2(theta - turn) + slope.e: a mean of e that is 0 leaves the slope no say, so the ends are 1
    and -1, each of one pair of opposite directions with equal weights."""
    cosine, sine = math.cos(2.0 * turn), math.sin(2.0 * turn)
    W = f"{cosine!r}*(c**2 - s**2) + {2.0 * sine!r}*c*s + {slope[0]}*c + {slope[1]}*s"
    found = filippov_sliding(c2.System(U=("c", "s"), W=(W,)), 0.0)
    assert sorted(found.vertices.ravel()) == pytest.approx([-1.0, 1.0], abs=1e-14)
    for vertex, directions, weights in zip(found.vertices, found.directions, found.weights, strict=True):
        first = turn if vertex[0] > 0.0 else turn + math.pi / 2
        expected = sorted([first % math.pi, first % math.pi + math.pi])
        away = (np.sort(directions % (2.0 * math.pi)) - expected + 1.0) % math.pi - 1.0  # 0 and pi are neighbours here
        np.testing.assert_allclose(away, 0.0, atol=1e-10)
        np.testing.assert_allclose(weights, 0.5, rtol=0.0, atol=1e-12)
        combined = weights @ np.stack([np.cos(directions), np.sin(directions)], axis=-1)
        np.testing.assert_allclose(combined, 0.0, atol=1e-14)


def test_the_polygon_of_a_disc_touches_it_all_round():
    """U = e and W = (cos 2 theta, sin 2 theta): opposite pairs give all of the unit circle, so W fills the disc."""
    found = filippov_sliding(c2.System(U=("c", "s"), W=("c**2 - s**2", "2*c*s")), (0.0, 0.0))
    np.testing.assert_allclose(np.hypot(*found.vertices.T), 1.0, rtol=0.0, atol=1e-12)
    angles = np.arctan2(*found.vertices.T[::-1])
    steps = np.diff(np.unwrap(np.append(angles, angles[0])))
    assert ((steps > 0.0) & (steps < 0.25)).all()  # counter-clockwise, once round
    assert steps.sum() == pytest.approx(2.0 * math.pi)
    assert "not unique" in found.sentence


def test_three_slow_variables_have_the_extremes_along_their_axes():
    system = c2.System(U=("c", "s"), W=("c**2 - s**2 + z3", "2*c*s", "c - 1/4"))
    found = filippov_sliding(system, (0.0, 0.0, 0.5))
    ends = {tuple(float(v) for v in vertex.round(9) + 0.0) for vertex in found.vertices}
    assert {(1.5, 0.0, -0.25), (-0.5, 0.0, -0.25), (0.5, 1.0, -0.25), (0.5, -1.0, -0.25)} <= ends
    np.testing.assert_allclose(found.vertices[:, 2], -0.25, rtol=0.0, atol=1e-12)


def test_a_point_is_one_candidate_in_any_number_of_slow_variables():
    for m in range(4):
        system = c2.System(U=("c - 1/5", "s/100"), W=("2*c + s/7",) * m)
        found = filippov_sliding(system, (0.0,) * m)
        assert found.unique
        assert "is unique" in found.sentence
        np.testing.assert_allclose(found.vertices, np.full((1, m), 0.4), rtol=0.0, atol=1e-12)
        (theta,), (weight,) = found.directions, found.weights
        assert weight.sum() == pytest.approx(1.0, abs=1e-12)
        np.testing.assert_allclose(
            weight @ np.stack([np.cos(theta), np.sin(theta)], -1), [0.2, 0.0], rtol=0.0, atol=1e-12
        )
        none = filippov_sliding(c2.System(U=("c - 6/5", "s/100"), W=("2*c",) * m), (0.0,) * m)
        assert (len(none), none.vertices.shape, none.unique) == (0, (0, m), False)
        assert "crossing" in none.sentence


def facing(theta, U, slope, level):
    """Text of a W whose W + slope.U touches `level` from below in just these directions, and the weights there.

    U is a matrix (2, 2): U(e) = U e. The product of all 1 - cos(. - theta_i) vanishes there, and is positive elsewhere.
    """
    below = "*".join(f"(1 - c*({math.cos(t)!r}) - s*({math.sin(t)!r}))" for t in theta)
    first, second = (np.asarray(slope) @ U).tolist()
    rows = np.vstack([np.cos(theta), np.sin(theta), np.ones(len(theta))])
    return f"{level!r} - ({first!r})*c - ({second!r})*s - {below}", np.linalg.solve(rows, [0.0, 0.0, 1.0])


LINEAR = np.array([[3.0, -1.0], [0.5, 2.0]])
TRIANGLE = np.array([0.5, 2.2, 4.6])


def typed(theta, slope=(0.3, -0.7), level=1.2):
    W, weights = facing(theta, LINEAR, slope, level)
    U = tuple(f"({row[0]!r})*c + ({row[1]!r})*s" for row in LINEAR.tolist())
    return c2.System(U=U, W=(W,)), weights


@pytest.mark.parametrize("turn", [0.0, 1.3, -0.5, 2.0 * math.pi - 4.6])
def test_an_extreme_of_three_directions_has_all_its_digits(turn):
    """W + slope.U touches its level in three known directions, whose triangle holds 0: the mean of W is that level."""
    system, weights = typed(TRIANGLE + turn)
    found = filippov_sliding(system, 0.0)
    i = int(np.argmax(found.vertices[:, 0]))
    assert found.vertices[i, 0] == pytest.approx(1.2, abs=1e-13)
    order = np.argsort((TRIANGLE + turn) % (2.0 * math.pi))
    away = np.exp(1j * found.directions[i]) - np.exp(1j * (TRIANGLE + turn))[order]
    if abs(turn) + 4.6 != 2.0 * math.pi:  # there, one direction is 0 or 2 pi
        np.testing.assert_allclose(away, 0.0, atol=1e-10)
        np.testing.assert_allclose(found.weights[i], weights[order], rtol=0.0, atol=1e-12)
    assert found.weights[i].sum() == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("gap", [1e-3, 1e-6])
def test_a_hull_that_holds_zero_by_little_is_found_between_the_first_directions(gap):
    """U = e - (1 - gap) e(phi): only the directions within sqrt(2 gap) of phi reach beyond 0, on either side."""
    phi = 0.0654  # between two of the 48
    shift = [(1.0 - gap) * v for v in (math.cos(phi), math.sin(phi))]
    found = filippov_sliding(c2.System(U=(f"c - {shift[0]!r}", f"s - {shift[1]!r}"), W=("2*c - s",)), 0.0)
    assert found.unique
    np.testing.assert_allclose(found.vertices, [[2.0 * shift[0] - shift[1]]], rtol=0.0, atol=1e-9)
    outside = [(1.0 + gap) * v for v in (math.cos(phi), math.sin(phi))]
    none = filippov_sliding(c2.System(U=(f"c - {outside[0]!r}", f"s - {outside[1]!r}"), W=("2*c - s",)), 0.0)
    assert len(none) == 0
    assert "crossing" in none.sentence


@pytest.mark.parametrize("factor", [1e-6, 3.0, 1e5])
def test_the_unit_of_time_changes_the_flow_and_neither_directions_nor_weights(factor):
    """(U, W) times a factor: the same combinations, and none where there was none."""
    plain, _ = typed(TRIANGLE)
    scaled = c2.System(U=tuple(f"{factor!r}*({row.text})" for row in plain.U), W=(f"{factor!r}*({plain.W[0].text})",))
    one, other = filippov_sliding(plain, 0.0), filippov_sliding(scaled, 0.0)
    np.testing.assert_allclose(other.vertices, factor * one.vertices, rtol=1e-12)
    for a, b in zip((*one.directions, *one.weights), (*other.directions, *other.weights), strict=True):
        np.testing.assert_allclose(np.sort(np.cos(b)), np.sort(np.cos(a)), rtol=0.0, atol=1e-9)
    for U in (("c - 6/5", "s/100"), ("c - 1001/1000", "s"), ("c/2", "s - 1.01 + c/9")):
        none = filippov_sliding(c2.System(U=tuple(f"{factor!r}*({u})" for u in U), W=(f"{factor!r}*c",)), 0.0)
        assert (len(none), none.sentence) == (0, filippov_sliding(c2.System(U=U, W=("c",)), 0.0).sentence)
        assert "crossing" in none.sentence
