"""Along which steps a slide goes on, and where it ends at the equator."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.kernels import ends, slow

from .placing import MOVES, placed

EDGE = math.sqrt(1.0 - 0.09)


@pytest.mark.parametrize("seed", range(6))
def test_a_step_of_a_slide_ends_where_its_set_leaves_the_disc(seed):
    """C = (z1, 0.3), and z1 any cubic of the part of the step."""
    S, rng = placed(MOVES, (0.0, 0.0)), np.random.default_rng(seed)
    values, unsure = np.empty((ends.GAUGES, 5)), 0
    for _ in range(6):
        start, coefficients = rng.uniform(-0.9, 0.9), rng.normal(size=3) * 0.6
        polynomial = np.zeros((4, 7))
        polynomial[2, :3] = polynomial[0, :3] = coefficients
        what, u = ends.step_end(S, np.array([start, 0.3, start, 0.1]), polynomial, 1.0, 0.0, 0.0, values)
        net = np.linspace(0.0, 1.0, 2001)
        along = start + coefficients @ net ** np.arange(1, 4)[:, None]
        out = np.abs(along) >= EDGE
        unsure += what == ends.UNSURE
        if what == ends.SAFE:
            assert not out.any()
            assert u == 1.0
            assert S[slow.PLACE] == pytest.approx(along[-1], abs=1e-9)
        elif what == ends.EQUATOR:
            first = net[out.argmax()]
            assert first - 6e-4 < u <= first + 1e-12
            assert abs(S[slow.PLACE]) == pytest.approx(EDGE, abs=1e-9)
            assert abs(start + coefficients @ u ** np.arange(1, 4)) == pytest.approx(EDGE, abs=1e-12)
            np.testing.assert_allclose(S[slow.PLACE + 1 : slow.PLACE + 4], [0.3, 0.0, 0.0], atol=1e-12)
    assert unsure <= 1


@pytest.mark.parametrize(
    ("U", "c", "low", "high", "n"),
    [
        (("z1 - c**2", "-s"), 0.5, 0.25, -0.1, (0.0, 0.0)),  # a fold, det = 2 c
        (("z1 - c**2", "-s"), 0.5, 0.25, -0.1, (1.0, 0.0)),  # the same in a line
        (("-c*z1 - 3*s", "3*c - s*z1"), 0.0, 0.3, -0.1, (0.0, 0.0)),  # a focus whose trace turns positive
        (("-(c - 0.3)*z1", "-s*z1**2"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # along C alone: the trace stays negative first
        (("-(c - 0.3)", "-s*z1"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # across C alone
        (("-(c - 0.3) - 3*s", "3*(c - 0.3) - 0.4*s*z1"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # the same of a focus
        (("-0.4*(c - 0.3)*z1 - 3*s", "3*(c - 0.3) - s"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # along C, of a focus
        (("-(c - 0.3) + (0.6 - z1)*s", "2*(c - 0.3) - s"), 0.3, 0.3, -0.1, (0.0, 0.0)),  # a saddle, where D12 D21 = 1
        (  # along an oblique line
            (
                "-0.6*z1*(0.6*(c - 0.3) + 0.8*s) + 0.8*(0.6*s - 0.8*(c - 0.3))",
                "-0.8*z1*(0.6*(c - 0.3) + 0.8*s) - 0.6*(0.6*s - 0.8*(c - 0.3))",
            ),
            0.3,
            0.3,
            -0.1,
            (0.6, 0.8),
        ),
    ],
)
def test_a_step_along_which_a_set_may_end_otherwise_is_not_sure(U, c, low, high, n):
    system = System(U=U, W=("1",))
    S, values, polynomial = placed(system, (0.0,)), np.empty((ends.GAUGES, 5)), np.zeros((3, 7))
    for end, what in ((0.8 * low, ends.SAFE), (high, ends.UNSURE)):
        polynomial[2, 0] = end - low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, 1.0, *n, values)[0] == what
    if n == (0.0, 0.0):
        polynomial[2, 0] = -0.2 * low
        assert ends.step_end(S, np.array([c, 0.0, low]), polynomial, -1.0, *n, values)[0] == ends.UNSURE


def _with_set(e, D):
    """A workspace in which a set e with the slopes D was found, for one slow variable."""
    S = np.zeros(slow.EXTENT)
    S[slow.PLACE : slow.PLACE + 2] = e
    S[slow.TABLE : slow.TABLE + 2], S[slow.TABLE + 5 : slow.TABLE + 7] = D[0], D[1]
    return S


@pytest.mark.parametrize("e", [(0.3, -0.4), (0.0, 0.0), (-1.2, 0.5)])
def test_what_turns_negative_where_a_slide_ends(e):
    """1 - |e|^2; det D_e U by its sign; -n.D n along C and across it; in a line -n.D n."""
    D = np.array([[-1.3, 0.7], [0.4, -2.1]])
    S, values = _with_set(e, D), np.full((ends.GAUGES, 5), math.nan)
    r = math.hypot(*e)
    along = np.array(e) / r if r > 0.0 else np.array([1.0, 0.0])
    across = np.array([-along[1], along[0]])
    assert ends.determinant(S, 3) == pytest.approx(np.linalg.det(D), rel=1e-14)
    ends._write_gauges(S, 3, -1.0, 0.0, 0.0, values, 2)
    expected = [1.0 - r * r, -np.linalg.det(D), -along @ D @ along, -across @ D @ across]
    np.testing.assert_allclose(values[:, 2], expected, rtol=1e-13)
    n = np.array([0.6, -0.8])
    for sign in (-1.0, 1.0):
        ends._write_gauges(S, 3, sign, *n, values, 4)
        np.testing.assert_allclose(values[:, 4], [1.0 - r * r, -n @ D @ n, 1.0, 1.0], rtol=1e-13)
    assert np.isnan(values[:, [0, 1, 3]]).all()


def test_five_values_are_a_polynomial_and_what_it_leaves_out():
    """Of T_0 ... T_4 on the step; eight times its last two coefficients are left out, about."""
    coefficients, found = np.array([2.0, -0.7, 0.4, -0.05, 0.02]), np.empty(5)
    at = 0.5 - 0.5 * np.cos(0.25 * math.pi * np.arange(5))
    values = np.polynomial.chebyshev.chebval(2.0 * at - 1.0, coefficients)
    assert ends._bounds(values, found) == pytest.approx(8.0 * 0.07, rel=1e-12)
    np.testing.assert_allclose(found, coefficients, atol=1e-14)


@pytest.mark.parametrize("u", [0.0, 0.3, 1.0])
def test_the_set_is_found_at_a_fraction_of_a_step(u):
    polynomial = np.random.default_rng(8).normal(size=(4, 7)) * 0.1
    S, first = placed(MOVES, (0.0, 0.0)), np.array([0.1, 0.25, 0.2, 3.0])
    assert ends.set_on_step(S, first, polynomial, u)
    there = first + polynomial @ u ** np.arange(1, 8)
    np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 6], [there[2], 0.3, 0.0, 0.0, *there[2:]], atol=1e-14)
    polynomial[0, 0] = 9.0  # e is so far off that there is none
    assert bool(ends.set_on_step(S, first, polynomial, u)) is (u == 0.0)


@pytest.mark.parametrize(
    ("low", "high", "terms"),
    [
        (0.0, 1.0, (0.9, 0.0)),
        (0.25, 0.75, (1.5, -0.2)),
        (0.0, 1.0, (0.5, 3.0)),
        (0.5, 1.0, (1e-3, 1.1)),
        (0.0, 1.0, (0.01, 900.0)),  # steep at its end alone: halved first
    ],
)
def test_the_zero_on_a_step_has_all_its_digits(low, high, terms):
    """z1 = 0.2 + a u + b u^2 is sqrt(0.91)."""
    polynomial = np.zeros((4, 7))
    polynomial[2, :2] = polynomial[0, :2] = terms
    S, first = placed(MOVES, (0.0, 0.0)), np.array([0.2, 0.3, 0.2, 0.0])

    def gap(u):
        z1 = 0.2 + terms[0] * u + terms[1] * u * u
        return 1.0 - 0.09 - z1 * z1

    exact = min((root.real for root in np.roots([terms[1], terms[0], 0.2 - EDGE]) if root.real > 0.0), default=math.nan)
    assert gap(low) > 0.0 > gap(high)
    found = ends._zero(S, first, polynomial, low, high, gap(low), gap(high))
    assert found == pytest.approx(exact, abs=3e-15)
    lost = System(U=("z1 - c**2", "-s"))  # no set beyond a fold
    S, polynomial = placed(lost, (0.0,)), np.zeros((3, 7))
    polynomial[2, 0] = -1.0
    assert math.isnan(ends._zero(S, np.array([0.3, 0.0, 0.09]), polynomial, 0.0, 1.0, 1.0, -1.0))


def test_a_part_of_a_step_is_told_of_by_itself():
    """z1 goes from 0 to 1.2: safe up to where |C| nears 1, then it ends."""
    S, values, found = placed(MOVES, (0.0, 0.0)), np.empty((ends.GAUGES, 5)), np.empty(5)
    polynomial, first = np.zeros((4, 7)), np.array([0.0, 0.3, 0.0, 0.0])
    polynomial[2, 0] = polynomial[0, 0] = 1.2

    def told(low, high, sign=1.0):
        return ends._part_end(S, first, polynomial, low, high, sign, 0.0, 0.0, values, found)

    assert told(0.0, 0.5) == (ends.SAFE, 0.5)
    assert told(0.25, 0.5) == (ends.SAFE, 0.5)
    what, u = told(0.75, 1.0)
    assert what == ends.EQUATOR
    assert u == pytest.approx(EDGE / 1.2, abs=1e-14)
    assert told(0.75, 0.999 * EDGE / 1.2) == (ends.SAFE, 0.999 * EDGE / 1.2)  # it falls, and is positive at its end
    assert told(0.85, 1.0)[0] == ends.UNSURE  # it has ended before
    assert told(0.0, 0.5, -1.0)[0] == ends.UNSURE
