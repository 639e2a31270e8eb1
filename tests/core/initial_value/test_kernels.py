"""The compiled parts of motions one by one, against the same in Python and against what is known on paper.

As Python, too, each takes little time: `tests.mutation` runs them so.
"""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

from codim2_core import System, critical_sets
from codim2_core import psi as families
from codim2_core.initial_value import leaving
from codim2_core.initial_value.compiled import functions_of, numbers_of_tableau
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import ends, explicit, radau, rate, slow
from codim2_core.initial_value.kernels.arrival import _captured, slides
from codim2_core.initial_value.kernels.leave import leave
from codim2_core.initial_value.kernels.motion import price
from codim2_core.initial_value.kernels.rate import Motion
from codim2_core.initial_value.kernels.stages import guess, tableau_of, workspace
from codim2_core.initial_value.line import InvariantLine
from codim2_core.initial_value.problem import plane_problem
from codim2_core.numerics.radau import tableau
from codim2_core.stepping.layout import PARAMETERS
from codim2_core.stepping.numbers import PSI

CURVED = System(
    U=("-2*c + 1.5*c*s + 2.4*sin(z1) + 0.3*x", "-s + 0.9*cos(z1) - 0.2*y*z2 + 0.4*c**2"),
    W=("1 + c*y - 0.3*s", "0.4*c - z2 + x*s"),
)
TANH, HILL = families.tanh(), families.hill(3)


def placed(system, z, psi=TANH):
    """The workspace that the kernels read, with z in place."""
    S, own = np.zeros(slow.EXTENT), functions_of(field(system), psi).addresses
    S[slow.VALUE : slow.SLOPES + 1] = own[:2].view(float)
    S[slow.SLOW] = len(z)
    S[slow.PLACE + 4 : slow.PLACE + 4 + len(z)] = z
    return S


def motion_of(system, psi, eps, rtol=1e-6, floor=0.01, line=(0.0, 0.0)):
    own = functions_of(field(system), psi).addresses.tolist()
    return Motion(*own, 2 + system.m, eps, rtol, floor, *line)


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
@pytest.mark.parametrize("line", [None, (0.6, -0.8)])
@pytest.mark.parametrize("eps", [0.3, 1e-4])
def test_rate_slopes_and_sizes_are_those_in_python(psi, line, eps):
    motion = motion_of(CURVED, psi, eps, line=line or (0.0, 0.0))
    problem = plane_problem(field(CURVED), psi, eps, 1e-6, 1e-8, line)
    work = workspace(4, psi.parameter)
    for y in np.random.default_rng(5).normal(size=(4, 4)) * ([eps, eps, 1.0, 1.0] if line is None else [1.0]):
        rate.rate(motion, y, work.S, work.rate)
        np.testing.assert_allclose(work.rate[:4], problem.F(y), rtol=1e-12, atol=1e-12)
        rate.sizes(motion, y, work.size)
        np.testing.assert_allclose(work.size[:4], [math.hypot(y[0], y[1], eps)] * 2 + [*(abs(y[2:]) + 0.01)])
        if line is None:
            rate.jacobian(motion, y, work.S, work.J)
            J = problem.J(y)
            np.testing.assert_allclose(work.J[:4, :4], J, rtol=1e-6, atol=1e-7 / eps)
            bound, reach = radau.linearised(motion, y, 1e3, np.zeros(4), work)
            assert bound == pytest.approx(problem.limit(y, problem.F(y), J), rel=1e-5)
            size = work.size[:4]
            assert reach == pytest.approx((abs(J) * size / size[:, None]).sum(axis=1).max(), rel=1e-5)


def test_in_contact_with_sigma_the_way_inward_bounds_no_step():
    """A straight fall, U = (-1, 0), through rho: 0.9 of the way, unless it is within 20 eps."""
    falls = System(U=("-1", "0*c"))
    motion, work = motion_of(falls, TANH, 1e-3), workspace(2, 0.0)
    outside, inside = (
        radau.linearised(motion, np.array([x, 0.0]), 1.0, np.zeros(4), work)[0] for x in (0.0201, 0.0199)
    )
    assert outside == pytest.approx(0.9 * (0.0201**2 + 1e-6) / 0.0201)
    assert inside == math.inf
    rising = radau.linearised(motion, np.array([-0.5, 0.0]), 1.0, np.zeros(4), work)[0]
    assert rising == math.inf


