"""The first, short step away from Sigma."""

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.motion.initial_value.kernels.slow import FAST_START, TILT, leave

from .placing import placed


@pytest.mark.parametrize("faster", [0.0, 0.7])
def test_a_way_out_turns_as_the_field_outside_and_z_make_it(faster):
    """lambda_rho = 1 and lambda_theta = -3 at n = (0.6, 0.8): theta' = t.(D_x U n + D_z U W)/4 along the way.

    It is short against the time in which lambda_rho, which changes at n.(D_x U n + D_z U W), becomes another.
    """
    M, N, W = np.array([[0.7, -1.1], [0.4, 1.3]]), np.array([[0.5, -0.8], [-0.3, 0.9]]), np.array([2.0, -1.5])
    outward = np.array([0.6, 0.8])
    N += np.outer(outward, W) * (faster - outward @ (M @ outward + N @ W)) / (W @ W)
    U = [
        f"{n} + {-2.0 * t}*(-0.8*c + 0.6*s) + {M[i, 0]}*x + {M[i, 1]}*y + {N[i, 0]}*z1 + {N[i, 1]}*z2"
        for i, (n, t) in enumerate(((0.6, -0.8), (0.8, 0.6)))
    ]
    S, linear, square = placed(System(U=U, W=("2", "-1.5")), (0.0, 0.0)), np.empty(4), np.empty(4)
    theta, n, t = math.atan2(0.8, 0.6), np.array([0.6, 0.8]), np.array([-0.8, 0.6])
    turning = t @ (M @ n + N @ W) / 4.0
    h = leave(S, 2, 0.0, 0.0, theta, 1e9, linear, square)
    expected = FAST_START / faster if faster else TILT / abs(turning)
    assert h == pytest.approx(expected, rel=1e-9)
    np.testing.assert_allclose(linear[:2] / h, n + t * turning * h, atol=1e-10)
    np.testing.assert_allclose(linear[2:], W * h, rtol=1e-12)
    np.testing.assert_array_equal(square, 0.0)
