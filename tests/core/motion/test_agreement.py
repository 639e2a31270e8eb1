"""The regularised motion tends to its limit with the order that is said, and the words tell where phases differ."""

from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core import ELinear, System, equator_equilibria, examples, simulate, simulate_nonsmooth
from codim2_core import psi as families
from codim2_core.motion.compare_with_limit import agreement, limit_order
from codim2_core.motion.result import Phase

PSI, RATIONAL = families.constant(), families.rational()
EQUATOR_EXIT = ELinear(-1.0, 0.0, -1.0, ("z", 0.0), g=(1.0,))


def measured(system, psi, state0, t, eps):
    limit = simulate_nonsmooth(system, state0, (0.0, t), psi, rtol=1e-12, atol=1e-14)
    errors = [
        np.abs(
            simulate(system, psi, state0, (0.0, t), eps=e, rtol=1e-12, atol=1e-14).states[-1] - limit.states[-1]
        ).max()
        for e in eps
    ]
    return np.diff(np.log10(errors)) / np.diff(np.log10(eps)), limit


@pytest.mark.parametrize(
    ("system", "ratio"),
    [
        (ELinear(1.698, 0.6235, 1.231, f=(-1.2954, -0.99546)), 0.4935),
        (ELinear(1.0, 0.5, 0.8, f=(-1.6, -0.9)), 0.6708),
        (ELinear(-0.5, 0.2, -0.3, f=(-1.0, -0.8)), 1.4878),
    ],
)
def test_leaving_along_a_limit_direction_has_the_order_of_its_eigenvalues(system, ratio):
    slopes, limit = measured(system, PSI, (0.0, 0.0), 2.0, [1e-6, 1e-8, 1e-10])
    equator = equator_equilibria(system)
    (i,) = np.flatnonzero((equator.lambda_rho > 0.0) & (equator.lambda_theta < 0.0))
    assert -equator.lambda_theta[i] / equator.lambda_rho[i] == pytest.approx(ratio, abs=1e-4)
    order = limit_order(system, PSI, limit)
    assert order == pytest.approx(min(1.0, ratio), abs=1e-4)
    np.testing.assert_allclose(slopes, order, atol=0.01)


@pytest.mark.parametrize(("psi", "order"), [(families.constant(), 4 / 5), (families.rational(), 8 / 9)])
def test_an_exit_through_the_equator_has_the_order_of_psi(psi, order):
    # The motion stays in a line; across it nothing changes, and the order is that of the exit.
    system = ELinear(-1.0, 0.0, -1.0, ("z", "(z - 1)/5"), g=(1.0,))
    slopes, limit = measured(system, psi, (0.0, 0.0, 0.8), 0.8, [1e-6, 1e-7, 1e-8])
    assert [phase.kind for phase in limit.phases] == ["slide", "slip"]
    assert limit_order(system, psi, limit) == pytest.approx(order, abs=1e-6)
    np.testing.assert_allclose(slopes, order, atol=0.02)


