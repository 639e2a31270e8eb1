"""What is said of a limit direction, case by case: on equators and endings made up so that every answer is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.portrait import approach
from codim2_core.portrait.outcomes import Outcome
from codim2_core.portrait.verdicts import Judged
from codim2_core.words import say

from .test_endings import equator

PSI = c2.psi.constant()


# ---- other regularisations ------------------------------------------------------------------------------------------


def outcome(verdict="slide", onto="C"):
    return Outcome(1.0, "Q1", "open set", verdict, onto, None, None, "As it is.")


@pytest.mark.parametrize(
    ("own", "others", "elinear", "depends", "alike"),
    [
        (("slide", "C"), [("slide", "C")] * 2, True, False, False),
        (("slide", "C"), [("slide", "C"), ("cycle", "cycle 1")], True, True, True),
        (("cycle", "cycle 1"), [("slide", "C")], True, True, True),
        (("cycle", "cycle 1"), [("cycle", "cycle 2")], True, True, True),
        (("slide", "C"), [("slide", "C"), ("cycle", "cycle 1")], False, True, False),  # C is not where it was
        (("slide", "C"), [("cycle", "cycle 1"), ("cross", "Q2")], True, True, False),
        (("cross", "Q2"), [("slide", "C")], True, True, False),
        (("cross", "Q2"), [("cross", "Q3")], True, True, False),
        (("cross", "Q2"), [("cross", "Q2")], True, False, False),
        (("slide", "C"), [("undecided", None)], True, True, False),
    ],
)
def test_other_regularisations_give_another_outcome_or_the_same(own, others, elinear, depends, alike):
    verdicts = [(f"psi {k}", *other) for k, other in enumerate(others)]
    found = approach._compared(outcome(*own), verdicts, True, elinear)
    assert (found.depends_on_psi, found.slides_alike) == (depends, alike)
    assert found.families == tuple(verdicts)
    assert found.reason == ("As it is. " + say("alike") if alike else "As it is.")
    theorem = approach._compared(outcome(*own), verdicts, False, elinear)
    assert (theorem.depends_on_psi, theorem.families, theorem.slides_alike) == (False, (), False)
    nobody = approach._compared(outcome(*own), [], True, elinear)
    assert (nobody.depends_on_psi, nobody.families, nobody.slides_alike) == (None, (), False)


@pytest.mark.parametrize(
    ("a", "d", "kind", "expected"),
    [
        (1.0, -2.0, "stable focus", True),
        (-2.0, 1.0, "stable node", True),
        (1.0, -2.0, "saddle", False),
        (-1.0, -2.0, "stable node", False),
        (1.0, 2.0, "unstable node", False),
        (0.0, -1.0, "stable focus", False),
        (-1.0, 0.0, "stable focus", False),
    ],
)
def test_with_a_critical_set_only_case_III_asks_for_psi(a, d, kind, expected):
    at = SimpleNamespace(normal_form=SimpleNamespace(a=a, d=d))
    assert approach._sensitive(at, equator([0.3, 2.0], [1, 1])[0], (SimpleNamespace(kind=kind),)) is expected
    assert approach._sensitive(SimpleNamespace(normal_form=None), equator([], [])[0], ()) is True


def test_without_one_several_ways_out_ask_for_psi():
    at = SimpleNamespace(normal_form=SimpleNamespace(a=-1.0, d=-2.0))
    limits, beyond = equator([0.3, 2.0, 3.5, 5.0], [1, 1, 1, 1])
    out = [i for i in range(4) if beyond[i] < 0]  # angularly attracting, and lambda_rho > 0: ways out
    assert approach._sensitive(at, limits, ()) is True
    limits.lambda_rho[out[0]] = -1.0
    assert approach._sensitive(at, limits, ()) is False
    limits.lambda_rho[:] = [-1.0 if i in out else 1.0 for i in range(4)]
    assert approach._sensitive(at, limits, ()) is False


def test_others_are_asked_unless_there_are_too_many_sets(monkeypatch):
    def direction(own, judged, texts, sensitive, i):
        asked.append((len(judged), len(texts), sensitive))
        return SimpleNamespace(arrives="open set")

    monkeypatch.setattr(approach, "_direction", direction)
    monkeypatch.setattr(approach, "arriving_begun", lambda problems, which: [len(which)] * len(problems))
    monkeypatch.setattr(approach, "arriving", lambda problem, which, *_: followed.append(which) or [problem.psi])
    limits, _ = equator([0.3, 1.0, 2.0, 3.0], [1, 1, 1, 1], lambda_rho=[-0.5, 0.5, 1.0, -1e-17])
    for count, compare, expected in ((8, None, None), (9, None, 0), (9, [PSI], 1), (8, (), 0), (8, [PSI] * 2, 2)):
        own = SimpleNamespace(
            at=SimpleNamespace(normal_form=None),
            equator=limits,
            equator_cycle=None,
            critical=(SimpleNamespace(kind="saddle"),) * count,
            psi=PSI,
            under=lambda other: SimpleNamespace(psi=other),
        )
        asked, followed = [], []
        found = approach.outcomes_of(own, compare)
        others = len(approach.compared()) if expected is None else expected
        different = {PSI, *(approach.compared() if compare is None and others else compare or ())}
        # what leads away, and what is neutral, is judged under none
        assert asked == [(1 + others, others, True), *[(0, others, True)] * 3]
        assert followed == [[0]] * len(different)
        assert len(found) == 4


# ---- one limit direction --------------------------------------------------------------------------------------------


def said(limits, i, judged=(), sensitive=False, texts=()):
    own = SimpleNamespace(equator=limits, at=SimpleNamespace(normal_form="there"))
    return approach._direction(own, judged, list(texts), sensitive, i)


def test_directions_that_nothing_arrives_along():
    limits, beyond = equator([0.3, 1.4, 2.9, 4.4], [1, 1, 1, 1], lambda_rho=[1.0, 1.0, 0.0, -1.0])
    for i, sign in enumerate(beyond):
        limits.lambda_rho[:] = 1.0
        limits.radially_degenerate[:] = False
        away = said(limits, i)
        assert (away.verdict, away.arrives, away.theta, away.label) == (
            "misses",
            "nothing",
            limits.theta[i],
            f"Q{i + 1}",
        )
        assert away.reason == say("repels" if sign > 0 else "leads away", Q=f"Q{'₁₂₃₄'[i]}")
        for beside in (i - 1, (i + 1) % 4, (i + 2) % 4):
            limits.lambda_rho[:] = 0.5
            limits.lambda_rho[beside] = -0.5
            turns = sign < 0 and beside != (i + 2) % 4  # what comes in beside it may turn away
            assert said(limits, i).reason == away.reason + (" " + say("turns away") if turns else "")
        limits.lambda_rho[:] = 1.0
        limits.lambda_rho[i], limits.radially_degenerate[i] = 0.0, True
        neutral = said(limits, i)
        assert (neutral.verdict, neutral.arrives, neutral.why) == ("undecided", "nothing", "neutral")
        assert "radially neutral" in neutral.reason


def test_beside_a_double_direction_that_leads_away_nothing_more_is_said():
    limits, _ = equator([0.3, 2.4, 4.9], [2, 1, 1], lambda_rho=[1.0, -1.0, -1.0])
    assert said(limits, 0).reason == say("leads away", Q="Q₁")


@pytest.mark.parametrize(
    ("multiplicity", "i", "arrives", "words"),
    [
        ((1, 1), 0, "single direction", "single direction"),
        ((1, 1), 1, "open set", "open set"),
        ((3, 1), 0, "single direction", "single direction"),
        ((2, 1, 1), 0, "one side", "one side"),
        ((2,), 0, "one side", "one side, all angles"),
    ],
)
def test_what_arrives_and_what_becomes_of_it(multiplicity, i, arrives, words):
    limits, beyond = equator([0.3, 2.4, 4.9][: len(multiplicity)], multiplicity)
    if arrives != "one side" and (arrives == "open set") != (beyond[i] < 0):
        i = 1 - i
    limits.lambda_rho[:] = -1.0
    flow = np.array([2.0])
    judged = [Judged("cycle", "cycle 1", 0.7, flow, "Round and round.", "why"), Judged("slide", "C")]
    one = said(limits, i, judged, True, ["psi"])
    assert (one.theta, one.label, one.arrives) == (limits.theta[i], f"Q{i + 1}", arrives)
    assert (one.verdict, one.onto, one.leaving, one.why) == ("cycle", "cycle 1", 0.7, "why")
    assert one.slow_flow is flow
    assert one.reason.startswith(say(words, Q=f"Q{'₁₂₃'[i]}") + " Round and round.")
    assert one.families == (("psi", "slide", "C"),)
    assert (one.depends_on_psi, one.slides_alike, one.slides) == (True, True, True)
    plain = said(limits, i, judged[:1])
    assert (plain.depends_on_psi, plain.families) == (False, ())


# ---- all angles at once ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("turn", [0.0, 1.1, 2.5, 3.6, 5.2])
@pytest.mark.parametrize("mean", [1.2, 0.95, 0.0, -0.95, -1.2])
def test_along_every_direction_it_is_the_sign_of_U_along_it_that_counts(monkeypatch, mean, turn):
    """U = (mean + cos(theta - turn)) e: all away, all towards, or some of either, wherever they are."""
    monkeypatch.setattr(approach, "spiralling", lambda *_: Judged("slide", "C", None, None, "They slide.", ""))
    c, s = math.cos(turn), math.sin(turn)
    radial = f"({mean!r} + {c!r}*c + {s!r}*s)"
    found = c2.approach_outcomes(c2.System(U=(f"c*{radial}", f"s*{radial}")), PSI, compare=())
    (verdict, why) = ("misses", "") if mean > 1.0 else ("slide", "") if mean < -1.0 else ("undecided", "several")
    assert (found.whole.verdict, found.whole.why, found.whole.label) == (verdict, why, "every direction")
    assert found.whole.arrives == ("open set" if mean < -1.0 else "nothing")
    assert len(found) == (verdict != "misses")
    if verdict == "slide":
        assert found.whole.reason == say("all directions") + " They slide."
    else:
        assert found.whole.reason == say("all lead away" if mean > 1.0 else "some lead")


def whole(monkeypatch, cycle, arcs=(), proven=True, others=()):
    asked = []

    def spiralling(problem, *_):
        asked.append(problem)
        return problem.judged

    monkeypatch.setattr(approach, "spiralling", spiralling)
    on = SimpleNamespace(all_directions=False, proven=proven, arcs=np.array(arcs, float).reshape(-1, 2))
    judged = Judged("cycle", "cycle 1", None, np.ones(1), "Round.", "")
    own = SimpleNamespace(at=SimpleNamespace(normal_form="there"), equator=on, equator_cycle=cycle, judged=judged)
    return approach._whole(approach._Asked(own, list(others), True)), asked


def test_what_spirals_onto_the_closed_equator(monkeypatch):
    onto = SimpleNamespace(neutral=False, stable_outside=True)
    other = SimpleNamespace(judged=Judged("slide", "C"), psi=SimpleNamespace(words="psi"))
    found, asked = whole(monkeypatch, onto, others=[other])
    assert (found.theta, found.label, found.arrives) == (None, "equator", "open set")
    assert (found.verdict, found.onto, found.families) == ("cycle", "cycle 1", (("psi", "slide", "C"),))
    assert (found.depends_on_psi, found.slides_alike) == (True, True)
    assert found.reason == f"{say('spiral')} Round. {say('alike')}"
    assert len(asked) == 2
    away, asked = whole(monkeypatch, SimpleNamespace(neutral=False, stable_outside=False))
    assert (away.verdict, away.arrives, away.reason, asked) == ("misses", "nothing", say("equator repels"), [])
    for cycle in (SimpleNamespace(neutral=True, stable_outside=True), None):
        found, asked = whole(monkeypatch, cycle)
        assert (found.verdict, found.why, found.reason, asked) == ("undecided", "neutral", say("neutral equator"), [])


def test_an_equator_on_which_directions_may_be_missing_decides_nothing(monkeypatch):
    onto = SimpleNamespace(neutral=False, stable_outside=True)
    found, asked = whole(monkeypatch, onto, proven=False)
    assert (found.verdict, found.why, found.reason, asked) == (
        "undecided",
        "unfollowed",
        say("no directions found"),
        [],
    )
    found, _ = whole(monkeypatch, None, [(1.0, 2.0)], proven=False)
    assert (found.verdict, found.label, found.arrives) == ("undecided", "equator", "nothing")
    assert found.reason == say("arc of directions", first=1.0, last=2.0)
