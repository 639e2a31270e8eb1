"""The way along a branch: on the normal form of a generalised Hopf bifurcation, all of it known, and rounds counted."""

import math
from itertools import pairwise

import pytest

from codim2_core import ELinear, psi
from codim2_core.continuation import branches
from codim2_core.continuation.asking import answered
from codim2_core.continuation.path import STEP, all_traced, traced
from codim2_core.continuation.points import Guess, Trace, passing, reversed_trace
from codim2_core.continuation.trace import Tracer, distance
from codim2_core.continuation.turns import Turn

TURN = 2.0 * math.pi


class NormalForm:
    """``r' = r (mu + l r^2 + m r^4)`` with chi = r: cycles at mu = -l r^2 - m r^4, the closed turns of `turn`."""

    def __init__(self, linear, square):
        self.l, self.m, self.rounds, self.asked = linear, square, 0, 0

    def mu(self, r):
        return -self.l * r**2 - self.m * r**4

    def exponent(self, r):
        return TURN * (2.0 * self.l * r**2 + 4.0 * self.m * r**4)

    def turn(self, xi, mu):
        if not math.isfinite(mu):
            return None
        r = 1.0 / (1.0 + math.exp(-xi))
        rate = r * (1.0 - r)
        return Turn(
            xi=xi, value=mu, shift=TURN * (mu - self.mu(r)), by_xi=self.exponent(r) * (1.0 - r), by_value=TURN,
            exponent=self.exponent(r), period=TURN, amplitude=r, height=0.5, rate=rate, drift=0.0, chi=r, p=(r, 0.0),
        )  # fmt: skip

    def follow(self, questions):
        self.rounds += 1
        self.asked += sum(len(question.xi) for question in questions)
        return [[self.turn(*place) for place in zip(q.xi, q.values, strict=True)] for q in questions]

    def traced(self, low, high, r=1e-3):
        tracer = Tracer(self, low, high)
        xi = math.log(r / (1.0 - r))
        start = tracer.point(self.turn(xi, self.mu(r)), (self.mu(r) - low) / (high - low), (1.0, 0.0))
        (found,) = answered([traced(tracer, start)], self.follow)
        return tracer, found


@pytest.mark.parametrize(("linear", "square"), [(-1.0, 0.0), (1.0, -2.0), (0.3, -4.0), (-0.2, 1.0)])
def test_every_point_is_a_cycle_of_the_normal_form(linear, square):
    form = NormalForm(linear, square)
    _, trace = form.traced(-0.3, 0.4)
    assert trace.reason == "span"
    assert trace.points[-1].nu in (0.0, 1.0)
    for point in trace.points:
        turn = point.turn
        assert turn.value == pytest.approx(form.mu(turn.chi), abs=1e-10)
        assert turn.value == pytest.approx(-0.3 + 0.7 * point.nu, abs=1e-15)
        assert turn.exponent == pytest.approx(form.exponent(turn.chi), abs=1e-7)
    assert max(distance(one, two) for one, two in pairwise(trace.points)) < 1.5 * STEP
    assert all(point.tangent[0] > 0.0 for point in trace.points)


@pytest.mark.parametrize(("linear", "square"), [(1.0, -2.0), (0.3, -4.0), (-0.2, 1.0)])
def test_the_fold_lies_where_the_normal_form_has_it(linear, square):
    form = NormalForm(linear, square)
    _, trace = form.traced(-0.3, 0.4)
    (i,) = trace.folds
    r = math.sqrt(-linear / (2.0 * square))
    assert trace.points[i].turn.chi == pytest.approx(r, abs=1e-10)
    assert trace.points[i].turn.value == pytest.approx(linear**2 / (4.0 * square), abs=1e-12)


def test_several_points_are_found_in_each_round():
    form = NormalForm(0.3, -4.0)
    _, trace = form.traced(-0.3, 0.4)
    assert form.rounds <= 0.6 * len(trace.points)
    assert form.asked <= 5 * len(trace.points)


