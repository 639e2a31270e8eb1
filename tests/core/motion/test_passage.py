"""How far a motion is from a critical set is known however small, and so when and where it leaves."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import System, psi, simulate, simulate_nonsmooth
from codim2_core.motion.result import SimulationStatus


def _log_distance(bend, eps, own, z1):
    """log(r/eps) at z = z1, from r = 0.02 at z = 0, by another method: of ``r' = (z - 1/2) e - bend(e)``."""

    def rate(z, state):
        if state[0] < -40.0:
            return [(z - 0.5) / eps]
        zeta = math.exp(min(state[0], 40.0))
        e = float(own.modulus(zeta))
        return [((z - 0.5) * e - bend(e)) / (eps * math.exp(state[0]))]

    found = solve_ivp(rate, (0.0, z1), [math.log(0.02 / eps)], "LSODA", rtol=1e-10, atol=1e-10)
    return float(found.y[0, -1])


@pytest.mark.parametrize(("text", "bend"), [("c**3", lambda e: e**3), ("c*c", lambda e: e * e)])
@pytest.mark.parametrize("eps", [1e-3, 1e-4, 1e-6, 1e-8])
def test_an_exchange_of_stability_is_left_to_the_side_it_came_from(text, bend, eps):
    system, own = System(U=(f"(z-0.5)*c - {text}", "-s"), W=("1",)), psi.constant()
    run = simulate(system, own, (0.02, 0.0, 0.0), (0.0, 1.5), eps=eps)
    assert run.status is SimulationStatus.T_END
    assert (run.states[:, 0] > 0.0).all()
    assert not run.states[:, 1].any()
    limit = simulate_nonsmooth(system, (0.02, 0.0, 0.0), (0.0, 1.5), own)
    assert limit.phases[-1].t_start == pytest.approx(0.9866, abs=2e-4)
    if eps == 1e-3:
        r = float(run.dense(1.0)[0])
        assert math.log(r / eps) == pytest.approx(_log_distance(bend, eps, own, 1.0), abs=1e-3)
    else:  # at C: (z - 1/2) e = bend(e)
        e = math.sqrt(0.5) if text == "c**3" else 0.5
        assert float(run.dense(1.0)[0]) / eps == pytest.approx(e / math.sqrt(1.0 - e * e), rel=20.0 * eps + 1e-6)


@pytest.mark.parametrize("turn", [0.5, 3.0])
@pytest.mark.parametrize("eps", [1e-3, 1e-4, 1e-5])
def test_a_delayed_hopf_bifurcation_is_left_when_the_radius_says(eps, turn):
    """U is (z - 1/2 - |e|^2) e turned by an angle: r alone obeys the equation in a line."""
    system = System(U=(f"(z-0.5)*c - {turn}*s - c*(c*c+s*s)", f"{turn}*c + (z-0.5)*s - s*(c*c+s*s)"), W=("1",))
    own = psi.constant()
    run = simulate(system, own, (0.02, 0.0, 0.0), (0.0, 1.0), eps=eps)
    left = float(run.times[np.flatnonzero(np.hypot(*run.states[:, :2].T) < 1e-3 * eps)[-1]])
    r = float(np.hypot(*run.dense(left)[:2]))
    assert math.log(r / eps) == pytest.approx(_log_distance(lambda e: e**3, eps, own, left), abs=2e-3)
    limit = simulate_nonsmooth(system, (0.02, 0.0, 0.0), (0.0, 1.0), own)
    assert left == pytest.approx(limit.phases[2].t_end, abs=30.0 * eps)


@pytest.mark.parametrize("sides", [(1, 1), (-1, 1), (1, -1)])
@pytest.mark.parametrize("eps", [1e-3, 1e-5, 1e-8])
def test_it_leaves_along_the_mode_that_grows_first_to_its_side(eps, sides):
    """Both axes are invariant; along x it is unstable from z = 0.5, along y from z = 0.8."""
    system = System(U=("(z-0.5)*c - c*(c*c+s*s)", "(z-0.8)*s - s*(c*c+s*s)"), W=("1",))
    start = (0.01 * sides[0], 0.01 * sides[1], 0.0)
    run = simulate(system, psi.constant(), start, (0.0, 1.2), eps=eps)
    assert run.status is SimulationStatus.T_END
    assert run.states[-1, 0] / eps * sides[0] == pytest.approx(math.sqrt(0.7 / 0.3), rel=0.01)  # |e|^2 = 0.7
    limit = simulate_nonsmooth(system, start, (0.0, 1.2), psi.constant())
    assert run.phases[-1].t_start == pytest.approx(limit.phases[-1].t_start, abs=20.0 * eps)


