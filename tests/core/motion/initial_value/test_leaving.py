"""The first step away from Sigma lies on the way out that is known in closed form."""

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.motion.initial_value.field import field
from codim2_core.motion.limit.slip import leave


@pytest.mark.parametrize("bend", [0.3, 5e4, -1e7])
@pytest.mark.parametrize("rate", [0.5, 2.0])
def test_however_fast_its_direction_turns_the_first_step_ends_on_the_way_out(rate, bend):
    """U = (r c, -s + k x): along the way out w = y/x has ``x w' = -(1 + 1/r) w + (k/r) x sqrt(1 + w^2)``.

    So w = q + (k x) q^2/(2 (4 r + 1)) + O(q^5) for q = k x/(2 r + 1).
    """
    out = leave(field(System(U=(f"{rate}*c", f"-s + {bend!r}*x"), W=("1",))), 0.0, 0.0, np.zeros(1), 1000.0)
    assert not isinstance(out, str)
    x, y, z = out.last
    q = bend * x / (2.0 * rate + 1.0)
    assert y / x == pytest.approx(q + 0.5 * bend * x * q * q / (4.0 * rate + 1.0), rel=1e-6, abs=1e-12)
    assert math.hypot(x, y) == pytest.approx(rate * out.h, rel=1e-9)
    assert z == pytest.approx(out.h, rel=1e-12)
    assert out.h > 0.0
