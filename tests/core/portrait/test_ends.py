"""A curve ends where it says it ends: separatrices, nullclines, cycles, branches of cycles, of every family of Psi."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import codim2_core as c2
from tests.core.general_systems import polynomials
from tests.core.strategies import regularisations

PIXEL = 1.0 / 180.0
number = st.floats(-2.0, 2.0, allow_subnormal=False).map(lambda v: round(v, 4) + 0.0)
ratio = st.floats(-3.0, 0.0)
families = st.one_of(regularisations, st.just(c2.psi.hill(6)))


@st.composite
def systems(draw):
    """E-linear, with coefficients of very different sizes among them."""
    values = [draw(number) * 10.0 ** draw(ratio) for _ in range(5)]
    return c2.ELinear(values[0], values[1], values[2], (values[3], values[4]))


def place(label, equator, critical):
    """The point that a label names, None where it names none."""
    if label.startswith("Q"):
        t = float(equator.theta[int(label[1:]) - 1])
        return np.array([math.cos(t), math.sin(t)])
    if label.startswith("C"):
        return critical[int(label[1:] or 1) - 1].p
    return None


def check_separatrices(system, p):
    cycles = c2.limit_cycles(system, p)
    equator, critical = c2.equator_equilibria(system), c2.critical_sets(system, p)
    for branch in c2.separatrices(system, p, cycles=cycles):
        line = branch.points if branch.direction == "unstable" else branch.points[::-1]
        assert np.isfinite(line).all()
        assert math.dist(line[0], place(branch.origin, equator, critical)) < 1e-9
        if not branch.inside or branch.connection or branch.end == "undecided":
            continue
        end = place(branch.end, equator, critical)
        if end is not None:
            assert math.dist(line[-1], end) < 1e-9
        elif branch.end == "equator":
            assert 1.0 - np.hypot(*line[-1]) < PIXEL
        else:
            points = cycles[int(branch.end.split()[1]) - 1].points
            spacing = np.hypot(*np.diff(points, axis=0).T).max()
            assert np.hypot(*(points - line[-1]).T).min() < 0.5 * spacing + PIXEL


@settings(max_examples=20)
@given(systems(), families)
@example(
    c2.ELinear(0.12194944967029515, -0.37940939819206226, -1.1363151482568636, (0.03932747836053405, -0.119092318512)),
    c2.psi.rational(),
)
def test_separatrices_reach_what_they_name(system, p):
    check_separatrices(system, p)


@pytest.mark.parametrize(
    ("system", "p"),
    [
        (
            c2.ELinear(-0.365019598, 0.000902350815, 4.93641860e-06, (0.00183846656, 3.9658171e-06)),
            c2.psi.exponential(),
        ),
        (c2.ELinear(0.000106897708, -5.468574921e-05, 0.84374474, (9.5371979e-05, -4.64028769e-05)), c2.psi.hill(3)),
        (c2.ELinear(1.7120009925e-05, 0.00025003451, 0.8279174254, (-2.49114978e-05, -0.020749560921)), c2.psi.tanh()),
    ],
)
def test_separatrices_that_creep_reach_what_they_name(system, p):
    """Along directions 1e-5 as fast as others: an explicit method gave up, and left them undecided."""
    assert not [branch for branch in c2.separatrices(system, p) if branch.end == "undecided"]
    check_separatrices(system, p)


@settings(max_examples=8)
@given(polynomials, st.sampled_from([c2.psi.constant(), c2.psi.tanh(), c2.psi.hill(3)]))
def test_separatrices_of_general_systems_reach_what_they_name(system, p):
    if c2.equator_equilibria(system).all_directions:
        return
    check_separatrices(system, p)


def check_nullclines(system, p):
    branches = [b for b in c2.nullclines(system, p) if b.inside]
    ends = [end for b in branches for end in (b.points[0], b.points[-1])]
    for b in branches:
        closed = math.dist(b.points[0], b.points[-1]) < 1e-9
        for end in (b.points[0], b.points[-1]):
            others = sum(math.dist(end, other) < 1e-6 for other in ends) - 1
            assert closed or others or abs(1.0 - np.hypot(*end)) < 1e-12


@settings(max_examples=20)
@given(systems(), families)
@example(c2.ELinear(1.376478, 1.376478, 0.0, (1.376478, 1.376478)), c2.psi.exponential())
def test_nullclines_end_on_the_equator_or_where_they_meet(system, p):
    check_nullclines(system, p)


@settings(max_examples=20)
@given(polynomials, st.sampled_from([c2.psi.exponential(), c2.psi.tanh(), c2.psi.hill(6)]))
@example(c2.System(U=("0", "s**2")), c2.psi.exponential())  # vanishes to second order, and no curve is followed there
@example(c2.System(U=("0", "s**2 - c*s")), c2.psi.tanh())
def test_nullclines_of_general_systems_end_on_the_equator_or_where_they_meet(system, p):
    check_nullclines(system, p)
