"""64 trajectories to T = 8: the compiled stepping, one stacked scipy solve_ivp, and heyoka's batch mode.

Run as ``python tests/benchmarks/bench_trajectories.py [--quick]``. Every method is timed in one run, in turns, on the
same seeds; a row gives the tolerance asked for, the true error of the final states (against the compiled stepping
and heyoka at their tightest, which agree) and the median time. The last lines compare times at equal true error,
interpolated between rows on a logarithmic scale.
"""

from __future__ import annotations

import argparse
import itertools
import math
import statistics
import time
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from codim2_core import hemisphere, psi
from codim2_core.regularisation import Psi
from codim2_core.systems import ELinear
from codim2_core.trajectories import trajectories

SYSTEM = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))
FROZEN = SYSTEM.at(())
COUNT, T = 64, 8.0
FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(4.0), psi.custom("1/(1+s)**2")]
ERRORS = (1e-6, 1e-9, 1e-12)
LANES = 8  # of heyoka: one AVX-512 register

Array = np.ndarray


def sunflower() -> Array:
    """Seeds, evenly over the disc."""
    k = np.arange(COUNT)
    r, t = 0.98 * np.sqrt((k + 0.5) / COUNT), 2.399963 * k
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


def compiled(p: Psi, seeds: Array, tolerance: float, drawn: bool = False) -> Callable[[], Array]:
    """Our own stepping, without early ends."""

    def run() -> Array:
        options = {"t_max": T, "rtol": tolerance, "atol": max(tolerance, 1e-15), "capture": 1e-15}
        return trajectories(FROZEN, p, seeds, samples=None if drawn else "ends", **options).ends[:, :2]

    return run


def stacked(p: Psi, seeds: Array, tolerance: float, method: str) -> Callable[[], Array]:
    """One solve_ivp for all trajectories, the field vectorised."""
    coefficients = FROZEN
    if p.family == "constant":  # e = p: the cheapest NumPy can do

        def field(t: float, q: Array) -> Array:
            x, y = q[:COUNT], q[COUNT:]
            u = coefficients.a * x - coefficients.b * y + coefficients.f1
            v = coefficients.b * x + coefficients.d * y + coefficients.f2
            s = x * u + y * v
            return np.concatenate([u - x * s, v - y * s])

    else:

        def field(t: float, q: Array) -> Array:
            return hemisphere.flow(coefficients, p, q.reshape(2, COUNT).T).T.ravel()

    def run() -> Array:
        done = solve_ivp(field, (0.0, T), seeds.T.ravel(), method=method, rtol=max(tolerance, 3e-14), atol=tolerance)
        return done.y[:, -1].reshape(2, COUNT).T

    return run


def heyoka_batch(p: Psi, seeds: Array, tolerance: float) -> Callable[[], Array] | None:
    """heyoka's Taylor method in batches of eight, on the field in p alone (a cubic polynomial for Psi = 1)."""
    try:
        import heyoka as hy
    except ImportError:
        return None
    c = FROZEN
    x, y = hy.make_vars("x", "y")
    s = x * x + y * y
    h = 1.0 - s
    gain = {
        "constant": lambda: 1.0,
        "rational": lambda: 1.0 / hy.sqrt(s + h * h),  # |p|^2 + ebar^2 = 1
        "exponential": lambda: 1.0 / hy.sqrt(s + h * hy.exp(-s / h)),
        "tanh": lambda: hy.tanh(hy.sqrt(s / h)) / hy.sqrt(s),
        "hill": lambda: 1.0 / hy.sqrt(s + 3.0 * h / (3.0 + (4.0 * s / h) ** p.parameter)),
        "custom": lambda: 1.0 / hy.sqrt(s + h * h * h),  # Psi = (1 + s)^-2
    }[p.family]()
    u = c.a * gain * x - c.b * gain * y + c.f1
    v = c.b * gain * x + c.d * gain * y + c.f2
    q = x * u + y * v
    batch = hy.taylor_adaptive_batch([(x, u - x * q), (y, v - y * q)], np.zeros((2, LANES)), tol=tolerance)
    result = np.empty((COUNT, 2))

    def run() -> Array:
        for k in range(0, COUNT, LANES):
            batch.set_time(0.0)
            batch.state[:] = seeds[k : k + LANES].T
            batch.propagate_until(T)
            result[k : k + LANES] = batch.state.T
        return result

    return run


