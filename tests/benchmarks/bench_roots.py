"""Limit directions: error against time, ours next to numpy.roots and sampling with brentq.

Run ``python -m tests.benchmarks roots [--quick]``. What counts next to error and time is the number of roots:
near a saddle-node a method may miss a pair or invent one. Counts are exact (integer Sturm sequences), errors are
against 50 digits, in radians.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from codim2_core import equator_equilibria
from codim2_core.systems.coefficients import Coefficients

from ..core.exact_trigonometric import count_equilibria, root_error, theta_coefficients
from .pictures import Plot, plot
from .race import clock

Numbers = tuple[float, float, float, float, float]
TURN = 2.0 * math.pi
ON_CIRCLE = 1e-6  # how far from |z| = 1 numpy.roots may be and still count
GAPS = (0.0, 3.0, 6.0, 9.0, 12.0)  # saddle-node +- 10^-k; 0: uniform
RESOLUTIONS = (32, 128, 512, 2048)


def near(rng: random.Random, power: float) -> Numbers:
    """A point of eq:tangencies, with b moved by 10^-power of itself to either side."""
    a, b, d = (rng.uniform(-2, 2) for _ in range(3))
    c, s = math.cos(theta := rng.uniform(0, TURN)), math.sin(theta)
    f1, f2 = b * s - (a - d) * c**3, (a - d) * s**3 - b * c
    return a, b * (1 + rng.choice((1, -1)) * 10.0**-power), d, f1, f2


def by_companion(q: Numbers) -> list[float]:
    """numpy.roots on z = exp(i theta), the roots near the circle polished by two Newton steps."""
    a, b, d, f1, f2 = q
    g, h = (d - a) / 4j, f2 / 2 - f1 / 2j
    z = np.roots([g, h, b, f2 / 2 + f1 / 2j, -g])
    theta = np.angle(z[np.abs(np.abs(z) - 1.0) < ON_CIRCLE])
    for _ in range(2):
        c, s = np.cos(theta), np.sin(theta)
        slope = (d - a) * (c * c - s * s) - f2 * s - f1 * c
        with np.errstate(all="ignore"):
            theta = theta - ((d - a) * s * c + f2 * c - f1 * s + b) / slope
    return [t for t in theta.tolist() if math.isfinite(t)]


def by_samples(count: int) -> Callable[[Numbers], list[float]]:
    """Sign changes on so many samples, then brentq."""
    grid = TURN * (np.arange(count + 1) + 0.31) / count
    c, s = np.cos(grid), np.sin(grid)

    def run(q: Numbers) -> list[float]:
        a, b, d, f1, f2 = q

        def f(t: float) -> float:
            return (d - a) * math.sin(t) * math.cos(t) + f2 * math.cos(t) - f1 * math.sin(t) + b

        values = (d - a) * s * c + f2 * c - f1 * s + b
        found = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0)
        return [brentq(f, grid[i], grid[i + 1], xtol=1e-15, rtol=8.9e-16) for i in found]

    return run


def by_ours(q: Numbers) -> list[float]:
    """Our public function, eigenvalues included."""
    a, b, d, f1, f2 = q
    at = Coefficients(a, b, d, f1, f2, np.zeros((0, 2)), np.zeros(0))
    return equator_equilibria(at).theta.tolist()


METHODS: dict[str, Callable[[Numbers], list[float]]] = {
    "ours": by_ours,
    "numpy.roots": by_companion,
    **{f"{n} samples, brentq": by_samples(n) for n in RESOLUTIONS},
}


@dataclass
class Row:
    """One method on one family of systems."""

    family: str
    method: str
    wrong: float  # share of systems with a wrong count
    error: float  # median over systems of the worst root's error, radians, in ulp (1 + condition)
    microseconds: float


def equator_rows(count: int, turns: int) -> list[Row]:
    """All methods on all families, timed in turns."""
    rng = random.Random(3)
    rows = []
    for gap in GAPS:
        draw = (lambda gap=gap: near(rng, gap)) if gap else lambda: tuple(rng.uniform(-2.0, 2.0) for _ in range(5))
        systems: list[Numbers] = [draw() for _ in range(count)]
        counts = [count_equilibria(*q) for q in systems]
        fifty = [theta_coefficients(*q) for q in systems]
        times: dict[str, list[float]] = {name: [] for name in METHODS}
        for _ in range(turns):
            for name, method in METHODS.items():
                times[name].append(clock(lambda _, m=method, all_=systems: [m(q) for q in all_], 0.0) / count)
        for name, method in METHODS.items():
            found = [method(q) for q in systems]
            right = [i for i in range(count) if len(found[i]) == counts[i]]
            errors = [max((root_error(fifty[i], t)[0] for t in found[i]), default=0.0) for i in right]
            title = f"saddle-node ± 1e-{gap:.0f}" if gap else "uniform"
            error = float(np.max(errors)) if errors else math.nan
            rows.append(Row(title, name, 1.0 - len(right) / count, error, 1e6 * float(np.median(times[name]))))
    return rows


def measure(quick: bool = False) -> list[Row]:
    """Measure everything."""
    return equator_rows(40 if quick else 300, 3 if quick else 9)


def text(found: list[Row]) -> str:
    """The table as Markdown."""
    lines = [
        "| limit directions of e-linear systems | method | wrong counts | worst error, ulp (1 + condition) | µs |",
        "|---|---|---|---|---|",
    ]
    for row in found:
        error = "–" if math.isnan(row.error) else f"{row.error:.1f}"
        lines.append(f"| {row.family} | {row.method} | {row.wrong:.0%} | {error} | {row.microseconds:.0f} |")
    return "\n".join(lines)


def plots(found: list[Row]) -> list[Plot]:
    """Share of wrong counts against the distance from a saddle-node, a point for each family of systems."""
    wrong: dict[str, list[tuple[float, float]]] = {}
    for row in found:
        gap = float(row.family.split()[-1]) if "±" in row.family else 1.0
        wrong.setdefault(row.method, []).append((gap, max(row.wrong, 1e-4)))
    return [
        plot("limit directions: wrong counts", wrong, x="distance from a saddle-node", y="share wrong (1e-4: none)")
    ]
