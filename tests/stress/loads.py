"""Random loads that switch, pulse and ramp, on a block with friction in the plane, against brute force.

``python -m tests.stress --loads [--seconds S] [--seed N]``

Brute force takes 100 000 to 400 000 equal steps, in each of which friction takes as much of the velocity as it can
(Moreau's scheme): it shares nothing with what is tried, and sees what lasts longer than some steps.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import numpy as np

import codim2_core as c2

from .ways import Check

SPAN, STEPS = 20.0, 100_000
EPS, MAX_STEPS = 1e-7, 20_000
MAX_ERROR = 3e-3  # of velocities and ways of the order 1 to 10, for brute force with steps of 2e-4
Load = tuple[str, Callable[[np.ndarray], np.ndarray]]


def draw_load(rng: random.Random) -> Load:
    """Return a load as text, and as a function of times (k,)."""
    a, t0 = round(rng.uniform(-2.5, 2.5), 3), round(rng.uniform(1.0, 18.0), 3)
    w, k = round(rng.choice((0.02, 0.1, 0.5, 2.0)) * rng.uniform(0.7, 1.4), 4), round(rng.uniform(0.4, 3.0), 3)
    t1 = round(t0 + rng.uniform(0.05, 6.0), 3)
    kinds: tuple[Load, ...] = (
        (f"{a}*0.5*(1+sign(t-{t0}))", lambda t: a * (t > t0)),
        (f"{a}*(t > {t0})*(t < {t1})", lambda t: a * ((t > t0) & (t < t1))),
        (f"{a}*sign(sin({k}*t))", lambda t: a * np.sign(np.sin(k * t))),
        (f"{a}*max(0, min(1, (t-{t0})/{w}))", lambda t: a * np.clip((t - t0) / w, 0.0, 1.0)),
        (f"{a}*min(2, max(0, {k}*(t-{t0})))", lambda t: a * np.clip(k * (t - t0), 0.0, 2.0)),
        (f"2*{a}*exp(-((t-{t0})/{w})^2)", lambda t: 2.0 * a * np.exp(-(((t - t0) / w) ** 2))),
        (f"{a}*exp(-(sin({k}*t)/0.1)^2)", lambda t: a * np.exp(-((np.sin(k * t) / 0.1) ** 2))),
        (f"{a}*0.5*(1+tanh((t-{t0})/{w}))", lambda t: a * 0.5 * (1.0 + np.tanh((t - t0) / w))),
        (f"{a}*abs(sin({k}*t))", lambda t: a * np.abs(np.sin(k * t))),
        (f"{a}*(mod({k}*t, 2) - 1)", lambda t: a * (np.mod(k * t, 2.0) - 1.0)),
        (f"{a}/4*floor(min(t, 8)/{k})", lambda t: a / 4.0 * np.floor(np.minimum(t, 8.0) / k)),
        (f"{a}*sin({k}*t)", lambda t: a * np.sin(k * t)),
    )  # fmt: skip
    return rng.choice(kinds)


def brute_force(
    forces: np.ndarray, mu: float, spring: float, damping: float, start: np.ndarray, h: float
) -> np.ndarray:
    """Return (x, y, z1, z2) at the end, from forces (k, 2) in the middle of k steps."""
    x, y, z1, z2 = start.tolist()
    for f1, f2 in forces.tolist():
        z1, z2 = z1 + 0.5 * h * x, z2 + 0.5 * h * y
        x += h * (f1 - spring * z1 - damping * x)
        y += h * (f2 - spring * z2 - damping * y)
        size = math.hypot(x, y)
        left = 1.0 - mu * h / size if size > mu * h else 0.0
        x, y = left * x, left * y
        z1, z2 = z1 + 0.5 * h * x, z2 + 0.5 * h * y
    return np.array([x, y, z1, z2])


def motion_and_brute_force(rng: random.Random) -> tuple[str, list[str]]:
    """The motion in the limit, that for a small eps, and brute force, which is asked twice where they differ."""
    count = rng.randint(1, 3)
    loads = [[draw_load(rng) for _ in range(count)], [draw_load(rng) for _ in range(rng.randint(0, 2))]]
    mu, spring = rng.choice((0.5, 1.0)), rng.choice((0.0, 0.0, 1.0, 4.0))
    damping = rng.choice((0.0, 0.2))
    start = np.zeros(4) if rng.random() < 0.7 else np.array([rng.uniform(-1, 1), rng.uniform(-1, 1), 0.0, 0.0])
    if not loads[1]:
        start[1] = 0.0
    rows = [" + ".join(text for text, _ in axis) or "0" for axis in loads]
    system = c2.System(
        U=(f"-{mu}*c - {damping}*x - {spring}*z1 + {rows[0]}", f"-{mu}*s - {damping}*y - {spring}*z2 + {rows[1]}"),
        W=("x", "y"),
    )
    what = f"{[row.text for row in system.U]}, from {start.tolist()}"
    psi = c2.psi.constant()
    runs = {
        "limit": c2.simulate_nonsmooth(system, start, (0.0, SPAN), psi, max_steps=MAX_STEPS),
        "eps": c2.simulate(system, psi, start, (0.0, SPAN), eps=EPS, max_steps=MAX_STEPS),
    }
    said = [f"{name}: {run.reason}" for name, run in runs.items() if run.status.name != "T_END"]
    for factor in (1, 4):
        h = SPAN / (factor * STEPS)
        t = h * (np.arange(factor * STEPS) + 0.5)
        forces = np.stack([sum((f(t) for _, f in axis), np.zeros_like(t)) for axis in loads], axis=-1)
        expected = brute_force(forces, mu, spring, damping, start, h)
        apart = {name: float(np.abs(run.states[-1, :4] - expected).max()) for name, run in runs.items()}
        bound = MAX_ERROR / factor * (1.0 + float(np.abs(expected).max()))
        wrong = [f"{name} is {error:.1e} from brute force" for name, error in apart.items() if error > bound]
        if not wrong:
            break
    return what, said + wrong


CHECKS: tuple[Check, ...] = (motion_and_brute_force,)
