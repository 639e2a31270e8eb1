"""Motions that end before their time: what was followed is returned, and the reason told."""

import math

import numpy as np
import pytest

from codim2_core import System, simulate, simulate_nonsmooth
from codim2_core import psi as families
from codim2_core.motion.result import SimulationStatus

ALL = ("smooth", "limit")


def motion(which, system, state0, t, **options):
    if which == "limit":
        return simulate_nonsmooth(system, state0, (0.0, t), families.constant(), **options)
    return simulate(system, families.constant(), state0, (0.0, t), eps=1e-4, **options)


@pytest.mark.parametrize("which", ALL)
@pytest.mark.parametrize(
    ("U", "W", "state0", "when", "kind"),
    [
        (("x**2 - c", "-s"), (), (2.0, 0.0), 0.5 * math.log(3.0), "slip"),
        (("-c", "-s"), ("z**2",), (0.0, 0.0, 1.0), 1.0, "slide"),
        (("-c", "-s"), ("1 + z**2",), (0.0, 0.0, 0.0), 0.5 * math.pi, "slide"),
        (("1", "exp(y)"), (), (0.0, 0.3), math.exp(-0.3), "slip"),
        (("-c", "-s"), ("z**9",), (0.1, 0.0, 1.0), 1.0 / 8.0, "slide"),
    ],
)
def test_a_blow_up_is_told_with_its_time(which, U, W, state0, when, kind):
    run = motion(which, System(U=U, W=W), state0, 20.0)
    assert run.status is SimulationStatus.BLOW_UP
    assert run.times[-1] == pytest.approx(when, rel=1e-6)
    assert float(run.reason.split("near t = ")[1][:-1]) == pytest.approx(when, rel=1e-6)
    assert run.phases[-1].kind == kind
    assert run.phases[-1].t_end == run.times[-1]
    assert len(run.times) < 3000


@pytest.mark.parametrize("which", ALL)
def test_where_formulas_end_the_motion_does(which):
    run = motion(which, System(U=("-c", "-s"), W=("-1/2 + log(z) - log(z)",)), (1.0, 0.0, 1.0), 3.0)
    assert run.status is SimulationStatus.STEP_LIMIT
    assert run.times[-1] == pytest.approx(2.0, abs=1e-6)
    assert "undefined after t = 2" in run.reason


@pytest.mark.parametrize("which", ALL)
def test_at_the_step_limit_what_was_followed_is_kept(which):
    system = System(U=("1.5*cos(z) - c", "-s"), W=("1",))
    run = motion(which, system, (0.5, 0.0, 0.0), 200.0, max_steps=400)
    assert run.status is SimulationStatus.STEP_LIMIT
    assert 1.0 < run.times[-1] < 200.0
    assert len(run.phases) > 3
    assert run.phases[-1].t_end == run.times[-1]


def test_phases_are_bounded_by_the_steps_alone():
    system = System(U=("1.5*cos(z) - c", "-s"), W=("1",))
    t = 60.0 * math.pi
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, t), families.constant(), rtol=1e-4, max_steps=10**6)
    assert run.status is SimulationStatus.T_END
    # In each half period it slips once (where |1.5 cos z| has exceeded 1) and sticks once.
    assert len(run.phases) == pytest.approx(120, abs=2)


def test_a_motion_in_an_invariant_line_stays_in_it():
    # Dry friction, driven so hard that it never sticks: it passes Sigma in the line, where Sigma repels across it.
    drive = "4*cos(z)"
    for turn in (0.0, 0.7):
        k, n = math.cos(turn), math.sin(turn)
        system = System(U=(f"{k}*{drive} - c", f"{n}*{drive} - s"), W=("1",))
        limit = simulate_nonsmooth(system, (0.3 * k, 0.3 * n, 0.0), (0.0, 60.0), families.constant())
        crossings = [phase for phase in limit.phases if phase.kind == "cross"]
        assert len(crossings) == pytest.approx(60.0 / math.pi, abs=2)
        across = limit.states[:, 0] * n - limit.states[:, 1] * k
        assert np.abs(across).max() < 1e-12
        if turn == 0.0:
            assert not across.any()
        run = simulate(system, families.constant(), (0.3 * k, 0.3 * n, 0.0), (0.0, 60.0), eps=1e-6)
        assert [phase.kind for phase in run.phases] == [phase.kind for phase in limit.phases]
        np.testing.assert_allclose(run.states[-1], limit.states[-1], atol=1e-3)
