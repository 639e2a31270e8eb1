"""Numbers as they are written in a sentence: also those that have no end."""

import math

import pytest

import codim2_core as c2
from codim2_core.words.written import number, power


@pytest.mark.parametrize(("value", "text"), [(1.6e-16, "1.6 · 10⁻¹⁶"), (2.5e17, "2.5 · 10¹⁷"), (math.inf, "∞")])
def test_a_power(value, text):
    assert power(value) == text


@pytest.mark.parametrize(("value", "text"), [(-0.25, "−0.25"), (1e-13, "0"), (-math.inf, "−∞"), (math.inf, "∞")])
def test_a_number(value, text):
    assert number(value) == text


def test_a_matrix_without_a_condition_number_is_told():
    claims = c2.certificates(c2.ELinear(0.0, 5.963088623574436e-38, 1.0, (0.0, 0.0)), c2.psi.constant())
    assert any("The condition number of A is ∞" in claim.sentence for claim in claims)
