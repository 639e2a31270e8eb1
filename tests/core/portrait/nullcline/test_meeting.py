"""The hyperbola and the unit circle of fig:intersections, against their equations."""

import math

import numpy as np
import pytest
from hypothesis import example, given

import codim2_core as c2
from codim2_core.portrait.layer_problem.problem import LayerProblem
from codim2_core.portrait.nullcline.conics import conics_of
from tests.core.strategies import systems

VIEW = 2.0


def conic(system, z=()):
    return conics_of(LayerProblem(system.at(z), c2.psi.constant()), VIEW)


def theta_form(at, x, y):
    """eq:conic11, and its gradient."""
    q = at.d - at.a
    return q * x * y + at.f2 * x - at.f1 * y + at.b, np.stack([q * y + at.f2, q * x - at.f1], axis=-1)


@given(systems)
@example(c2.ELinear(-1.0, 0.5, -2.0, (0.5, -1.0)))  # b (d - a) + f1 f2 = 0: it falls apart into two lines
@example(c2.ELinear(-1.0, 0.0, -1.0, (1.1, 0.0)))  # a = d: a straight line
@example(c2.ELinear(-1.0, 0.3, -1.0 - 1e-9, (1.0, 0.4)))  # its centre is far away
@example(c2.ELinear(0.0, 1.0, 6.1e-05, (0.0, 1.0)))  # its centre is 16 000 away, and the border is met exactly
def test_every_drawn_point_is_on_the_conic_and_the_chords_stay_next_to_it(system):
    found, at = conic(system), system.at()
    for piece in found.pieces:
        assert np.abs(piece).max() <= VIEW * (1.0 + 1e-12)
        for points, allowed in ((piece, 1e-5), (0.5 * (piece[1:] + piece[:-1]), 1e-3)):
            value, gradient = theta_form(at, *points.T)
            slope = np.hypot(*gradient.T)
            far = slope > 1e-4 * at.size  # at the crossing of two lines the distance is no quotient
            assert (np.abs(value[far]) / slope[far] <= VIEW * allowed).all()


@given(systems)
def test_the_meeting_points_are_on_both_conics_and_are_the_limit_directions(system):
    found, at = conic(system), system.at()
    theta = c2.equator_equilibria(system).theta
    np.testing.assert_allclose(np.hypot(*found.meeting.T), 1.0, rtol=0.0, atol=1e-15)
    value, gradient = theta_form(at, *found.meeting.T)
    np.testing.assert_allclose(np.arctan2(*found.meeting.T[::-1]) % (2 * math.pi), theta, rtol=0.0, atol=1e-14)
    assert (np.abs(value) <= 1e-12 * at.size + 1e-7 * np.hypot(*gradient.T)).all()


@pytest.mark.parametrize(("name", "count"), [("conics-0", 0), ("conics-2", 2), ("conics-4", 4)])
def test_the_figures_have_a_hyperbola_of_two_branches(name, count):
    found = conic(c2.presets[name].system)
    assert (found.kind, len(found.pieces), len(found.meeting)) == ("hyperbola", 2, count)


@pytest.mark.parametrize(
    ("values", "kind", "pieces"),
    [
        ((-1.0, 0.0, -1.0, (0.0, 0.0)), "plane", 0),
        ((-1.0, 1.0, -1.0, (0.0, 0.0)), "none", 0),
        ((-1.0, 0.0, -1.0, (1.1, 0.0)), "line", 1),
        ((-1.0, 0.0, -1.5, (-0.5, 0.0)), "two lines", 2),
        ((-1.0, 1e6, -1.5, (0.0, 0.0)), "hyperbola", 0),  # all of it lies beyond the view
    ],
)
def test_degenerate_conics_have_names(values, kind, pieces):
    found = conic(c2.ELinear(*values))
    assert (found.kind, len(found.pieces)) == (kind, pieces)


def test_a_typed_system_has_the_conic_of_its_normal_form_turned_back():
    # A is turned by 0.4 against the normal form of a = -1, b = 0.2, d = -2
    turn = np.array([[math.cos(0.4), -math.sin(0.4)], [math.sin(0.4), math.cos(0.4)]])
    A, f = turn @ np.array([[-1.0, -0.2], [0.2, -2.0]]) @ turn.T, turn @ np.array([0.2, 0.1])
    U = tuple(f"({float(r[0])!r})*c + ({float(r[1])!r})*s + ({float(k)!r})" for r, k in zip(A, f, strict=True))
    found, plain = conic(c2.System(U=U)), conic(c2.ELinear(-1.0, 0.2, -2.0, (0.2, 0.1)))
    points = np.concatenate(found.pieces) @ turn
    value, gradient = theta_form(c2.ELinear(-1.0, 0.2, -2.0, (0.2, 0.1)).at(), *points.T)
    assert (np.abs(value) <= 1e-9 * np.hypot(*gradient.T)).all()
    assert found.kind == plain.kind
    assert len(found.meeting) == 4
