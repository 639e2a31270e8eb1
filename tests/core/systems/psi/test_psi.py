"""Psi and e_Psi against 50-digit arithmetic, and R1 to R5."""

import math
import pickle

import mpmath
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from mpmath import mpf

from codim2_core import psi as constructors
from codim2_core.systems.psi import FAMILIES
from tests.core.exact_psi import hill, regularisation

ULP = 2.0**-52


# Each Psi with itself and its derivative in mpmath.
PLAIN = ("constant", "rational", "exponential", "tanh")
TYPED = {
    "custom exp": "exp(-s)", "custom square": "1/(1+s)**2", "custom half": "(1+s)/(1+2*s)",
    "custom rising": "1+0.1*sin(s)*exp(-s)",
}  # fmt: skip
MADE = {
    **{name: getattr(constructors, name)() for name in PLAIN},
    **{f"hill {n}": constructors.hill(n) for n in (0.01, 0.3, 1, 1.5, 2, 3, 4, 17.25, 200, 1000)},
    **{name: constructors.custom(text) for name, text in TYPED.items()},
}
EXACT = {name: (psi, *regularisation(psi)) for name, psi in MADE.items()}
EXACT["custom hill"] = constructors.custom("3/(3+(4*s)**40)"), *hill(40)
ALL = pytest.mark.parametrize("name", EXACT)
BUILT_IN = pytest.mark.parametrize("name", [name for name in EXACT if not name.startswith("custom")])
LOG_ZETA = st.floats(-160.0, 8.0)
ZETAS = np.concatenate(
    [10.0 ** np.linspace(-160, -3, 30), 10.0 ** np.linspace(-3, 3, 120), 10.0 ** np.linspace(3, 8, 20)]
)


def kappa(name, zeta) -> float:
    """-s Psi'/Psi, in size: the condition of Psi under a change of s."""
    s = mpf(zeta) ** 2
    _, value, slope = EXACT[name]
    return abs(float(s * slope(s) / value(s)))


@pytest.fixture(autouse=True)
def _fifty_digits():
    with mpmath.workdps(50):
        yield


@ALL
def test_value_and_slope(name):
    psi, exact, slope = EXACT[name]
    s = ZETAS**2
    for x, value, rate in zip(s, psi(s), psi.derivative(s), strict=True):
        if x < 1e-300:  # subnormal
            continue
        k = kappa(name, math.sqrt(x))
        assert value == pytest.approx(float(exact(mpf(x))), rel=(6 + 3 * k) * ULP, abs=1e-300), x
        assert psi(float(x)) == pytest.approx(value, rel=(4 + 2 * k) * ULP, abs=1e-300)
        # the rounding of a typed formula's own terms, and that of a power's exponent
        own = (
            8 * ULP * float(exact(mpf(x))) if name == "custom half" else 0.02 * ULP if name == "custom rising" else 0.0
        )
        tolerance = (30 + 6 * k + 3 * psi.parameter) * ULP
        assert rate == pytest.approx(float(slope(mpf(x))), rel=tolerance, abs=max(own, 1e-290)), x
        assert psi.derivative(float(x)) == pytest.approx(rate, rel=tolerance, abs=max(own, 1e-290)), x


@BUILT_IN
def test_small_and_large_s(name):
    psi, exact, _ = EXACT[name]
    for x in (0.0, 5e-324, 1e-300, 1e-20, 1e20, 1e200, 1e300):
        assert psi(x) == pytest.approx(float(exact(mpf(x))), rel=1e-12, abs=1e-300)
        assert not math.isnan(psi.derivative(x))
        assert psi.derivative(x) <= 0.0
    assert psi(math.inf) == psi.limit
    assert psi(np.array([math.inf, 1.0]))[0] == psi.limit
    n = psi.parameter
    at_zero = {"constant": 0.0, "rational": -1.0, "exponential": -1.0, "tanh": -1 / 3}
    expected = at_zero.get(name, -4 / 3 if n == 1 else 0.0 if n > 1 else -math.inf)
    assert psi.derivative(0.0) == pytest.approx(expected, rel=1e-15)


