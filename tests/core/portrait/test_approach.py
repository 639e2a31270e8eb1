"""Approach outcomes: the paper's portraits, the basins outside, and agreement with the regularised system."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from codim2_core import (
    ELinear,
    System,
    critical_sets,
    equator_equilibria,
    presets,
    psi,
    trajectories,
)
from codim2_core.layer_problem.problem import LayerProblem
from codim2_core.portrait import approach, verdicts
from codim2_core.portrait.approach import approach_outcomes
from codim2_core.portrait.separatrices import separatrices
from codim2_core.words import say
from tests.core.strategies import regularisations, systems

VERDICTS = {"slide", "cycle", "cross", "undecided", "misses"}


def of(name):
    return approach_outcomes(presets[name].system, presets[name].psi)


# ---- the paper's portraits ----------------------------------------------------------------------------------------


def test_case_I_with_a_critical_set_slides():
    for name in ("case1-cm0", "case1-cm2", "case1-cm4"):
        found = of(name)
        assert len(found) > 0
        for outcome in found:
            assert (outcome.verdict, outcome.onto, outcome.depends_on_psi) == ("slide", "C", False)
    assert of("case1-cm0").whole is of("case1-cm0").outcome(1.0) or of("case1-cm0").outcome(1.0).label == "equator"
    assert [outcome.arrives for outcome in of("case1-cm4")] == ["open set"] * 2 + ["single direction"] * 2


def test_case_I_without_one_crosses():
    (outcome,) = of("case1-ncm2")
    assert (outcome.verdict, outcome.onto, outcome.leaving) == ("cross", "Q1", 0.0)
    found = of("case1-ncm4")
    assert {outcome.verdict for outcome in found} == {"cross"}
    assert {outcome.leaving for outcome in found} == {0.0}
    assert found.outcome(math.pi - 0.1).verdict == "cross"
    assert found.outcome(0.1).verdict == "misses"


def test_case_II_saddle_leaves_it_to_chance():
    found = of("case2-saddle")
    assert [outcome.verdict for outcome in found] == ["undecided", "undecided"]
    assert all("different places: " in outcome.reason for outcome in found)


@pytest.mark.parametrize(("n", "verdict"), [(1, "slide"), (2, "slide"), (3, "cycle"), (4, "cycle")])
def test_case_III_depends_on_psi(n, verdict):
    p = psi.hill(n)
    system = ELinear(172, 186, -200, (-86, -93), B=[[1.0, 2.0]], g=[0.5])
    found = approach_outcomes(system, p, compare=[psi.constant(), psi.hill(2), psi.hill(3)])
    first = found[0]
    assert (first.label, first.arrives, first.verdict) == ("Q1", "open set", verdict)
    assert first.slow_flow == pytest.approx([1.0], abs=1e-9)  # (1/2, 0) B + g, on C and on the cycle
    assert first.depends_on_psi
    assert [words for words, _, _ in first.families] == ["1", *(f"3/(3 + (4s)ⁿ), n = {k}" for k in (2, 3))]
    assert [given for _, given, _ in first.families] == ["slide", "slide", "cycle"]
    assert approach_outcomes(system, p, compare=())[0].depends_on_psi is None
    # "Whether trajectories slide or cross depends upon their initial conditions."
    assert {outcome.verdict for _, _, outcome in found.arcs} == {verdict, "misses"}


# ---- degenerate ---------------------------------------------------------------------------------------------------


def test_every_direction():
    found = approach_outcomes(ELinear(-1, 0, -1), psi.tanh())
    assert found.whole is not None
    assert found.outcome(2.0).verdict == "slide"
    assert found.arcs == ((0.0, 2 * math.pi, found.whole),)
    assert approach_outcomes(ELinear(1, 0, 1), psi.tanh()).outcome(0.0).verdict == "misses"
    assert approach_outcomes(ELinear(0, 0, 0), psi.tanh()).outcome(0.0).verdict == "undecided"


def test_closed_equator():
    assert approach_outcomes(ELinear(1, 2, 1), psi.tanh()).outcome(1.0).verdict == "misses"
    assert approach_outcomes(ELinear(0, 2, 0), psi.tanh()).outcome(1.0).verdict == "undecided"
    assert approach_outcomes(ELinear(-1, 2, -1), psi.tanh()).outcome(1.0).verdict == "slide"


def test_critical_set_on_the_equator_is_named():
    found = approach_outcomes(ELinear(-1, 0, -1, (1.0, 0.0)), psi.constant())
    assert any("radially neutral" in outcome.reason for outcome in found.directions)
    # what arrives at the other direction comes to it like 1/T: neutral, and no computation that gave up
    assert {outcome.why for outcome in found.directions if outcome.verdict == "undecided"} == {"neutral"}


@pytest.mark.parametrize("n", [1, 2, 3, 4])
def test_in_case_three_psi_changes_what_it_slides_on_and_not_how(n):
    found = of(f"case3-n{n}")
    (first, *_) = [o for o in found if o.arrives == "open set"]
    assert first.depends_on_psi
    assert first.slides_alike
    C = critical_sets(presets[f"case3-n{n}"].system, psi.hill(n))[0]
    assert first.slow_flow == pytest.approx(C.slow_flow)


@pytest.mark.parametrize("turning", ["s**3", "-s**3", "s**5", "s*abs(s)", "-s*abs(s)", "s**3*(1 - c)"])
@pytest.mark.parametrize("radial", ["-", "+"])
def test_where_all_directions_are_multiple_zeros_the_attracting_one_is_arrived_at(turning, radial):
    """Theta = ±sin^3 and its like: no slope tells which of 0 and pi attracts; orbits from all other angles go there."""
    system = System(U=(f"-s*({turning}) {radial} c", f"c*({turning}) {radial} s"))
    limits = equator_equilibria(system)
    assert len(limits) == 2
    assert (limits.multiplicity > 1).all()
    found = approach_outcomes(system, psi.constant(), compare=())
    sink = 0 if turning.startswith("-") else 1  # Theta > 0 above: to pi
    assert math.cos(limits.theta[sink]) == pytest.approx(1.0 - 2.0 * sink)
    for angle in (0.5, 2.5, 4.0, 6.0):
        assert found.destination(angle) == sink
    assert "attracting" in limits.kind(sink).split("ally")[-1] or limits.multiplicity[sink] > 4
    assert "repelling" in limits.kind(1 - sink).split("ally")[-1] or limits.multiplicity[1 - sink] > 4
    arrives = [direction.arrives for direction in found.directions]
    if radial == "-":
        assert (arrives[sink], arrives[1 - sink]) == ("open set", "single direction")
    else:
        assert arrives == ["nothing", "nothing"]
        assert found.directions[1 - sink].reason == say("repels", Q=f"Q{'₁₂'[1 - sink]}")
    # orbits go up where others come along the equator, and come down where others leave along it: a half-saddle
    inside = [one.origin for one in separatrices(system, psi.constant()) if one.inside]
    assert inside == [f"Q{(sink if radial == '-' else 1 - sink) + 1}"]


def test_angle_must_be_finite():
    with pytest.raises(ValueError, match="finite angle"):
        of("case1-cm2").outcome(math.nan)


# ---- random systems -----------------------------------------------------------------------------------------------


def robust(system):
    plane = np.array(system.at(()).plane)
    size = np.abs(plane).max()
    assume(size > 0.1)
    equator = equator_equilibria(system)
    assume(len(equator) and (equator.multiplicity == 1).all() and not equator.radially_degenerate.any())
    assume((np.abs(equator.lambda_rho) > 0.02 * size).all() and (np.abs(equator.lambda_theta) > 0.02 * size).all())
    return equator


@settings(max_examples=20)
@given(systems, st.floats(0.0, 6.28))
def test_destination_is_where_trajectories_outside_go(system, theta):
    equator = robust(system)
    assume(np.abs(np.angle(np.exp(1j * (equator.theta - theta)))).min() > 1e-3)
    found = approach_outcomes(system, psi.constant(), compare=())
    i = found.destination(theta)
    assert i is not None
    assert equator.lambda_theta[i] < 0.0
    # On the equator itself theta' = Theta, whatever the distance.
    line = trajectories(system, psi.constant(), [(math.cos(theta), math.sin(theta))], t_max=1e3, samples="ends")
    end = math.atan2(line.ends[0, 1], line.ends[0, 0])
    assert abs(math.remainder(end - equator.theta[i], 2 * math.pi)) < 1e-4
    outcome = found.outcome(theta)
    assert (outcome.verdict == "misses") == (equator.lambda_rho[i] > 0.0)


@settings(max_examples=20)
@given(systems, regularisations)
def test_outcomes_are_consistent(system, p):
    equator = robust(system)
    critical = critical_sets(system, p)
    for C in critical:
        assume(np.abs(C.eigenvalues.real).min() > 0.02 * np.abs(system.at(()).plane).max())
    found = approach_outcomes(system, p, compare=())
    assert len(found) == (equator.lambda_rho < 0.0).sum()
    for outcome in found:
        assert outcome.verdict in VERDICTS
        assert outcome.reason.endswith(".")
        if outcome.verdict == "slide":
            assert critical[0].kind.startswith("stable")
        if outcome.verdict == "cross":
            i = int(outcome.onto[1]) - 1
            assert equator.lambda_rho[i] > 0.0
            assert equator.lambda_theta[i] < 0.0
            assert outcome.leaving == equator.theta[i]
        if outcome.arrives == "open set":
            assert outcome.verdict != "undecided", outcome.reason
    arcs = found.arcs
    assert arcs[-1][1] - arcs[0][0] == pytest.approx(2 * math.pi)


def test_the_regularised_system_does_as_foretold():
    """The layer problem from |x2| = 1e4, that is eps = 1e-4 of |(x, y)|, for random systems and angles."""
    random, tried = np.random.default_rng(3), {"slide": 0, "cross": 0}
    while min(tried.values()) < 8:
        a, b, d, f1, f2 = random.uniform(-3.0, 3.0, 5)
        system, p = ELinear(a, b, d, (f1, f2)), (psi.constant(), psi.rational())[random.integers(2)]
        theta = random.uniform(0.0, 2.0 * math.pi)
        equator = equator_equilibria(system)
        sharp = (
            np.abs(equator.lambda_rho).min(initial=3.0) > 0.1 and np.abs(equator.lambda_theta).min(initial=3.0) > 0.1
        )
        near = len(equator) and np.abs(np.angle(np.exp(1j * (equator.theta - theta)))).min() < 0.2
        slow = any(np.abs(C.eigenvalues.real).min() < 0.2 for C in critical_sets(system, p))
        outcome = approach_outcomes(system, p, compare=()).outcome(theta)
        if not sharp or near or slow or tried.get(outcome.verdict, 8) >= 8:
            continue
        tried[outcome.verdict] += 1
        q, far = system.at(()), 1e4

        def field(_, x, q=q, p=p):
            zeta = max(math.hypot(*x), 1e-300)
            return q.U(np.array(x) * (float(p.modulus(zeta)) / zeta))

        start = [far * math.cos(theta), far * math.sin(theta)]
        # Sigma is reached by 10 far; beyond |x2| = 100 far an orbit has left for good.
        path = solve_ivp(field, (0.0, 300.0 * far), start, method="LSODA", rtol=1e-8, atol=1e-6)
        x = path.y[:, -1]
        if outcome.verdict == "slide":
            assert x == pytest.approx(critical_sets(system, p)[0].x2, abs=1e-3)
        else:
            assert math.hypot(*x) > 10.0 * far
            # The angle closes in on the direction like a power of the distance.
            assert abs(math.remainder(math.atan2(x[1], x[0]) - outcome.leaving, 2 * math.pi)) < 0.5


@pytest.mark.parametrize("name", ["case1-cm0", "case1-cm4", "case2-saddle", "case3-n3"])
def test_one_angle_of_approach_is_told_as_all_are(name):
    preset = presets[name]
    found = approach_outcomes(preset.system, preset.psi, compare=())
    for theta in (0.1, 1.3, 2.9, 4.4):
        one = approach.outcome_towards(LayerProblem(preset.system.at(), preset.psi), theta, ())
        told = found.outcome(theta)
        for attribute in ("theta", "label", "arrives", "verdict", "onto", "leaving", "reason", "depends_on_psi", "why"):
            assert getattr(one, attribute) == getattr(told, attribute)


@given(
    *(st.floats(low, high) for low, high in ((-3.0, -0.1), (-0.3, 0.3), (-3.0, -0.1), (0.0, 0.9), (0.0, 6.3))),
    regularisations,
)
@settings(max_examples=20)
def test_where_all_must_end_on_C_they_are_followed_there(a, b, d, r, angle, shape):
    c, s = r * math.cos(angle), r * math.sin(angle)
    problem = LayerProblem(ELinear(a, b, d, (b * s - a * c, -b * c - d * s)).at(), shape)
    assert verdicts._all_end_on_C(problem) or len(problem.equator.arcs)
    which = list(range(len(problem.equator)))
    assume(which)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(verdicts, "_all_end_on_C", lambda problem: False)
        followed = verdicts.arriving(problem, which)
    for told, found in zip(verdicts.arriving(problem, which), followed, strict=True):
        if found.why != "unfollowed":  # which a theorem need not be
            assert (told.verdict, told.onto, told.reason) == (found.verdict, found.onto, found.reason)


def test_no_psi_is_followed_twice(monkeypatch):
    """The own one is among those compared."""
    followed = []
    real = approach.arriving
    monkeypatch.setattr(approach, "arriving", lambda problem, *given: followed.append(problem) or real(problem, *given))
    own = psi.hill(2)
    found = approach_outcomes(presets["case3-n2"].system, own)
    assert own.words in [text for text, *_ in found[0].families]
    assert len(followed) == len({problem.psi for problem in followed}) == len(found[0].families)


@pytest.mark.parametrize("system", [ELinear(-1.0, 0.0, -1.5, (2.0, 0.3)), ELinear(1.0, 0.2, 1.5, (0.1, 0.2))])
def test_where_nothing_slides_no_psi_is_asked(system):
    """No critical set: all that arrives crosses; and a repelling Sigma, at which nothing arrives."""
    found = approach_outcomes(system, psi.constant())
    for outcome in (*found, *found.directions):
        assert outcome.verdict in ("cross", "misses")
        assert (outcome.depends_on_psi, outcome.families, outcome.slides_alike, outcome.why) == (False, (), False, "")
        assert outcome.slow_flow is None
    assert any(outcome.verdict == "cross" for outcome in found) == (system.at().a < 0.0)


# ---- all Psi side by side -------------------------------------------------------------------------------------------


def random_case_III(seed, count):
    """Systems about those of the paper and about one with two cycles."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        about = np.array([(1.0, 1.3, -1.2, 0.33, 0.07), (172.0, 186.0, -200.0, -86.0, -93.0)][i % 2])
        a, b, d, f1, f2 = about * rng.uniform(0.8, 1.2, 5)
        yield ELinear(a, b, d, (f1, f2)), psi.hill(1.0 + i % 4)


