"""Each value that is known is computed again, by another way than its formula, and this package finds it."""

import itertools
import math
import pickle

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import brentq

from codim2_core import reference
from codim2_core.motion.reference import oscillators, sliding

G = 9.81


@pytest.mark.parametrize("key", reference.catalogue)
def test_what_is_found_is_what_is_known(key):
    motion = reference.catalogue[key]
    for known, one in zip(motion.values, motion.compare(), strict=True):
        assert one.difference == pytest.approx(0.0, abs=known.error + 1e-11 * max(1.0, abs(known.value))), one.name


def value(key, i=0):
    return reference.catalogue[key].values[i].value


def centre_of_rotation(c, R=1.0):
    """Force and torque on a disc of radius R that turns about a point at distance c from its middle, by quadrature.

    Over lines through that point: S of them lies in the disc, from S1 to S2.
    """
    if c < R:
        a = 2.0 * math.pi * np.arange(2000) / 2000
        weight, root = np.full(2000, math.pi / 1000), np.sqrt(R * R - (c * np.cos(a)) ** 2)
        near = np.zeros(2000)
    else:
        t, weight = np.polynomial.legendre.leggauss(200)
        d = np.arcsin(R / c * np.sin(0.5 * math.pi * t))
        a = d - 0.5 * math.pi
        weight = weight * 0.5 * math.pi * R / c * np.cos(0.5 * math.pi * t) / np.cos(d)
        root = np.sqrt(np.maximum(R * R - (c * np.cos(a)) ** 2, 0.0))
        near = -c * np.sin(a) - root
    far = root - c * np.sin(a)
    area, moment = (far**2 - near**2) / 2, (far**3 - near**3) / 3
    return -(weight * np.sin(a) * area).sum(), (weight * (c * np.sin(a) * area + moment)).sum()


@pytest.mark.parametrize(("key", "i", "k2", "eta"), [
    ("spinning-disc", 0, 0.5, 0.0), ("gyration", 0, 0.36, 0.0), ("gyration", 1, 0.5625, 0.0), ("washer", 0, 0.545, 0.3),
    ("washer", 1, 0.625, 0.5), ("washer", 2, 0.82, 0.8),
])  # fmt: skip
def test_a_disc_stops_where_both_fall_alike(key, i, k2, eta):
    def miss(c):
        force, torque = centre_of_rotation(c)
        if eta:
            inner = centre_of_rotation(c, eta)
            force, torque = force - inner[0], torque - inner[1]
        return k2 * force - c * torque

    assert brentq(miss, max(1.01 * eta, 0.1), 0.999, xtol=1e-15) == pytest.approx(value(key, i), abs=2e-12)


def test_a_puck_across_a_ramp_by_quadrature():
    v0, psi0, pull, m = 2.0, 2.0, G * math.sin(0.3), 0.5 / math.tan(0.3)

    def speed(psi):
        return v0 * math.sin(psi0) / math.sin(psi) * (math.tan(psi / 2) / math.tan(psi0 / 2)) ** m

    def over(function):
        return quad(lambda psi: function(psi) * speed(psi) / (pull * math.sin(psi)), 0.0, psi0, epsabs=1e-13)[0]

    ways = over(lambda _: 1.0), over(lambda p: speed(p) * math.cos(p)), over(lambda p: speed(p) * math.sin(p))
    assert ways == pytest.approx([value("ramp-across", i) for i in range(3)], abs=1e-11)


def test_multipliers_of_a_mass_that_is_driven_round_by_differences():
    """The map over one period of the forcing, followed by SciPy, in central differences about the known motion."""
    F, S, w = 1.0, 0.5, 2.0
    R = value("circular-forcing")

    def rate(t, s):
        speed = math.hypot(s[0], s[1])
        return [
            F * math.cos(w * t) - S * s[0] / speed - s[2], F * math.sin(w * t) - S * s[1] / speed - s[3], s[0], s[1]
        ]  # fmt: skip

    # (1 - w^2) q + i S q/|q| = F: where it is at t = 0
    q = F / complex(1.0 - w * w, S / R)
    start = np.array([-w * q.imag, w * q.real, q.real, q.imag])

    def after(state):
        return solve_ivp(rate, (0.0, 2.0 * math.pi / w), state, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]

    assert after(start) == pytest.approx(start, abs=1e-10)
    map_ = np.stack([(after(start + 1e-5 * e) - after(start - 1e-5 * e)) / 2e-5 for e in np.eye(4)], axis=1)
    found = sorted(np.linalg.eigvals(map_).tolist(), key=lambda one: (-abs(one), -one.imag))
    assert found == pytest.approx(oscillators.round_multipliers(S, w, R), abs=1e-7)


