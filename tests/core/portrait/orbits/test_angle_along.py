"""The angle along a curve: that of a spiral by its formula, and kept where the curve is rounding about the middle."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.portrait.orbits.in_time import angle_along


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0), st.integers(2, 60))
def test_a_spiral_turns_by_its_formula(first, rate, count):
    turned = first + rate * np.arange(count)
    radius = np.exp(-0.1 * np.arange(count))
    angle = angle_along(np.column_stack([radius * np.cos(turned), radius * np.sin(turned)]), 1e-6)
    assert angle - angle[0] == pytest.approx(turned - turned[0], abs=1e-9)
    assert np.cos(angle[0] - first) == pytest.approx(1.0)


def test_a_disc_at_rest_does_not_turn_in_the_picture():
    """For eps > 0 it stays about (0, 0) once it rests: the angle climbed there by whole turns."""
    from codim2_app.picture.slow_layers.typed_start import RTOL, curves

    system = c2.examples.spinning_disc()
    for run in (
        c2.simulate(system, c2.psi.constant(), (1.0, 0.4), (0.0, 1.0), eps=0.01, rtol=RTOL),
        c2.simulate_nonsmooth(system, (1.0, 0.4), (0.0, 1.0), psi=c2.psi.constant(), rtol=RTOL),
    ):
        angle = np.array(curves(run)["states"][2])
        assert np.abs(np.diff(angle)).max() < 0.5
        assert 0.99 < angle[-1] < 0.5001 * np.pi  # from its limit direction to that in which C draws it
