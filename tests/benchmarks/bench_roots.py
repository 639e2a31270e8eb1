"""Limit directions and critical sets: error against time, ours beside numpy.roots, sampling with brentq, SciPy's hybr.

Run ``python -m tests.benchmarks.bench_roots [--quick]``. What counts beside error and time is the number of roots:
near a saddle-node a method may miss a pair or invent one. Counts are exact (integer Sturm sequences), errors are
against 50 digits, in radians.
"""

from __future__ import annotations

import math
import random
import sys
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import brentq, root

from codim2_core import critical_sets, equator_equilibria, examples, psi
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


@dataclass
class General:
    """A general problem: what each method finds, beside what is exact."""

    name: str
    rows: list[tuple[str, str, float, float]] = field(default_factory=list)  # method, count, error, seconds


def general_equator(turns: int) -> General:
    """Limit directions of the non-unique sliding example, z near 0.3: cos theta = 0, sin theta = 0, and eq:exmult."""
    system = examples.nonunique_sliding()

    def exact(z: float) -> np.ndarray:
        half = (1 + 2 * z * z) / (1 + z * z) / 2
        inner = math.sqrt(half * half + 0.5)  # Theta = c s (c² - half² - 1/2)
        roots = [0.0, math.pi / 2, math.pi, 3 * math.pi / 2]
        if inner < 1.0:
            t = math.acos(inner)
            roots += [t, math.pi - t, math.pi + t, TURN - t]
        return np.sort(np.mod(roots, TURN))

    def U(z: float) -> Callable[[np.ndarray], np.ndarray]:
        at = system.at((z,))

        def Theta(t: np.ndarray) -> np.ndarray:
            e = np.stack([np.cos(t), np.sin(t)], axis=-1)
            u = at.U(e)
            return u[..., 1] * e[..., 0] - u[..., 0] * e[..., 1]

        return Theta

    def sampled(count: int) -> Callable[[float], np.ndarray]:
        def run(z: float) -> np.ndarray:
            f = U(z)
            grid = TURN * (np.arange(count + 1) + 0.31) / count
            values = f(grid)
            at = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0)
            return np.array([brentq(lambda t: float(f(np.array(t))), grid[i], grid[i + 1], xtol=1e-15) for i in at])

        return run

    def companion(count: int) -> Callable[[float], np.ndarray]:
        def run(z: float) -> np.ndarray:
            series = np.fft.fft(U(z)(TURN * np.arange(count) / count)) / count
            order = count // 2 - 1
            kept = np.concatenate([series[-order:], series[: order + 1]])[::-1]
            small = np.abs(kept) < 1e-13 * np.abs(kept).max()
            first = int(np.argmin(small))
            z_roots = np.roots(kept[first : len(kept) - first])
            return np.angle(z_roots[np.abs(np.abs(z_roots) - 1.0) < ON_CIRCLE])

        return run

    methods: dict[str, Callable[[float], np.ndarray]] = {
        "ours": lambda z: equator_equilibria(system, (z,)).theta,
        "interpolation, numpy.roots": companion(32),
        **{f"{n} samples, brentq": sampled(n) for n in RESOLUTIONS[:3]},
    }
    return _measured("limit directions, non-unique sliding", methods, exact, turns)


def critical_general(turns: int) -> General:
    """Critical sets of the same example: (0, 0) and (+-chi/2, 0), exact; hybr from so many starts finds them or not."""
    system, shape = examples.nonunique_sliding(), psi.rational()

    def exact(z: float) -> np.ndarray:
        half = (1 + 2 * z * z) / (1 + z * z) / 2
        return np.array([-half, 0.0, half])

    def starts(count: int) -> Callable[[float], np.ndarray]:
        k = np.arange(count)
        r, t = np.sqrt((k + 0.5) / count), 2.399963 * k
        places = np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)

        def run(z: float) -> np.ndarray:
            at = system.at((z,))
            found: list[np.ndarray] = []
            for place in places:
                done = root(lambda e: at.U(e), place, jac=lambda e: at.DU(e), tol=1e-14)
                inside = done.success and np.hypot(*done.x) < 1.0
                if inside and all(np.hypot(*(done.x - other)) > 1e-6 for other in found):
                    found.append(done.x)
            return np.sort([e[0] for e in found])

        return run

    methods: dict[str, Callable[[float], np.ndarray]] = {
        "ours": lambda z: np.sort([C.e[0] for C in critical_sets(system, shape, (z,))]),
        **{f"hybr, {n} starts": starts(n) for n in (4, 16, 64)},
    }
    return _measured("critical sets, non-unique sliding", methods, exact, turns)


def _measured(
    name: str,
    methods: dict[str, Callable[[float], np.ndarray]],
    exact: Callable[[float], np.ndarray],
    turns: int,
) -> General:
    result = General(name)
    times: dict[str, list[float]] = {method: [] for method in methods}
    z = 0.3
    for method in methods.values():
        method(z)
    for _ in range(turns):
        for method, run in methods.items():
            z += 1e-7
            times[method].append(clock(lambda _, r=run, at=z: r(at), 0.0))
    for method, run in methods.items():
        z += 1e-7
        true, found = exact(z), np.atleast_1d(run(z))
        error = math.nan
        if name.startswith("limit"):
            found = np.sort(np.mod(found + 1e-9, TURN) - 1e-9)
        if len(found) == len(true):
            error = float(np.abs(found - true).max())
        result.rows.append((method, f"{len(found)} of {len(true)}", error, float(np.median(times[method]))))
    return result


@dataclass
class Roots:
    """All that is measured here."""

    equator: list[Row]
    general: list[General]


def measure(quick: bool = False) -> Roots:
    """Measure everything."""
    turns = 5 if quick else 41
    general = [general_equator(turns), critical_general(turns)]
    return Roots(equator_rows(40 if quick else 300, 3 if quick else 9), general)


def text(found: Roots) -> str:
    """Both tables as Markdown."""
    lines = [
        "| limit directions of e-linear systems | method | wrong counts | worst error, ulp (1 + condition) | µs |",
        "|---|---|---|---|---|",
    ]
    for row in found.equator:
        error = "–" if math.isnan(row.error) else f"{row.error:.1f}"
        lines.append(f"| {row.family} | {row.method} | {row.wrong:.0%} | {error} | {row.microseconds:.0f} |")
    lines += ["", "| roots of one system, not seen before | method | found | error | ms |", "|---|---|---|---|---|"]
    for item in found.general:
        for method, count, error, seconds in item.rows:
            shown = "–" if math.isnan(error) else f"{error:.0e}"
            lines.append(f"| {item.name} | {method} | {count} | {shown} | {1e3 * seconds:.3f} |")
    return "\n".join(lines)


def plots(found: Roots) -> list[Plot]:
    """Error against time, a point for each family of systems; and share of wrong counts against time."""
    errors: dict[str, list[tuple[float, float]]] = {}
    wrong: dict[str, list[tuple[float, float]]] = {}
    for row in found.equator:
        errors.setdefault(row.method, []).append((row.error, 1e-6 * row.microseconds))
        gap = float(row.family.split()[-1]) if "±" in row.family else 1.0
        wrong.setdefault(row.method, []).append((gap, max(row.wrong, 1e-4)))
    return [
        plot("limit directions (right counts)", errors, x="worst error, ulp (1 + condition)", y="seconds a system"),
        plot("limit directions: wrong counts", wrong, x="distance from a saddle-node", y="share wrong (1e-4: none)"),
    ] + [
        plot(item.name, {method: [(error, seconds)] for method, _, error, seconds in item.rows}, x="error")
        for item in found.general
    ]


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    return text(measure(quick))


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
