"""What a nonsmooth motion does where a phase has ended, with the parts that it asks played by hand."""

from __future__ import annotations

import math
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.initial_value.events import Watch, checked_events
from codim2_core.initial_value.field import field
from codim2_core.initial_value.line import invariant_line
from codim2_core.initial_value.problem import plane_problem
from codim2_core.motion import nonsmooth
from codim2_core.motion.agreement import agreement
from codim2_core.motion.followed import in_disc
from codim2_core.motion.limit import course as module
from codim2_core.motion.limit.course import PAST, Course, StopError
from codim2_core.motion.limit.decide import Decision
from codim2_core.motion.limit.folded import Fold
from codim2_core.motion.limit.part import MotionPart
from codim2_core.motion.limit.slide_on_cycle import CycleSlide
from codim2_core.motion.result import Phase
from codim2_core.numerics.radau import STAGES, Step, TooManyStepsError

PSI = c2.psi.rational()
TYPED = c2.System(U=("-c + z1 + c**2/9", "-s + z2"), W=("c + 2", "s - z1"))


def course(system=TYPED, psi=PSI, state=(0.0, 0.0, 0.2, -0.1), t_end=3.0, line=None, slid=0.0):
    formulas, first = field(system), np.array(state)
    problem = plane_problem(formulas, None, 0.0, 1e-10, 1e-12, None)
    watch = Watch(checked_events(()), 1.0, first)
    made = Course(system, psi, formulas, problem, line, watch, 1.0, first, t_end, 1e-10, 1e-12, 100)
    if slid:
        made.parts.append(MotionPart(Phase("slide", 1.0 - slid, 1.0, "It came here."), [], None))
    return made


def step(first, last, start=1.0, h=0.5):
    return Step(start, h, np.array(first), np.array(last), np.zeros((len(first), STAGES)))


def test_z_a_part_of_the_time_ahead_or_of_the_slide_behind_lies_along_the_slow_flow():
    own, e = course(slid=20.0), np.array([0.3, -0.2])
    np.testing.assert_allclose(own.ahead(e, 0.25), np.array([0.2, -0.1]) + 0.25 * 2.0 * np.array([2.3, -0.4]))
    own = course(slid=0.2)
    np.testing.assert_allclose(own.ahead(e, 0.25), np.array([0.2, -0.1]) + 0.25 * 0.2 * np.array([2.3, -0.4]))
    beside = c2.System(U=("-c", "-s"), W=("1 + 3*x + 5*y + s", "x*y - c"))  # on Sigma x = y = 0
    there = course(beside, slid=20.0).ahead(e, 0.25)
    np.testing.assert_allclose(there, np.array([0.2, -0.1]) + 0.5 * np.array([0.8, -0.3]))


def script(monkeypatch, name, answers):
    """Let a method of a course answer as said, and note with what it was asked."""
    asked, left = [], list(answers)

    def answer(_self, *arguments):
        asked.append(arguments)
        return left.pop(0)

    monkeypatch.setattr(Course, name, answer)
    return asked


STOP, LEAVE = Decision("stop", "nothing"), Decision("leave", "that way", theta=0.3)


@pytest.mark.parametrize(
    ("answers", "which"), [([LEAVE], 0), ([STOP, LEAVE], 1), ([STOP, STOP, LEAVE], 2), ([STOP] * 3, 2)]
)
def test_past_a_fold_the_first_answer_counts_that_is_no_stop(monkeypatch, answers, which):
    own, e = course(slid=20.0), np.array([0.5, -0.1])
    asked = script(monkeypatch, "onward", answers)
    assert own.past_fold(e, Fold("It ends.")) is answers[which]
    assert len(asked) == which + 1
    flow = own.ahead(e, PAST) - own.state[2:]
    further = [float((z - own.state[2:]) @ flow / (flow @ flow)) for _, z, _ in asked]
    assert further[0] == pytest.approx(1.0)
    assert all(later > 10.0 * before for before, later in pairwise(further))
    for _, z, points in asked:
        np.testing.assert_allclose(z - own.state[2:], (z - own.state[2:]) @ flow / (flow @ flow) * flow)
        np.testing.assert_array_equal(points, [in_disc(PSI, e)])
    np.testing.assert_array_equal(own.ascent.start, in_disc(PSI, e))
    np.testing.assert_array_equal(own.ascent.z, asked[0][1])


