"""What a whole motion in the limit is put together from, part by part."""

import math

import numpy as np
import pytest

from codim2_core import ELinear, System
from codim2_core.initial_value import compiled_hybrid
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels.hybrid_run import LEAVE, SLIDE, SLIP, WHOLE
from codim2_core.initial_value.line import invariant_line

from .placing import TANH


def _followed(system, first, t_end, rtol=1e-3, most=10000, psi=TANH):
    first, own = np.atleast_2d(np.array(first, float)), field(system)
    lines = [invariant_line(own, state) for state in first]
    return compiled_hybrid.run_hybrid(own, psi, lines, first, (0.0, t_end), rtol, 0.01, most)


def test_without_slow_variables_a_slide_stays_to_the_end():
    """At C, for the time that is left; x and y fall into it along straight lines."""
    rests = ELinear(-1.0, 0.0, -1.0, f=(0.3, -0.2))
    for one in _followed(rests, [(0.6, -0.8), (1.2, 0.5)], 7.0):
        assert one.onward == WHOLE
        last = one.legs[-1]
        assert (last.kind, last.last - last.first) == (SLIDE, 1)
        times, lengths = one.motion.times, one.motion.lengths
        assert times[-1] == 7.0
        assert lengths[-1] == pytest.approx(7.0 - times[-2], abs=1e-14)
        np.testing.assert_array_equal(one.motion(np.linspace(times[-2] + 1e-9, 7.0, 5)), 0.0)
        np.testing.assert_allclose(one.sets[-2:], [[0.3, -0.2]] * 2, atol=1e-14)


def test_a_motion_of_more_phases_than_there_is_room_for_is_whole():
    """C = (1.1 sin z, 0), z' = 6: in each half turn it leaves where C is at the equator, and is soon back."""
    to_and_fro = System(U=("-(c - 1.1*sin(z1))", "-s"), W=("6",))
    (one,) = _followed(to_and_fro, (1e-3, 0.0, 0.0), 4.0, rtol=1e-2)
    kinds = [leg.kind for leg in one.legs]
    assert one.onward == WHOLE
    assert len(kinds) > 12
    assert kinds[:4] == [SLIP, SLIDE, LEAVE, SLIDE]
    times = one.motion.times
    left = [(leg.theta, one.motion.states[leg.first, 2]) for leg in one.legs if leg.kind == LEAVE]
    for theta, z in left:
        assert 1.1 * math.sin(z) == pytest.approx(math.cos(theta), abs=1e-6)
        assert abs(math.sin(theta)) < 1e-9
    np.testing.assert_allclose(one.motion.states[:, 2], 6.0 * times, atol=1e-6)
    assert [leg.first for leg in one.legs[1:]] == [leg.last for leg in one.legs[:-1]]


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