def test_a_switch_on_the_way_keeps_the_distance():
    """From z = 0.6 on it repels twice as much: so it is left where (0.6^2 - ...) balances, and not at 0.6."""
    system = System(
        U=("(z - 0.5 + max(0, z - 0.6))*c - 3*s - c**3", "3*c + (z - 0.5 + max(0, z - 0.6))*s - s**3"), W=("1",)
    )
    start = (0.02, 0.0, 0.0)
    limit = simulate_nonsmooth(system, start, (0.0, 1.2), psi.constant())
    run = simulate(system, psi.constant(), start, (0.0, 1.2), eps=1e-5)
    arrives = limit.phases[1].t_start
    balance = 0.5 * (0.5 - arrives) ** 2  # = int (z - 1/2) + int (z - 0.6)
    left = 0.55 + math.sqrt(balance - 0.005 + 0.0025)
    slides = [phase for phase in run.phases if phase.kind == "slide"]
    assert slides[1].t_end == pytest.approx(left, abs=1e-3)


def test_it_keeps_its_side_under_every_psi():
    system = System(U=("sin(3*z)*c - c**3", "-s"), W=("-1",))
    for own in (psi.constant(), psi.tanh(), psi.hill(3)):
        run = simulate(system, own, (-0.02, 0.0, -0.05), (0.0, 2.0), eps=1e-5)
        assert run.status is SimulationStatus.T_END
        assert (run.states[:, 0] < 0.0).all()


@pytest.mark.parametrize(
    "U",
    [
        ("0.35*c + 0.82*s + 0.33*c*c - 1.3*s*s", "0.91*c + 0.45*s - 0.54*c*c + 0.58*c*s"),
        ("0.36*c + 0.29*s + 0.03*c*c + 0.55*s*s", "-0.74*c - 0.16*s - 0.48*c*c + 0.6*c*s"),
        ("0.2*c - 0.47*s + 0.24*c*c + 0.76*s*s", "-1.65*c + 0.25*s + 1.22*c*c - 0.3*c*s"),
        ("c", "s"),  # in all directions alike
        ("c**3 + 0.5*c", "s"),
        ("c - 2*s", "2*c + s"),  # it spirals
        ("c - 2*c**3", "-s"),  # a saddle, next to which two sets attract
    ],
)
def test_what_starts_exactly_on_a_repelling_set_stays_in_both(U):
    system, start = System(U=U, W=("1",)), (0.0, 0.0, 0.7)
    for run in (
        simulate(system, psi.tanh(), start, (0.0, 1.0), eps=1e-4),
        simulate_nonsmooth(system, start, (0.0, 1.0), psi.tanh()),
    ):
        assert [phase.kind for phase in run.phases] == ["slide"]
        assert "any disturbance would make it leave" in run.phases[0].reason
        np.testing.assert_array_equal(run.states[-1, :2], 0.0)


@pytest.mark.parametrize("x", [0.02, 0.0])
def test_a_load_that_sets_in_while_it_rests_ends_the_delay(x):
    """The push z - 0.7 sets in at z = 0.7; friction holds it up to z = 1.1, and then x' = (z - 1/2) - 1 + (z - 0.7)."""
    system = System(U=("(z-0.5)*c - c**3 + max(0, z-0.7)", "-s"), W=("1",))
    runs = (
        simulate(system, psi.constant(), (x, 0.0, 0.0), (0.0, 1.5), eps=1e-6),
        simulate_nonsmooth(system, (x, 0.0, 0.0), (0.0, 1.5), psi.constant()),
    )
    for run, error in zip(runs, (1e-4, 1e-9), strict=True):
        assert run.status is SimulationStatus.T_END
        assert run.phases[-1].kind == "slip"
        assert run.phases[-1].t_start == pytest.approx(1.1, abs=error)
        assert run.states[-1, 0] == pytest.approx(0.16, abs=error)


def test_a_load_that_jumps_while_it_rests_on_a_repelling_set():
    """It stays until 1, and is then pushed with e + 3 = 4."""
    system = System(U=("c + 3*(t>1)", "0.5*s"), W=("x",))
    run = simulate(system, psi.constant(), (0.0, 0.0, 0.0), (0.0, 2.0), eps=1e-6)
    assert run.states[-1, [0, 2]] == pytest.approx([4.0, 2.0], abs=1e-5)
