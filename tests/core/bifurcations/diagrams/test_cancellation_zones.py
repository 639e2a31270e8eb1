"""Diagrams of general systems through a value at which a formula is 0/0, and next to which it is rounding."""

import math

import numpy as np
import pytest
from scipy.optimize import root_scalar

import codim2_core as c2

PSI = c2.psi.constant()
#: (exp(ks) - exp(s))/(k - 1) goes smoothly through k = 1, where it is s exp(s).
REMOVABLE = c2.System(U=("c*((k - 1)**2 + 1e-6)", "(exp(k*s) - exp(s))/(k - 1)"), parameters={"k": 0.5})


@pytest.mark.parametrize("span", [(0.0, 2.0), (0.1, 2.0)], ids=["the pole is asked for", "next to it"])
def test_a_pole_that_is_none_is_passed_and_nothing_next_to_it_is_special(span):
    """lambda_rho dips at k = 1 to 1e-6, so that what may hide is looked for there, where U has no value or is noise.

    Theta vanishes at theta = 3 pi/2 always, and is a pitchfork there where U2 = s (k - 1)^2.
    """
    found = c2.branches(REMOVABLE, PSI, "k", span, with_cycles=False)
    gap = lambda k: (math.exp(-1.0) - math.exp(-k)) / (k - 1.0) - (k - 1.0) ** 2 - 1e-6
    expected = [root_scalar(gap, bracket=part, xtol=1e-14).root for part in ((0.15, 0.9), (1.1, 1.9))]
    forks = [one for one in found.special if one.kind == "pitchfork"]
    others = [one for one in found.special if one.kind != "pitchfork"]
    # at theta = 0 and pi both slopes of U are equal where (k - 1)^2 + 1e-6 = 1
    assert {one.kind for one in others} == {"exchange of limit directions"}
    for one in others:
        assert (one.value - 1.0) ** 2 == pytest.approx(1.0 - 1e-6, abs=1e-12)
        assert one.place[1] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(
        [one.value for one in forks], expected, rtol=0.0, atol=1e-8
    )  # as near as a triple zero is told
    for branch in found.limit_directions:  # nothing breaks off at k = 1
        assert min(abs(branch.value[[0, -1]] - 1.0)) > 0.4
