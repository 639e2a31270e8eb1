"""How phases are read off a motion, part by part: contacts, what is followed in them, and from when on."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.motion import phases as module
from codim2_core.motion.followed import Followed
from codim2_core.motion.limit.decide import Decision

PSI = c2.psi.rational()
EPS = 1e-3
SYSTEM = c2.System(U=("-c", "-s"), W=("1",))


class Motion:
    """Straight from state to state, at times that differ."""

    def __init__(self, states, times=None):
        self.states = np.array(states, float)
        self.times = np.arange(len(states)) * 2.0 if times is None else np.array(times)
        self.lengths = np.diff(self.times)

    def within(self, i, u):
        return (1.0 - u) * self.states[i] + u * self.states[i + 1]


def on(e, attracts=True, rate=1.0):
    return Followed(np.array(e), np.array(e), attracts, rate, -rate if attracts else rate)


@dataclass(frozen=True)
class Reader(module._ReadMotion):
    """Follows what a table says, by the state's z."""

    table: dict = field(default_factory=dict)

    def set_at(self, state):
        return self.table.get(round(float(state[2]), 6))


def reader(states, table=None, times=None, system=SYSTEM):
    return Reader(system, PSI, EPS, Motion(states, times), None, 1e-8, table or {})


def by_r(radii, z=0.0):
    return [(r, 0.0, z) for r in radii]


def test_contacts_with_returns_from_a_middle_distance():
    """r up to 20 eps is contact; what stays below sqrt(20 eps max r) belongs to it where the motion comes back."""
    assert pytest.approx(0.02) == module.NEAR * EPS
    stays = lambda radii: list(reader(by_r(radii)).stays())
    assert stays([1.0, 0.5, 0.01, 0.1, 0.01, 0.5, 1.0, 0.01]) == [(2, 4), (7, 7)]
    assert stays([1.0, 0.01, 0.2, 0.01]) == [(1, 1), (3, 3)]
    assert stays([0.01, 0.1, 1.0]) == [(0, 0)]
    assert stays([0.01, 0.02, 0.021, 0.0, 1.0]) == [(0, 3)]
    assert stays([0.01, 0.03, 0.01, 0.04]) == [(0, 0), (2, 2)]  # the largest distance is small itself
    assert stays([0.01, 0.027, 0.01, 0.04]) == [(0, 2)]
    assert stays([0.001, 0.002, 0.001]) == [(0, 2)]
    assert stays([1.0, 0.1, 0.1, 0.5]) == []
    assert stays([0.1, 0.01]) == [(1, 1)]


def test_what_is_followed_farther_out_belongs_to_a_contact():
    radii, z = [1.0, 0.1, 0.1, 0.01, 0.01, 0.1, 0.1, 1.0], [0, 1, 2, 3, 4, 5, 6, 7]
    states = [(r, 0.0, float(k)) for r, k in zip(radii, z, strict=True)]
    for table, expected in (
        ({}, (3, 4)),
        ({2.0: on((0, 0))}, (2, 4)),
        ({2.0: on((0, 0)), 1.0: on((0, 0)), 0.0: on((0, 0))}, (1, 4)),  # far outside nothing belongs to it
        ({1.0: on((0, 0))}, (3, 4)),
        ({5.0: on((0, 0))}, (3, 5)),
        ({5.0: on((0, 0)), 6.0: on((0, 0)), 7.0: on((0, 0))}, (3, 6)),
    ):
        assert list(reader(states, table).stays()) == [expected]


