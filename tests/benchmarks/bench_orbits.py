"""Limit cycles and separatrices: error against time, ours next to SciPy with a Poincare section.

Run ``python -m tests.benchmarks orbits [--quick]``. Periods are held against an extrapolation method (Gragg,
Bulirsch, Stoer) at 22 digits; separatrices against DOP853 at 3e-14 from 1e-8 next to the saddle.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from codim2_core import Preset, critical_sets, limit_cycles, presets, psi, separatrices
from codim2_core.portrait.layer_problem.hemisphere import flow

from .pictures import Plot, plot
from .race import Curve, Runner, race

PERIODS = {"case3-n3": 0.5044751410092433, "case3-n4": 0.6066957493683202}
TURNS = 4.5  # of the cycle, which attracts: its multiplier is below 4e-6
SHAPE = psi.rational()
REACH = (1e-3, 0.5)  # distances from the saddle at which separatrices are compared
Array = np.ndarray


def scipy_period(preset: Preset, method: str, period: float) -> Callable[[float], float]:
    """The time between the last two crossings of a half-line from C: the field in kappa_2, in floats."""
    a, b, d, f1, f2 = preset.system.at(()).plane
    n, C = preset.psi.parameter or 1, critical_sets(preset.system, preset.psi)[0].x2

    def right(t: float, q: Array) -> tuple[float, float]:
        x, y = q.tolist()
        s = x * x + y * y
        k = 1.0 / math.sqrt(s + 3.0 / (3.0 + (4.0 * s) ** n))
        return k * (a * x - b * y) + f1, k * (b * x + d * y) + f2

    def section(t: float, q: Array) -> float:
        return q[1] - C[1]

    section.direction = 1.0  # type: ignore[attr-defined]

    def run(tolerance: float) -> float:
        done = solve_ivp(
            right, (0.0, TURNS * period), C + np.array([0.2, 0.0]), method, rtol=max(tolerance, 3e-14), atol=tolerance,
            events=section,
        )  # fmt: skip
        crossings = done.t_events[0]
        return float(crossings[-1] - crossings[-2]) if len(crossings) > 2 else math.nan

    return run


def cycle_curves(name: str, turns: int) -> dict[str, Curve]:
    """Relative error of a period against time."""
    preset, period = presets[name], PERIODS[name]
    tolerances = 10.0 ** -np.arange(3.0, 14.0, 2.0)
    runners = [Runner("ours (one call finds all)", lambda _: limit_cycles(preset.system, preset.psi)[0].period, (0.0,))]
    others = [(name, scipy_period(preset, name, period)) for name in ("DOP853", "LSODA", "RK45")]
    runners += [Runner(f"SciPy {name}, section", run, tolerances) for name, run in others]
    return race(runners, lambda found: abs(float(found) / period - 1.0), turns, 1.0)  # type: ignore[arg-type]


def branches() -> tuple[Callable[[float, Array], Array], Array, list[tuple[Array, float]]]:
    """The field on the disc, the saddle, and its four branches: direction, and the sense of time."""
    system = presets["case2-saddle"].system
    at, C = system.at(()), critical_sets(system, SHAPE)[0]
    step = 1e-6

    def right(t: float, p: Array) -> Array:
        return flow(at, SHAPE, p)

    columns = [(flow(at, SHAPE, C.p + e) - flow(at, SHAPE, C.p - e)) / (2 * step) for e in step * np.eye(2)]
    values, vectors = np.linalg.eig(np.stack(columns, axis=-1))
    found = []
    for i, value in enumerate(values.real):
        found += [(side * vectors[:, i].real, math.copysign(1.0, value)) for side in (1.0, -1.0)]
    return right, C.p, found


def followed(offset: float, tolerance: float, dense: bool = False) -> list:
    """Branches by SciPy's DOP853, from `offset` next to the saddle along its eigenvectors."""
    right, C, found = branches()
    results = []
    for direction, sense in found:
        start = C + offset * direction

        def field(t: float, p: Array, sense: float = sense) -> Array:
            return sense * right(t, p)

        def gone(t: float, p: Array) -> float:
            return math.hypot(p[0] - C[0], p[1] - C[1]) - REACH[1]

        gone.terminal = True  # type: ignore[attr-defined]
        results.append(
            solve_ivp(
                field, (0.0, 60.0), start, "DOP853", rtol=tolerance, atol=tolerance, events=gone, dense_output=dense
            )
        )
    return results


