"""Names of general portraits: counts, degeneracies, and the e-linear name where the field is affine."""

import numpy as np
import pytest
from hypothesis import given, settings

import codim2_core as c2
from codim2_core import classify, psi
from codim2_core.portrait.layer_problem.disc_zeros import disc_zeros
from codim2_core.portrait.layer_problem.problem import LayerProblem
from codim2_core.systems.typed import System
from tests.core.general_systems import ATTRACTING, NONUNIQUE, polynomials
from tests.core.strategies import regularisations

from ...words.recognition import recognise

RATIONAL = psi.rational()


def names(*U, **parameters):
    return [d.name for d in classify(System(U=U, parameters=parameters), RATIONAL).degeneracies]


def test_names_of_the_examples():
    found = classify(ATTRACTING, RATIONAL, 0.4)
    assert found.case is None
    assert found.name == "2 critical sets, 6 limit directions"
    assert found.degeneracies == ()
    assert "reach Σ along five and leave it along the other" in found.sentence
    assert "Sliding along Σ is stable." in found.sentence
    assert classify(NONUNIQUE, RATIONAL, 0.4).name == "3 critical sets, 8 limit directions"
    assert "stable in two ways" in classify(NONUNIQUE, RATIONAL, 0.4).sentence
    assert classify(NONUNIQUE, RATIONAL, 1.0).name == "3 critical sets, 4 limit directions"


@given(polynomials, regularisations)
@settings(max_examples=10)
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
    assert problem.equator.summary.endswith("no others.") != problem.equator.proven


@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_next_to_a_pitchfork_rounding_makes_no_limit_directions(side):
    """sec:nonunique: 8 limit directions, or 4; within rounding two triple zeros. No more, unless called unproved."""
    for distance in np.geomspace(1e-13, 1e-7, 60):
        equator = c2.equator_equilibria(c2.examples.nonunique_sliding(), (2**-0.25 + side * distance,))
        count = len(equator) if distance > 3e-9 or equator.proven else 4
        assert count in ((8, 4) if side < 0 else (4, 5))
        if distance < 3e-11:
            assert equator.multiplicity.tolist() == [3, 1, 3, 1]
