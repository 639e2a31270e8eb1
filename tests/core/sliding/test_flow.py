"""The sliding flow: W where U vanishes, in the shape that each kind of system has."""

import numpy as np
import pytest

import codim2_core as c2


def test_a_typed_system_has_a_row_for_each_critical_set():
    """c' = c^2 - z/2 vanishes at c = -+sqrt(z/2); an affine U has one zero, here e = -A^-1 f."""
    bent = c2.System(U=("c**2 - z/2", "-s"), W=("3*c + 1",))
    np.testing.assert_allclose(np.sort(c2.sliding_flow(bent, 0.5)[:, 0]), [-0.5, 2.5], rtol=0.0, atol=1e-12)
    assert c2.sliding_flow(bent, -0.5) is None
    affine = c2.System(U=("-2*c + z", "-s - c"), W=("c",))
    assert c2.sliding_flow(affine, 0.8).tolist() == [[pytest.approx(0.4)]]
    assert c2.sliding_flow(affine, 3.0) is None


def test_an_e_linear_system_has_one_vector():
    system = c2.ELinear(-2.0, 0.0, -1.0, ("z", 0.1), B=((1.0, 0.0), (0.0, 2.0)), g=(1.0, "z"))
    assert c2.sliding_flow(system, (0.8, 0.0)) == pytest.approx(np.array([1.4, 1.0]))
    assert c2.sliding_flow(system, (3.0, 0.0)) is None