def test_two_step_ends_follow_one_set_if_what_lies_between_does():
    states = [(0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
    one = reader(states)
    assert one.goes_on(on((0.5, 0.5)), on((0.52, 0.5)), 0)
    assert not one.goes_on(on((0.5, 0.5)), on((0.3, 0.5)), 0)
    assert not one.goes_on(None, on((0.5, 0.5)), 0)
    assert not one.goes_on(on((0.5, 0.5)), None, 0)
    for middle, same in (((0.6, 0.5), True), ((0.6, 0.9), False), ((0.2, 0.5), False)):
        between = reader(states, {0.5: on(middle)})
        assert between.goes_on(on((0.5, 0.5)), on((0.7, 0.5)), 0) == same


def test_from_when_to_when_a_set_is_followed(monkeypatch):
    """Between z = 1 and 3 of a motion with z = t/2: the ends lie within steps, where what is followed changes."""
    monkeypatch.setattr(module, "critical_name", lambda system, psi, z, e: f"C{z[0]:.0f}")

    class Between(Reader):
        def set_at(self, state):
            return on((0.1, state[2] / 10)) if 1.25 <= state[2] <= 2.75 else None

    motion = Motion([(0.0, 0.0, float(k)) for k in range(5)])
    between = Between(SYSTEM, PSI, EPS, motion, None, 1e-8)
    run = between.on_set(2, 2, on((0.1, 0.2)), on((0.1, 0.2)))
    assert (run.t_start, run.t_end, run.onto) == (pytest.approx(2.5), pytest.approx(5.5), "C2")
    (found,) = between.runs(1, 4)
    assert (found.first, found.last, found.t_start, found.t_end) == (2, 2, pytest.approx(2.5), pytest.approx(5.5))
    early = Between(SYSTEM, PSI, EPS, Motion([(0.0, 0.0, 1.0), (0.0, 0.0, 2.0), (0.0, 0.0, 3.0)]), None, 1e-8)
    assert early.on_set(1, 1, on((0.1, 0.2)), on((0.1, 0.2))).t_start == pytest.approx(0.5)
    whole = reader([(0.0, 0.0, 0.0)] * 3, {0.0: on((0.1, 0.2))})
    run = whole.on_set(0, 2, on((0.1, 0.2)), on((0.1, 0.3)))
    assert (run.t_start, run.t_end) == (0.0, 4.0)
    part = whole.on_set(1, 1, on((0.1, 0.2)), on((0.1, 0.3)))  # what lies beside is on a set as well: another
    assert (part.t_start, part.t_end) == (2.0, 2.0)


def run(first, last, t_start, t_end, onto="C"):
    return module._Run(first, last, t_start, t_end, onto, (np.zeros(2), np.zeros(2)))


def test_what_attracts_is_followed_and_what_repels_if_it_is_followed_for_long():
    one, passing = reader(by_r([0.0, 0.0])), module.PASSING * EPS
    repels = [on((0, 0), False, 4.0), None, on((0, 0), False, 2.0)]
    assert one.is_followed(run(0, 1, 0.0, 1e-9), [None, on((0, 0), True)])
    assert not one.is_followed(run(0, 1, 3.0, 3.0 + 0.49 * passing), repels)
    assert one.is_followed(run(0, 1, 3.0, 3.0 + 0.51 * passing), repels)


def test_when_a_contact_begins():
    """At |p| = 0.95, which is r = 3 eps; else with what is followed; else at r = 20 eps."""
    coming = reader(by_r([1.0, 0.019, 0.001, 0.0]))
    assert coming.contact(1, 3, []) == pytest.approx(2.0 + 2.0 * (0.019 - 0.003) / 0.018)
    passing = reader(by_r([1.0, 0.01, 0.01, 1.0]))
    assert passing.contact(1, 2, []) == pytest.approx(2.0 * 0.98 / 0.99)
    assert passing.contact(1, 2, [run(2, 2, 3.5, 4.0)]) == 3.5
    later = reader(by_r([1.0, 0.019, 0.01, 0.001]))  # close only after what is followed has begun
    assert later.contact(1, 3, [run(2, 3, 3.5, 6.0)]) == 3.5
    assert later.contact(1, 3, [run(3, 3, 3.5, 6.0)]) == pytest.approx(4.0 + 2.0 * 0.007 / 0.009)


CIRCLE = 0.5 * np.stack([np.cos(np.linspace(0, math.tau, 60)), np.sin(np.linspace(0, math.tau, 60))], axis=-1)[:-1]


def turning(turns, p=0.5, count=90):
    angle = np.linspace(0.0, math.tau * turns, count)
    r = EPS * p / math.sqrt(1.0 - p * p)
    return [(r * math.cos(a), r * math.sin(a), k / 100) for k, a in enumerate(angle.tolist())]


@pytest.mark.parametrize(
    ("turns", "p", "stable", "onto"),
    [
        (5.0, 0.5, True, "cycle 2"),
        (-5.0, 0.5, True, "cycle 2"),
        (1.9, 0.5, True, None),  # too few turns
        (2.1, 0.5, True, "cycle 2"),
        (5.0, 0.5, False, None),
        (5.0, 0.55, True, "cycle 2"),  # within 0.04 and 20 eps
        (5.0, 0.45, True, "cycle 2"),
        (5.0, 0.57, True, None),
        (5.0, 0.43, True, None),
    ],
)
def test_a_limit_cycle_is_followed_near_it_for_two_turns(monkeypatch, turns, p, stable, onto):
    other = SimpleNamespace(stable=True, points=0.1 * CIRCLE)
    asked = []

    def limit_cycles(system, psi, z):
        asked.append(z[0])
        return [other, SimpleNamespace(stable=stable, points=CIRCLE)] if z[0] >= 0.3 else []

    monkeypatch.setattr(module, "limit_cycles", limit_cycles)
    found = reader(turning(turns, p)).on_cycle(0, 89)
    assert (found and found.onto) == onto
    if onto:
        assert (found.first, found.last, found.t_end, found.e) == (38, 89, 178.0, None)
        assert found.t_start == 76.0
        assert asked[-1] == 0.89
        assert len(asked) == module.ASKED


def test_cycles_are_looked_for_between_the_runs_on_critical_sets(monkeypatch):
    one, asked = reader(turning(5.0)), []

    def on_cycle(_self, first, last):
        asked.append((first, last))
        return run(first, last, float(first), float(last), "cycle 1") if last == 50 else None

    monkeypatch.setattr(Reader, "on_cycle", on_cycle, raising=False)
    runs = [run(0, 20, 0.0, 20.0), run(50, 80, 50.0, 80.0, "C2")]
    found = one.with_cycles(0, 89, runs)
    assert asked == [(20, 50), (80, 89)]
    assert [each.onto for each in found] == ["C", "cycle 1", "C2"]
    asked.clear()
    one.with_cycles(0, 88, runs)
    assert asked == [(20, 50)]  # eight steps are no turns


def test_what_a_motion_is_on_its_way_to(monkeypatch):
    asked = []

    def answer(verdict):
        def from_hemisphere(system, psi, z, points):
            asked.append((z.tolist(), points.tolist()))
            if isinstance(verdict, Exception):
                raise verdict
            return verdict

        return from_hemisphere

    one, state = reader(by_r([0.0])), np.array([EPS, 0.0, 0.7])
    for verdict, onto in (
        (Decision("slide", "", onto="C2"), "C2"),
        (Decision("cycle", "", onto="cycle 1"), "cycle 1"),
        (Decision("leave", "", onto="C2"), None),
        (Decision("stop", ""), None),
        (ValueError("no value"), None),
    ):
        monkeypatch.setattr(module, "from_hemisphere", answer(verdict))
        assert one.ahead(state) == onto
    assert asked[0] == ([0.7], [[pytest.approx(math.sqrt(0.5)), 0.0]])
    asked.clear()
    assert one.ahead(np.array([1e9, 0.0, 0.7])) is None  # on the equator
    assert not asked


def phases(states, table, monkeypatch, ahead=None, name="C1"):
    monkeypatch.setattr(module, "critical_name", lambda system, psi, z, e: name)
    monkeypatch.setattr(Reader, "ahead", lambda _self, state: ahead, raising=False)
    return [(p.kind, p.onto, round(p.t_start, 3), round(p.t_end, 3)) for p in reader(states, table).phases()]


def test_phases_in_order(monkeypatch):
    """A step takes 2; r = 0.003 and 0.02 lie 0.994 and 0.98 of the way from 1 to 0, or from 0 to 1 so much later."""
    out, mid = (1.0, 0.0, 5.0), (0.0, 0.0, 0.0)
    follows = {0.0: on((0.1, 0.2))}
    come, go = 1.994, 0.04
    assert phases([out, out], {}, monkeypatch) == [("slip", None, 0.0, 2.0)]
    assert phases([out, mid, out], {}, monkeypatch) == [
        ("slip", None, 0.0, come), ("cross", None, come, 2.0 + go), ("slip", None, 2.0 + go, 4.0),
    ]  # fmt: skip
    assert phases([mid, out], {}, monkeypatch) == [("slip", None, 0.0, 2.0)]  # leaves at once
    assert phases([mid, mid], follows, monkeypatch) == [("slide", "C1", 0.0, 2.0)]
    assert phases([out, mid, mid], follows, monkeypatch) == [("slip", None, 0.0, come), ("slide", "C1", come, 4.0)]
    assert phases([mid, mid, out], follows, monkeypatch) == [("slide", "C1", 0.0, 2.0), ("slip", None, 2.0, 4.0)]
    # the end is on its way to a set: the same one, another, or from nothing
    assert phases([out, mid], {}, monkeypatch, ahead="C2") == [("slip", None, 0.0, come), ("slide", "C2", come, 2.0)]
    off = (0.0, 0.0, 1.0)
    assert phases([mid, mid, off], follows, monkeypatch, ahead="C1") == [("slide", "C1", 0.0, 4.0)]
    assert phases([mid, mid, off], follows, monkeypatch, ahead="C2") == [
        ("slide", "C1", 0.0, 2.0), ("slide", "C2", 2.0, 4.0),
    ]  # fmt: skip
    assert phases([mid, mid, off], follows, monkeypatch) == [("slide", "C1", 0.0, 2.0), ("slip", None, 2.0, 4.0)]


def test_why_a_phase_began(monkeypatch):
    monkeypatch.setattr(module, "critical_name", lambda system, psi, z, e: "C1")
    monkeypatch.setattr(Reader, "ahead", lambda _self, state: "cycle 2", raising=False)
    out, mid, off = (1.0, 0.0, 5.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    said = [phase.reason for phase in reader([out, mid, off], {0.0: on((0.1, 0.2))}).phases()]
    assert said[1].startswith("Comes within O(ε) of Σ, and follows the critical set C₁")
    assert said[2].startswith("Goes on within O(ε) of Σ, to limit cycle 2")
    (starts,) = reader([mid, mid], {0.0: on((0.1, 0.2))}).phases()
    assert starts.reason.startswith("The motion starts within O(ε) of Σ, and follows the critical set C₁")
