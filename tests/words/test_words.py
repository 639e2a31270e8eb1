"""Every sentence on a portrait is listed, and held by what it was not made from: motions with and without eps."""

import math

import pytest
from hypothesis import given, settings

import codim2_core as c2
from codim2_core import ELinear, psi
from codim2_core.results.words import power, written_number
from tests.core.strategies import regularisations, systems

from .portrait_checks import CLASSES, OUTCOMES, Portrait
from .recognition import recognise

FEW = 3  # random systems: each is followed by dozens of motions


def held(system, family, z=()):
    """Hold every sentence of a portrait; return their keys."""
    portrait = Portrait(system, family, z)
    said = c2.classify(system, family, z)
    text = said.sentence
    if said.case or text.startswith(("CM", "NCM")):
        text = text.partition(". ")[2]
    for degeneracy in said.degeneracies:  # what a degeneracy says is told next to it once more
        text = text.replace(degeneracy.sentence.partition(" In double")[0], "")
    keys = []
    for key, fields in recognise(text):
        if key in CLASSES:
            CLASSES[key](portrait, fields)
        keys.append(key)
    found = c2.approach_outcomes(system, family, z)
    for outcome in found.directions if found.whole is None else (found.whole,):
        for key, _ in recognise(outcome.reason):
            OUTCOMES[key](portrait, outcome)
            keys.append(key)
    return keys


@pytest.mark.parametrize("name", c2.presets)
def test_of_every_portrait(name):
    preset = c2.presets[name]
    assert held(preset.system, preset.psi, preset.z)


@settings(max_examples=FEW)
@given(systems, regularisations)
def test_of_random_systems(system, family):
    held(system, family)


def test_where_the_way_in_is_long():
    """Within a turn this spiral grows tenfold before it shrinks."""
    assert held(ELinear(3.60161226, 4.86135258, -3.58835332, (2.76897393, 3.23009686)), psi.hill(13))


DEGENERATE = {
    "at rest": (0, 0, 0, (0, 0)),
    "all directions": (-1, 0, -1, (0, 0)),
    "all directions away": (1, 0, 1, (0, 0)),
    "closed equator": (0, 2, 0, (0, 0)),
    "all directions, det A = 0": (-1, 0, 0, (0.3, 0.2)),
    "line of equilibria": (-1, 0, 0, (0.3, 0)),
    "centre": (-1, 3, 1, (0, 0)),
    "centre, f on a diagonal": (1, 2, -1, (0.4, -0.4)),
    "transcritical": (-1, 0, -1, (1, 0)),
    "transcritical, away": (1, 0, 1, (1, 0)),
    "saddle-node": (-1, 1, -1, (1, 0)),
    "saddle-node, away": (1, 1, 1, (1, 0)),
    "pitchfork": (-1, 0, -1.5, (-0.5, 0)),
    "pure f": (0, 0, 0, (1, 0)),
    "away": (1, 1, 1, (0.2, 0)),
    "away, no critical set": (1, 0, 1, (1.4, 0)),
}


@pytest.mark.parametrize("name", DEGENERATE)
def test_of_degenerate_settings(name):
    a, b, d, f = DEGENERATE[name]
    held(ELinear(a, b, d, f), psi.constant())


@pytest.mark.parametrize("z", [0.0, 0.4, 0.84, 1.2])
def test_of_the_papers_nonlinear_systems(z):
    held(c2.examples.nonunique_sliding(), psi.constant(), (z,))
    held(c2.examples.attracting_repelling(), psi.tanh(), (z,))


@pytest.mark.parametrize(
    ("value", "text"),
    [(-6.12e-17, "0"), (1e-13, "0"), (-0.5, "−0.5"), (3e-9, "3 · 10⁻⁹"), (1.5e7, "1.5 · 10⁷"), (-math.inf, "−∞"),
     (math.inf, "∞")],
)  # fmt: skip
def test_numbers_in_sentences(value, text):
    assert written_number(value) == text
    assert [power(v) for v in (1.6e-16, 2.5e17, math.inf)] == ["1.6 · 10⁻¹⁶", "2.5 · 10¹⁷", "∞"]


def test_a_matrix_without_a_condition_number_is_told():
    claims = c2.certificates(c2.ELinear(0.0, 5.963088623574436e-38, 1.0, (0.0, 0.0)), psi.constant())
    assert any("The condition number of A is ∞" in claim.sentence for claim in claims)