@pytest.mark.parametrize(
    ("system", "state0", "psi", "order"),
    [
        # in a line, where the order measured is 0.7997 and 0.8873 for eps = 1e-6 to 1e-7
        (EQUATOR_EXIT, (0.1, 0.0, 0.4), families.constant(), 4 / 5),
        (EQUATOR_EXIT, (0.1, 0.0, 0.4), families.rational(), 8 / 9),
        (ELinear(0.5, 0.0, 0.1, f=(1.0, 0.0)), (0.1, 0.0), families.constant(), 1.0),  # never at Sigma
        # lambda_rho = 3 and lambda_theta = -3/2 where it leaves, but in the line there are no other directions
        (ELinear(1.0, 0.0, 1.5, f=(2.0, 0.0)), (-0.1, 0.0), families.constant(), 1.0),
        # from Sigma itself, along an axis or not: lambda_theta/lambda_rho = -13/18, and the order measured is 1.0000
        (ELinear(0.2, 0.0, 0.5, f=(-1.6, 0.0)), (0.0, 0.0), families.constant(), 1.0),
        (System(U=("s/2", "c/5 - 8/5")), (0.0, 0.0), families.constant(), 1.0),
        (System(U=("0.35*c - 0.15*s - 1.2", "0.35*s - 0.15*c - 1.2")), (0.0, 0.0), families.constant(), 1.0),
        (ELinear(1.0, 0.5, 0.8, f=(-1.6, -0.9)), (0.0, 0.0), families.rational(), 0.6708),
        (ELinear(-0.5, 0.2, -0.3, f=(-1.0, -0.8)), (0.0, 0.0), families.constant(), 1.0),
        (ELinear(-1.0, 0.5, -2.0), (0.3, -0.2), families.constant(), 1.0),  # arrives, and stays
    ],
)
def test_the_order_is_read_off_the_limit_alone(system, state0, psi, order):
    limit = simulate_nonsmooth(system, state0, (0.0, 1.0 if state0[-1] != 0.4 else 1.6), psi)
    assert limit_order(system, psi, limit) == pytest.approx(order, abs=1e-4)


def test_only_the_time_that_both_were_followed_is_compared():
    system, start = examples.nonunique_sliding(), (0.25, 0.3, 0.0)
    limit = simulate_nonsmooth(system, start, (0.0, 2.0), PSI)
    assert len(limit.phases) > 1
    early = 0.3 * limit.phases[0].t_end
    assert agreement(system, PSI, simulate(system, PSI, start, (0.0, early), eps=1e-2), limit).same
    other = simulate_nonsmooth(system, start, (0.0, early), PSI)
    assert agreement(system, PSI, simulate(system, PSI, start, (0.0, 2.0), eps=1e-2), other).same


def simulated(phases, end=1.0, eps=0.01):
    limit = simulate_nonsmooth(ELinear(-1.0, 0.5, -2.0), (0.3, -0.2), (0.0, 0.1), RATIONAL)
    return SimpleNamespace(
        times=np.array([0.0, end]), phases=tuple(phases), eps=eps, states=limit.states, dense=lambda t: limit.states[0]
    )


def test_where_phases_differ_the_earlier_time_is_told():
    slip, later = Phase("slip", 0.0, 0.3, ""), Phase("slip", 0.0, 0.6, "")
    slide, cross = Phase("slide", 0.3, 1.0, "", "C2"), Phase("cross", 0.6, 0.6, "")
    system = ELinear(-1.0, 0.5, -2.0)
    for own, limit, words in (
        ((slip, slide), (later, cross), "t = 0.3 the motion slides on C₂, while in the limit it crosses Σ"),
        ((later, cross), (slip, slide), "t = 0.3 the motion crosses Σ, while in the limit it slides on C₂"),
        ((slip, slide), (later,), "t = 0.3 the motion slides on C₂, while in the limit it goes on as before"),
        ((slip,), (later, cross), "t = 0.6 the motion goes on as before, while in the limit it crosses Σ"),
    ):
        found = agreement(system, RATIONAL, simulated(own), simulated(limit))
        assert not found.same
        assert words in found.sentence
    same = agreement(system, RATIONAL, simulated((slip, slide)), simulated((slip, slide)))
    assert (same.same, same.order) == (True, 1.0)
    assert "O(ε)." in same.sentence
    limit = simulate_nonsmooth(EQUATOR_EXIT, (0.1, 0.0, 0.4), (0.0, 1.6), RATIONAL)
    run = simulate(EQUATOR_EXIT, RATIONAL, (0.1, 0.0, 0.4), (0.0, 1.6), eps=1e-5)
    assert "O(ε^0.889)" in agreement(EQUATOR_EXIT, RATIONAL, run, limit).sentence


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
    slopes, limit = measured(system, psi, state0, t, [1e-4, 1e-6, 1e-8])
    assert [phase.kind for phase in limit.phases] == phases
    assert limit_order(system, psi, limit) == 1.0
    np.testing.assert_allclose(slopes, 1.0, atol=0.1)