def test_past_a_folded_node_orbits_are_followed_beside_it_where_both_sets_are_gone(monkeypatch):
    own, beyond = course(slid=20.0), np.array([0.6, 0.8])
    asked = script(monkeypatch, "onward", [LEAVE])
    own.past_fold(np.array([0.5, -0.1]), Fold("It ends.", beyond=beyond))
    away = asked[0][1] - own.state[2:]
    np.testing.assert_allclose(away / np.linalg.norm(away), beyond)


def test_past_a_hopf_point_psi_is_asked_for():
    found = course(psi=None).past_loss(np.zeros(2), "C1")
    assert found.kind == "stop"
    assert "C₁ loses its stability (Hopf)" in found.reason
    assert "depends on Ψ: give it" in found.reason


def circle(n, radius=0.3):
    angle = math.tau * np.arange(n) / n
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


@pytest.mark.parametrize("stable", [(), (False,), (True, True), (True,), (False, True)])
def test_past_a_cycle_orbits_are_followed_from_all_around_the_one_that_was_stable(monkeypatch, stable):
    own = course()
    cycles = [SimpleNamespace(stable=one, points=circle(200 + i)) for i, one in enumerate(stable)]
    asked_at = []
    monkeypatch.setattr(module, "limit_cycles", lambda system, psi, z: asked_at.append((psi, z)) or cycles)
    asked = script(monkeypatch, "onward", [LEAVE])
    found = own.past_cycle(np.array([0.7, 0.8]))
    assert asked_at == [(PSI, (0.2, -0.1))]
    if sum(stable) != 1:
        assert found.kind == "stop"
        assert not asked
        return
    assert found is LEAVE
    ((_, z, points),) = asked
    np.testing.assert_array_equal(z, (0.7, 0.8))
    assert 12 <= len(points) <= 20
    np.testing.assert_allclose(np.hypot(*points.T), 0.3)
    assert abs(points.mean(axis=0)).max() < 0.02  # all around
    few = SimpleNamespace(stable=True, points=circle(5))
    monkeypatch.setattr(module, "limit_cycles", lambda *_: [few])
    asked = script(monkeypatch, "onward", [Decision("cycle", "again", onto="cycle 1")])
    assert own.past_cycle(np.zeros(2)).kind == "stop"  # it comes and goes
    assert len(asked[0][2]) == 5


def test_from_where_an_attractor_was_orbits_decide_unless_psi_would(monkeypatch):
    asked = []

    def from_hemisphere(system, psi, z, points):
        asked.append((psi, z, points))
        if z[0] > 1.0:
            raise ValueError("no value there.")
        return LEAVE if z[0] > 0.0 else STOP

    monkeypatch.setattr(module, "from_hemisphere", from_hemisphere)
    here, none = np.array([0.5, 0.0]), np.array([-0.5, 0.0])
    found = course().onward("Because.", here, circle(3))
    assert (found.kind, found.theta, found.reason) == ("leave", 0.3, "Because. that way")
    assert asked[-1][0] == PSI
    open_ = course(psi=None)
    assert open_.onward("Because.", here, circle(3)).kind == "stop"
    assert open_.onward("Because.", none, circle(3)).reason == "Because. nothing"
    assert asked[-1][0] == c2.psi.constant()
    edge = course().onward("Because.", np.array([2.0, 0.0]), circle(3))
    assert (edge.kind, edge.reason) == ("stop", "Because. no value there.")


@pytest.mark.parametrize("name", ["cycle 1", "cycle 3"])
def test_a_cycle_is_followed_by_its_number_and_looked_past_where_it_ends(monkeypatch, name):
    asked = []
    z = (0.2, -0.1), (0.5, 0.3)
    whole = step((0.0, 0.0, *z[0]), (0.0, 0.0, *z[1]))
    parts = [
        CycleSlide([whole], True, [np.zeros(2)] * 2, [np.zeros(2)] * 2),
        CycleSlide([], False, [np.zeros(2)], [np.zeros(2)]),
        CycleSlide([whole], False, [np.zeros(2)] * 2, [np.zeros(2)] * 2),
    ]
    monkeypatch.setattr(module, "slide_on_cycle", lambda *all: asked.append(all) or parts.pop(0))
    decision = Decision("cycle", "It turns.", np.zeros(2), onto=name)
    past = script(monkeypatch, "past_cycle", [LEAVE])
    assert course().slide(decision) is None
    assert (asked[0][2], asked[0][3], asked[0][5], asked[0][6]) == (int(name[-1]) - 1, 1.0, 3.0, 100)
    assert course().slide(decision).kind == "stop"
    own = course()
    assert own.slide(decision) is LEAVE
    np.testing.assert_allclose(past[0][0], np.array(z[1]) + 10.0 * (np.array(z[1]) - z[0]))
    assert own.left == 98
    with pytest.raises(StopError, match="It turns"):
        course(c2.System(U=("-c", "-s")), state=(0.0, 0.0)).slide(decision)


