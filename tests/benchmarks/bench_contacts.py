"""Motions of several contacts: error beside time, against solve_ivp: ``python -m tests.benchmarks contacts``.

Shaken plates on three feet, t from 0 to 3. In the limit the references are our own runs at 1e-12, and solve_ivp (Radau)
has the regularised equations with Psi = 1 and a small eps, as `tests.core.systems.mechanics.plates` writes them in
NumPy: that is what can be done without events. For eps = 1e-3 the reference is solve_ivp's Radau at 1e-12. All run in
one process; processor times are the least of three.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from codim2_core import psi
from tests.core.systems.mechanics.plates import shaken_plate, shaken_rate

SPAN, TURNS, EPS = 3.0, 3, 1e-3
TIMES = np.linspace(0.0, SPAN, 100)
METHODS = ("Radau", "LSODA")
Parts = tuple[np.ndarray, np.ndarray, np.ndarray]


def draw_parts(seed: int) -> Parts:
    """Return places, loads and push of a plate that sticks, turns about a foot and slides."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(3, 2)), rng.uniform(2.0, 12.0, 3), rng.uniform(5.0, 8.0, 3)


def timed(run: Callable[[], np.ndarray], exact: np.ndarray) -> tuple[float, float]:
    """Return the least of the processor times, and the largest error of velocities over time; inf if it stops."""
    taken, found = [], exact
    for _ in range(TURNS):
        begun = time.process_time()
        found = run()
        taken.append(time.process_time() - begun)
    return min(taken), float(np.abs(found - exact).max()) if found.shape == exact.shape else np.inf


def scipy(parts: Parts, eps: float, method: str, rtol: float) -> np.ndarray:
    """Return SciPy's velocities at all times."""
    rate = shaken_rate(*parts, eps)
    return solve_ivp(rate, (0.0, SPAN), np.zeros(3), method, TIMES, rtol=rtol, atol=1e-3 * rtol * min(1.0, eps)).y.T


def limit_rows(parts: Parts) -> list[tuple[str, float, float]]:
    """Return what was run in the limit, its time and its error."""
    whole, start = shaken_plate(*parts), np.zeros(4)
    ours = lambda rtol: whole.simulate_nonsmooth(start, (0.0, SPAN), rtol=rtol, atol=1e-2 * rtol, times=TIMES)
    exact = ours(1e-12).states[:, :3]
    rows = [(f"ours, rtol {r:.0e}", *timed(lambda r=r: ours(r).states[:, :3], exact)) for r in (1e-4, 1e-6, 1e-9)]
    for eps in (1e-3, 1e-4, 1e-6):
        for method in METHODS:
            found = timed(lambda eps=eps, method=method: scipy(parts, eps, method, 1e-6), exact)
            rows.append((f"solve_ivp {method}, ε = {eps:.0e}", *found))
    return rows


def regularised_rows(parts: Parts) -> list[tuple[str, float, float]]:
    """Return what was run at one eps, its time and its error."""
    whole, start, exact = shaken_plate(*parts), np.zeros(4), scipy(parts, EPS, "Radau", 1e-12)

    def ours(rtol: float) -> np.ndarray:
        asked = {"eps": EPS, "rtol": rtol, "atol": 1e-2 * rtol * EPS, "times": TIMES}
        return whole.simulate(psi.constant(), start, (0.0, SPAN), **asked).states[:, :3]

    rows = [(f"ours, rtol {r:.0e}", *timed(lambda r=r: ours(r), exact)) for r in (1e-4, 1e-6, 1e-8)]
    for method in METHODS:
        for rtol in (1e-4, 1e-6, 1e-8):
            found = timed(lambda rtol=rtol, method=method: scipy(parts, EPS, method, rtol), exact)
            rows.append((f"solve_ivp {method}, rtol {rtol:.0e}", *found))
    return rows


def report(quick: bool = False) -> str:
    """Return times and errors as Markdown: the median over the plates."""
    seeds = (3,) if quick else (3, 8, 12)
    parts = []
    for title, measure in (("limit ε → 0", limit_rows), (f"ε = {EPS:.0e}", regularised_rows)):
        found = [measure(draw_parts(seed)) for seed in seeds]
        lines = [f"| {title}: {len(seeds)} shaken plates on three feet | ms | largest error |", "|---|---|---|"]
        for rows in zip(*found, strict=True):
            took, error = np.median([row[1:] for row in rows], axis=0)
            lines.append(f"| {rows[0][0]} | {1e3 * took:.0f} | {error:.1e} |")
        parts.append("\n".join(lines))
    return "\n\n".join(parts)
