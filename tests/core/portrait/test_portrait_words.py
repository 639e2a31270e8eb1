"""What the portrait's sentences say of the directions, of the critical set, and of what is degenerate."""

from dataclasses import replace

import numpy as np
import pytest

from codim2_core import ELinear, System, approach_outcomes, classify, equator_cycle, equator_equilibria, psi
from codim2_core.layer_problem.equator import EquatorEquilibria
from codim2_core.portrait import classify_typed
from codim2_core.portrait.classification import directions


def said(a, b, d, f1, f2, family=None):
    return classify(ELinear(a, b, d, (f1, f2)), family or psi.constant())


@pytest.mark.parametrize(
    ("plane", "words"),
    [
        ((-1, 1, -1, 0, 0), "No limit directions: the equator is a closed orbit that attracts outside and repels on"),
        ((1, 1, 1, 0, 0), "No limit directions: the equator is a closed orbit that repels outside and attracts on"),
        ((0, 1, 0, 0.3, 0), "No limit directions: the equator is a closed orbit. "),
        ((-1, 0, -1, 0, 0), "Every direction is a limit direction."),
        ((-2, 0, -1, 0.1, 0.1), "4 limit directions: trajectories reach Σ along them."),
        ((2, 0, 1, 0.1, 0.1), "4 limit directions: trajectories leave Σ along them."),
        ((-1, 5, -1, 3, 4), "1 limit direction: trajectories reach Σ along it."),
        ((7, -5, 7, -4, 3), "1 limit direction: trajectories leave Σ along it."),
        ((-1, 0, -1, 1.5, 0), "2 limit directions: trajectories reach Σ along 1 and leave it along 1."),
        ((1, 0, -2, 0.2, 0.3), "4 limit directions: trajectories reach Σ along 2 and leave it along 2."),
        ((-2, 0, -1, 0.1, 0.1), "The critical set C is a stable node: stable sliding along Σ."),
        (
            (-1, 0, -1, 1, 0),
            "2 limit directions: trajectories reach Σ along 1 of them. Q₁ is radially neutral",
        ),
        ((2, 0, 1, 0.1, 0.1), "The critical set C is an unstable node: sliding along C itself is unstable."),
        ((1, 0, -2, 0.2, 0.3), "The critical set C is a saddle whatever Ψ is"),
        ((0, 1, 0, 0.3, 0), "The critical set C is a centre: closed orbits surround it."),
        ((-1, 0, -1, 1.5, 0), "There is no critical set, so nothing slides: what reaches Σ crosses it."),
        ((2.71, -2.25, -1.38, 1.62, -1.43), "The critical set C is a stable focus, but nothing reaches Σ: only"),
        ((1, 1, -1, 0.5, 0.25), "det A = 0 within rounding, and f is not in the range of A: no critical set."),
    ],
)
def test_sentence(plane, words):
    assert words in said(*plane).sentence


@pytest.mark.parametrize(
    ("plane", "names", "case"),
    [
        ((0, 1, -1, 0.1, 0.1), ["a = 0"], None),
        ((-1, 1, 0, 0.1, 0.1), ["d = 0"], None),
        ((-1, 1, -2, 0.1, 0.1), [], "I"),
        ((0.5, 1, 0.5, 0.1, 0.1), [], "I"),
        ((225, -180, 100, -171, 172), ["cusp"], "I"),
        ((-1, 0, -1.5, -0.5, 0), ["pitchfork"], "I"),
        ((0, 1.5, 1, 2**0.5, -(2**0.5)), ["a = 0", "quadruple zero"], None),
        ((-1, 5, -1, 3, 4), ["saddle-node"], "I"),
        ((0.5, 1.0, -0.5, 0.1, 0.1), ["neutral equator", "tr J = 0"], "III"),
        ((0.6, 1.0, -0.5, 0.1, 0.1), [], "III"),
    ],
)
def test_names(plane, names, case):
    found = said(*plane)
    assert [d.name for d in found.degeneracies] == names
    assert found.case == case