def test_an_implicit_step_costs_what_was_measured():
    assert [price(n) for n in (2, 4)] == [2.0, 5.0]


def test_a_guess_continues_the_last_polynomial():
    table = tableau_of(numbers_of_tableau())
    polynomial = np.array([[1.0, -0.5, 0.25, 0.1, 0.3], [2.0, 0.0, -1.0, 0.0, 0.5]])
    first, Z = np.array([0.3, -0.2]), np.empty((5, 2))
    y = first + polynomial.sum(axis=1)
    for ratio, goes in ((0.7, True), (1.9, True), (1e6, False)):
        assert bool(guess(table, polynomial, first, ratio, y, Z)) is goes
        u = 1.0 + ratio * tableau().nodes[:, None]
        expected = (polynomial[:, None] * u ** np.arange(1, 6)).sum(axis=-1).T + first - y
        np.testing.assert_allclose(Z, expected if goes else 0.0 * expected, atol=1e-12)


@pytest.mark.parametrize("line", [None, (0.8, 0.6)])
def test_one_explicit_step_solves_the_equations(line):
    """The motion inside a step, and its slope there; in a line it stays."""
    psi, h = TANH, 0.05
    motion = motion_of(CURVED, psi, 0.3, line=line or (0.0, 0.0))
    problem = plane_problem(field(CURVED), psi, 0.3, 1e-6, 1e-8, line)
    work, clock, y = workspace(4, psi.parameter), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    first, polynomial, end = y.copy(), np.empty((4, explicit.DEGREE)), np.empty(4)
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    accepted, change = explicit.attempt(motion, h, clock, work)
    assert accepted
    assert change > 1.0
    explicit.keep(motion, y, clock, work, polynomial, end)
    assert clock[3] == 15.0
    np.testing.assert_array_equal(y, end)
    np.testing.assert_allclose(first + polynomial.sum(axis=1), end, atol=1e-14)
    powers = np.arange(1, explicit.DEGREE + 1)
    for u in (0.0, 0.3, 0.6, 1.0):
        there, slope = first + polynomial @ u**powers, polynomial @ (powers * u ** (powers - 1)) / h
        np.testing.assert_allclose(slope, problem.F(there), atol=1e-7)
    if line is not None:
        assert abs(y[0] * 0.6 - y[1] * 0.8) < 1e-15
    explicit.go_on(motion, work)
    np.testing.assert_allclose(work.rate[:4], problem.F(y), rtol=1e-12)
    np.testing.assert_allclose(work.size[:4], [math.hypot(y[0], y[1], 0.3)] * 2 + [*(abs(y[2:]) + 0.01)])


def test_one_implicit_step_solves_the_equations():
    psi, h = TANH, 0.02
    motion, table = motion_of(CURVED, psi, 0.3, rtol=1e-8), tableau_of(numbers_of_tableau())
    problem = plane_problem(field(CURVED), psi, 0.3, 1e-8, 1e-10)
    work, clock, y = workspace(4, psi.parameter), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    first, polynomial, end = y.copy(), np.full((4, explicit.DEGREE), math.nan), np.empty(4)
    radau.linearised(motion, y, h, clock, work)
    accepted, change = radau.attempt(motion, table, y, h, 0.0, False, clock, work)
    assert accepted
    assert change > 1.0
    radau.keep(table, y, work, polynomial, end)
    np.testing.assert_array_equal(y, end)
    np.testing.assert_allclose(first + polynomial.sum(axis=1), end, atol=1e-14)
    assert not polynomial[:, 5:].any()
    for u in tableau().nodes:
        powers = np.arange(1, 6)
        slope = polynomial[:, :5] @ (powers * u ** (powers - 1)) / h
        np.testing.assert_allclose(slope, problem.F(first + polynomial[:, :5] @ u**powers), atol=3e-6)


