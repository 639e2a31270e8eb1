"""A family of Psi is one file and one line: one from a temporary folder is used through the public API."""

import math
import pickle

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.families.first_lyapunov import psi_derivatives
from codim2_core.formulas.expression import parse
from codim2_core.portrait.layer_problem.vary import limits, names, value_of, vary
from codim2_core.systems.psi import FAMILIES, Family, make, register, unregister
from codim2_core.systems.psi.constructors import comparison_families

from ...additions import added_family

CASE3 = c2.ELinear(172, 186, -200, f=(-86, -93))


def at_hopf(psi):
    """Case III with f on the Hopf curve of this Psi."""
    (curve, *_) = c2.bifurcations.hopf(c2.ELinear(CASE3.a, CASE3.b, CASE3.d), psi).branches
    return c2.ELinear(CASE3.a, CASE3.b, CASE3.d, f=tuple(curve[len(curve) // 3]))


@pytest.fixture
def family(tmp_path):
    with added_family(tmp_path) as added:
        yield added


@pytest.mark.parametrize("name", [name for name in FAMILIES if name != "custom"])
def test_kernel_gain_derivatives_and_formula_of_a_family_say_the_same(name):
    record = FAMILIES[name]
    for value in (0.0,) if record.parameter is None else (*record.compared, 1.5):
        psi = make(name, value) if record.parameter else make(name)
        formula = parse(psi.text, ("s",))
        s = np.array([0.03, 0.4, 1.0, 2.5, 7.0])
        np.testing.assert_allclose(psi(s), formula.evaluate({"s": s}), rtol=1e-12)
        for own in psi_derivatives(psi, s):
            formula = formula.derivative("s")
            np.testing.assert_allclose(own, formula.evaluate({"s": s}), rtol=1e-6, atol=1e-9)
        assert record.gain is not None
        whole = record.uses_gain_whole(value) and record.gain_whole is not None
        for w in (0.05, 0.4, 1.0):
            for r2 in (0.1, 0.7, 1.3):
                exact = 1.0 / math.sqrt(r2 + w * w * psi(r2 / w**2))
                assert record.gain(r2, w, value) == pytest.approx(exact, rel=1e-12)
                assert not whole or record.gain_whole(r2, w, int(value)) == pytest.approx(exact, rel=1e-12)


def test_an_added_family_is_listed_and_made_everywhere(family):
    assert list(FAMILIES)[-2:] == ["power", "custom"]
    psi = c2.psi.power(3.0)
    assert psi == make("power", 3)
    assert (psi.family, psi.parameter, psi.text) == ("power", 3.0, "(1+s/3)**(-3)")
    assert make("power").parameter == 2.0
    assert pickle.loads(pickle.dumps(psi)) == psi
    assert psi.check().holds
    assert make("power", 2.0) in comparison_families()
    with pytest.raises(ValueError, match=r"k is 60; allowed is 0.5 <= k <= 50"):
        c2.psi.power(60)
    with pytest.raises(ValueError, match="there is a family 'power' already"):
        register(family)


def test_an_added_family_varies_by_its_parameter(family):
    psi = c2.psi.power(3.0)
    assert names(CASE3, psi)[-1] == "k"
    assert vary(CASE3, psi, (), "k", 4.0)[1] == c2.psi.power(4.0)
    assert value_of(CASE3, psi, (), "k") == 3.0
    assert limits(CASE3, psi, "k") == (0.5, 50.0)
    found = c2.bifurcations.parameter_changes(at_hopf(psi), psi)
    assert [change.n for change in found if change.type == "Hopf"] == [pytest.approx(3.0, rel=1e-6)]


def test_what_cannot_be_registered():
    with pytest.raises(ValueError, match="family is of type str"):
        register("power")
    with pytest.raises(ValueError, match="the family's name is 'a b'"):
        register(Family("a b", "1", "1"))
    with pytest.raises(ValueError, match="has no formula"):
        register(Family("nothing", "1", ""))
    with pytest.raises(ValueError, match="cannot read"):
        register(Family("wrong", "1", "1/(1+q)"))
    with pytest.raises(ValueError, match="'hill' is built in"):
        unregister("hill")
    with pytest.raises(AttributeError, match="no attribute 'power'"):
        c2.psi.power  # noqa: B018


@pytest.mark.parametrize(
    ("text", "psi"),
    [
        ("constant", c2.psi.constant()), ("tanh", c2.psi.tanh()), ("hill:3", c2.psi.hill(3)), ("hill", c2.psi.hill(2)),
        (" tanh ", c2.psi.tanh()), (" 1", c2.psi.constant()),
        ("1/(1+s)**2", c2.psi.custom("1/(1+s)**2")),
    ],
)  # fmt: skip
def test_a_psi_by_its_text(text, psi):
    assert c2.psi.from_text(text) == psi
    system = c2.ELinear(172, 186, -200, (-86, -93))
    assert c2.classify(system, text) == c2.classify(system, psi)
    assert c2.Scene(system, text).psi == psi


def test_a_family_without_a_parameter_is_given_none():
    with pytest.raises(ValueError, match="tanh has no parameter"):
        c2.psi.from_text("tanh:3")
