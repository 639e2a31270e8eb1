"""64 trajectories: true error against run time, ours next to SciPy, Numba-LSODA, diffrax and heyoka.

Run ``python -m tests.benchmarks trajectories [--quick]``. All run on one thread, on the same
formulas and seeds, in turns; the error is the largest over the 64 ends, against 30 digits or an exact solution
(`problems`). Times of early ends (our `capture`) and of drawing are left out. numbalsoda needs a Fortran compiler to
install, diffrax brings JAX; what is not installed is named and skipped.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass

import numpy as np

from .methods import METHODS, OURS, QUICK, Method
from .pictures import Plot, plot
from .problems import Problem, problems
from .race import DECADES, Curve, Runner, race, ratio

QUICK_PROBLEMS = ("so(2,1)", "Case I CM4", "Case III n = 3", "near the equator")
SHOWN = ("so(2,1)", "Case I CM4", "Case III n = 3", "Case I, hill n = 16", "near the equator", "past a saddle")


@dataclass(frozen=True)
class Race:
    """One problem's curves, and who could not run."""

    problem: Problem
    curves: dict[str, Curve]
    absent: dict[str, str]


def entered(problem: Problem, methods: tuple[Method, ...]) -> tuple[list[Runner], dict[str, str]]:
    """Return who runs, and why others do not."""
    runners, absent = [], {}
    for method in methods:
        try:
            repeats = 5 if method is OURS else 1
            run = method.prepare(problem)
            runners.append(Runner(method.name, run, method.tolerances, method.share, repeats))
        except (ImportError, OSError) as error:
            absent[method.name] = f"{type(error).__name__}: {error}"
    return runners, absent


def measure(quick: bool = False) -> list[Race]:
    """Run the races: all problems and methods, or a few."""
    methods = (OURS, *(m for m in METHODS if not quick or m.name in QUICK))
    chosen = [p for p in problems() if not quick or p.name in QUICK_PROBLEMS]
    races = []
    for problem in chosen:
        runners, absent = entered(problem, methods)
        end = problem.end

        def error(result: object, end: np.ndarray = end) -> float:
            worst = float(np.abs(np.asarray(result) - end).max())
            return worst if math.isfinite(worst) else math.inf

        races.append(Race(problem, race(runners, error, 3 if quick else 5, 0.15), absent))
        print(f"raced: {problem.name}", file=sys.stderr, flush=True)
    return races


def short(value: float) -> str:
    """A ratio."""
    if math.isnan(value):
        return "ours does not reach it"
    if math.isinf(value):
        return "–"
    return f"{value:.0f}" if value >= 10.0 else f"{value:.1f}"


def best_table(races: list[Race]) -> str:
    """The best competitor's time over ours, for each problem and decade."""
    head = " | ".join(f"{error:.0e}" for error in DECADES)
    lines = [f"| best other time / ours at the error | {head} | the best other |", "|---" * (len(DECADES) + 2) + "|"]
    for item in races:
        own, cells, winners = item.curves["ours"], [], []
        for error in DECADES:
            others = {name: ratio(curve, own, error) for name, curve in item.curves.items() if name != "ours"}
            name = min(others, key=lambda name: others[name] if not math.isnan(others[name]) else math.inf)
            cells.append(short(others[name]))
            winners.append(name)
        usual = max(set(winners), key=winners.count)
        lines.append(f"| {item.problem.name} | {' | '.join(cells)} | {usual} |")
    return "\n".join(lines)


def slower(races: list[Race]) -> str:
    """Where another one is faster, in words."""
    found = []
    for item in races:
        own = item.curves["ours"]
        for name, curve in item.curves.items():
            values = {error: ratio(curve, own, error) for error in DECADES} if name != "ours" else {}
            lost = {error: value for error, value in values.items() if value < 1.0}
            if lost:
                cases = ", ".join(f"{value:.2f} at {error:.0e}" for error, value in lost.items())
                found.append(f"{item.problem.name}: {name} ({cases})")
            missed = [error for error, value in values.items() if math.isnan(value)]
            if missed and name == "heyoka, batch of 8" and math.isfinite(curve.cost(missed[-1])):
                found.append(f"{item.problem.name}: ours stops short of {missed[-1]:.0e}, {name} does not")
    return "Slower than another one: " + (
        "; ".join(found) + "." if found else "nowhere, at any error from 1e-3 to 1e-12."
    )


def readme(races: list[Race]) -> str:
    """The best competitors over ours, least and median over all problems, at four errors."""
    errors = (1e-3, 1e-6, 1e-9, 1e-12)
    groups = {"SciPy, alone": ", alone", "SciPy, stacked": ", stacked"}
    names = dict.fromkeys(name for item in races for name in item.curves if name != "ours")
    rows = {**groups, **{name: name for name in names if "SciPy" not in name}}
    head = " | ".join(f"{error:.0e}" for error in errors)
    lines = [f"| {len(races)} problems, time / ours at true error | {head} |", "|---" * (len(errors) + 1) + "|"]
    for title, part in rows.items():
        cells = []
        for error in errors:
            found = []
            for item in races:
                group = [ratio(c, item.curves["ours"], error) for name, c in item.curves.items() if part in name]
                found.append(min((value for value in group if not math.isnan(value)), default=math.inf))
            middle, least = short(float(np.median(found))), short(min(found))
            cells.append(middle if middle == least else f"{middle} (least {least})")
        best = " (best method)" if title in groups else ""
        lines.append(f"| {title}{best} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n\n" + slower(races)


def plots(races: list[Race]) -> list[Plot]:
    """One plot for each problem; an error above 1 says nothing on the disc."""
    return [
        plot(
            item.problem.name,
            {name: [point for point in curve.points if point[0] <= 1.0] for name, curve in item.curves.items()},
            x="largest error",
        )
        for item in races
    ]


def missing(races: list[Race]) -> str:
    """Who could not run."""
    absent = {name: why for item in races for name, why in item.absent.items()}
    return "\n\n".join(f"Not run: {name} ({why})." for name, why in absent.items())


def text(races: list[Race]) -> str:
    """All tables, as Markdown."""
    return "\n\n".join(filter(None, (best_table(races), readme(races), missing(races))))
