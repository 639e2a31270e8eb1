"""Points of the bifurcation curves in 50 digits: how far the function that vanishes there is from zero.

The unit is what one rounding of a, b, d, f1, f2 does to that function.
"""

import mpmath as mp
import numpy as np
import pytest

from codim2_core import psi
from codim2_core.portrait.layer_problem.lyapunov import psi_derivatives

from .reference import DIGITS, regularisation

FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.hill(0.7)]


@pytest.mark.parametrize("family", FAMILIES, ids=lambda p: p.text)
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