@pytest.mark.parametrize("h", [40.0, 3.0])
def test_a_step_that_is_too_long_is_not_taken_and_made_shorter(h):
    motion, table = motion_of(CURVED, TANH, 0.01), tableau_of(numbers_of_tableau())
    work, clock, y = workspace(4, 0.0), np.zeros(4), np.array([0.4, 0.3, 0.7, -0.2])
    radau.linearised(motion, y, h, clock, work)
    accepted, change = radau.attempt(motion, table, y, h, 0.0, False, clock, work)
    assert not accepted
    assert change <= 0.8
    explicit.begin(motion, y, work)
    rate.sizes(motion, y, work.size)
    accepted, change = explicit.attempt(motion, h, clock, work)
    assert not accepted
    assert 0.1 < change <= 0.8


def test_stiff_is_what_a_step_that_long_would_be_for_stability_alone():
    """z' = -k z: a step of 0.05/k is not, one of 2/k is."""
    for k in (3.0, 3000.0):
        decays = System(U=(f"-{k}*x + 0*c", f"-{k}*y"))
        motion, work, y = motion_of(decays, TANH, 1.0), workspace(2, 0.0), np.array([0.4, 0.3])
        for part, is_stiff in ((0.05, False), (2.0, True)):
            explicit.begin(motion, y, work)
            rate.sizes(motion, y, work.size)
            explicit.attempt(motion, part / k, np.zeros(4), work)
            assert bool(explicit.stiff(motion, part / k, work)) is is_stiff


def _directions(system, z):
    """The zeros of Theta."""
    at = field(system)

    def theta_rate(t):
        u, v = at.value(math.cos(t), math.sin(t), 0.0, 0.0, *z)[:2]
        return math.cos(t) * v - math.sin(t) * u

    net = np.linspace(-math.pi, math.pi, 60)
    return [brentq(theta_rate, a, b, xtol=1e-15) for a, b in pairwise(net) if theta_rate(a) * theta_rate(b) < 0.0]


@pytest.mark.parametrize("ahead", [2.0, 1e6])  # so long that how fast it turns bounds the step
def test_the_first_step_away_is_that_in_python(ahead):
    told = set()
    for z in ((1.2, 0.4), (-1.0, 0.3), (2.5, -1.0)):
        for theta in _directions(CURVED, z):
            S, linear, square = placed(CURVED, z), np.full(4, math.nan), np.full(4, math.nan)
            own = leaving.leave(field(CURVED), theta + 1e-3, 0.0, np.array(z), ahead)
            h = leave(S, 2, 0.0, 0.0, theta + 1e-3, ahead, linear, square)
            told.add(isinstance(own, str))
            if isinstance(own, str):
                assert h == 0.0
                continue
            assert h == pytest.approx(own.h, rel=1e-9)
            np.testing.assert_allclose(linear, own.polynomial[:, 0], rtol=1e-8, atol=1e-24)
            np.testing.assert_allclose(square, own.polynomial[:, 1], rtol=1e-8, atol=1e-24)
    assert told == {False, True}


REACHED = System(  # e = (0.6, 0.8) is critical at z1 = 0, and moves out of the disc with z1
    U=("-(c - 0.6) + 0.5*(s - 0.8) + 1.3*z1", "-0.2*(c - 0.6) - 1.4*(s - 0.8) + 0.4*z1 + 0.1*z2"),
    W=("1.0 + 0.3*c", "0.7*s - 0.2*z1*c"),
)


@pytest.mark.parametrize("line", [False, True])
def test_the_first_step_away_from_where_a_set_reaches_the_equator_is_that_in_python(line):
    system, z, n = REACHED, np.zeros(2), (0.6, 0.8)
    if line:  # U along n only
        system = System(U=("0.6*(z1 - (0.6*c + 0.8*s) + 1)", "0.8*(z1 - (0.6*c + 0.8*s) + 1)"), W=("1.5 + 0.2*c", "-s"))
    S, linear, square = placed(system, z), np.full(4, math.nan), np.full(4, math.nan)
    own = leaving.leave(
        field(system), math.atan2(0.8, 0.6), 0.0, z, 3.0, InvariantLine(field(system), np.array(n)) if line else None
    )
    h = leave(S, 2, *(n if line else (0.0, 0.0)), math.atan2(0.8, 0.6), 3.0, linear, square)
    assert h == pytest.approx(own.h, rel=1e-6)
    assert square[:2].all()
    np.testing.assert_allclose(linear, own.polynomial[:, 0], rtol=1e-6, atol=1e-20)
    np.testing.assert_allclose(square, own.polynomial[:, 1], rtol=1e-5, atol=1e-20)
    other = leave(S, 2, *(n if line else (0.0, 0.0)), math.atan2(-0.8, -0.6), 3.0, linear, square)
    assert (other > 0.0) is not isinstance(
        leaving.leave(
            field(system), math.atan2(-0.8, -0.6), 0.0, z, 3.0,
            InvariantLine(field(system), np.array(n)) if line else None,
        ),
        str,
    )  # fmt: skip