def test_den_hartogs_motion_by_halves():
    """From the turn at q = A to that at q = -A, half a period later, friction is constant: two linear conditions."""
    for key, w, S in oscillators.DEN_HARTOG:
        half = math.pi / w
        c, s = math.cos(half), math.sin(half)

        # q = S + (A - S - p) cos t + r sin t + p cos wt + ..., with the phase a of the forcing: solve for A and a

        def miss(a, w=w, S=S, c=c, s=s, half=half):
            P = 1.0 / (1.0 - w * w)
            first, slope = P * math.cos(a), -P * w * math.sin(a)
            # velocity zero at both ends: -(A - S - first) s - slope (c + 1) = 0 gives A
            A = S + first - slope * (c + 1.0) / s
            return A, S + (A - S - first) * c - slope * s - first + A

        grid = np.linspace(0.0, 2.0 * math.pi, 721)
        amplitudes = [
            miss(brentq(lambda a: miss(a)[1], lo, hi, xtol=1e-15))[0]
            for lo, hi in itertools.pairwise(grid) if miss(lo)[1] * miss(hi)[1] < 0.0
        ]  # fmt: skip
        assert min(abs(A - value(key)) for A in amplitudes) < 1e-12


def test_stick_and_slip_by_scipy():
    delta, v = 3.0, 0.2

    def rate(_, s):
        return [s[1], -s[0] + 1.0 / (1.0 + delta * abs(v - s[1]))]

    def caught(_, s):
        return s[1] - v

    caught.direction, caught.terminal = 1, True
    run = solve_ivp(
        rate, (0.0, 20.0), [1.0, v], method="DOP853", rtol=1e-13, atol=1e-15, events=caught, first_step=1e-4
    )
    slip, stick = run.t[-1], (1.0 - run.y[0, -1]) / v
    assert (slip, stick, slip + stick) == pytest.approx([value("leine-block", i) for i in range(3)], abs=3e-12)


@pytest.mark.parametrize(("i", "eps"), [(0, 1e-3), (1, 1e-2)])
def test_the_regularised_block_by_scipy(i, eps):
    def rate(_, s):
        slip = s[1] - 0.2
        return [s[1], -s[0] - slip / math.hypot(slip, eps) / (1.0 + 3.0 * abs(slip))]

    def through(_, s):
        return s[0] - 0.5

    through.direction = 1
    run = solve_ivp(rate, (0.0, 40.0), [1.0, 0.0], method="Radau", rtol=1e-10, atol=1e-12, events=through, max_step=0.1)
    assert np.diff(run.t_events[0])[-1] == pytest.approx(value("leine-block-regularised", i), abs=1e-8)


def test_another_solver_is_scored():
    box = reference.catalogue["box-stops"]
    found = box.compare(lambda: (1.25, 3.0), "mine")
    assert [one.difference for one in found] == pytest.approx([1.25 - 6.0 / (0.5 * G), 3.0 - 36.0 / G])
    assert found.solver == "mine"
    assert found.largest == pytest.approx(abs(3.0 - 36.0 / G) / (36.0 / G))
    with pytest.raises(ValueError, match="these 2: time to rest, way to rest"):
        box.compare(lambda: (1.0,))


def test_motions_are_results():
    for motion in reference.catalogue.values():
        again = pickle.loads(pickle.dumps(motion))
        assert again == motion
        assert again.values[0].formula in again.values[0]._repr_html_()
    frame = reference.catalogue["pool"].compare().to_frame()
    assert list(frame["name"]) == ["time until it rolls", "speed at which it rolls", "speed after 3 s"]


def test_mujoco_comes_near():
    pytest.importorskip("mujoco")
    from codim2_core.motion.reference.mujoco import FOLLOWED, follow_in_mujoco

    for key in FOLLOWED:
        found = follow_in_mujoco(reference.catalogue[key])
        assert 1e-6 < found.largest < 0.05, key  # near, and not by our own simulator
    with pytest.raises(ValueError, match="no model in MuJoCo here"):
        follow_in_mujoco(sliding.BELT)
