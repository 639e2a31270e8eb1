"""The slow portrait against closed forms: the ball, Case III along z, and systems built around a known slow flow."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.portrait.sliding.along_z import slow_portrait


@pytest.mark.parametrize("psi", [c2.psi.constant(), c2.psi.tanh()], ids=lambda p: p.family)
def test_the_ball_slides_between_two_passages_through_the_equator(psi):
    ball = c2.examples.ball_in_pool(mu=0.3, m=2.0, K=1.5)
    crit = 7.0 * 0.3 * 2.0 * c2.examples.GRAVITY / (2.0 * 1.5)
    found = slow_portrait(ball, psi, "z1", (-2.0 * crit, 2.0 * crit))
    assert [i.kind for i in found.intervals] == ["crossing", "sliding", "crossing"]
    assert [p.kind for p in found.points if p.kind != "node-focus"] == ["equator", "equilibrium", "equator"]
    np.testing.assert_allclose([p.z for p in found.points], [-crit, 0.0, crit], rtol=1e-13, atol=1e-13 * crit)
    assert found.points[1].stable
    (branch,) = found.branches
    np.testing.assert_allclose(branch.flow[:, 0], -5.0 * 1.5 / (7.0 * 2.0) * branch.z, rtol=0.0, atol=1e-12)


def test_case_iii_changes_from_unstable_to_stable_where_the_trace_vanishes():
    system = c2.ELinear(172, 186, -200, ("-86 + 20*z", "-93"), B=((1.0, 0.0),), g=("z",))
    psi = c2.psi.hill(3)
    found = slow_portrait(system, psi, "z1", (-2.0, 2.0))
    points = {p.kind: p.z for p in found.points}
    hopfs = [p.z for p in found.points if p.kind == "Hopf"]
    assert len(hopfs) == 3
    for z in hopfs:
        (at_hopf,) = c2.critical_sets(system, psi, (z,))
        assert abs(at_hopf.trace) < 1e-9 * np.abs(at_hopf.jacobian).max()
    # -A^-1 f at z, with adj(A) f = (d f1 + b f2, a f2 - b f1) and det A = a d + b^2
    det = 172 * -200 + 186**2
    slow = lambda z: -(-200 * (-86 + 20 * z) + 186 * -93) / det + z
    assert slow(points["equilibrium"]) == pytest.approx(0.0, abs=1e-12)
    assert [i.kind for i in found.intervals] == ["crossing", "unstable", "sliding", "unstable", "sliding", "crossing"]
    for interval, after in zip(found.intervals, found.intervals[1:], strict=False):
        assert interval.high == pytest.approx(after.low, abs=1e-12)


@settings(max_examples=20)  # each is a whole portrait
@given(st.floats(-0.9, 0.9), st.booleans())
def test_an_equilibrium_of_the_slow_flow_is_found_with_its_stability(place, attracts):
    sign = -1.0 if attracts else 1.0
    system = c2.ELinear(-1.0, 0.3, -2.0, ("z", 0.0), g=(f"{sign}*(z - {place})",))
    found = slow_portrait(system, c2.psi.rational(), "z1", (-1.5, 1.5))
    (equilibrium,) = [p for p in found.points if p.kind == "equilibrium"]
    assert equilibrium.z == pytest.approx(place, abs=1e-13)
    assert equilibrium.stable is attracts


THREE = ("-c*(c - 1/2)*(c + 1/2)", "-s")  # nodes at c = -1/2 and 1/2, a saddle between them


def test_each_of_several_critical_sets_has_its_branch_and_its_equilibrium():
    """z' = c - z: on each set the slow flow has its own zero, where c is that of the set."""
    found = slow_portrait(c2.System(U=THREE, W=("c - z",)), c2.psi.constant(), "z1", (-1.0, 1.0), count=21)
    assert len(found.branches) == 3
    for branch in found.branches:
        np.testing.assert_allclose(branch.e, np.broadcast_to(branch.e[0], branch.e.shape), rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(branch.flow[:, 0], branch.e[:, 0] - branch.z, rtol=0.0, atol=1e-12)
    points = [p for p in found.points if p.kind == "equilibrium"]
    assert len(points) == len(found.points) == 3
    np.testing.assert_allclose([p.z for p in points], [-0.5, 0.0, 0.5], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose([p.e for p in points], [(-0.5, 0.0), (0.0, 0.0), (0.5, 0.0)], rtol=0.0, atol=1e-12)
    assert all(p.stable for p in points)


def test_sets_that_cross_in_one_coordinate_keep_their_branches():
    """The nodes go round each other: each branch stays on its own circle arc."""
    turned = ("-(c*cos(2*z) + s*sin(2*z))*((c*cos(2*z) + s*sin(2*z))**2 - 1/4)", "c*sin(2*z) - s*cos(2*z)")
    U = (f"({turned[0]})*cos(2*z) - ({turned[1]})*sin(2*z)", f"({turned[0]})*sin(2*z) + ({turned[1]})*cos(2*z)")
    found = slow_portrait(c2.System(U=U, W=("1",)), c2.psi.constant(), "z1", (-1.5, 1.5), count=41)
    nodes = [b for b in found.branches if b.kind == "stable node"]
    assert len(nodes) == 2
    for branch in nodes:
        side = np.sign(branch.e[0] @ (np.cos(2 * branch.z[0]), np.sin(2 * branch.z[0])))
        expected = 0.5 * side * np.stack([np.cos(2 * branch.z), np.sin(2 * branch.z)], axis=-1)
        np.testing.assert_allclose(branch.e, expected, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("count", [3, 5])
@pytest.mark.parametrize(("flow", "stable"), [("-z", [True]), ("z", [False]), ("z**2", []), ("0", [])])
def test_an_equilibrium_at_a_value_that_is_looked_at(flow, stable, count):
    found = slow_portrait(c2.ELinear(-1, 0, -2, g=(flow,)), c2.psi.constant(), "z1", (-1.0, 1.0), count=count)
    assert [p.stable for p in found.points if p.kind == "equilibrium"] == stable
    assert all(p.z == 0.0 for p in found.points)


def test_two_sets_are_born_in_a_fold_and_one_leaves_through_the_equator():
    """c = -1/4 -+ sqrt(1/16 + z/2) exist from z = -1/8; the first reaches c = -1 at z = 1. Both within one step."""
    system = c2.System(U=("c**2 + c/2 - z/2", "-s"), W=("c + 2",))
    for count in (2, 21):
        found = slow_portrait(system, c2.psi.constant(), "z1", (-1.0, 2.0), count=count)
        assert [p.kind for p in found.points] == ["fold", "equator"]
        fold, equator = found.points
        assert (fold.z, equator.z) == pytest.approx((-0.125, 1.0), abs=1e-9)
        assert (fold.e, equator.e) == (pytest.approx((-0.25, 0.0), abs=1e-4), pytest.approx((-1.0, 0.0), abs=1e-9))
        assert (fold.flow, equator.flow) == (pytest.approx((1.75,), abs=1e-4), pytest.approx((1.0,), abs=1e-9))
        assert fold.stable is equator.stable is None
        assert [(i.kind, i.low, i.high) for i in found.intervals] == [
            ("crossing", -1.0, pytest.approx(-0.125, abs=1e-9)),
            ("sliding", pytest.approx(-0.125, abs=1e-9), pytest.approx(1.0, abs=1e-9)),
            ("unstable", pytest.approx(1.0, abs=1e-9), 2.0),
        ]
        for branch in found.branches:
            side = -1.0 if branch.kind == "stable node" else 1.0
            expected = -0.25 + side * np.sqrt(np.maximum(0.0625 + 0.5 * branch.z, 0.0))
            np.testing.assert_allclose(branch.e[:, 0], expected, atol=1e-7)
            assert branch.stable == (branch.kind == "stable node")


@pytest.mark.parametrize(
    ("square", "kinds"),
    [("c**2 - z/2", ["crossing", "sliding"]), ("c**3 - z*c", ["unstable", "sliding"]), ("z*c - c**3", ["sliding"])],
)
@pytest.mark.parametrize("high", [0.5, 0.6])
def test_a_fold_at_a_value_that_is_looked_at_is_one_point(square, kinds, high):
    """At z = 0, where sets are born, there is one of determinant 0: no interval of its own, and no second point."""
    found = slow_portrait(c2.System(U=(square, "-s"), W=("c + 1",)), c2.psi.constant(), "z1", (-0.5, high), count=21)
    (point,) = found.points
    assert point.kind == "fold"
    assert (point.z, *point.e, *point.flow) == pytest.approx((0.0, 0.0, 0.0, 1.0), abs=1e-6)
    assert [i.kind for i in found.intervals] == kinds
    assert [found.intervals[0].low, found.intervals[-1].high] == [-0.5, high]
    assert {b.kind for b in found.branches} <= {"stable node", "saddle"}
    assert all(b.z[-1] - b.z[0] > 0.4 for b in found.branches)


@pytest.mark.parametrize(("trace", "becomes"), [("z", "an unstable focus"), ("-z", "a stable focus")])
def test_a_hopf_point_at_a_value_that_is_looked_at(trace, becomes):
    found = slow_portrait(c2.ELinear(trace, 1, trace, B=((2.0, 0.0),), g=(3.0,)), c2.psi.constant(), "z1", (-1.0, 1.0))
    (point,) = found.points
    assert (point.kind, point.flow, point.e) == ("Hopf", (3.0,), (0.0, 0.0))
    assert point.z == pytest.approx(0.0, abs=1e-12)
    assert becomes in point.sentence
    kinds = ["unstable", "sliding"] if trace == "-z" else ["sliding", "unstable"]
    assert [i.kind for i in found.intervals] == kinds
    assert [b.kind for b in found.branches] == [f"{'' if k == 'sliding' else 'un'}stable focus" for k in kinds]


def test_any_slow_variable_is_varied_and_the_others_stay():
    crit = 3.5 * 0.2 * c2.examples.GRAVITY
    found = slow_portrait(c2.examples.ball_in_pool(), c2.psi.constant(), "z2", (-10.0, 10.0), z=(0.6 * crit, 99.0))
    np.testing.assert_allclose([p.z for p in found.points], [-0.8 * crit, 0.0, 0.8 * crit], rtol=1e-12, atol=1e-12)
    assert found.points[1].flow == pytest.approx((-3.0 / 7.0 * crit, 0.0), abs=1e-12)
    assert slow_portrait(c2.examples.ball_in_pool(), c2.psi.constant(), "z1", (-10.0, 10.0), count=5).points[
        -1
    ].z == pytest.approx(crit)


def test_sets_that_move_far_between_two_values_are_not_mistaken():
    """c = z/2 -+ 1/10: within a step of z the lower comes nearer to where the upper was than the upper is."""
    upper, lower = "(c - z/2 - 1/10)", "(c - z/2 + 1/10)"
    for k, z in ((0.24, 0.28), (0.39, 0.58)):
        found = slow_portrait(
            c2.System(U=(f"{upper}*{lower}", "-s"), W=(f"c - {k}",)), c2.psi.constant(), "z1", (-0.9, 0.9), count=7
        )
        points = {branch.e[-1, 0]: p.z for branch in found.branches for p in found.points if p.kind == "equilibrium"}
        assert len(points) == 2
        places = {round(p.z, 9): round(p.e[0], 9) for p in found.points if p.kind == "equilibrium"}
        assert places[z] == pytest.approx(k)


def test_an_equilibrium_is_looked_for_on_its_own_branch_between_two_values():
    """Sets at c = 3/10 and 9/25 for all z: z' vanishes on the first at z = 0.9, on the other at z = 0.6."""
    system = c2.System(U=("(c - 3/10)*(c - 9/25)", "-s"), W=("z - 9/10 + 5*(c - 3/10)",))
    found = slow_portrait(system, c2.psi.constant(), "z1", (0.0, 1.0), count=2)
    expected = [("equilibrium", pytest.approx(z), pytest.approx((c, 0.0)), False) for z, c in ((0.6, 0.36), (0.9, 0.3))]
    assert [(p.kind, p.z, p.e, p.stable) for p in found.points] == expected


@pytest.mark.parametrize("gap", [1e-4, 1e-8])
def test_sets_that_pass_each_other_by_do_not_meet(gap):
    """c^2 - z c - gap: a saddle and a node, never closer than 2 sqrt(gap)."""
    system = c2.System(U=(f"-(c**2 - z*c - {gap})", "-s"), W=("1",))
    assert not [
        p
        for p in c2.slow_portrait(system, c2.psi.tanh(), "z1", (-0.5, 0.43), count=21).points
        if "exchange" in p.sentence
    ]


@pytest.mark.parametrize(
    ("span", "count"),
    [((-0.1, 0.9), 9), ((-0.3, 0.1), 4), ((-0.549, 0.451), 11)],
    ids=["first step", "last of three", "midway"],
)
def test_sets_that_exchange_their_kinds_within_any_step(span, count):
    """c = 0 and c = z - 3/10 meet at z = 3/10; a third set, at c = -4/5, stays away."""
    system = c2.System(U=("c*(c - z + 3/10)*(c + 4/5)", "-s"), W=("z",))
    (point,) = slow_portrait(system, c2.psi.constant(), "z1", (span[0] + 0.3, span[1] + 0.3), count=count).points[-1:]
    assert (point.kind, point.z) == ("fold", pytest.approx(0.3, abs=1e-8))
    assert "exchange" in point.sentence
    assert point.e == pytest.approx((0.0, 0.0), abs=1e-6)
    assert point.flow == pytest.approx((0.3,), abs=1e-6)


@pytest.mark.parametrize("offset", [0.0, 50.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_what_is_there_only_at_an_end_of_the_span_is_no_interval(sign, offset):
    """A set is born at the end: there it is degenerate, and for no z next to it does it exist."""
    low, high = sorted((offset, offset - sign))
    system = c2.System(U=(f"c**2 - {sign}*(z - {offset})/2", "-s"), W=("1",))
    found = slow_portrait(system, c2.psi.constant(), "z1", (low, high), count=5)
    assert [(i.kind, i.low, i.high) for i in found.intervals] == [("crossing", low, high)]
    assert (found.points, found.branches) == ((), ())
