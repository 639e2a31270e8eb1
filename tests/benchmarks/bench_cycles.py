"""Case III: limit cycles, their branches and folds; error next to time.

Run ``python -m tests.benchmarks cycles [--quick]``. Times are of the processor.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable
from typing import Any

import numpy as np

import codim2_core as c2
from codim2_core.bifurcations.diagrams.equilibrium_branches import equilibrium_branches

PERIODS = {3: 0.5044751410092433, 4: 0.6066957493683202}  # of Case III's cycle, by extrapolation at 22 digits
CLEAR = 1e-4  # exponent from which a period is known better than its value is rounded
FOLDING = c2.ELinear(1.0, 1.3, -1.2, (0.33, 0.07))  # with Hill 3 a fold of cycles lies near f2 = 0.069


def spent(call: Callable[[], Any]) -> tuple[float, Any]:
    """Milliseconds of the processor, and the result."""
    start = time.process_time()
    found = call()
    return 1e3 * (time.process_time() - start), found


def timed(call: Callable[[], Any], repeats: int) -> tuple[float, Any]:
    """Return the median of the milliseconds after a first run, and the result."""
    _, found = spent(call)
    return statistics.median(spent(call)[0] for _ in range(repeats)), found


def branch_error(branches: Any, system: c2.ELinear, psi: c2.Psi) -> float:
    """Largest relative difference of periods along branches from those of `limit_cycles` there.

    Next to folds and the closed equator, where exponents tend to 0, the rounding of the value alone moves a cycle.
    """
    worst = 0.0
    for branch in branches:
        told = (branch.amplitude > 0.05) & np.isfinite(branch.period) & (np.abs(branch.exponent) > CLEAR)
        inner = np.flatnonzero(told)[3:-3]
        for i in inner[:: max(len(inner) // 6, 1)]:
            here = c2.limit_cycles(system.evolve(f1=float(branch.value[i])), psi)
            gaps = [abs(cycle.period / branch.period[i] - 1.0) for cycle in here]
            worst = max(worst, min(gaps, default=np.inf))
    return worst


def branch_rows(repeats: int, quick: bool) -> list[str]:
    """Milliseconds of branches, and the largest error of a period."""
    psi, three = c2.psi.hill(3), c2.presets["case3-n3"].system
    cases = [
        ("f1 from 0.2 to 0.5, b = 1.3", FOLDING, "f1", (0.2, 0.5)),
        ("Case III, n from 2.1 to 4", three, "n", (2.1, 4.0)),
        ("Case III, f1 from -120 to -60: cycles explode", three, "f1", (-120.0, -60.0)),
    ]
    rows = []
    for label, system, name, span in cases[: 1 if quick else None]:
        cost, found = timed(lambda s=system, n=name, span=span: c2.branches(s, psi, n, span).cycles, repeats)
        error = branch_error(found, system, psi) if name == "f1" and system is FOLDING else None
        shown = "" if error is None else f"{error:.0e}"
        rows.append(f"| {label}: {len(found)} | {cost:.0f} | {shown} |")
    return rows


def standing_row(repeats: int) -> tuple[float, float]:
    """Milliseconds of a general diagram, and how far its special values are from those of its e-linear twin."""
    psi, span = c2.psi.hill(3), (0.2, 0.5)
    numbers = {"a": 1.0, "b": 1.3, "d": -1.2, "f1": 0.33, "f2": 0.07}
    twin = c2.System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=numbers)
    cost, found = timed(lambda: equilibrium_branches(twin, psi, "f1", span), max(repeats // 3, 1))
    exact = [one.value for one in equilibrium_branches(FOLDING, psi, "f1", span).special]
    values = [one.value for one in found.special]
    return cost, max(map(abs, np.subtract(values, exact)), default=0.0) if len(values) == len(exact) else np.inf


def report(quick: bool = False) -> str:
    """Return both tables as Markdown."""
    repeats = 3 if quick else 15
    lines = ["| | ms of the processor | error |", "|---|---|---|"]
    system = c2.presets["case3-n3"].system
    for n in (3,) if quick else (3, 4):
        cost, cycles = timed(lambda n=n: c2.limit_cycles(system, c2.psi.hill(n)), repeats)
        lines.append(f"| limit cycles, n = {n} | {cost:.2f} | {abs(cycles[0].period / PERIODS[n] - 1.0):.0e} |")
    cost, _ = timed(lambda: c2.approach_outcomes(system, c2.psi.hill(3)), repeats)
    lines.append(f"| approach outcomes, n = 3, eight families compared | {cost:.1f} | |")
    psi = c2.psi.hill(3)
    cost, error = standing_row(repeats)
    lines.append(f"| what stands still along f1 of the same system, general, as text | {cost:.0f} | {error:.0e} |")
    if not quick:
        ring = c2.examples.spinning_annulus()
        cost, along = timed(lambda: equilibrium_branches(ring, c2.psi.constant(), "eta", (0.5, 1.5)), 1)
        count = len(along.special)
        lines.append(f"| the same of the spinning annulus, eta through 1: {count} special values | {cost:.0f} | |")
        cost, curve = timed(lambda: c2.bifurcations.cycle_folds(c2.ELinear(1.0, 1.3, -1.2), psi), 1)
        lines.append(f"| folds of cycles in (f1, f2): {len(curve)} curves | {cost:.0f} | |")
    lines += ["", "| branches of cycles | ms of the processor | error of the period |"]
    lines += ["|---|---|---|", *branch_rows(max(repeats // 3, 1), quick)]
    return "\n".join([*lines, "", f"Load of the machine then: {os.getloadavg()[0]:.1f}."])