MOVES = System(U=("-2*(c - z1) + 0.7*(s - 0.3)", "-0.9*(c - z1) - (s - 0.3)"), W=("1.0 + 0.5*c", "s - 2*z2 + 3*z1*c"))
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


def test_sets_near_points_and_their_slopes():
    own = functions_of(field(MOVES), TANH).addresses
    points = np.array([[0.1, 0.1, 0.4, 2.0], [-0.2, 0.5, -0.7, 1.0]])
    e, D = slow.sets(own[:2].view(float), points)
    np.testing.assert_allclose(e, [[0.4, 0.3], [-0.7, 0.3]], atol=1e-14)
    np.testing.assert_allclose(D, [[[-2.0, 0.7], [-0.9, -1.0]]] * 2, atol=1e-14)
    S = placed(MOVES, (0.4, 2.0))
    assert slow.found_set(S, 2)
    assert ends.determinant(S, 4) == pytest.approx(2.0 + 0.7 * 0.9, abs=1e-14)
    lost = System(U=("z1 - c**2", "-s"))
    e, _ = slow.sets(functions_of(field(lost), TANH).addresses[:2].view(float), np.array([[0.3, 0.0, -0.5]]))
    assert np.isnan(e).all()


def _slides(system, theta, psi=None, affine=False, line=(0.0, 0.0), z=()):
    S, P = placed(system, z, psi or TANH), np.zeros(PARAMETERS)
    P[PSI] = (psi or TANH).parameter
    gain = int(functions_of(field(system), psi or TANH).addresses[2])
    found = slides(S, P, gain, 2 + len(z), affine, psi is not None, *line, theta)
    return bool(found), (float(S[slow.PLACE]), float(S[slow.PLACE + 1]))


@pytest.mark.parametrize(
    ("C", "A", "expected"),
    [
        ((0.4, -0.2), (-1.0, 2.0, -0.5, -1.5), True),  # A + A^T negative definite
        ((0.9, -0.6), (-1.0, 2.0, -0.5, -1.5), False),  # outside
        ((0.4, -0.2), (-1.0, 2.6, 0.5, -1.5), False),  # A + A^T is not
        ((0.4, -0.2), (-2.0, 0.0, 0.0, -1e-7), False),  # hardly
        ((-0.3, 0.8), (-1.0, -3.0, 3.0, -0.2), True),  # round and round onto it: there is no direction
        ((0.4, -0.2), (-1.0, 0.6, -0.2, -1.5), True),
    ],
)
def test_what_arrives_slides_on_the_only_set(C, A, expected):
    a, b, c, d = A
    system = System(U=(f"{a}*(c - {C[0]}) + {b}*(s - {C[1]})", f"{c}*(c - {C[0]}) + {d}*(s - {C[1]})"))
    found, place = _slides(system, 0.3, affine=True)
    assert found is expected
    if expected:
        assert place == pytest.approx(C, abs=1e-14)


def test_what_arrives_slides_where_two_orbits_end():
    system = System(U=("-(c - 0.4) + 0.6*(s + 0.2)", "-0.2*(c - 0.4) - 1.5*(s + 0.2)"))
    theta = _attracting(system)
    found, place = _slides(system, theta, TANH)
    assert found
    assert place == pytest.approx((0.4, -0.2), abs=1e-9)
    assert _slides(system, theta + 0.1, TANH)[0]
    assert not _slides(system, theta + 0.5, TANH)[0]  # no direction is near
    assert not _slides(system, theta)[0]  # with no Psi known