def test_an_arrival_that_leads_on_is_a_crossing_and_what_follows_leaves():
    own = course()
    assert own.crossed(STOP) is STOP
    assert not own.parts
    own.ascent = ascent = module.Ascent(TYPED, PSI, np.zeros(2), 0.3)
    assert own.crossed(LEAVE) is LEAVE
    (part,) = own.parts
    assert (part.phase.kind, part.phase.t_start, part.phase.t_end, part.theta) == ("cross", 1.0, 1.0, 0.3)
    assert part.ascent is ascent
    assert own.ascent is None
    placed = part.placed(TYPED, PSI, None)
    np.testing.assert_allclose(placed.e(1.0), (math.cos(0.3), math.sin(0.3)))


@pytest.mark.parametrize(
    ("q", "z", "kind", "there"),
    [
        (0.2, 0.4, "slide", 0.4),  # q' = z - q, of which q = z attracts
        (1.0, -0.3, "slide", -0.3),
        (-1.0, 1.5, "leave", 0.0),
        (1.0, -1.5, "leave", math.pi),
        (0.4, 0.4, "slide", 0.4),  # on it
    ],
)
def test_in_a_line_its_own_equation_decides(q, z, kind, there):
    system = c2.ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(1.0,))
    state = (0.0, 0.0, z)
    own = course(system, state=state, line=invariant_line(field(system), np.array([0.1, *state[1:]])))
    found = own.in_line(q, "So.")
    assert found.kind == kind
    if kind == "slide":
        assert found.e == pytest.approx([there, 0.0], abs=1e-12)
        assert found.onto == "C"
        end = there
    else:
        assert abs(math.remainder(found.theta - there, math.tau)) < 1e-12
        end = math.cos(there)
    start, last = own.ascent.along
    np.testing.assert_allclose(start, in_disc(PSI, np.array([q, 0.0])))
    np.testing.assert_allclose(last, in_disc(PSI, np.array([end, 0.0])), rtol=0.0, atol=1e-12)


def test_at_rest_on_a_repelling_set_of_a_line_it_stops():
    system = c2.ELinear(1.0, 0.0, -1.0, ("-z", 0.0), g=(1.0,))  # q' = q - z
    state = (0.0, 0.0, 0.4)
    own = course(system, state=state, line=invariant_line(field(system), np.array([0.1, *state[1:]])))
    assert own.in_line(0.4, "So.").kind == "stop"
    assert own.in_line(0.5, "So.").theta == pytest.approx(0.0)
    assert abs(own.in_line(0.3, "So.").theta) == pytest.approx(math.pi)


def test_the_field_is_evaluated_as_often_as_is_said(monkeypatch):
    calls = [0]

    def counted(system):
        own = field(system)

        def value(*arguments):
            calls[0] += 1
            return own.value(*arguments)

        return type(own)(own.m, own.rows, value, own.slope)

    monkeypatch.setattr(nonsmooth, "field", counted)
    run = c2.simulate_nonsmooth(c2.ELinear(-1.0, 0.5, -2.0), (0.3, 0.2), (0.0, 0.1))
    assert run.evaluations == calls[0] > 10


def simulated(phases, end=1.0, eps=0.01):
    limit = c2.simulate_nonsmooth(c2.ELinear(-1.0, 0.5, -2.0), (0.3, -0.2), (0.0, 0.1), PSI)
    return SimpleNamespace(
        times=np.array([0.0, end]), phases=tuple(phases), eps=eps, states=limit.states, dense=lambda t: limit.states[0]
    )


