"""Random plates on two to four feet, shaken: the motion of the limit, against SciPy on the regularised equations.

``python -m tests.stress --contacts [--seconds S] [--seed N]``

SciPy's Radau has the equations as `tests.core.systems.mechanics.plates` writes them again, with Psi = 1, and shares
nothing with what is tried. At rest the accelerations are those of projected Gauss-Seidel.
"""

from __future__ import annotations

import random
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from codim2_core import psi
from codim2_core.systems.mechanics import Contacts
from tests.core.systems.mechanics.plates import INERTIA, MASS, MU, Blocks, Driven, shaken_plate, shaken_rate
from tests.core.systems.mechanics.test_contacts import gauss_seidel

from .ways import Check

EPS, SPAN = 1e-7, 3.0
MAX_ERROR = 1e-4  # of velocities of the order 1: the limit differs by some eps after each departure
MAX_LOAD_ERROR = 5e-3  # of steps of 1e-4
MAX_ACCELERATION_ERROR = 1e-6


def draw_plate(rng: random.Random) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return places, loads, push and the first velocities, at rest every other time."""
    own = np.random.default_rng(rng.getrandbits(64))
    count = int(own.integers(2, 5))
    start = own.normal(size=3) * int(own.integers(0, 2))
    return own.normal(size=(count, 2)), own.uniform(2.0, 12.0, count), own.uniform(0.0, 10.0, 3), start


def draw_driven(rng: random.Random) -> tuple[Driven, np.ndarray]:
    """Return a plate on two or three feet that turns, held by springs, and its first velocities and angle."""
    own = np.random.default_rng(rng.getrandbits(64))
    draw = lambda low, high, count: np.round(own.uniform(low, high, count), 2).tolist()
    count = int(own.integers(2, 4))
    places = np.round(own.normal(size=(2, count)) * 0.6, 2).tolist()
    feet = tuple(zip(*places, draw(0.15, 0.7, count), draw(1.0, 6.0, count), strict=True))
    (mass,), (inertia,), (omega,), (spring,) = draw(1.0, 3.0, 1), draw(0.2, 1.0, 1), draw(0.5, 2.0, 1), draw(0, 3, 1)
    F1, F2, torque = np.round(own.normal(size=3) * (3.0, 3.0, 1.5), 2).tolist()
    start = np.round(own.normal(size=4) * (0.8, 0.8, 1.2, 1.0), 2)
    return Driven(mass, inertia, feet, (F1, F2), omega, spring, torque), start


def motion_and_scipy(rng: random.Random) -> tuple[str, list[str]]:
    """The motion of the limit, and SciPy's at a small eps."""
    places, loads, push, start = draw_plate(rng)
    what = f"plate on {places.tolist()}, loads {loads.tolist()}, push {push.tolist()}, from {start.tolist()}"
    return what, _compare(shaken_plate(places, loads, push), shaken_rate(places, loads, push, EPS), start)


def turning_motion_and_scipy(rng: random.Random) -> tuple[str, list[str]]:
    """The same of a plate that turns, so that a stuck foot lets go while others slip."""
    driven, start = draw_driven(rng)
    found = _compare(driven.contacts(), driven.rate(EPS), np.append(start, (0.0, 0.0)))
    return f"{driven}, from {start.tolist()}", found


def _compare(whole: Contacts, rate: Callable[..., np.ndarray], start: np.ndarray) -> list[str]:
    """Return what is wrong with the motion of the limit, whose last position is the time."""
    run = whole.simulate_nonsmooth((*start, 0.0), (0.0, SPAN))
    if run.status.name != "T_END":
        return [run.reason]
    own = solve_ivp(rate, (0.0, SPAN), start, "Radau", rtol=1e-9, atol=1e-12, dense_output=True)
    times = np.linspace(0.0, SPAN, 200)
    apart = np.abs(run.dense(times)[:, :-1] - own.sol(times).T).max(axis=1)
    worst = int(np.argmax(apart))
    kinds = ["/".join(phase.kinds) for phase in run.phases]
    return [f"{apart[worst]:.2e} at t = {times[worst]:.3f}; {kinds}"] if apart[worst] > MAX_ERROR else []


def loads_and_tiny_steps(rng: random.Random) -> tuple[str, list[str]]:
    """Two blocks under loads that switch, pulse and ramp, in the limit and for a small eps."""
    whole, start, span = Blocks.drawn(np.random.default_rng(rng.getrandbits(64))), (0.0,) * 6, (0.0, SPAN)
    blocks, own = whole.contacts(), whole.tiny_steps(SPAN)
    found = {"limit": blocks.simulate_nonsmooth(start, span)}
    found["eps"] = blocks.simulate(psi.constant(), start, span, eps=EPS)
    apart = {name: float(np.abs(run.states[-1, :5] - own).max()) for name, run in found.items()}
    return f"{whole}", [
        f"{name}: {apart[name]:.2e}; {run.reason}"
        for name, run in found.items()
        if run.status.name != "T_END" or not apart[name] <= MAX_LOAD_ERROR
    ]


def rest_and_gauss_seidel(rng: random.Random) -> tuple[str, list[str]]:
    """What a plate at rest begins to do."""
    places, loads, push, _ = draw_plate(rng)
    found = shaken_plate(places, loads, push).decide((0.0, 0.0, 0.0, 0.0))
    J = np.array([[[1.0, 0.0, -y], [0.0, 1.0, x]] for x, y in places])
    Q = push * (0.0, 1.0, 1.0)
    for rounds in (4_000, 40_000):  # it converges slowly where feet are nearly in a line
        other = gauss_seidel(np.diag([MASS, MASS, INERTIA]), Q, J, np.zeros((len(J), 2)), MU * loads, rounds)
        apart = float(np.abs(found.acceleration - other).max())
        if apart <= MAX_ACCELERATION_ERROR:
            break
    what = f"plate at rest on {places.tolist()}, loads {loads.tolist()}, push {push.tolist()}"
    return what, [f"accelerations {apart:.2e} apart"] if apart > MAX_ACCELERATION_ERROR else []


CHECKS: tuple[Check, ...] = (motion_and_scipy, turning_motion_and_scipy, loads_and_tiny_steps, rest_and_gauss_seidel)
