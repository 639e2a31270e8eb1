"""Psi typed as a formula: its conditions R1 to R5, what is refused, and how far it is inverted."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import psi as constructors
from codim2_core.systems.psi.function import Psi


@pytest.mark.parametrize(
    ("text", "fails"),
    [
        ("1/(1+s)**2", {}), ("exp(-s**2)", {}), ("1-tanh(s)", {}), ("2/(1+exp(s))", {}), ("1/cosh(s)", {}),
        ("1/cosh(sqrt(s))", {}), ("1-0.9*tanh(s)", {}), ("1-2/pi*atan(s)", {}), ("1/(1+s**40)", {}),
        ("1/(1+1e6*s)", {}), ("1/(1+1e-6*s)", {}), ("exp(-s)*(1+s)", {}), ("2/(1+s)", {"R2": 0.0}),
        ("1+s/(1+s)", {"R4": 0.0}), ("1/(1+s**1.5)", {"R1": 0.0, "R5": math.inf}),
        ("1/(1+sqrt(s))", {"R1": 0.0, "R5": math.inf}), ("exp(-s**3.5)", {"R1": 0.0}),
        ("1/sqrt(1+s)", {"R5": math.inf}), ("1/(1+log(1+s))", {"R5": math.inf}),
        ("1+s**0.5", {"R1": 0.0, "R4": 0.0, "R5": math.inf}), ("1/(1+s+0.1*abs(s-1))*1.1", {"R1": 1.0}),
        ("exp(1-abs(s-1))", {"R1": 1.0, "R4": 0.0}), ("max(1-s, 0)", {"R1": 1.0, "R3": 1.0}),
        ("(4-s+abs(4-s))/8", {"R1": 4.0, "R3": 4.0}), ("max(1-s, 0)**2", {"R1": 1.0, "R3": 1.0}),
        ("max(1-s, 0.04)", {"R1": 0.96}), ("1+0.2*sin(log(1+s))", {"R4": 0.0, "R5": math.inf}),
    ],
)  # fmt: skip
def test_conditions_of_typed_text(text, fails):
    check = constructors.custom(text).check()
    assert {c.name: c.where for c in check if not c.holds} == pytest.approx(fails, abs=1e-9)


def test_where_psi_begins_to_rise():
    """Psi = 1 - s/(1+s)^2/2 falls up to s = 1 and rises from there."""
    check = constructors.custom("1-0.5*s/(1+s)**2").check()
    assert not check.R4.holds
    assert check.R4.where == pytest.approx(1.0, abs=1e-9)
    assert [c.name for c in check if not c.holds] == ["R4"]


@given(a=st.floats(0.02, 50.0), p=st.integers(1, 6), c=st.floats(0.0, 0.9))
@settings(max_examples=20, deadline=None)
def test_no_false_alarm_in_a_family_that_meets_all(a, p, c):
    psi = constructors.custom(f"{c!r}+(1-{c!r})/(1+{a!r}*s)**{p}")
    assert [x.sentence for x in psi.check() if not x.holds] == []
    assert psi.limit == pytest.approx(c, abs=1e-14)
    m = np.linspace(0.0, 0.9999, 50)
    assert psi.modulus(psi.radius(m)) == pytest.approx(m, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("1-s", "is 0 at s = 1"), ("max(1-s, 0)-max(s-5, 0)", "at s = 1"), ("cos(s)", "at s = 1.5708"),
        ("0", "is 0 at s = 0"), ("-1", "is -1 at s = 0"), ("sqrt(s)", "is 0 at s = 0"), ("1/s", "is inf at s = 0"),
        ("log(s)", "is -inf at s = 0"), ("exp(s)", "is inf at s = 7"), ("s/sinh(sqrt(s))**2", "is nan at s = 0"),
        ("1+s", "rises to 0.707"), ("1+s**2", "rises to"), ("(2+sin(s))/2", "does not rise"),
        ("1+2*exp(-20*(s-1)**2)", "does not rise"), ("1+", "column 3"), ("1/(1+t)", "'t' is not known"),
        ("s.real", "column 2"),
    ],
)  # fmt: skip
def test_unusable_text(text, message):
    with pytest.raises(ValueError, match=r".") as caught:
        constructors.custom(text)
    assert message in str(caught.value)


def test_custom_beyond_the_table():
    psi = constructors.custom("0.5+0.5/(1+s)")
    for zeta in (1e-250, 1e-30, 1e9, 1e30, 1e100):
        assert psi.radius(psi.modulus(zeta), psi.complement(zeta)) == pytest.approx(zeta, rel=1e-13)
    assert isinstance(psi, Psi)
