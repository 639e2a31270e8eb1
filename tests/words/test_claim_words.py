"""What is said of the paper's claims is so on the system at hand: counts by nets, kinds by orbits, means by sums."""

import dataclasses

import pytest
from hypothesis import given, settings

import codim2_core as c2
from codim2_core import ELinear, System, psi
from codim2_core.portrait.theorems.certificates import certificates
from codim2_core.results.words import ROOMS, recognise
from tests.core.strategies import regularisations, systems

from .claim_case import HILL, ONE, Case
from .claim_checks import ATTRACTING, BALL, CHECKS, NONUNIQUE

CYCLING = dataclasses.replace(c2.presets["case3-n3"].system, B=((1.0, 0.0),), g=(0.1,))
CASES = {
    "case1(a)": (ELinear(-1, 0.3, -1.6, (0.2, 0.1)), HILL),
    "case1(a), backwards": (ELinear(1, 0.3, 1.6, (0.2, 0.1)), ONE),
    "case1(b)": (ELinear(-1, 0.3, -1.6, (2.2, 0.1)), ONE),
    "case2(a)": (ELinear(1, 0.3, -1.6, (0.2, 0.1)), ONE),
    "case2(b)": (ELinear(1, 0.3, -1.6, (2.2, 0.1)), HILL),
    "geneps0(c)": (ELinear(-1, 3, -1.2, (0.2, 0.1)), ONE),
    "all are equilibria": (ELinear(-1, 0, -1), ONE),
    "border of existence": (ELinear(-1, 0, -1, (1, 0)), ONE),
    "none, on a border": (ELinear(-1, 0, -4, (-3, 0)), ONE),
    "no inverse": (ELinear(-1, 0, 0, (0.3, 0.2)), ONE),
    "D1, here": (ELinear(-1, 0.5, -1, (0.3, 0.9)), ONE),
    "D2, here": (ELinear(-1, 0, -2, (0.3, 0)), ONE),
    "D2, at the pitchfork": (ELinear(-1, 0, -1.5, (-0.5, 0)), ONE),
    "rotated": (System(U=("-c/2 + s - 0.1", "-s - c/3")), ONE),
    "U not e-linear": (System(U=("-c**3 + s/2", "-s")), ONE),
    "ball sticks": (BALL, ONE, (0.3, 0.2)),
    "ball slips": (BALL, ONE, (40.0, 3.0)),
    "within a third": (ATTRACTING, ONE, (0.3,)),
    "two slow flows": (NONUNIQUE, ONE, (0.2,)),
    "two slow flows, four directions": (NONUNIQUE, psi.tanh(), (1.2,)),
    "elsewhere in the chart": (ELinear(-1, 0.3, -1.6, (0.2, "0.1 + z/3"), B=((1, 2),), g=(0.2,)), HILL, (0.1,)),
    "all combinations agree": (ELinear(-1, 0.3, -1.6, (0.2, 0.1), B=((1, 2),), g=(0.2,)), ONE, (0.1,)),
    "W not e-linear": (System(U=("-c", "-s"), W=("c**2",)), ONE, (0.1,)),
    "mean is that of C": (CYCLING, HILL, (0.0,), True),
    "no cycle there": (ELinear(-1, 0.3, -1.6, (0.2, 0.1)), ONE, (), True),
    "not hyperbolic": (ELinear(0, 2, 0, (0.3, 0.1), B=((1, 2),)), ONE, (0.0,)),
    "condition number": (ELinear(1.0, 1.0, -1.0 + 1e-13, (0.3, 0.1)), ONE),
}


def elsewhere(*_):
    """What is true of all Psi, or of an example, is held where these are."""


def hold(system, family, z=(), cycles=False):
    found = c2.limit_cycles(system, family, z) if cycles else None
    case = Case(system, family, z, None if found is None else tuple(found))
    keys = set()
    for certificate in certificates(system, family, z, cycles=found):
        told = [certificate.sentence]
        if certificate.verdict.value == "holds":
            told.append(certificate.statement)
        for text in told:
            for key, fields in recognise(text):
                if key in ROOMS["claims"]:
                    CHECKS.get(key, elsewhere)(case, fields)
                    keys.add(key)
    return keys


@pytest.mark.parametrize("key", CASES)
def test_of_the_claims(key):
    assert key.split(", back")[0].split(", four")[0] in hold(*CASES[key])


@settings(max_examples=3)
@given(systems, regularisations)
def test_of_random_systems(system, family):
    assert hold(system, family)


@pytest.mark.parametrize("name", c2.presets)
def test_of_every_portrait(name):
    preset = c2.presets[name]
    assert hold(preset.system, preset.psi, preset.z)