def test_a_triple_zero_is_a_pitchfork_only_where_the_system_is_symmetric():
    for f1, f2, d in ((-0.5, 0.0, -1.5), (0.0, 2.0, 1.0)):
        found = equator_equilibria(ELinear(-1.0, 0.0, d, (f1, f2)))
        assert found.symmetric
        assert any("pitchfork" in found.kind(i) for i in range(len(found)))
    for plane in ((225, -180, 100, -171, 172), (225, -180, 100, -171.0, 172.0)):
        assert not equator_equilibria(ELinear(*plane[:3], plane[3:])).symmetric
    assert not equator_equilibria(ELinear(1, 0, 2, (0.1, 0.1))).symmetric
    assert not equator_equilibria(ELinear(1, 0.5, 2, (0.1, 0.0))).symmetric
    assert not equator_equilibria(ELinear(1, 0.5, 2, (0.0, 0.1))).symmetric
    assert equator_equilibria(ELinear(1, 0.0, 2, (0.0, 0.1))).symmetric
    fourfold = equator_equilibria(ELinear(0, 1.5, 1, (2**0.5, -(2**0.5))))
    assert fourfold.kind(0).endswith("fourfold zero")
    weakly = equator_equilibria(ELinear(1.0, 0.0, 1.5, (0.5, 0.0)))  # the paper's pitchfork, backward
    assert [weakly.kind(i).endswith("weakly attracting") for i in range(2)].count(True) == 1


def test_sentences_count_from_one():
    found = equator_equilibria(ELinear(1, 0, 2, (0.5, 0)))
    assert [found.sentence(i).split()[0] for i in range(4)] == ["Q₁", "Q₂", "Q₃", "Q₄"]
    assert (
        equator_equilibria(ELinear(-1, 5, -1, (3, 4))).summary == "1 equilibrium on the equator, 1 of them degenerate."
    )


def test_case_iii_claims_of_sliding_only_what_the_limit_does():
    """Random portraits of Case III: the sentence against what arrives and where the layer problem leads."""
    draw = np.random.default_rng(3)
    seen = set()
    while len(seen) < 3:
        a, d = draw.uniform(0.2, 3), -draw.uniform(0.2, 3)
        system = ELinear(a, draw.choice((-1, 1)) * draw.uniform(1, 2) * np.sqrt(-a * d), d, draw.uniform(-2, 2, 2))
        found = classify(system, psi.constant())
        if found.case != "III" or "is a stable" not in found.sentence:
            continue
        assert "stable sliding along Σ" not in found.sentence
        equator, cycle = equator_equilibria(system), equator_cycle(system)
        arrives = bool((equator.lambda_rho < 0).any()) if len(equator) else cycle is not None and cycle.exponent < 0
        assert ("nothing reaches Σ" in found.sentence) == (not arrives)
        outcomes = approach_outcomes(system, psi.constant(), compare=())
        assert any(o.arrives != "nothing" for o in outcomes) == arrives
        seen.add((arrives, bool(len(equator))))


@pytest.mark.parametrize("plane", [(1, 2, -1, 0, 0), (0, 1, 0, 0, 0), (0, 1, 0, 0.3, 0)])
def test_a_true_centre_is_called_no_bifurcation(plane):
    (degeneracy,) = [d for d in said(*plane).degeneracies if d.name == "tr J = 0"]
    assert "a centre of the layer problem" in degeneracy.sentence
    assert "stable is decided" not in degeneracy.sentence


def test_outcomes_say_only_what_happens_at_their_direction():
    for system in (ELinear(-1, 0, -1, (1.2, 0.0)), ELinear(1, 0.3, -1, (0.2, 0.1)), ELinear(-0.3, 0, -1, (0.5, 0))):
        outcomes = approach_outcomes(system, psi.constant())
        equator = outcomes.equator
        for i, outcome in enumerate(outcomes.directions):
            if equator.lambda_rho[i] > 0 and equator.lambda_theta[i] > 0:
                assert "nothing tends to it" in outcome.reason
            elif equator.lambda_rho[i] > 0:
                assert "what turns towards it leaves" in outcome.reason
            elif equator.lambda_theta[i] > 0:
                assert "turn to the next" in outcome.reason


def test_at_the_saddle_node_every_angle_arrives():
    (outcome,) = approach_outcomes(ELinear(-1, 1, -1, (1, 0)), psi.constant())
    assert outcome.arrives == "one side"
    assert "from every angle" in outcome.reason


def limits(rho, neutral=(), proven=True):
    k = len(rho)
    return EquatorEquilibria(
        np.linspace(0.1, 6.0, k),
        np.array(rho, float),
        np.ones(k),
        np.ones(k, np.int64),
        np.isin(np.arange(1, k + 1), neutral),
        False,
        k,
        np.inf,
        False,
        proven,
    )


