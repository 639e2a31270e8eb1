"""Approach outcomes: the paper's portraits, the basins outside, and agreement with the regularised system."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from codim2_core import ELinear, System, critical_sets, equator_equilibria, presets, psi, trajectories
from codim2_core.portrait.approach_outcomes import approach_outcomes
from codim2_core.portrait.separatrices import separatrices
from codim2_core.results.words import say
from tests.core.strategies import systems


def of(name):
    return approach_outcomes(presets[name].system, presets[name].psi)


def test_case_I_without_one_crosses():
    (outcome,) = of("case1-ncm2")
    assert (outcome.verdict, outcome.onto, outcome.leaving) == ("cross", "Q1", 0.0)
    found = of("case1-ncm4")
    assert {outcome.verdict for outcome in found} == {"cross"}
    assert {outcome.leaving for outcome in found} == {0.0}
    assert found.outcome(math.pi - 0.1).verdict == "cross"
    assert found.outcome(0.1).verdict == "misses"


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


def test_closed_equator():
    assert approach_outcomes(ELinear(1, 2, 1), psi.tanh()).outcome(1.0).verdict == "misses"
    assert approach_outcomes(ELinear(0, 2, 0), psi.tanh()).outcome(1.0).verdict == "undecided"
    assert approach_outcomes(ELinear(-1, 2, -1), psi.tanh()).outcome(1.0).verdict == "slide"


def test_critical_set_on_the_equator_is_named():
    found = approach_outcomes(ELinear(-1, 0, -1, (1.0, 0.0)), psi.constant())
    assert any("radially neutral" in outcome.reason for outcome in found.directions)
    # what arrives at the other direction comes to it like 1/T: neutral, and no computation that gave up
    assert {outcome.why for outcome in found.directions if outcome.verdict == "undecided"} == {"neutral"}


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


@pytest.mark.parametrize("turn", [0.0, 1.1, 2.5, 3.6, 5.2])
@pytest.mark.parametrize("mean", [1.2, 0.95, 0.0, -0.95, -1.2])
def test_along_every_direction_it_is_the_sign_of_U_along_it_that_counts(mean, turn):
    """U = (mean + cos(theta - turn)) e: all away, all towards, or some of either, wherever they are."""
    c, s = math.cos(turn), math.sin(turn)
    radial = f"({mean!r} + {c!r}*c + {s!r}*s)"
    found = approach_outcomes(System(U=(f"c*{radial}", f"s*{radial}")), psi.constant(), compare=())
    (verdict, why) = ("misses", "") if mean > 1.0 else ("slide", "") if mean < -1.0 else ("undecided", "several")
    assert (found.whole.verdict, found.whole.why, found.whole.label) == (verdict, why, "every direction")
    assert found.whole.arrives == ("open set" if mean < -1.0 else "nothing")
    assert len(found) == (verdict != "misses")
    assert found.whole.reason.startswith(
        say("all lead away" if mean > 1.0 else "all directions" if mean < -1.0 else "some lead")
    )


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


@pytest.mark.parametrize("system", [ELinear(-1.0, 0.0, -1.5, (2.0, 0.3)), ELinear(1.0, 0.2, 1.5, (0.1, 0.2))])
def test_where_nothing_slides_no_psi_is_asked(system):
    """No critical set: all that arrives crosses; and a repelling Sigma, at which nothing arrives."""
    found = approach_outcomes(system, psi.constant())
    for outcome in (*found, *found.directions):
        assert outcome.verdict in ("cross", "misses")
        assert (outcome.depends_on_psi, outcome.families, outcome.slides_alike, outcome.why) == (False, (), False, "")
        assert outcome.slow_flow is None
    assert any(outcome.verdict == "cross" for outcome in found) == (system.at().a < 0.0)


def test_case_I_with_a_critical_set_slides():
    for name in ("case1-cm0", "case1-cm2", "case1-cm4"):
        found = of(name)
        assert len(found) > 0
        for outcome in found:
            assert (outcome.verdict, outcome.onto, outcome.depends_on_psi) == ("slide", "C", False)
    assert of("case1-cm0").whole is of("case1-cm0").outcome(1.0) or of("case1-cm0").outcome(1.0).label == "equator"
    assert [outcome.arrives for outcome in of("case1-cm4")] == ["open set"] * 2 + ["single direction"] * 2


def test_case_II_saddle_leaves_it_to_chance():
    found = of("case2-saddle")
    assert [outcome.verdict for outcome in found] == ["undecided", "undecided"]
    assert all("different places: " in outcome.reason for outcome in found)


def test_every_direction():
    found = approach_outcomes(ELinear(-1, 0, -1), psi.tanh())
    assert found.whole is not None
    assert found.outcome(2.0).verdict == "slide"
    assert found.arcs == ((0.0, 2 * math.pi, found.whole),)
    assert approach_outcomes(ELinear(1, 0, 1), psi.tanh()).outcome(0.0).verdict == "misses"
    assert approach_outcomes(ELinear(0, 0, 0), psi.tanh()).outcome(0.0).verdict == "undecided"
