"""An exchange of stability (det J = 0) on a critical set that goes on: way in = way out, and the side is kept."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import codim2_core as c2
from codim2_core import psi

CONSTANT = psi.constant()
TRANSCRITICAL = c2.System(U=("(z-0.5)*c-c*c", "-s"), W=("1",))
PITCHFORK = c2.System(U=("(z-0.5)*c-c**3", "-s"), W=("1",))
#: x = 0 is invariant, and y = 0 is no line.
IN_THE_PLANE = c2.System(U=("(z-0.5)*c-c*c+0.3*s*c", "-s+0.2*c*c"), W=("1",))
GENERAL = c2.System(
    U=("-0.691*c-1.239*s+0.913*z1*c*s+1.206*z1*s+1.144*s", "0.499*c-0.992*s+0.268*s*s-1.2*z1*c*s"), W=("0.74",)
)


@pytest.mark.parametrize(
    ("system", "x", "name", "last"),
    [
        (TRANSCRITICAL, 0.02, "transcritical", 1.0),
        (PITCHFORK, 0.02, "pitchfork", 1.0),
        (PITCHFORK, -0.02, "pitchfork", -1.0),
        (IN_THE_PLANE, 0.02, "transcritical", 1.0),
    ],
)
def test_it_leaves_when_it_is_repelled_as_much_as_it_was_attracted_and_on_its_side(system, x, name, last):
    """There e = 0 has the eigenvalue z - 1/2 for every Psi, and z = t."""
    start = (x, 0.01 if system is IN_THE_PLANE else 0.0, 0.0)
    for family in (CONSTANT, psi.tanh()):
        motion = c2.simulate_nonsmooth(system, start, (0.0, 1.2), psi=family)
        slip, _, after, onward = motion.phases
        assert [phase.kind for phase in motion.phases] == ["slip", "slide", "slide", "slide"]
        assert after.t_start == pytest.approx(0.5, abs=1e-9)
        assert after.t_end == pytest.approx(1.0 - slip.t_end, abs=1e-8)
        assert after.delay.bifurcation == name
        assert f"({name})" in after.reason == after.delay.reason
        np.testing.assert_array_equal(after.e(0.8), 0.0)
        assert math.copysign(1.0, onward.e(1.1)[0]) == last
        sets = c2.critical_sets(system, family, (after.t_end + 1e-6,))
        assert sets[int(onward.onto[1:]) - 1].kind.startswith("stable")


def leading(z):
    D = np.array([[-0.691, -1.239 + 1.206 * z + 1.144], [0.499, -0.992]])
    return float(np.linalg.eigvals(D).real.max())


def test_of_a_general_system():
    motion = c2.simulate_nonsmooth(GENERAL, (0.2724, 0.00313, 0.08977), (0.0, 3.5), psi=CONSTANT)
    before, after, onward = motion.phases[1:]
    z = [float(motion.dense(t)[2]) for t in (before.t_start, after.t_start, after.t_end)]
    assert abs(leading(z[1])) < 1e-9
    attracted, repelled = quad(leading, z[0], z[1], epsabs=1e-12)[0], quad(leading, z[1], z[2], epsabs=1e-12)[0]
    assert repelled == pytest.approx(-attracted, rel=1e-8)
    assert attracted < -0.05
    # for this eps doubles still tell on which side it is: the distance falls to exp(attracted/(0.74 eps)) only
    run = c2.simulate(GENERAL, CONSTANT, (0.2724, 0.00313, 0.08977), (0.0, 3.5), eps=0.005, rtol=1e-12)
    assert np.hypot(*(run.states[-1, :2] / math.hypot(*run.states[-1, :2], 0.005) - onward.p(3.5))) < 0.1


def test_delays_tell_it_too():
    for system, name in ((TRANSCRITICAL, "transcritical"), (PITCHFORK, "pitchfork")):
        delay = next(iter(c2.delays(system, CONSTANT, (-0.3,), {"z1": (-1.0, 2.0)})))
        assert (delay.bifurcation, delay.buffer) == (name, None)
        assert [delay.z_hopf[0], delay.z_out[0]] == pytest.approx([0.5, 1.3], abs=1e-9)
    (delay,) = c2.delays(PITCHFORK, CONSTANT, (-0.3,), {"z1": (-1.0, 1.0)})
    assert delay.t_out is None
    assert "(pitchfork)" in delay.reason


def test_on_a_set_that_moves_terms_of_order_eps_decide():
    moving = c2.System(U=("(z-0.5)*(c-0.2*z)-(c-0.2*z)**2", "-s"), W=("1",))
    motion = c2.simulate_nonsmooth(moving, (0.1, 0.01, 0.0), (0.0, 1.2), psi=CONSTANT)
    assert motion.status is c2.SimulationStatus.NOT_UNIQUE
    assert motion.times[-1] == pytest.approx(0.5, abs=1e-7)
    assert "(transcritical, det J = 0)" in motion.reason
    assert "terms of order ε decide" in motion.reason
    assert not c2.delays(moving, CONSTANT, (0.0,))


HOPF = c2.System(U=("z*c - s", "c + z*s"), W=("1",))


@pytest.mark.parametrize(
    ("system", "start", "turns"),
    [
        (TRANSCRITICAL, (0.02, 0.0, 0.0), 0.5),
        (PITCHFORK, (0.02, 0.0, 0.0), 0.5),
        (IN_THE_PLANE, (0.02, 0.01, 0.0), 0.5),
        (HOPF, (0.01, 0.0, -0.5), 0.5),
    ],
)
@pytest.mark.parametrize("eps", [1e-3, 1e-6])
def test_for_positive_eps_the_phase_says_when_stability_is_lost_and_that_the_motion_stays(system, start, turns, eps):
    """By then the distance is e^(-125) and less of what it was."""
    run = c2.simulate(system, CONSTANT, start, (0.0, 0.95), eps=eps)
    before, after = [phase for phase in run.phases if phase.kind == "slide"][:2]
    assert before.t_end == after.t_start == pytest.approx(turns, abs=20.0 * eps)
    assert "until repulsion balances attraction" in after.reason
    assert after.onto in after.reason.replace("₁", "1").replace("₂", "2")
