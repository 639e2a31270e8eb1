"""A force that is exactly what friction can hold, and then a smooth push that begins below rounding."""

import math

import numpy as np
import pytest

from codim2_core import System, psi, simulate, simulate_nonsmooth

PSI, SPAN = psi.constant(), (0.0, 10.0)
DIRECTIONS = [(1.0, 0.0), (0.6, 0.8), (math.cos(2.0), math.sin(2.0))]
PUSHES = [  # g(t) of the force 1 + d g, and its integral over the span
    ("z", 50.0),
    ("z**2", 1000.0 / 3.0),
    ("z**3", 2500.0),
    ("max(0, z - 3)", 24.5),
    ("(1 - exp(-z))", 9.0 + math.exp(-10.0)),
    ("(1 - cos(z))", 10.0 - math.sin(10.0)),
    ("exp(-((z - 5)/0.5)**2)", 0.5 * math.sqrt(math.pi)),
]


@pytest.mark.parametrize("d", [1e-4, 1e-8, 1e-11, 1e-16])
@pytest.mark.parametrize(("push", "area"), PUSHES)
@pytest.mark.parametrize("n", DIRECTIONS)
def test_it_slips_as_the_push_says_from_where_that_is_no_rounding(n, push, area, d):
    n1, n2 = n
    system = System(U=(f"-c + {n1!r}*(1 + {d!r}*{push})", f"-s + {n2!r}*(1 + {d!r}*{push})"), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), SPAN, PSI)
    assert run.status.name == "T_END"
    # The force is known to 1e-16 of friction, and 1e-13 of it may be held: over ten units of time, 1e-12.
    # A push that no stage of a step sees is bounded to 1e-5 of the way.
    np.testing.assert_allclose(run.states[-1, :2], d * area * np.array(n), rtol=1e-5, atol=1e-12)


@pytest.mark.parametrize("U", [("-c + sin(z)", "-s"), ("-c + 0.6*sin(z)", "-s + 0.8*sin(z)"), ("-c + 1", "-s"),
                               ("-c + cos(0.3*z)", "-s + sin(0.3*z)")])  # fmt: skip
def test_a_force_that_reaches_the_bound_and_no_more_moves_nothing(U):
    run = simulate_nonsmooth(System(U=U, W=("1",)), (0.0, 0.0, 0.0), (0.0, 20.0), PSI)
    assert run.status.name == "T_END"
    assert [phase.kind for phase in run.phases] == ["slide"]
    assert not run.states[:, :2].any()


def test_a_load_that_jumps_to_the_bound_is_held_and_grows_from_there():
    load = "max(0, sign(z - 3))*(1 + 1e-9*(z - 3)**2)"
    system = System(U=(f"-c + 0.6*{load}", f"-s + 0.8*{load}"), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), SPAN, PSI)
    assert run.states[-1, :2] == pytest.approx([0.6e-9 * 343.0 / 3.0, 0.8e-9 * 343.0 / 3.0], rel=1e-5)


def test_a_block_that_arrives_under_such_a_force_stays():
    run = simulate_nonsmooth(System(U=("-c + 0.6", "-s + 0.8"), W=("1",)), (-0.6, -0.8, 0.0), SPAN, PSI)
    assert [phase.kind for phase in run.phases] == ["slip", "slide"]
    assert run.phases[1].t_start == pytest.approx(0.5, abs=1e-12)
    assert not run.states[-1, :2].any()


def test_a_force_that_turns_and_grows_slowly_takes_the_block_along():
    """The regularised motion creeps by (eps^2 t)^(1/3), so eps is small; in the limit it lags by rho alone."""
    system = System(U=("-c + cos(z)*(1 + 1e-4*z)", "-s + sin(z)*(1 + 1e-4*z)"), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), SPAN, PSI)
    near = simulate(system, PSI, (0.0, 0.0, 0.0), SPAN, eps=1e-10)
    assert run.status.name == "T_END"
    assert run.states[-1, :2] == pytest.approx(near.states[-1, :2], rel=1e-4)