def at_error(rows: list[tuple[float, float]], error: float) -> float:
    """Time at a true error: rows of (error, time), interpolated in logarithms; infinite out of reach."""
    best = {}
    for e, t in rows:
        best[e] = min(t, best.get(e, math.inf))
    points = sorted((math.log(max(e, 1e-17)), math.log(t)) for e, t in best.items())
    x = math.log(error)
    if x < points[0][0]:
        return math.inf
    if x >= points[-1][0]:
        return math.exp(points[-1][1])
    for (x0, t0), (x1, t1) in itertools.pairwise(points):
        if x0 <= x <= x1:
            return math.exp(t0 + (t1 - t0) * (x - x0) / max(x1 - x0, 1e-9))
    raise AssertionError


def measure(p: Psi, seeds: Array, turns: int = 40) -> dict[str, list[tuple[float, float, float]]]:
    """(tolerance, true error, median seconds) of every method, interleaved in one run."""
    reference = compiled(p, seeds, 1e-14)()
    runs: dict[str, list[tuple[float, Callable[[], Array], int]]] = {"compiled": [], "drawn": []}
    for tolerance in 10.0 ** -np.arange(3.0, 14.0):
        runs["compiled"].append((tolerance, compiled(p, seeds, tolerance), turns))
        runs["drawn"].append((tolerance, compiled(p, seeds, tolerance, True), turns))
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14):
        batch = heyoka_batch(p, seeds, tolerance)
        if batch is not None:
            runs.setdefault("heyoka batch", []).append((tolerance, batch, turns))
    for method, tolerances in (
        ("DOP853", (1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13)),
        ("RK45", (1e-5, 1e-6, 1e-8, 1e-10)),
        ("LSODA", (1e-5, 1e-6, 1e-7, 1e-9, 1e-11)),
    ):
        runs[method] = [(t, stacked(p, seeds, t, method), 3) for t in tolerances]
    if p.family == "constant":  # implicit: 128 coupled unknowns in every Newton step
        runs["Radau"] = [(1e-6, stacked(p, seeds, 1e-6, "Radau"), 1)]
    times: dict[tuple[str, float], list[float]] = {}
    errors: dict[tuple[str, float], float] = {}
    for turn in range(turns):
        for name, cases in runs.items():
            for tolerance, run, count in cases:
                if turn == 0:
                    errors[name, tolerance] = float(np.abs(run() - reference).max())
                if turn < count:
                    begin = time.perf_counter()
                    run()
                    times.setdefault((name, tolerance), []).append(time.perf_counter() - begin)
    rows: dict[str, list[tuple[float, float, float]]] = {}
    for (name, tolerance), taken in times.items():
        rows.setdefault(name, []).append((tolerance, errors[name, tolerance], statistics.median(taken)))
    return rows


def report(families: tuple[Psi, ...] = FAMILIES, verbose: bool = False) -> str:
    """Return the table of equal true errors as Markdown; verbose prints every run on the way."""
    lines = [
        "| 64 trajectories to T = 8, Ψ | true error | ours, ms | ours drawn, ms | SciPy stacked (best) / ours | "
        "heyoka batch / ours |",
        "|---|---|---|---|---|---|",
    ]
    for p in families:
        rows = measure(p, sunflower())
        for name, cases in rows.items() if verbose else ():
            for tolerance, error, seconds in cases:
                print(f"{p.text[:16]:16s} {name:14s} {tolerance:9.0e} {error:10.1e} {1e3 * seconds:10.3f} ms")
        times = {name: [case[1:] for case in cases] for name, cases in rows.items()}
        for error in ERRORS:
            own, drawn = at_error(times["compiled"], error), at_error(times["drawn"], error)
            best = min(at_error(times[m], error) for m in ("DOP853", "RK45", "LSODA", "Radau") if m in times)
            heyoka = times.get("heyoka batch")
            batch = f"{at_error(heyoka, error) / own:.1f}" if heyoka else "not installed"
            lines.append(
                f"| {p.text} | {error:.0e} | {1e3 * own:.3f} | {1e3 * drawn:.3f} | {best / own:.0f} | {batch} |"
            )
    return "\n".join(lines)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="Psi = 1 and 1/(1 + s) only")
    print(report(FAMILIES[: 2 if parser.parse_args().quick else None], verbose=True))
