"""What a whole motion in the limit is put together from, part by part."""

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value import compiled_hybrid
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.hybrid_run import LEAVE, SLIDE, SLIP, WHOLE
from codim2_core.initial_value.line import invariant_line

from .placing import TANH


def _followed(system, first, t_end, rtol=1e-3, most=10000, psi=TANH):
    first, own = np.atleast_2d(np.array(first, float)), field(system)
    lines = [invariant_line(own, state) for state in first]
    return compiled_hybrid.run_hybrid(own, psi, lines, first, (0.0, t_end), rtol, 0.01, most)


def test_which_of_two_sets_it_slides_on_is_told_with_a_psi_alone():
    two = System(U=("3*c*(0.25 - c**2)", "-4*s + 0*z1"), W=("1",))
    for x, c in ((0.3, 0.5), (-0.3, -0.5)):
        (one,) = _followed(two, (x, 0.05, 0.0), 1.0)
        assert one.onward == WHOLE
        assert [leg.kind for leg in one.legs] == [SLIP, SLIDE]
        np.testing.assert_allclose(one.sets[-1], [c, 0.0], atol=1e-12)
        (one,) = _followed(two, (x, 0.05, 0.0), 1.0, psi=None)
        assert one.onward == SLIP
        assert one.legs == ()


def test_a_slide_ends_at_the_equator_whatever_its_set_does_beyond():
    """C = (2 - sqrt(2 - z), 0) leaves the disc at z = 1, and has a fold at z = 2."""
    system = System(U=("(c - 2)**2 - 2 + z1", "-s"), W=("1",))
    (one,) = _followed(system, (-0.05, 0.0, 0.0), 3.0)
    assert one.onward == WHOLE
    assert [leg.kind for leg in one.legs] == [SLIP, SLIDE, LEAVE]
    assert one.motion.times[one.legs[1].last] == pytest.approx(1.0, abs=1e-9)
    assert one.legs[2].theta == pytest.approx(0.0, abs=1e-9)
    assert one.motion.states[-1, 0] == pytest.approx(2.0, rel=1e-3)  # x' = z - 1
