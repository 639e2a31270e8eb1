"""Nullclines of general systems: on the curve, complete, unbroken, and ending on the equator's zeros."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings

from codim2_core import nullclines, psi
from codim2_core.portrait.layer_problem.equator_zeros import component_zeros
from codim2_core.portrait.nullcline.general_nullclines import ALL_POINTS, MOST_POINTS, inside_curves
from codim2_core.systems.typed import System
from tests.core.general_systems import ATTRACTING, NONUNIQUE, circle, polynomials
from tests.work import calls

KINDS = ("rho", "theta", "U1", "U2")
ONE = psi.constant()


def parts(at, e):
    U = at.U(e)
    return {
        "rho": (U * e).sum(axis=-1),
        "theta": e[..., 0] * U[..., 1] - e[..., 1] * U[..., 0],
        "U1": U[..., 0],
        "U2": U[..., 1],
    }


def gradient(at, kind, e, h=1e-6):
    steps = [(parts(at, e + h * u)[kind] - parts(at, e - h * u)[kind]) / (2 * h) for u in np.eye(2)]
    return np.hypot(*steps)


def branches(at, kind):
    return [curve for found, curve in inside_curves(at) if found == kind]


@given(polynomials)
@settings(max_examples=8)
def test_every_traced_point_lies_on_its_curve(system):
    at = system.at()
    for kind, curve in inside_curves(at):
        values = parts(at, curve.points)[kind]
        firm = gradient(at, kind, curve.points) > 1e-3 * at.size
        np.testing.assert_allclose(values[firm], 0.0, atol=1e-12 * at.size)
        # at a crossing a point 1e-5 away would have a value of 1e-10
        np.testing.assert_allclose(values, 0.0, atol=1e-10 * at.size)
        assert (np.hypot(*curve.points.T) <= 1 + 1e-12).all()
        between = curve(np.linspace(0, 1, 5 * len(curve.points)))
        slope = gradient(at, kind, between)
        firm = slope > 0.1 * at.size  # near a crossing a value says little about the distance
        np.testing.assert_allclose(parts(at, between)[kind][firm] / slope[firm], 0.0, atol=1e-5)


@given(polynomials)
@settings(max_examples=10)
def test_no_sign_change_is_missing(system):
    at = system.at()
    assume(at.size > 0)
    curves = inside_curves(at)
    for r in (0.35, 0.8):
        _, e = circle(3000, r)
        for kind, values in parts(at, e).items():
            slope = gradient(at, kind, e)
            at_change = np.flatnonzero((values > 0) != (np.roll(values, -1) > 0))
            drawn = [c(np.linspace(0, 1, 40 * len(c.points))) for found, c in curves if found == kind]
            for i in at_change:
                if np.abs(values).max() < 1e-9 * at.size or slope[i] < 0.1 * at.size:
                    continue
                assert min(np.hypot(*(points - e[i]).T).min() for points in drawn) < 0.01


@given(polynomials)
@settings(max_examples=20)
def test_ends_are_the_zeros_on_the_equator(system):
    at = system.at()
    assume(at.size > 0)
    for kind in KINDS:
        angles, multiplicity = component_zeros(at.key, kind)
        assume((multiplicity == 1).all())
        slopes = [gradient(at, kind, np.array([math.cos(t), math.sin(t)])) for t in angles]
        assume(min(slopes, default=1.0) > 1e-2 * at.size)
        curves = branches(at, kind)
        ends = [p for c in curves for p in (c.points[0], c.points[-1]) if abs(np.hypot(*p) - 1) < 1e-9]
        exact = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        for u in exact:
            assert sum(bool((p == u).all()) for p in ends) == 1
        assert len(ends) == len(exact)


def test_attracting_and_repelling_directions():
    """Theta = s/2 (1 - 2c)(1 + 2c): the diameter and two lines, which cross nothing; U1 two lines; U2 the diameter."""
    found = inside_curves(ATTRACTING.at(0.1))
    lines = {kind: sorted(float(c.points[0, 0]) for k, c in found if k == kind) for kind in ("theta", "U1")}
    assert lines["theta"] == pytest.approx([-0.5, 0.5, 1.0], abs=1e-12)
    assert lines["U1"] == pytest.approx([(1 - math.sqrt(5)) / 4, (1 + math.sqrt(5)) / 4], abs=1e-12)
    for kind, curve in found:
        if kind in ("U1", "U2"):
            assert curve.straight
    assert [len(branches(ATTRACTING.at(0.1), kind)) for kind in KINDS] == [2, 3, 2, 1]


def test_curves_go_straight_on_through_crossings():
    """sec:nonunique: Theta = s c (...), lines that cross at right angles at the origin and elsewhere."""
    at = NONUNIQUE.at(0.3)
    curves = branches(at, "theta")
    diameters = [c for c in curves if c.straight and np.hypot(*(c.points[0] - c.points[-1])) == pytest.approx(2.0)]
    assert len(diameters) == 2
    assert len(curves) == 4
    (lemniscate,) = branches(at, "rho")
    np.testing.assert_array_equal(lemniscate.points[0], lemniscate.points[-1])


@pytest.mark.parametrize("angle", [2.0, 0.3, 0.05, 0.01])
@pytest.mark.parametrize("place", [(0.0, 0.0), (0.31, -0.27), (0.5, 0.862)])
def test_lines_that_cross_at_any_angle_stay_straight(angle, place):
    """U1 = product of two lines through one point: two chords, whole."""
    p, q = place
    lines = [f"({math.sin(t)!r}*(c - ({p})) - {math.cos(t)!r}*(s - ({q})))" for t in (0.4, 0.4 + angle)]
    found = branches(System(U=("*".join(lines), "s - 2")).at(), "U1")
    assert len(found) == 2
    for curve in found:
        along = (curve.points[-1] - curve.points[0]) / np.hypot(*(curve.points[-1] - curve.points[0]))
        np.testing.assert_allclose(np.hypot(*curve.points[[0, -1]].T), 1.0, rtol=0.0, atol=1e-12)
        away = (curve.points - curve.points[0]) @ [along[1], -along[0]]
        np.testing.assert_allclose(away, 0.0, atol=1e-11 / angle)


@pytest.mark.parametrize("gap", [1e-2, 1e-3, 3e-4, -3e-4, -1e-2])
def test_hyperbolas_keep_to_their_side(gap):
    """U1 = (c - s) (c + s) - gap**2, with 2 |gap| between its two branches."""
    found = branches(System(U=(f"(c - s)*(c + s) - {gap * abs(gap)!r}", "s - 2")).at(), "U1")
    assert len(found) == 2
    for curve in found:
        along = curve.points[:, 0 if gap > 0 else 1]
        assert (along > 0).all() or (along < 0).all()
        assert abs(along).min() == pytest.approx(abs(gap), rel=0.05)


def test_a_figure_of_eight_is_one_loop():
    """Bernoulli's lemniscate, away from the middle; its crossing is at (0.2, 0.1)."""
    x, y = "(c - 0.2)", "(s - 0.1)"
    (loop,) = branches(System(U=(f"({x}**2 + {y}**2)**2 - 0.3*({x}**2 - {y}**2)", "s - 2")).at(), "U1")
    np.testing.assert_array_equal(loop.points[0], loop.points[-1])
    length = np.hypot(*np.diff(loop.points, axis=0).T).sum()
    assert length == pytest.approx(5.2441 * math.sqrt(0.3), rel=0.01)