class Skeleton:
    """The reference, and how far points are from it."""

    def __init__(self) -> None:
        self.right, self.C, _ = branches()
        self.solutions = [done.sol for done in followed(1e-8, 3e-14, dense=True)]
        self.times = [np.linspace(0.0, sol.t_max, 4000) for sol in self.solutions]
        self.lines = [sol(t).T for sol, t in zip(self.solutions, self.times, strict=True)]

    def distance(self, p: Array) -> float:
        """From the nearest branch: Newton on the foot of the perpendicular."""
        i = min(range(len(self.lines)), key=lambda i: float(np.hypot(*(self.lines[i] - p).T).min()))
        t = self.times[i][int(np.argmin(np.hypot(*(self.lines[i] - p).T)))]
        for _ in range(4):
            q = self.solutions[i](t)
            u = self.right(t, q) * (1.0 if np.dot(self.solutions[i](t + 1e-6) - q, self.right(t, q)) > 0 else -1.0)
            t = min(max(t + float(np.dot(p - q, u) / np.dot(u, u)), 0.0), self.solutions[i].t_max)
        q = self.solutions[i](t)
        return float(np.hypot(*(p - q)))

    def error(self, lines: object) -> float:
        """The largest distance of points in reach."""
        points = np.concatenate(lines)  # type: ignore[call-overload]
        away = np.hypot(*(points - self.C).T)
        points = points[(away > REACH[0]) & (away < 0.98 * REACH[1])]
        return max(map(self.distance, points[:: max(1, len(points) // 60)]), default=math.nan)


def separatrix_curves(turns: int) -> dict[str, Curve]:
    """Distance from the true separatrices of the saddle of Case II against time: all separatrices of the portrait."""
    skeleton, system = Skeleton(), presets["case2-saddle"].system

    def ours(tolerance: float) -> list[Array]:
        found = separatrices(system, SHAPE, rtol=tolerance)
        return [branch.points[1:-1] for branch in found if branch.origin == "C"]

    def theirs(tolerance: float) -> list[Array]:
        return [done.y.T[1:-1] for done in followed(math.sqrt(tolerance), tolerance)]

    tolerances = 10.0 ** -np.arange(4.0, 13.0, 2.0)
    runners = [
        Runner("ours (8 branches and their ends)", ours, tolerances),
        Runner("SciPy DOP853, 4 branches, offset √rtol", theirs, tolerances),
    ]
    return race(runners, skeleton.error, turns, 1.0)


def measure(quick: bool = False) -> dict[str, dict[str, Curve]]:
    """All curves by title."""
    turns = 3 if quick else 9
    found = {f"period, {presets[name].title}": cycle_curves(name, turns) for name in PERIODS}
    return found | {"separatrices of a saddle": separatrix_curves(turns)}


def text(found: dict[str, dict[str, Curve]]) -> str:
    """One table as Markdown."""
    lines = ["| problem | method | error and ms, from loose to tight |", "|---|---|---|"]
    for title, curves in found.items():
        for name, curve in curves.items():
            points = ", ".join(f"{e:.0e} in {1e3 * t:.1f}" for e, t in curve.points)
            lines.append(f"| {title} | {name} | {points} |")
    return "\n".join(lines)


def plots(found: dict[str, dict[str, Curve]]) -> list[Plot]:
    """One plot for each problem."""
    return [
        plot(title, {name: curve.points for name, curve in curves.items()}, x="relative error" if "period" in title else
             "distance from the true curve")
        for title, curves in found.items()
    ]  # fmt: skip
