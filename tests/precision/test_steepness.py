"""-s Psi'/Psi in 50 digits, and where Psi itself has long underflown."""

import mpmath as mp
import numpy as np
import pytest

from codim2_core import psi

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
