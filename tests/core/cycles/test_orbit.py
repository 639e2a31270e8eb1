"""The closed orbit as a polynomial on pieces: its collocation."""

import numpy as np
import pytest

from codim2_core.cycles.orbit import gauss


def test_nodes_of_the_collocation_integrate_polynomials():
    c, w, a = gauss()
    for degree in range(12):
        assert w @ c**degree == pytest.approx(1.0 / (degree + 1), abs=1e-15)
    for degree in range(6):
        np.testing.assert_allclose(a @ c**degree, c ** (degree + 1) / (degree + 1), atol=1e-14)