@ALL
def test_modulus_complement_and_jacobian(name):
    psi, exact, _ = EXACT[name]
    modulus, complement = psi.modulus(ZETAS), psi.complement(ZETAS)
    radial, tangential = psi.jacobian_factors(ZETAS)
    for z, m, c, r, t in zip(ZETAS, modulus, complement, radial, tangential, strict=True):
        s = mpf(z) ** 2
        value, k = exact(s), kappa(name, z)
        length = mpmath.sqrt(s + value)
        share = float(value / (s + value))  # how much of zeta^2 + Psi is Psi
        assert m == pytest.approx(float(z / length), rel=(4 + 3 * k * share) * ULP)
        assert c == pytest.approx(share, rel=(8 + 3 * k) * ULP, abs=1e-300)
        assert t == pytest.approx(float(1 / length), rel=(4 + 3 * k * share) * ULP)
        reference = float((value - s * EXACT[name][2](s)) / length**3)
        # where Psi rises, 1 + kappa cancels; elsewhere it does not
        assert r == pytest.approx(reference, rel=(40 + 8 * k) * ULP, abs=1e-290)
    assert np.isfinite(radial).all()
    assert np.isfinite(tangential).all()
    assert psi.jacobian_factors(0.0) == pytest.approx((1.0, 1.0), rel=1e-15)
    for z in (1e100, 1e160, 1.7e308):
        assert all(math.isfinite(f) and f >= 0.0 for f in psi.jacobian_factors(z))
        assert psi.modulus(z) == 1.0


@ALL
@given(log_zeta=LOG_ZETA)
@example(log_zeta=-160.0)
@example(log_zeta=8.0)
@example(log_zeta=math.log10(0.5))
@settings(max_examples=20, deadline=None)
def test_radius_inverts_modulus(name, log_zeta):
    """Condition: zeta has the relative error of w = m/sqrt(c), divided by 1 + kappa >= 1 where Psi falls."""
    psi, exact, _ = EXACT[name]
    zeta = 10.0**log_zeta
    with mpmath.workdps(50):
        s = mpf(zeta) ** 2
        value = exact(s)
        modulus, complement = mpmath.sqrt(s / (s + value)), value / (s + value)
        k = kappa(name, zeta)
    if complement < 1e-290:
        return  # Psi has underflowed: the saturation that the module documents
    modulus, complement = float(modulus), float(complement)
    allowed = 8 * ULP * (2 + 3 * k) / (1 + k)
    assert psi.radius(modulus, complement) == pytest.approx(zeta, rel=allowed)
    vector = psi.radius(np.array([modulus, 0.5]), np.array([complement, 0.75]))
    assert vector[0] == pytest.approx(zeta, rel=allowed)
    if modulus < 1.0:
        # the modulus alone knows 1 - |e| to half an ulp of 1
        assert psi.radius(modulus) == pytest.approx(zeta, rel=allowed + 4 * ULP / complement / (1 + k))
    # and back through the public functions
    if psi.complement(zeta) > 1e-290:
        assert psi.radius(psi.modulus(zeta), psi.complement(zeta)) == pytest.approx(zeta, rel=2 * allowed)


@ALL
def test_refused_arguments(name):
    psi, *_ = EXACT[name]
    for call in (psi, psi.derivative, psi.modulus, psi.radius, psi.complement, psi.jacobian_factors):
        for bad in (-1e-9, -math.inf, math.nan, [0.5, -0.5], np.array([0.1, math.nan])):
            with pytest.raises(ValueError, match="allowed is"):
                call(bad)
    for bad in (1.0, 1.5, math.inf, [0.5, 1.0]):
        with pytest.raises(ValueError, match=r"0 <= \|e_Psi\| < 1"):
            psi.radius(bad)
    for bad in (0.0, -1e-9, 1.5, math.nan):
        with pytest.raises(ValueError, match="complement"):
            psi.radius(1.0, bad)
    with pytest.raises(ValueError, match="equal shapes"):
        psi.radius([0.1, 0.2], 0.5)
    for call in (psi.modulus, psi.derivative, psi.complement, psi.jacobian_factors):
        with pytest.raises(ValueError, match="inf"):
            call(math.inf)
    with pytest.raises(ValueError, match="give numbers"):
        psi("text")  # type: ignore[arg-type]


@ALL
def test_contract_of_the_family(name):
    psi, *_ = EXACT[name]
    assert psi.family in FAMILIES
    assert psi.family == name.split()[0]
    assert (psi.expression is None) == (psi.family != "custom")
    again = constructors.make(psi.family, psi.parameter, psi.text)
    assert again == psi
    assert hash(again) == hash(psi)
    copy = pickle.loads(pickle.dumps(psi))
    assert copy == psi
    assert copy.radius(0.5) == psi.radius(0.5)
    assert psi.text in repr(psi)
    with pytest.raises(AttributeError):
        psi.text = "2"  # type: ignore[misc]
    check = psi.check()
    assert [c.name for c in check] == ["R1", "R2", "R3", "R4", "R5"]
    assert all((c.where is None) == c.holds and c.sentence for c in check)
    smooth = psi.family != "hill" or psi.parameter.is_integer()
    assert check.R1.holds == smooth
    assert check.R2.holds
    assert check.R3.holds
    assert check.R4.holds == (name != "custom rising")
    assert check.R5.holds == smooth
    assert check.holds == all(check)
