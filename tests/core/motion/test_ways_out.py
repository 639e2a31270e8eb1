"""The ways off Sigma: limit directions that repel radially and attract along the equator, however slowly."""

import math

from hypothesis import given
from hypothesis import strategies as st

from codim2_core.layer_problem.equator import equator_equilibria
from codim2_core.motion.limit.decide import _ways_out
from codim2_core.systems.elinear import ELinear

rates = st.floats(-0.9, 0.9).filter(lambda rate: abs(rate) > 1e-3)


@given(rates, rates, rates)
def test_ways_out_are_told_by_both_signs(a, d, f1):
    # U = (a c + f1, d s): on the axis lambda_rho = a +- f1 and lambda_theta = d - a -+ f1, at theta = 0 and pi.
    if min(abs(rate) for rate in (a + f1, a - f1, d - a - f1, d - a + f1)) < 1e-3:
        return
    equator = equator_equilibria(ELinear(a, 0.0, d, (f1, 0.0)))
    ways = {round(math.cos(equator.theta[i]), 9) for i in _ways_out(equator)}
    for c, rho, theta in ((1.0, a + f1, d - a - f1), (-1.0, a - f1, d - a + f1)):
        assert (c in ways) is (rho > 0.0 > theta)
    beside = -f1 / (a - d) if a != d else 2.0  # where a c + f1 = d c: |beside| < 1 gives two more
    if abs(beside) < 1.0 - 1e-6:
        # There lambda_rho = d, and lambda_theta = (a - d) sin^2 theta.
        assert (round(beside, 9) in ways) is (d > 0.0 > a - d)
    assert len(ways) <= 3
