"""Motions at eps > 0 and in the nonsmooth limit: error against time, ours beside SciPy; error against eps.

Run ``python -m tests.benchmarks.bench_motions [--quick]``. The ball in the pool, pushed along a line, slips and then
slides, and both are linear: the nonsmooth motion has a closed form. At eps > 0 the reference is heyoka's Taylor method
at 1e-18 where it is installed (eps = 1e-3), else and below that our own run at 1e-13, with SciPy's Radau at 1e-12 as a
witness.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable

import mpmath
import numpy as np
from scipy.integrate import solve_ivp

from codim2_core import examples, psi, simulate, simulate_nonsmooth

from .bench_simulate import COURSES
from .pictures import Plot, plot
from .race import Curve, Runner, race

MU, MASS, K, G = 0.2, 1.0, 2.0, 9.81
STATE, T_END = (1.0, 0.3, 10.0, 0.0), 3.0
LINE = (1.0, 0.0, 3.0, 0.0)  # along a line; it comes to Sigma with |z| < 7 mu m g/(2 K), and slides
EPS = (1e-3, 1e-6)
ALL_EPS = 10.0 ** -np.arange(1.0, 11.0)
Array = np.ndarray


def field(eps: float, e: Callable[[float, float], tuple[float, float]]) -> Callable[[float, Array], tuple[float, ...]]:
    """The ball's equations (sec:ballpool) in floats, the fastest that Python has."""

    def right(t: float, q: Array) -> tuple[float, float, float, float]:
        x, y, u, v = q.tolist()
        c, s = e(x, y)
        push, slow = 3.5 * MU * G, MU * G
        return (
            -push * c - K / MASS * u, -push * s - K / MASS * v, -slow * c - K / MASS * u, -slow * s - K / MASS * v,
        )  # fmt: skip

    return right


def regularised(eps: float) -> Callable[[float, Array], tuple[float, ...]]:
    """With e_Psi, Psi = 1."""

    def e(x: float, y: float) -> tuple[float, float]:
        rho = math.sqrt(x * x + y * y + eps * eps)
        return x / rho, y / rho

    return field(eps, e)


def taylor(eps: float) -> Array | None:
    """The end of the regularised motion by heyoka in extended precision, or None where it is not installed."""
    try:
        import heyoka as hy
    except ImportError:
        return None
    real = np.longdouble
    x, y, u, v = hy.make_vars("x", "y", "u", "v")
    rho = hy.sqrt(x * x + y * y + real(eps) * real(eps))
    push, slow = real(3.5) * real(MU) * real(G), real(MU) * real(G)
    right = [-push * x / rho - K * u, -push * y / rho - K * v, -slow * x / rho - K * u, -slow * y / rho - K * v]
    start = np.array(STATE, real)
    run = hy.taylor_adaptive(
        list(zip((x, y, u, v), right, strict=True)), start, fp_type=real, tol=real("1e-18"), compact_mode=True
    )
    run.propagate_until(real(T_END))
    return np.array(run.state, float)


def regularised_curves(eps: float, turns: int) -> tuple[dict[str, Curve], str]:
    """Error at the end against time, and what the reference is."""
    system, shape, span = examples.ball_in_pool(MU, MASS, K, G), psi.constant(), (0.0, T_END)
    own = simulate(system, shape, eps, STATE, span, rtol=1e-13, atol=1e-15).states[-1]
    witness = solve_ivp(regularised(eps), span, STATE, "Radau", rtol=1e-12, atol=1e-16).y[:, -1]
    end = taylor(eps) if eps >= 1e-3 else None
    note = f"ours at 1e-13 and Radau at 1e-12 differ by {np.abs(own - witness).max():.0e}"
    if end is None:
        end = own
    else:
        note += f", ours and heyoka at 1e-18 by {np.abs(own - end).max():.0e}"

    def ours(tolerance: float) -> Array:
        return simulate(system, shape, eps, STATE, span, rtol=tolerance, atol=tolerance).states[-1]

    def scipy(method: str) -> Callable[[float], Array]:
        right = regularised(eps)

        def run(tolerance: float) -> Array:
            # x and y come down to eps: that is what atol must resolve for an error of its size in z
            return solve_ivp(right, span, STATE, method, rtol=tolerance, atol=tolerance * min(1.0, eps)).y[:, -1]

        return run

    tolerances = 10.0 ** -np.arange(3.0, 13.0, 2.0)
    runners = [Runner("ours", ours, tolerances)]
    runners += [Runner(f"SciPy {method}", scipy(method), tolerances) for method in ("Radau", "LSODA", "BDF")]
    return race(runners, lambda q: float(np.abs(q - end).max()), turns, 1.5), note  # type: ignore[operator]


