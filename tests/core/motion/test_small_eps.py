"""The regularised system comes to the nonsmooth limit as eps goes to 0, in the order that the way out says."""

from __future__ import annotations

import numpy as np
import pytest

from codim2_core import ELinear, examples
from codim2_core import psi as families
from codim2_core.motion.nonsmooth import simulate_nonsmooth
from codim2_core.motion.regularised import simulate


def slope(system, psi, state0, t, eps):
    limit = simulate_nonsmooth(system, state0, (0.0, t), psi, rtol=1e-12, atol=1e-14)
    errors = [
        np.abs(simulate(system, psi, e, state0, (0.0, t), rtol=1e-12, atol=1e-14).states[-1] - limit.states[-1]).max()
        for e in eps
    ]
    return np.diff(np.log10(errors)) / np.diff(np.log10(eps)), [phase.kind for phase in limit.phases]


@pytest.mark.parametrize(
    ("system", "state0", "t", "phases"),
    [
        (examples.ball_in_pool(K=2.0), (-1.0, 0.3, 10.0, 0.0), 2.5, ["slip", "slide"]),
        (examples.ball_in_pool(K=2.0), (1.0, 0.0, 12.0, 0.0), 2.5, ["slip", "cross", "slip", "slide"]),
        (examples.tilting_block(), (0.3, 0.1, 0.1), 5.0, ["slip", "slide"]),
        (examples.nonunique_sliding(), (0.02, 0.01, 0.1), 0.2, ["slip", "slide"]),
    ],
)
@pytest.mark.parametrize("psi", [families.constant(), families.tanh()])
def test_the_two_agree_to_first_order_in_eps(system, state0, t, phases, psi):
    slopes, found = slope(system, psi, state0, t, [1e-4, 1e-6, 1e-8])
    assert found == phases
    np.testing.assert_allclose(slopes, 1.0, atol=0.1)


@pytest.mark.parametrize(("psi", "order"), [(families.constant(), 4 / 5), (families.rational(), 8 / 9)])
def test_after_an_exit_through_the_equator_the_order_is_lower(psi, order):
    # x' = beta t + k (eps/x)^q, Psi ~ s^-mu, q = 2 + 2 mu: the balance t ~ (eps/t^2)^q gives x ~ eps^(2 q/(1 + 2 q)).
    slopes, found = slope(ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(1.0,)), psi, (0.0, 0.0, 0.8), 0.8, [1e-5, 1e-7, 1e-9])
    assert found == ["slide", "slip"]
    np.testing.assert_allclose(slopes, order, atol=0.01)
