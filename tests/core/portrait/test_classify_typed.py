"""Names of general portraits: counts, degeneracies, and the e-linear name where the field is affine."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, given, settings

import codim2_core as c2
from codim2_core import ELinear, classify, equator_equilibria, psi
from codim2_core.layer_problem.disc_zeros import disc_zeros
from codim2_core.layer_problem.problem import LayerProblem
from codim2_core.portrait import classify_typed
from codim2_core.portrait.classification import directions
from codim2_core.systems.typed import System
from codim2_core.words import recognise, say
from tests.core.general_systems import ATTRACTING, NONUNIQUE, polynomials
from tests.core.strategies import regularisations, systems

RATIONAL = psi.rational()


def names(*U, **parameters):
    return [d.name for d in classify(System(U=U, parameters=parameters), RATIONAL).degeneracies]


def test_names_of_the_examples():
    found = classify(ATTRACTING, RATIONAL, 0.4)
    assert found.case is None
    assert found.name == "2 critical sets, 6 limit directions"
    assert found.degeneracies == ()
    assert "reach Σ along 5 and leave it along 1" in found.sentence
    assert "one way to slide stably" in found.sentence
    assert classify(NONUNIQUE, RATIONAL, 0.4).name == "3 critical sets, 8 limit directions"
    assert "2 ways to slide stably" in classify(NONUNIQUE, RATIONAL, 0.4).sentence
    assert classify(NONUNIQUE, RATIONAL, 1.0).name == "3 critical sets, 4 limit directions"


@given(systems, regularisations)
@settings(max_examples=20)
def test_affine_systems_have_the_name_of_the_normal_form(system, regularisation):
    at = system.at()
    a, b, d, f1, f2 = at.plane
    # turned by a right angle: (c, s) -> (s, -c) and the rows likewise
    typed = System(U=(f"({d!r})*c - ({b!r})*s + ({f2!r})", f"({b!r})*c + ({a!r})*s - ({f1!r})"))
    expected = classify(at, regularisation)
    assume(not expected.degeneracies)
    found = classify(typed, regularisation)
    assert (found.case, found.name, found.sentence) == (expected.case, expected.name, expected.sentence)


def test_affine_form():
    system = System(U=("p*c - s + z", "c - 2*s"), W=("-z",), parameters={"p": -1.0})
    form = system.at(0.25).normal_form
    assert (form.plane, form.rotation) == ((-1.0, 1.0, -2.0, 0.25, 0.0), 0.0)  # as it stands
    system = System(U=("p*c - s + z", "2*c - 2*s"), W=("-z",), parameters={"p": -1.0})
    expected = ELinear.from_matrix([[-1.0, -1.0], [2.0, -2.0]], (0.25, 0.0)).at()
    assert system.at(0.25).normal_form.plane == pytest.approx(expected.plane)
    assert System(U=("c**2", "s")).at().normal_form is None
    assert System(U=("c + x", "s")).at().normal_form is None


@given(polynomials, regularisations)
@settings(max_examples=20)
def test_psi_never_changes_the_name(system, regularisation):
    assert classify(system, regularisation).name == classify(system, RATIONAL).name


def test_degeneracies_are_named():
    assert names("-c - s*s**2", "-s + c*s**2") == ["saddle-node"]
    assert names("-c*(c**2 - 1/2)", "-s/2") == ["pitchfork"]
    assert names("-c*(1 + c*s)", "-s*(1 + c*s)") == ["all directions"]
    assert names("2*c**2 - c - 1", "-s") == ["transcritical"]
    assert "fold" in names("c**2", "s - 1/7")
    assert "degenerate critical set" in names("c**3", "s - 1/7")
    assert "curve of equilibria" in names("c*(c - s)", "s*(c - s) + s*(c - s)")
    assert "everything stands still" in names("c - c", "0*s")
    assert "limit directions uncertain" in names("-c/(1 + abs(s)) + 0.1", "-abs(s)*s - c/2")
    assert "critical sets uncertain" in names("c/(1/3 + s) - 1", "exp(c) - 1.2 + s")


def test_neutral_equator_and_hopf():
    neutral = names("-s + c**3*s", "c + c**2*s**2")
    assert "neutral equator" in neutral
    assert "tr J = 0" in neutral
    assert "tr J = 0" not in names("p*c - s + c**2", "c + p*s", p=1e-9)
    assert "tr J = 0" in names("p*c - s + c**2", "c - p*s", p=0.5)


def test_cusp_of_limit_directions():
    """Theta = (theta - t0)^3 (...) without symmetry: sin^3 times something uneven."""
    found = classify(System(U=("-c - s*s**3*(2 + c + s)", "-s + c*s**3*(2 + c + s)")), RATIONAL)
    assert "cusp" in [d.name for d in found.degeneracies]


@pytest.mark.parametrize("k", ["1e-140", "1", "1e140"])
def test_the_unit_of_time_changes_nothing(k):
    assert (
        classify(System(U=(f"{k}*(2*c**2 - c - 1/2)", f"-{k}*s")), RATIONAL).name
        == classify(ATTRACTING, RATIONAL, 0.0).name
    )
    assert "fold" in names(f"{k}*c**2", f"{k}*(s - 1/7)")
    assert names(f"{k}*(-c*(1 + c*s))", f"-{k}*s*(1 + c*s)") == ["all directions"]


WILD = {
    "directions": c2.System(U=("sin(1000000*c) - c", "s")),  # some million zeros of Theta
    "kinks": c2.System(U=("-c/(1 + abs(s)) + 0.1", "-abs(s)*s - c/2")),
    "sets": c2.System(U=("c/(1/3 + s) - 1", "exp(c) - 1.2 + s")),
}


@pytest.mark.parametrize("name", WILD)
def test_what_is_not_proved_is_said_to_be_found(name):
    system = WILD[name]
    problem = LayerProblem(system.at(), c2.psi.tanh())
    sets = disc_zeros(system.at().key)
    found = c2.classify(system, c2.psi.tanh())
    first, second = found.name.split(", ")
    assert not (problem.equator.proven and sets.proven)
    assert (first.endswith(" found"), second.endswith(" found")) == (not sets.proven, not problem.equator.proven)
    unproved = [key for key, _ in recognise(found.sentence) if key.endswith(("unproved", "found"))]
    assert len(unproved) == (not sets.proven) + (not problem.equator.proven)
    assert problem.equator.summary.endswith("not proved.") != problem.equator.proven


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_next_to_a_pitchfork_rounding_makes_no_limit_directions(side):
    """sec:nonunique: 8 limit directions, or 4; within rounding two triple zeros. No more, unless called unproved."""
    for distance in np.geomspace(1e-13, 1e-7, 60):
        equator = c2.equator_equilibria(c2.examples.nonunique_sliding(), (2**-0.25 + side * distance,))
        count = len(equator) if distance > 3e-9 or equator.proven else 4
        assert count in ((8, 4) if side < 0 else (4, 5))
        if distance < 3e-11:
            assert equator.multiplicity.tolist() == [3, 1, 3, 1]


def test_what_follows_from_the_sets_that_are_there():
    def said(*kinds, cycles=0, **what):
        found = {"everything": False, "curve": False, "on_equator": False, "proven": True} | what
        sets = tuple(SimpleNamespace(kind=kind) for kind in kinds)
        return classify_typed.general_consequence(sets, SimpleNamespace(**found), cycles)

    assert said() == say("no critical set")
    assert said(proven=False) == say("no set found")
    for what in ("everything", "curve", "on_equator"):
        assert said(**{what: True}) == say("no isolated set")
    assert said("saddle", "unstable node") == say("none stable", kinds="1 saddle, 1 unstable node")
    assert said("stable node", "saddle", "saddle") == say("one stable", kinds="2 saddles, 1 stable node")
    assert said("stable node", cycles=2) == say("several stable", kinds="1 stable node", count=3)
    assert said("unstable node", cycles=1) == say("none stable", kinds="1 unstable node")
    two = ("stable node", "stable focus", "saddle")
    assert said(*two) == say("several stable", kinds="1 saddle, 1 stable focus, 1 stable node", count=2)
    assert said(*two, proven=False) == say("sets unproved", kinds="1 saddle, 1 stable focus, 1 stable node")


def test_degenerate_zeros_of_the_equator_have_names():
    def named(*multiplicity, **what):
        on = {
            "all_directions": False,
            "arcs": np.zeros((0, 2)),
            "symmetric": False,
            "proven": True,
            "certificate": "Why.",
        }
        on |= {"multiplicity": np.array(multiplicity, int)} | what
        cycle = on.pop("cycle", None)
        return [(d.name, d.sentence) for d in classify_typed._equator(SimpleNamespace(**on), cycle)]

    def names(*multiplicity, **what):
        return [name for name, _ in named(*multiplicity, **what)]

    assert names(1, 1) == names() == []
    assert names(1, 2, 2, 1) == ["saddle-node"]
    assert names(3, 1) == ["cusp"]
    assert names(3, 3, symmetric=True) == ["pitchfork"]
    assert names(2, 3, 4, 1) == ["saddle-node", "cusp", "quadruple zero"]
    assert names(6, 6, 5, symmetric=True) == ["zero of multiplicity 5", "zero of multiplicity 6"]
    assert names(all_directions=True) == ["all directions"]
    assert names(1, arcs=np.array([(1.0, 2.0), (3.0, 4.0)])) == ["arc of directions"] * 2
    assert named(1, 1, proven=False) == [("limit directions uncertain", "Why.")]
    assert names(cycle=SimpleNamespace(neutral=False)) == []
    assert names(cycle=SimpleNamespace(neutral=True)) == [classify_typed.NEUTRAL_CLOSED_EQUATOR.name]


def test_degenerate_sets_have_names():
    def names(*kinds, degenerate=(), rough=(), index=(), **what):
        count = len(degenerate)
        found = {
            "everything": False,
            "curve": False,
            "on_equator": False,
            "proven": True,
            "consistent": True,
            "degree": 1,
        }
        found |= {
            "degenerate": np.array(degenerate, bool),
            "rough": np.array(rough or [False] * count, bool),
            "index": np.array(index or [1] * count, int),
        }
        sets = tuple(SimpleNamespace(kind=kind) for kind in kinds)
        return [d.name for d in classify_typed._critical(sets, SimpleNamespace(**(found | what)))]

    assert names("stable node", "saddle", degenerate=[False, False]) == []
    for what, name in (
        ("everything", "everything stands still"),
        ("curve", "curve of equilibria"),
        ("on_equator", "transcritical"),
    ):
        assert names(**{what: True}) == [name]
    assert names("saddle-node", "saddle", degenerate=[True, False], index=[0, -1]) == ["fold"]
    assert names("degenerate", degenerate=[True]) == ["degenerate critical set"]
    assert names("degenerate", degenerate=[True], rough=[True]) == ["corner at a critical set"]
    assert names("degenerate", "degenerate", degenerate=[True, True], rough=[True, False]) == [
        "degenerate critical set",
        "corner at a critical set",
    ]
    assert names("centre (linear)") == ["tr J = 0"]
    assert names(proven=False) == ["critical sets uncertain"]
    assert names(consistent=False) == ["index mismatch"]
    assert names(consistent=None) == []


def test_arcs_of_limit_directions_are_named_beside_single_ones(monkeypatch):
    nothing = SimpleNamespace(
        everything=False, curve=False, on_equator=False, proven=True, consistent=True,
        degenerate=np.zeros(0, bool), rough=np.zeros(0, bool), index=np.zeros(0, int),
    )  # fmt: skip
    monkeypatch.setattr(classify_typed, "disc_zeros", lambda _: nothing)

    def name(arcs, count):
        on = equator_equilibria(ELinear(-1, 0, -2, (0.2, 0.1)))
        few = {key: getattr(on, key)[:count] for key in ("theta", "lambda_rho", "lambda_theta", "multiplicity")}
        limits = replace(
            on, **few, radially_degenerate=on.radially_degenerate[:count], proven=not arcs,
            arcs=np.array([(0.5 * k, 0.5 * k + 0.1) for k in range(arcs)]).reshape(-1, 2),
        )  # fmt: skip
        found = classify_typed.general_name(SimpleNamespace(key=None), limits, None, ())
        arc_said = say("arc of directions", first=0.0, last=0.1) in directions(limits, None)
        return found.name.removeprefix("no critical set, "), arc_said

    assert name(0, 4) == ("4 limit directions", False)
    assert name(0, 1) == ("1 limit direction", False)
    assert name(1, 0) == ("an arc of limit directions", True)
    assert name(2, 0) == ("2 arcs of limit directions", True)
    assert name(1, 2) == ("2 limit directions found and an arc of them", False)
    assert name(3, 1) == ("1 limit direction found and 3 arcs of them", False)