def test_a_branch_that_is_followed_back_comes_to_c():
    form = NormalForm(1.0, -2.0)
    tracer, there = form.traced(-0.3, 0.4)
    (back,) = answered([traced(tracer, reversed_trace(there).points[0])], form.follow)
    assert back.reason == "C"
    assert len(back.folds) == 1
    assert back.points[-1].turn.chi < 3e-3


def test_where_a_branch_passes_a_value():
    form = NormalForm(1.0, -2.0)
    _, trace = form.traced(-0.3, 0.4)
    mu = -0.1  # 2 r^4 - r^2 = -0.1
    nu = (mu + 0.3) / 0.7
    expected = [math.sqrt((1.0 - math.sqrt(0.2)) / 4.0), math.sqrt((1.0 + math.sqrt(0.2)) / 4.0)]
    found = passing(trace, nu, 0.7)
    assert [chi for chi, _ in found] == pytest.approx(expected, abs=1e-3)
    for (_, guess), r in zip(found, expected, strict=True):
        assert isinstance(guess, Guess)
        assert guess.nu == nu
        assert guess.xi == pytest.approx(math.log(r / (1.0 - r)), abs=5e-3)
        assert guess.backward == (form.exponent(r) > 0.0)
    assert passing(Trace(trace.points[:3], (), ""), 0.9, 0.7) == []


@pytest.mark.parametrize(
    ("system", "name", "span", "most"),
    [
        (ELinear(1.0, 1.3, -1.2, (0.33, 0.07)), "f1", (0.2, 0.5), 36),  # 62 rounds with steps that wait for each other
        (ELinear(172, 186, -200, (-86, -93)), "f1", (-100.0, -70.0), 190),  # 224: its cycles explode
    ],
)
def test_rounds_of_a_branch(system, name, span, most, monkeypatch):
    rounds = []
    follow = branches.follow
    monkeypatch.setattr(branches, "follow", lambda questions: rounds.append(1) or follow(questions))
    branches.continue_cycles(system, psi.hill(3), name, span)
    assert len(rounds) <= most


def _both_ways(form, low, high, radii):
    tracer = Tracer(form, low, high)
    starts = []
    for r, towards in zip(radii, (1.0, -1.0), strict=True):
        turn = form.turn(math.log(r / (1.0 - r)), form.mu(r))
        starts.append(tracer.point(turn, (form.mu(r) - low) / (high - low), (towards, 0.0)))
    (found,) = answered([all_traced(tracer, starts)], form.follow)
    return found


@pytest.mark.parametrize(("linear", "square"), [(-1.0, 0.4), (1.0, -2.0), (-0.2, 1.0)])
def test_two_ways_that_meet_are_one_branch_in_half_the_rounds(linear, square):
    form, alone = NormalForm(linear, square), NormalForm(linear, square)
    mu = [form.mu(0.01 * k) for k in range(96)]
    low, high = min(mu) - 0.1, max(mu) + 0.1
    (joined, nothing) = _both_ways(form, low, high, (1e-3, 0.95))
    assert nothing is None
    trace, other = joined
    assert other == 1
    r = [point.turn.chi for point in trace.points]
    assert all(one < two for one, two in pairwise(r))
    assert (r[0], r[-1]) == pytest.approx((1e-3, 0.95), abs=1e-9)
    for point in trace.points:
        assert low + point.nu * (high - low) == pytest.approx(form.mu(point.turn.chi), abs=1e-9)
        assert point.tangent[0] > 0.0
    assert all(distance(one, two) < 2.0 * STEP for one, two in pairwise(trace.points))
    folds = [r[i] for i in trace.folds]
    expected = math.sqrt(-linear / (2.0 * square)) if linear * square < 0.0 else math.inf
    assert folds == pytest.approx([expected] if expected < 0.95 else [], abs=1e-6)
    alone.traced(low, high)
    assert form.rounds < 0.75 * alone.rounds


def test_two_ways_that_part_do_not_meet():
    form = NormalForm(1.0, -2.0)
    one, two = _both_ways(form, form.mu(0.5) - 1e-3, 0.5, (0.45, 0.4))
    assert one[1] is None
    assert two[1] is None
    assert one[0].points[-1].turn.chi > 0.5 > two[0].points[0].turn.chi
