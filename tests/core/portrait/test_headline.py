"""The sentence of a portrait names all that attracts, critical sets and limit cycles, and nothing that does not."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import psi
from codim2_core.results.words import count_word, written_label

from ...words.recognition import recognise

FAMILIES = (psi.constant(), psi.rational(), psi.hill(3.0), psi.tanh(), psi.exponential())


def held(system, family, z=()):
    """Hold what a sentence says of attractors to those that are computed; return how many of them are cycles."""
    critical, cycles = c2.critical_sets(system, family, z), c2.limit_cycles(system, family, z)
    said = c2.classify(system, family, z)
    text = said.sentence.partition(". ")[2] if said.name.startswith(("CM", "NCM")) else said.sentence
    keys = dict(recognise(text))
    for kind in ("stable", "semistable"):
        some = [cycle for cycle in cycles if cycle.kind == kind]
        told = [fields for key, fields in recognise(text) if key.startswith(f"{kind} cycle")]
        assert sum(int(fields.get("count", 1)) for fields in told) == len(some), text
        for fields in told:
            assert surrounded(critical, some, fields["sets"]) >= int(fields.get("count", 1)), text
    stable = sum(C.kind.startswith("stable") for C in critical)
    if said.case or not critical or "sets unproved" in keys:
        assert all(C.kind in said.sentence for C in critical), text
        return len(cycles)
    ways = stable + sum(cycle.stable for cycle in cycles)
    assert bool({"none stable", "not stable"} & keys.keys()) == (stable == 0), text
    assert ("one stable" in keys) == (stable == ways == 1), text
    if stable and ways > 1:
        assert keys["several stable"]["count"] == count_word(ways), text
    return len(cycles)


def surrounded(critical, cycles, sets):
    """Count the cycles about just these sets: their names stand in the sentence."""
    labels = ["C"] if len(critical) == 1 else [written_label(f"C{i + 1}") for i in range(len(critical))]
    wanted = [C.p for C, label in zip(critical, labels, strict=True) if label in sets.replace(" and", ",").split(", ")]
    assert wanted
    return sum(sum(inside(p, cycle.points) for p in wanted) == len(wanted) for cycle in cycles)


def inside(p, points):
    """Cast a ray."""
    (x0, y0), (x1, y1) = points[:-1].T, points[1:].T
    crossed = (y0 > p[1]) != (y1 > p[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.count_nonzero(crossed & (p[0] < x0 + (p[1] - y0) * (x1 - x0) / (y1 - y0))) % 2 == 1


@pytest.mark.parametrize("seed", range(10))
def test_of_random_elinear_systems(seed):
    random = np.random.default_rng(seed)
    cycles = 0
    for _ in range(50):
        a, d = random.uniform(0.2, 2.0) * np.array([1.0, -random.uniform(0.6, 1.5)])
        b, family = random.uniform(1.2, 2.5) * math.sqrt(-a * d), FAMILIES[random.integers(len(FAMILIES))]
        cycles += held(c2.ELinear(a, b, d, tuple(random.uniform(-1.0, 1.0, 2))), family)
    assert cycles > 0


@pytest.mark.parametrize("seed", range(40))
def test_of_random_general_systems(seed):
    random = np.random.default_rng(100 + seed)
    for _ in range(2):
        k = random.uniform(-1.0, 1.0, 12).round(3)
        U = (
            "({})*c+({}-1.2)*s+({})*c*c+({})*c*s+({})*s*s+({})*c**3".format(*k[:6]),
            "({}+1.2)*c+({})*s+({})*c*c+({})*c*s+({})*s*s+({})*s**3".format(*k[6:]),
        )
        held(c2.System(U=U, W=()), FAMILIES[random.integers(3)])
