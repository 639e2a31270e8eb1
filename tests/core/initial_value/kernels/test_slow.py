"""The slow flow on a critical set, and the sets themselves."""

from __future__ import annotations

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.compiled import functions_of
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import ends, slow

from .placing import MOVES, TANH, placed


def test_sets_near_points_and_their_slopes():
    own = functions_of(field(MOVES), TANH).addresses
    points = np.array([[0.1, 0.1, 0.4, 2.0], [-0.2, 0.5, -0.7, 1.0]])
    e, D = slow.sets(own[:2].view(float), points)
    np.testing.assert_allclose(e, [[0.4, 0.3], [-0.7, 0.3]], atol=1e-14)
    np.testing.assert_allclose(D, [[[-2.0, 0.7], [-0.9, -1.0]]] * 2, atol=1e-14)
    S = placed(MOVES, (0.4, 2.0))
    assert slow.found_set(S, 2)
    assert ends.determinant(S, 4) == pytest.approx(2.0 + 0.7 * 0.9, abs=1e-14)
    lost = System(U=("z1 - c**2", "-s"))
    e, _ = slow.sets(functions_of(field(lost), TANH).addresses[:2].view(float), np.array([[0.3, 0.0, -0.5]]))
    assert np.isnan(e).all()