def closed_form() -> Array:
    """The nonsmooth motion along the line at T_END: linear slip until x = 0, then z' = -5 K z/(7 m)."""
    with mpmath.workdps(30):
        mu, g, k = mpmath.mpf(MU), mpmath.mpf(G), mpmath.mpf(K) / mpmath.mpf(MASS)
        x0, z0 = LINE[0], LINE[2]

        def z(t: mpmath.mpf) -> mpmath.mpf:
            return (z0 + mu * g / k) * mpmath.exp(-k * t) - mu * g / k

        def x(t: mpmath.mpf) -> mpmath.mpf:  # x' = -(7/2) mu g - k z = z' - (5/2) mu g
            return x0 + z(t) - z0 - mpmath.mpf(5) / 2 * mu * g * t

        stop = mpmath.findroot(x, 0.1)
        return np.array([0.0, 0.0, float(z(stop) * mpmath.exp(-5 * k / 7 * (T_END - stop))), 0.0])


def nonsmooth_curves(turns: int) -> dict[str, Curve]:
    """The limit itself: events and sliding known to us; told by hand to SciPy."""
    system, end = examples.ball_in_pool(MU, MASS, K, G), closed_form()

    def ours(tolerance: float) -> Array:
        return simulate_nonsmooth(system, LINE, (0.0, T_END), psi.constant(), rtol=tolerance, atol=tolerance).states[-1]

    def by_hand(method: str) -> Callable[[float], Array]:
        slip = field(0.0, lambda x, y: (1.0, 0.0))

        def stop(t: float, q: Array) -> float:
            return q[0]

        stop.terminal = True  # type: ignore[attr-defined]

        def run(tolerance: float) -> Array:
            rtol = max(tolerance, 3e-14)
            first = solve_ivp(slip, (0.0, T_END), LINE, method, events=stop, rtol=rtol, atol=tolerance)
            rate = -5.0 * K / (7.0 * MASS)
            z = first.y[2:, -1]
            second = solve_ivp(lambda t, q: rate * q, (first.t[-1], T_END), z, method, rtol=rtol, atol=tolerance)
            return np.array([0.0, 0.0, *second.y[:, -1]])

        return run

    def regularise(tolerance: float) -> Array:
        run = simulate(system, psi.constant(), tolerance, LINE, (0.0, T_END), rtol=max(tolerance, 1e-12))
        return run.states[-1]

    tolerances = 10.0 ** -np.arange(3.0, 14.0, 2.0)
    runners = [
        Runner("ours", ours, tolerances),
        Runner("SciPy DOP853, the event and the sliding told", by_hand("DOP853"), tolerances),
        Runner("SciPy LSODA, the event and the sliding told", by_hand("LSODA"), tolerances),
        Runner("ours, regularised, ε = rtol", regularise, tolerances[:5]),
    ]
    return race(runners, lambda q: float(np.abs(q - end).max()), turns, 1.0)  # type: ignore[operator]


def limits(quick: bool) -> dict[str, list[tuple[float, float]]]:
    """Distance of the regularised end from the nonsmooth one, for each eps."""
    found = {}
    for name in list(COURSES)[:: 5 if quick else 1]:
        system, shape, state, t = COURSES[name]
        limit = simulate_nonsmooth(system, state, (0.0, t), shape, rtol=1e-12, atol=1e-14).states[-1]
        rows = []
        for eps in ALL_EPS[:: 3 if quick else 1]:
            run = simulate(system, shape, float(eps), state, (0.0, t), rtol=1e-11, atol=1e-13)
            rows.append((float(eps), float(np.abs(run.states[-1] - limit).max())))
        found[name] = rows
    return found


Motions = tuple[dict[str, dict[str, Curve]], dict[str, list[tuple[float, float]]], list[str]]


def measure(quick: bool = False) -> Motions:
    """All curves by title, errors against eps, and notes."""
    turns = 1 if quick else 5
    found, notes = {}, []
    for eps in EPS[: 1 if quick else 2]:
        title = f"ball, ε = {eps:.0e}"
        found[title], note = regularised_curves(eps, turns)
        notes.append(f"{title}: {note}.")
    found["ball, nonsmooth"] = nonsmooth_curves(turns)
    return found, limits(quick), notes


def text(motions: Motions) -> str:
    """Tables as Markdown."""
    found, against_eps, notes = motions
    lines = ["| motion | method | error and ms, from loose to tight |", "|---|---|---|"]
    for title, curves in found.items():
        for name, curve in curves.items():
            points = ", ".join(f"{e:.0e} in {1e3 * t:.1f}" for e, t in curve.points)
            lines.append(f"| {title} | {name} | {points} |")
    lines += ["", " ".join(notes), "", "| motion | slope of the error in ε, 1e-3 … 1e-8 |", "|---|---|"]
    for name, rows in against_eps.items():
        kept = [(e, error) for e, error in rows if 1e-8 <= e <= 1.1e-3 and error > 0.0]
        if len(kept) > 1:
            slope = np.polyfit(*np.log10(np.array(kept)).T, 1)[0]
            lines.append(f"| {name} | {slope:.3f} |")
    return "\n".join(lines)


def plots(motions: Motions) -> list[Plot]:
    """Work-precision of each motion, and the error against eps."""
    found, against_eps, _ = motions
    drawn = [plot(title, {name: c.points for name, c in curves.items()}) for title, curves in found.items()]
    return [*drawn, plot("distance from the nonsmooth limit", against_eps, x="ε", y="error")]


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    return text(measure(quick))


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
