"""(U, W) of a system as one field of all its variables, with its slopes."""

import numpy as np
import pytest

from codim2_core import ELinear, System, examples
from codim2_core.motion.initial_value.field import field

SYSTEMS = [
    examples.ball_in_pool(),
    examples.nonunique_sliding(),
    examples.tilting_block(),
    examples.ball_on_turntable(),
    examples.unit_vector_control(),
    ELinear.from_matrix([[1.0, 2.0], [0.5, -3.0]], (0.1, "z"), B=((1.0, 2.0),), g=("z**2",)),
]


@pytest.mark.parametrize("system", SYSTEMS)
def test_fields_are_those_of_the_system_with_exact_slopes(system):
    formulas, rng = field(system), np.random.default_rng(1)
    for _ in range(5):
        point = rng.uniform(-0.8, 0.8, 4 + system.m)
        at = system.at(tuple(point[4:]))
        expected = np.concatenate([at.U(point[:2], point[2:4]), at.W(point[:2], point[2:4])])
        np.testing.assert_allclose(formulas.value(*point), expected, rtol=1e-13, atol=1e-13)
        slopes = formulas.jacobian(*point[:4], point[4:])
        for j in range(len(point)):
            h = 1e-5 * np.eye(len(point))[j]
            central = (np.array(formulas.value(*(point + h))) - formulas.value(*(point - h))) / 2e-5
            np.testing.assert_allclose(slopes[:, j], central, rtol=1e-8, atol=1e-8)


def test_axes_that_turn_with_z_are_refused():
    with pytest.raises(ValueError, match="turn the axes"):
        field(ELinear.from_matrix([["z", 1.0], [0.0, 1.0]], g=(1.0,)))


@pytest.mark.parametrize("steep", [100, 3000, 1e5])
def test_what_overflows_on_the_way_is_what_ieee_arithmetic_makes_of_it(steep):
    """1/cosh^2 of 1000 is 0, and 1/(1 + exp(1000)) too; what is undefined is so alone."""
    formulas = field(System(U=(f"-c + tanh({steep}*s)/2", f"-s + 1/(1 + exp(-{steep}*c))"), W=("log(z1)",)))
    assert formulas.value(-0.9, 0.5, 0.0, 0.0, 1.0) == pytest.approx((1.4, -0.5, 0.0), abs=1e-12)
    slopes = formulas.jacobian(0.9, 0.5, 0.0, 0.0, [1.0])
    np.testing.assert_allclose(slopes[:, [0, 1, 4]], [[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]], atol=1e-12)
    u, v, w = formulas.value(-0.9, 0.5, 0.0, 0.0, -1.0)
    assert (u, v) == pytest.approx((1.4, -0.5), abs=1e-12)
    assert np.isnan(w)
