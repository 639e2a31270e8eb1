"""The critical set that a state follows, held against `critical_sets`."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.initial_value.field import field
from codim2_core.motion.followed import followed

SETS = {
    "node": c2.ELinear(-1.0, 0.0, -3.0, (0.2, -0.3)),
    "focus": c2.ELinear(-1.0, 4.0, -1.5, (0.2, -0.3)),
    "saddle": c2.ELinear(1.0, 0.0, -3.0, (0.2, -0.3)),
}


@pytest.mark.parametrize("name", SETS)
def test_its_rate_is_the_largest_modulus_of_its_eigenvalues(name):
    system, psi, eps = SETS[name], c2.psi.rational(), 1e-3
    (C,) = c2.critical_sets(system, psi)
    one = followed(field(system), psi, eps, eps * C.x2)
    assert one is not None
    np.testing.assert_allclose(one.e, C.e, atol=1e-12)
    assert one.rate == pytest.approx(np.abs(C.eigenvalues).max(), rel=1e-9)
    assert one.attracts == C.kind.startswith("stable")