def _attracting(system):
    for theta in _directions(system, ()):
        c, s = math.cos(theta), math.sin(theta)
        D = field(system).jacobian(c, s, 0.0, 0.0, ())[:2, :2]
        u, v = field(system).value(c, s, 0.0, 0.0)[:2]
        if c * u + s * v < 0.0 and -s * (D[0] @ [-s, c]) + c * (D[1] @ [-s, c]) < c * u + s * v:
            return theta
    raise AssertionError("there is none")


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
def test_of_two_sets_the_direction_tells_the_one(psi):
    """c = 0.5 and c = -0.5 attract, 0 repels in c; all attract in s."""
    two = System(U=("3*c*(0.25 - c**2)", "-4*s"))
    for theta, e in ((0.05, 0.5), (math.pi - 0.05, -0.5)):
        found, place = _slides(two, theta, psi)
        assert found
        assert place == pytest.approx((e, 0.0), abs=1e-9)
    assert not _slides(two, 0.5 * math.pi, psi)[0]  # where nothing arrives


def test_where_orbits_on_both_sides_end_on_two_sets_it_is_not_sure():
    """The one between them, up c = 0, ends at the saddle."""
    assert not _slides(System(U=("c*(0.5 - 4*s**2 - c**2)", "-1.5*s")), 0.5 * math.pi, TANH)[0]


def test_in_a_line_it_slides_on_the_first_zero_if_that_attracts():
    n = (0.6, -0.8)
    q = "(0.6*c - 0.8*s)"
    line = System(U=(f"0.6*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})", f"-0.8*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})"))
    theta = math.atan2(-0.8, 0.6)
    found, place = _slides(line, theta, line=n)
    assert found
    assert place == pytest.approx((0.2 * 0.6, -0.2 * 0.8), abs=1e-12)
    assert not _slides(line, theta + math.pi, line=n)[0]  # it leaves at that end
    through = System(U=("-0.6 + 0*c", "0.8 + 0*c"))
    assert not _slides(through, theta, line=n)[0]
    near = System(U=("-0.6*(0.6*c - 0.8*s + 0.9999999)", "0.8*(0.6*c - 0.8*s + 0.9999999)"))
    assert not _slides(near, theta, line=n)[0]  # within 1e-6 of the other end


@pytest.mark.parametrize(
    ("D", "away", "attracts"),
    [
        ((-1.0, 0.5, -0.5, -1.0), 0.0, True),
        ((-1.0, 0.5, -0.5, -1.0), 0.005, True),
        ((-1.0, 0.5, -0.5, -1.0), 0.03, False),
        ((-1.0, 4.0, -1.5, -1.0), 0.0, False),  # along C it repels: an eigenvalue of D e_Psi may be small
        ((-0.3, -2.0, 1.9, -0.3), 0.0, True),
        ((-1.0, -1.5, 4.0, -1.0), 0.0, False),
        ((1.0, 0.5, -0.5, -3.0), 0.0, False),  # a saddle
        ((-1.0, 0.999, 0.995, -1.0), 0.0, False),  # hardly a node
        ((1.0, 0.5, -0.5, 1.0), 0.0, False),
        ((-3.0, 2.0, -4.0, 0.9), 0.0, None),
    ],
)
def test_an_orbit_has_ended_at_a_set_that_attracts_under_every_psi(D, away, attracts):
    e, n = np.array([0.3, 0.4]), np.array([0.6, 0.8])
    a, b, c, d = D
    system = System(U=(f"{a}*(c - 0.3) + {b}*(s - 0.4)", f"{c}*(c - 0.3) + {d}*(s - 0.4)"))
    J, across = np.array(D).reshape(2, 2), np.array([-n[1], n[0]])
    if attracts is None:  # both parts of the trace, by themselves
        attracts = bool(max(n @ J @ n, across @ J @ across) < 0.0)
    (C,) = critical_sets(system, TANH)
    S, P = placed(system, ()), np.zeros(PARAMETERS)
    gain = int(functions_of(field(system), TANH).addresses[2])
    p = C.p + away * n
    assert bool(_captured(S, P, gain, 0, p[0], p[1])) is attracts
    np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 2], e, atol=1e-12)