@pytest.mark.parametrize(
    ("rho", "neutral", "words"),
    [
        ([-0.5], (), "1 limit direction: trajectories reach Σ along it."),
        ([0.5], (), "1 limit direction: trajectories leave Σ along it."),
        ([-0.5, -2.0], (), "2 limit directions: trajectories reach Σ along them."),
        ([0.5, 2.0, 0.2], (), "3 limit directions: trajectories leave Σ along them."),
        ([-0.5, 0.5, 0.2], (), "3 limit directions: trajectories reach Σ along 1 and leave it along 2."),
        ([-0.5, -0.5, 0.2], (), "3 limit directions: trajectories reach Σ along 2 and leave it along 1."),
        ([-0.5, -0.5, 0.0], (3,), "3 limit directions: trajectories reach Σ along 2 of them. Q₃ is radially neutral"),
        ([0.0, 0.5, 0.0], (1, 3), "3 limit directions: trajectories leave Σ along 1 of them. Q₁ and Q₃ are radially n"),
        ([1e-3, 0.5], (1,), "2 limit directions: trajectories leave Σ along 1 of them. Q₁ is radially neutral"),
        ([0.0, 0.0], (1, 2), "Limit directions: 2. Q₁ and Q₂ are radially neutral"),
    ],
)
def test_what_directions_do(rho, neutral, words):
    assert directions(limits(rho, neutral), None).startswith(words)
    assert ("neutral" in directions(limits(rho, neutral), None)) == bool(neutral)
    unproved = directions(limits(rho, neutral, proven=False), None)
    assert "that there are no more is not proved" in unproved
    assert "that there are no more is not proved" not in directions(limits(rho, neutral), None)


def test_what_is_said_without_directions():
    assert directions(limits([], proven=False), None).startswith("No limit direction was found")
    assert directions(limits([]), None) == "No limit directions: the equator is a closed orbit."
    for exponent, words in ((-0.3, "attracts outside"), (0.3, "repels outside"), (0.0, "is a closed orbit.")):
        cycle = replace(equator_cycle(ELinear(-1, 1, -1)), exponent=exponent)
        assert words in directions(limits([]), cycle)


@pytest.mark.parametrize(
    ("kind", "several"),
    [
        ("stable focus", "3 stable foci"),
        ("saddle", "3 saddles"),
        ("saddle-node", "3 saddle-nodes"),
        ("centre (linear)", "3 centres (linear)"),
        ("unstable node", "3 unstable nodes"),
        ("degenerate", "3 degenerate"),
    ],
)
def test_kinds_are_counted_in_words(kind, several):
    assert classify_typed._counted(1, kind) == f"1 {kind}"
    assert classify_typed._counted(3, kind) == several


@pytest.mark.parametrize(("power", "name"), [(2, "saddle-node"), (4, "quadruple zero"), (5, "zero of multiplicity 5")])
def test_a_zero_of_theta_is_named_by_its_multiplicity(power, name):
    """U = -e + s^power times e turned: Theta = s^power."""
    (found,) = classify(System(U=(f"-c - s*s**{power}", f"-s + c*s**{power}")), psi.constant()).degeneracies
    assert found.name == name
    assert 0.0 < found.within < 1e-9
    assert power != 5 or "5 " in found.sentence
    for change, named in ((0.5 * found.within, True), (100.0 * found.within, False), (1e-4, False)):
        near = System(U=(f"-c - s*(s**{power} + {change!r})", f"-s + c*(s**{power} + {change!r})"))
        assert (name in [d.name for d in classify(near, psi.constant()).degeneracies]) == named, change


@pytest.mark.parametrize(
    ("U", "words"),
    [
        (("(c - 1)*(2 + s)", "s"), "No isolated critical set inside."),  # one on the equator
        (("(c - s)*(2 + c)", "(c - s)*(3 + s)"), "No isolated critical set inside."),  # a curve
        (("c*s - s*c", "0*c*s"), "No isolated critical set inside."),
        (("c*s + 2", "s"), "There is no critical set."),
        (("c**2 - 1/4", "-s"), "Critical sets: 1 saddle, 1 stable node. There is one way to slide stably along Σ."),
        (("c**2 - 1/4", "s"), "Critical sets: 1 saddle, 1 unstable node. None is stable"),
        (("-c*(c**2 - 1/4)", "-s"), "1 saddle, 2 stable nodes. There are 2 ways to slide stably along Σ"),
    ],
)
def test_what_is_said_of_several_critical_sets(U, words):
    assert words in classify(System(U=U), psi.constant()).sentence
