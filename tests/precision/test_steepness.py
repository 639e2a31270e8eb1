"""-s Psi'/Psi in 50 digits, also where Psi itself has long underflown, and three derivatives of Psi."""

import mpmath as mp
import numpy as np
import pytest

from codim2_core import psi
from codim2_core.bifurcations.families.first_lyapunov import psi_derivatives

from .reference import DIGITS, regularisation
from .samples import FAMILIES, STEEP


@pytest.mark.parametrize("family", [*FAMILIES, *STEEP], ids=lambda p: p.text)
def test_steepness(family):
    zeta = np.geomspace(1e-3, 4.0, 15)
    found = family.steepness(zeta)
    value, slope = regularisation(family)
    with mp.workdps(DIGITS):
        for z, k in zip(zeta.tolist(), found.tolist(), strict=True):
            s = mp.mpf(z) ** 2
            exact = -s * slope(s) / value(s)
            assert abs(k - exact) <= (1e-15 * (8 + 4 * family.parameter)) * abs(exact) + mp.mpf(10) ** -290
            assert family.steepness(z) == pytest.approx(k, rel=1e-14 * (1 + family.parameter))


def test_steepness_far_out():
    for n in (0.3, 1, 7.5, 200, 1000):
        for zeta in (1e3 if n > 5 else 1e60, 1e150, 1e300):
            assert psi.hill(n).steepness(zeta) == pytest.approx(n, rel=1e-12)
    assert psi.rational().steepness(1e200) == 1.0
    assert psi.constant().steepness(1e200) == 0.0
    assert psi.tanh().steepness(1e4) == pytest.approx(1e4 - 1.0)
    assert psi.exponential().steepness(30.0) == pytest.approx(900.0)
    for family in FAMILIES:
        assert family.steepness(0.0) == 0.0
        with pytest.raises(ValueError, match="zeta"):
            family.steepness(-1.0)


SMOOTH = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.hill(0.7)]


@pytest.mark.parametrize("family", SMOOTH, ids=lambda p: p.text)
def test_three_derivatives_of_psi(family):
    value, _ = regularisation(family)
    s = np.array([1e-12, 1e-8, 1e-3, 0.07, 0.24, 0.4, 1.3, 5.0, 11.0])
    found = psi_derivatives(family, s)
    with mp.workdps(DIGITS):
        for k in range(3):
            for i, at in enumerate(s.tolist()):
                exact = mp.diff(value, mp.mpf(at), k + 1)
                scale = abs(exact) + abs(value(mp.mpf(at))) * (1 if family.family == "tanh" else 0)
                assert abs(found[k][i] - exact) <= 3e-14 * scale + 1e-300, (k, at)
