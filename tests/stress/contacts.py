"""Random plates on two to four feet, shaken: the motion of the limit, against SciPy on the regularised equations.

``python -m tests.stress --contacts [--seconds S] [--seed N]``

SciPy's Radau has the equations as `tests.core.mechanics.plates` writes them again, with Psi = 1, and shares nothing
with what is tried. At rest the accelerations are those of projected Gauss-Seidel.
"""

from __future__ import annotations

import random

import numpy as np
from scipy.integrate import solve_ivp

from tests.core.mechanics.plates import INERTIA, MASS, MU, shaken_plate, shaken_rate
from tests.core.mechanics.test_contacts import gauss_seidel

from .ways import Check

EPS, SPAN = 1e-6, 3.0
MAX_ERROR = 1e-4  # of velocities of the order 1: the limit differs by some eps after each departure
MAX_ACCELERATION_ERROR = 1e-6


def draw_plate(rng: random.Random) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return places, loads, push and the first velocities, at rest every other time."""
    own = np.random.default_rng(rng.getrandbits(64))
    count = int(own.integers(2, 5))
    start = own.normal(size=3) * int(own.integers(0, 2))
    return own.normal(size=(count, 2)), own.uniform(2.0, 12.0, count), own.uniform(0.0, 10.0, 3), start


def motion_and_scipy(rng: random.Random) -> tuple[str, list[str]]:
    """The motion of the limit, and SciPy's at a small eps."""
    places, loads, push, start = draw_plate(rng)
    run = shaken_plate(places, loads, push).simulate_nonsmooth((*start, 0.0), (0.0, SPAN))
    what = f"plate on {places.tolist()}, loads {loads.tolist()}, push {push.tolist()}, from {start.tolist()}"
    if run.status.name != "T_END":
        return what, [run.reason]
    rate = shaken_rate(places, loads, push, EPS)
    own = solve_ivp(rate, (0.0, SPAN), start, "Radau", rtol=1e-8, atol=1e-11, dense_output=True)
    times = np.linspace(0.0, SPAN, 200)
    apart = np.abs(run.dense(times)[:, :3] - own.sol(times).T).max(axis=1)
    worst = int(np.argmax(apart))
    kinds = ["/".join(phase.kinds) for phase in run.phases]
    return what, [f"{apart[worst]:.2e} at t = {times[worst]:.3f}; {kinds}"] if apart[worst] > MAX_ERROR else []


def rest_and_gauss_seidel(rng: random.Random) -> tuple[str, list[str]]:
    """What a plate at rest begins to do."""
    places, loads, push, _ = draw_plate(rng)
    found = shaken_plate(places, loads, push).decide((0.0, 0.0, 0.0, 0.0))
    J = np.array([[[1.0, 0.0, -y], [0.0, 1.0, x]] for x, y in places])
    Q = push * (0.0, 1.0, 1.0)
    other = gauss_seidel(np.diag([MASS, MASS, INERTIA]), Q, J, np.zeros((len(J), 2)), MU * loads)
    apart = float(np.abs(found.acceleration - other).max())
    what = f"plate at rest on {places.tolist()}, loads {loads.tolist()}, push {push.tolist()}"
    return what, [f"accelerations {apart:.2e} apart"] if apart > MAX_ACCELERATION_ERROR else []


CHECKS: tuple[Check, ...] = (motion_and_scipy, rest_and_gauss_seidel)
