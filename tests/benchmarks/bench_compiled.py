"""Motions against SciPy with a compiled right-hand side: ``python -m tests.benchmarks compiled [--quick]``.

The five motions of `motions` for eps from 1e-1 to 1e-12: our `simulate`, and solve_ivp with LSODA, Radau, DOP853 and
BDF (each with two absolute tolerances) on a field compiled by Numba, run in turns in one process. For each true error
that is asked, against the stored ends, the processor time of the cheapest setting that meets it; the ratio is that of
the best of SciPy to ours (inf where none of its settings meets it within 30 times our longest run). Last, ten thousand
motions at once.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections.abc import Callable, Sequence

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from codim2_core import psi, simulate

from .motions import EPS, MOTIONS, ends, key

METHODS = ("LSODA", "Radau", "DOP853", "BDF")
ERRORS = (1e-3, 1e-6, 1e-9, 1e-12)
PATIENCE = 30.0  # times our longest run (at least 1 ms) that a setting may take; no tighter one is tried then
Array = np.ndarray
Cost = tuple[float, float]  # seconds, true error


def timed(run: Callable[[], Array], turns: int, longest: float) -> tuple[Array, float]:
    """The end of a run, and the least of its processor times."""
    end, taken = np.empty(0), []
    for _ in range(turns):
        start = time.process_time()
        end = run()
        taken.append(time.process_time() - start)
        if taken[-1] > longest:
            break
    return end, min(taken)


def costs(
    run: Callable[[float], Array], exact: Array, tolerances: Sequence[float], turns: int, longest: float = math.inf
) -> dict[float, Cost]:
    """Least time at each error asked for, and the error that it gives."""
    found: list[Cost] = []
    for tolerance in tolerances:
        end, taken = timed(lambda tolerance=tolerance: run(tolerance), turns, longest)
        error = float(np.abs(end - exact).max())
        found.append((taken, error if math.isfinite(error) else math.inf))
        if taken > longest or error <= 0.1 * ERRORS[-1]:
            break
    return {asked: min((one for one in found if one[1] <= asked), default=(math.inf, math.inf)) for asked in ERRORS}


def scipy(field: Callable[..., Array], start: Sequence[float], t: float, eps: float, method: str, fine: bool):
    """solve_ivp at a tolerance; with an absolute tolerance in the size of x and y on Sigma, or not."""

    def run(tolerance: float) -> Array:
        atol = tolerance * min(1.0, eps) if fine else tolerance
        found = solve_ivp(field, (0.0, t), start, method, args=(eps,), rtol=max(tolerance, 3e-14), atol=atol)
        return found.y[:, -1] if found.status == 0 else np.full(len(start), math.inf)

    return run


def row(name: str, eps: float, turns: int) -> tuple[str, list[float]]:
    """One motion at one eps, and its ratios."""
    motion, exact = MOTIONS[name], ends()[key(name, eps)]
    field = njit(error_model="numpy")(motion.field(sqrt=math.sqrt, sin=math.sin, cos=math.cos, pack=np.array))
    system, shape, start, span = motion.system, psi.constant(), motion.start, (0.0, motion.t_end)
    simulate(system, shape, eps, [start] * 8, span)  # compiles

    def ours(tolerance: float) -> Array:
        return simulate(system, shape, eps, start, span, rtol=tolerance, atol=tolerance, max_steps=10**6).states[-1]

    own = costs(ours, exact, 10.0 ** -np.arange(2.0, 13.1, 0.5), turns + 1)
    longest = PATIENCE * max(1e-3, max((taken for taken, _ in own.values() if taken < math.inf), default=0.0))
    theirs = {}
    for method in METHODS:
        if method == "DOP853" and eps < 1e-4 and name != "so(2,1)":
            continue  # steps of length eps
        for fine in (True, False):
            run = scipy(field, start, motion.t_end, eps, method, fine)
            field(0.0, np.array(start), eps)  # compiles
            theirs[method, fine] = costs(run, exact, 10.0 ** -np.arange(3.0, 13.1, 1.0), turns, longest)
    cells, ratios = [], []
    for asked in ERRORS:
        (best, error), method = min((found[asked], method) for (method, _), found in theirs.items())
        taken, own_error = own[asked]
        ratios.append(best / taken if math.isfinite(taken) else math.nan)
        told = f"{1e3 * best:.2g} {method} {error:.0e}" if math.isfinite(best) else f"none in {1e3 * longest:.0f}"
        cells.append(f"{1e3 * taken:.2g} {own_error:.0e} / {told} (**{best / taken:.1f}**)")
    return f"| {name} | {eps:.0e} | " + " | ".join(cells) + " |", ratios


def summary(what: str, ratios: Sequence[Sequence[float]], methods: Sequence[str] = METHODS) -> str:
    """The median and the least of the ratios, those of each motion a row, at each error that is asked; as Markdown."""
    of = np.array(ratios)
    cells = [f"{np.nanmedian(column):.1f} (least {np.nanmin(column):.1f})" for column in (*of.T, of.ravel())]
    return "\n".join(
        [
            f"| {what}, time / ours at true error | {' | '.join(f'{asked:.0e}' for asked in ERRORS)} | all |",
            "|" + "---|" * (len(ERRORS) + 2),
            f"| best of {', '.join(methods)} | {' | '.join(cells)} |",
        ]
    )


def readme(text: str) -> str:
    """What of a report is kept on the page of all: the summary, and what follows it."""
    return text.split("\n\n", 1)[1]


def many(count: int) -> str:
    """Motions at once."""
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4)) * (1.0, 1.0, 5.0, 5.0)
    system, shape, lines = MOTIONS["ball"].system, psi.constant(), []
    for eps in (1e-2, 1e-4, 1e-6):
        simulate(system, shape, eps, states[:20], (0.0, 2.0), rtol=1e-6, atol=1e-8)
        wall, cpu = time.perf_counter(), time.process_time()
        simulate(system, shape, eps, states, (0.0, 2.0), rtol=1e-6, atol=1e-8)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        lines.append(f"at ε = {eps:.0e} {wall:.2f} s ({cpu:.2f} s of processor time)")
    return f"{count} motions of the ball to t = 2 at 1e-6: {', '.join(lines)}."


def report(quick: bool = False) -> str:
    """Return times and ratios as Markdown."""
    lines = [
        "| motion | ε | " + " | ".join(f"{e:.0e}: ms, true error: ours / best of SciPy (ratio)" for e in ERRORS) + " |",
        "|" + "---|" * (2 + len(ERRORS)),
    ]
    ratios: list[list[float]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # LSODA gives up loudly
        for name in MOTIONS:
            for eps in (1e-1, 1e-3, 1e-8) if quick else EPS:
                line, found = row(name, eps, 1 if quick else 3)
                lines.append(line)
                ratios.append(found)
    lines += ["", summary("SciPy with a compiled right-hand side, 5 motions, ε from 1e-1 to 1e-12", ratios)]
    return "\n".join([*lines, "", many(1000 if quick else 10_000)])


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
