"""Motions against SciPy with a compiled right-hand side: ``python -m tests.benchmarks.bench_compiled [--quick]``.

The ball in the pool and the sliding that is not unique, Psi = 1, for eps from 1e-1 down: our `simulate`, compiled, and
solve_ivp with LSODA, Radau, DOP853 and BDF on a field compiled by Numba, run in turns in one process. For each error
that is asked, the time of the cheapest setting whose true error (against our own run at 1e-13) is no larger; the ratio
is that of the best of SciPy to ours. Last, ten thousand motions at once.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from codim2_core import examples, psi, simulate

METHODS = ("LSODA", "Radau", "DOP853", "BDF")
ERRORS = (1e-3, 1e-6, 1e-9, 1e-12)
PATIENCE = 2.0  # seconds that a setting may take
Array = np.ndarray


@njit(error_model="numpy")
def ball(t, q, eps):
    """The ball's equations (sec:ballpool), mu = 0.2, K = 2, Psi = 1."""
    rho = math.sqrt(q[0] * q[0] + q[1] * q[1] + eps * eps)
    c, s, friction = q[0] / rho, q[1] / rho, 0.2 * 9.81
    push = 3.5 * friction
    return np.array(
        [-push * c - 2.0 * q[2], -push * s - 2.0 * q[3], -friction * c - 2.0 * q[2], -friction * s - 2.0 * q[3]]
    )


@njit(error_model="numpy")
def unique(t, q, eps):
    """The system of sec:nonunique, Psi = 1."""
    rho = math.sqrt(q[0] * q[0] + q[1] * q[1] + eps * eps)
    c, s, chi = q[0] / rho, q[1] / rho, (1.0 + 2.0 * q[2] * q[2]) / (1.0 + q[2] * q[2])
    return np.array([-c * (c - 0.5 * chi) * (c + 0.5 * chi), -0.5 * s, -2.0 * c + 0.25])


CASES = {
    "ball": (examples.ball_in_pool(K=2.0), ball, (-1.0, 0.3, 10.0, 0.0), 3.0),
    "non-unique sliding": (examples.nonunique_sliding(), unique, (0.25, 0.3, 0.0), 2.0),
}


def timed(run: Callable[[], Array], turns: int) -> tuple[Array, float]:
    """The end of a run, and the median of its processor times after a first run."""
    end, taken = run(), []
    for _ in range(turns):
        start = time.process_time()
        run()
        taken.append(time.process_time() - start)
        if taken[-1] > PATIENCE:
            break
    return end, float(np.median(taken))


def costs(run: Callable[[float], Array], exact: Array, turns: int) -> dict[float, float]:
    """Least time at each error asked for."""
    found: list[tuple[float, float]] = []
    for power in range(3, 14):
        end, taken = timed(lambda tolerance=10.0**-power: run(tolerance), turns)
        found.append((float(np.abs(end - exact).max()), taken))
        if taken > PATIENCE or found[-1][0] <= ERRORS[-1]:
            break
    return {error: min((taken for e, taken in found if e <= error), default=math.inf) for error in ERRORS}


def row(name: str, eps: float, turns: int) -> str:
    """One system at one eps."""
    system, field, start, t = CASES[name]
    shape = psi.constant()
    simulate(system, shape, eps, [start] * 8, (0.0, t))  # compiles
    exact = simulate(system, shape, eps, start, (0.0, t), rtol=1e-13, atol=1e-15).states[-1]
    ours = costs(
        lambda tolerance: simulate(system, shape, eps, start, (0.0, t), rtol=tolerance, atol=tolerance).states[-1],
        exact, turns,
    )  # fmt: skip
    theirs = [
        costs(
            lambda tolerance, method=method: solve_ivp(
                field, (0.0, t), start, method, args=(eps,), rtol=max(tolerance, 1e-13), atol=1e-2 * tolerance * eps
            ).y[:, -1],
            exact, turns,
        )
        for method in METHODS
        if eps >= 1e-4 or method != "DOP853"
    ]  # fmt: skip
    best = {error: min(one[error] for one in theirs) for error in ERRORS}
    cells = (f"{1e3 * ours[e]:.2g} / {1e3 * best[e]:.2g} ({best[e] / ours[e]:.1f})" for e in ERRORS)
    return f"| {name} | {eps:.0e} | " + " | ".join(cells) + " |"


def many(count: int) -> str:
    """Motions at once."""
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4)) * (1.0, 1.0, 5.0, 5.0)
    system, shape = CASES["ball"][0], psi.constant()
    simulate(system, shape, 1e-6, states[:8], (0.0, 2.0), rtol=1e-6, atol=1e-8)
    wall, cpu = time.perf_counter(), time.process_time()
    simulate(system, shape, 1e-6, states, (0.0, 2.0), rtol=1e-6, atol=1e-8)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    return f"{count} motions of the ball to t = 2 at 1e-6, ε = 1e-6: {wall:.2f} s ({cpu:.2f} s of processor time)."


def report(quick: bool = False) -> str:
    """Return times and ratios as Markdown."""
    lines = [
        "| motion | ε | " + " | ".join(f"ms at error {e:.0e}: ours / best of SciPy (ratio)" for e in ERRORS) + " |",
        "|" + "---|" * (2 + len(ERRORS)),
    ]
    every = (1e-1, 1e-6) if quick else (1e-1, 1e-3, 1e-6, 1e-9, 1e-12)
    lines += [row(name, eps, 1 if quick else 5) for name in CASES for eps in every]
    return "\n".join([*lines, "", many(500 if quick else 10_000)])


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