def test_outside_curves_where_the_field_reads_the_position():
    """U1 = c + 0.3 - 1.5 r with r = |(x, y)|: a curve outside; U2 = s - 0.2 a ray; theta and rho likewise."""
    at = System(U=("c + 0.3 - 1.5*sqrt(x**2 + y**2)", "s - 0.2 + x*y/4")).at()
    seen = set()
    for branch in nullclines(at, psi.rational(), view=2.0):
        if branch.inside:
            continue
        seen.add(branch.kind)
        r = np.hypot(*branch.points.T)
        assert (r >= 1 - 1e-12).all()
        assert (r <= 2 * math.sqrt(2) + 1e-9).all()
        e = branch.points / r[:, None]
        U = at.U(e, (r - 1)[:, None] * e)
        values = {"rho": (U * e).sum(1), "theta": e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0], "U1": U[:, 0], "U2": U[:, 1]}
        np.testing.assert_allclose(values[branch.kind], 0.0, atol=1e-6)
    assert seen == set(KINDS)


@pytest.mark.parametrize("U", [("-x", "-y"), ("x*(2 + c)", "y*(2 + c)"), ("-c*x^2 - c*y^2", "-s*(x^2 + y^2)")])
def test_a_component_that_is_rounding_only_has_no_nullcline_where_u_vanishes_on_sigma(U):
    """U is 0 on Sigma: what is small outside is measured by U there. theta' = 0 everywhere."""
    drawn = nullclines(System(U=U), ONE)
    assert not any(branch.kind == "theta" for branch in drawn)
    assert any(branch.kind == "U1" for branch in drawn)


@pytest.mark.parametrize(
    "U", [("sin(90*c)*cos(70*s)", "cos(80*s*c) - sin(60*c)"), ("abs(abs(c) - 0.5)", "abs(s)"), ("c**2", "(c - s)**2")]
)
def test_wild_fields_end_in_bounded_work(U):
    at = System(U=U).at()
    curves = inside_curves(at)
    assert sum(len(curve.points) for _, curve in curves) <= 4 * (ALL_POINTS + 2 * MOST_POINTS)
    assert calls(lambda: inside_curves(at)) < 800_000


def test_a_component_that_vanishes_has_no_nullcline():
    at = System(U=("-3*c*(1 + s)", "-3*s*(1 + s)")).at()
    assert branches(at, "theta") == []
    assert nullclines(System(U=("0", "0")), psi.constant()) == ()