def told(found):
    return [(o.label, o.arrives, o.verdict, o.onto, o.leaving, o.reason, o.families, o.why) for o in found.directions]


def test_side_by_side_and_cut_short_orbits_are_told_as_one_after_the_other(monkeypatch):
    """Under each Psi by itself, and where C repels as long as where it attracts: the same to the last word.

    1200 systems were compared with the answers of the code that did so, in which they did not differ.
    """
    cases = [(presets["case3-n2"].system, psi.hill(2)), *random_case_III(7, 9)]
    beside = [told(approach_outcomes(*case)) for case in cases]
    monkeypatch.setattr(approach, "arriving_begun", lambda problems, _: [None] * len(problems))
    monkeypatch.setattr(verdicts, "SOON", verdicts.EARLY)
    assert [told(approach_outcomes(*case)) for case in cases] == beside
    assert {"slide", "cycle", "misses"} <= {verdict for found in beside for _, _, verdict, *_ in found}


def test_all_psi_cost_two_calls_of_the_lanes_and_few_steps(monkeypatch):
    """Of Case III in the paper: about a C that attracts, and about one that repels.

    One after the other it took eight calls, 64 orbits and 176 764 evaluations of the field; it takes 87 312.
    """
    calls, real = [], verdicts.together
    monkeypatch.setattr(verdicts, "together", lambda *given: calls.append(real(*given)) or calls[-1])
    approach_outcomes(presets["case3-n2"].system, presets["case3-n2"].psi)
    assert len(calls) == 2
    lines = [one for call in calls for one in call]
    assert (len(lines), sum(map(len, lines))) == (8, 36)
    assert sum(one.evaluations for one in lines) < 100_000