def test_where_phases_differ_the_earlier_time_is_told():
    slip, later = Phase("slip", 0.0, 0.3, ""), Phase("slip", 0.0, 0.6, "")
    slide, cross = Phase("slide", 0.3, 1.0, "", "C2"), Phase("cross", 0.6, 0.6, "")
    system = c2.ELinear(-1.0, 0.5, -2.0)
    for own, limit, words in (
        ((slip, slide), (later, cross), "t = 0.3 on the motion slides on C₂, and in the limit it crosses Σ"),
        ((later, cross), (slip, slide), "t = 0.3 on the motion crosses Σ, and in the limit it slides on C₂"),
        ((slip, slide), (later,), "t = 0.3 on the motion slides on C₂, and in the limit it goes on as before"),
        ((slip,), (later, cross), "t = 0.6 on the motion goes on as before, and in the limit it crosses Σ"),
    ):
        found = agreement(system, PSI, simulated(own), simulated(limit))
        assert not found.same
        assert words in found.sentence
    same = agreement(system, PSI, simulated((slip, slide)), simulated((slip, slide)))
    assert (same.same, same.order) == (True, 1.0)
    assert "O(ε)." in same.sentence
    exits = c2.ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(1.0,))
    limit = c2.simulate_nonsmooth(exits, (0.1, 0.0, 0.4), (0.0, 1.6), PSI)
    run = c2.simulate(exits, PSI, 1e-5, (0.1, 0.0, 0.4), (0.0, 1.6))
    assert "O(ε^0.889)" in agreement(exits, PSI, run, limit).sentence


def test_a_part_knows_its_place_in_the_end():
    limit = c2.simulate_nonsmooth(c2.ELinear(-1.0, 0.5, -2.0, (0.1, 0.3)), (0.3, -0.2), (0.0, 1.0), PSI)
    assert [phase.kind for phase in limit.phases] == ["slip", "slide"]
    slip, slide = limit.phases
    xy = limit.dense(0.05)[:2]
    np.testing.assert_allclose(slip.p(0.05), xy / np.hypot(*xy))
    np.testing.assert_allclose(slide.e(0.9), c2.critical_sets(c2.ELinear(-1.0, 0.5, -2.0, (0.1, 0.3)), PSI)[0].e)
    means = [np.array((0.1, 0.2)), np.array((0.3, 0.4))]
    part = MotionPart(Phase("slide", 0.0, 1.0, "", "cycle 1"), [0.0, 1.0], None, means, [2.0 * one for one in means])
    on_cycle = part.placed(TYPED, PSI, limit.motion)
    np.testing.assert_allclose(on_cycle.e(0.5), (0.2, 0.3))
    np.testing.assert_allclose(on_cycle.p(0.5), (0.4, 0.6))


@pytest.mark.parametrize(("most", "why"), [(1, StopError), (0, TooManyStepsError)])
def test_at_the_step_limit_nothing_more_is_decided(monkeypatch, most, why):
    script(monkeypatch, "slip", [STOP])
    own = course(state=(0.3, 0.0, 0.2, -0.1))
    own.most = most
    with pytest.raises(why):
        own.run()


def test_a_motion_in_a_line_that_comes_back_is_known_from_its_first_moment():
    """U1 = z - c, z' = -1 from z = 3/2: x = t/2 - t^2/2 leaves Sigma, and is there again at t = 1."""
    system = c2.ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(-1.0,))
    run = c2.simulate_nonsmooth(system, (0.0, 0.0, 1.5), (0.0, 1.25), PSI)
    assert [phase.kind for phase in run.phases] == ["slip", "slide"]
    assert run.phases[1].t_start == pytest.approx(1.0, abs=1e-9)
    t = np.array([1e-12, 1e-10, 1e-6, 0.25, 0.5, 0.9])
    np.testing.assert_allclose(run.dense(t)[:, 0], t / 2 - t * t / 2, rtol=1e-6)
    assert run.times[1] < 1e-6  # the first step away is short


@pytest.mark.parametrize("theta", [0.0, 2.0, -1.2])
def test_a_critical_set_on_the_equator_is_told_by_its_direction(theta):
    e0 = (math.cos(theta), math.sin(theta))
    own = course(c2.System(U=(f"({e0[0]!r}) - c", f"({e0[1]!r}) - s")), state=(0.0, 0.0))
    assert own.on_equator(theta, np.zeros(0))
    assert own.on_equator(theta + math.tau, np.zeros(0))
    for other in (theta + 0.01, theta + math.pi, -theta if theta else 0.5):
        assert not own.on_equator(other, np.zeros(0))
