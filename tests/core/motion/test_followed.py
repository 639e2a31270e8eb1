"""The critical set that a state follows, held against `critical_sets`."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.initial_value.field import field
from codim2_core.motion.followed import followed

SETS = {
    "node": c2.ELinear(-1.0, 0.0, -3.0, (0.2, -0.3)),
    "focus": c2.ELinear(-1.0, 4.0, -1.5, (0.2, -0.3)),
    "saddle": c2.ELinear(1.0, 0.0, -3.0, (0.2, -0.3)),
    "slow node": c2.ELinear(-0.4, 0.0, -0.3, (0.05, -0.1)),
    "slow, repels": c2.ELinear(0.3, 2.0, 0.2, (0.2, -0.3)),
}


@pytest.mark.parametrize("name", SETS)
def test_its_rate_is_the_largest_modulus_of_its_eigenvalues(name):
    system, psi, eps = SETS[name], c2.psi.rational(), 1e-3
    (C,) = c2.critical_sets(system, psi)
    one = followed(field(system), psi, eps, eps * C.x2)
    assert one is not None
    np.testing.assert_allclose(one.e, C.e, rtol=0.0, atol=1e-12)
    assert one.rate == pytest.approx(np.abs(C.eigenvalues).max(), rel=1e-9)
    assert one.attracts == C.kind.startswith("stable")


@pytest.mark.parametrize("psi", [c2.psi.constant(), c2.psi.tanh()], ids=lambda p: p.family)
def test_a_state_follows_within_twice_what_the_slow_manifold_is_away(psi):
    """The motion itself tells where the slow manifold is; beyond it, and on the other side, up to twice as far."""
    system = c2.System(U=("-c + z/4 + 2*x", "-2*s + y - z/3"), W=("4 + c",))
    eps, formulas = 0.02, field(system)
    run = c2.simulate(system, psi, eps, (0.0, 0.0, -0.4), (0.0, 0.15), rtol=1e-10, atol=1e-12)
    for t in (0.1, 0.15):
        state = np.asarray(run.dense(t))
        (C,) = c2.critical_sets(system, psi, state[2:])
        own = state[:2] / np.hypot(np.hypot(*state[:2]), eps)
        away = own - C.p
        assert np.hypot(*away) > 5e-3  # more than what any orbit is given
        for k, follows in ((0.0, True), (1.0, True), (1.8, True), (-1.8, True), (2.5, False), (-2.5, False)):
            p = C.p + k * away
            x = eps * p / np.sqrt(1.0 - p @ p)
            found = followed(formulas, psi, eps, np.append(x, state[2:]))
            assert (found is not None) == follows, (t, k)
            if found is not None:
                np.testing.assert_allclose(found.e, C.e, rtol=0.0, atol=1e-9)
                np.testing.assert_allclose(found.p, C.p, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(("away", "follows"), [(0.95e-3, True), (1.05e-3, False), (0.3, False)])
def test_where_the_slow_manifold_is_the_set_a_state_follows_within_what_an_orbit_is_given(away, follows):
    system, psi, eps = SETS["node"], c2.psi.rational(), 1e-9
    (C,) = c2.critical_sets(system, psi)
    for way in ((1.0, 0.0), (-0.6, 0.8)):
        p = C.p + away * np.array(way)
        found = followed(field(system), psi, eps, eps * p / np.sqrt(1.0 - p @ p))
        assert (found is not None) == follows


@pytest.mark.parametrize(("away", "follows"), [(0.24, True), (0.26, False)])
def test_no_state_follows_that_is_further_than_a_quarter(away, follows):
    """However far the slow manifold is: W = 100."""
    system, psi, eps = c2.System(U=("-c + z/4", "-2*s"), W=("100",)), c2.psi.rational(), 0.02
    p = np.array([away, 0.0])
    found = followed(field(system), psi, eps, np.append(eps * p / np.sqrt(1.0 - p @ p), 0.0))
    assert (found is not None) == follows
