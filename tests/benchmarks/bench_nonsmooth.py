"""Motions in the limit against SciPy told its events by hand: ``python -m tests.benchmarks nonsmooth [--quick]``.

SciPy is told what we have to find out: which phases follow one another, where each ends (a terminal event: the distance
to Sigma, or |e| = 1), and e on Sigma in closed form; its right-hand sides and events are compiled by Numba. Each motion
from several starts, with LSODA, Radau and DOP853. For each true error that is asked, of the end and of the times of all
phases, the processor time of the cheapest setting that meets it; the ratio is that of the best of SciPy to ours. The
reference is our own run at 1e-13; how near SciPy comes to it is printed: the two share nothing.
"""

from __future__ import annotations

import math
import sys
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from codim2_core import System, psi, simulate_nonsmooth
from codim2_core.systems.kinds import AnySystem

from .bench_compiled import ERRORS, PATIENCE, costs, readme, summary
from .motions import MOTIONS, Motion

__all__ = ["readme", "report"]

METHODS = ("LSODA", "Radau", "DOP853")
LEAVING = 1e-6  # the time after which a motion that left Sigma is handed on
Array = np.ndarray

_OWN = System(U=("-2*c + 0.3*sin(z1) - x/4", "-s*(1 + c/5)"), W=("cos(z1) - c",))
OWN = Motion(_OWN, (0.6, -0.4, 0.2), 4.0, ("-2*c + 0.3*sin(z[0]) - q[0]/4", "-s*(1 + c/5)", "cos(z[0]) - c"))


@dataclass(frozen=True)
class Told:
    """What is known of a motion by hand.

    Attributes
    ----------
    motion : Motion
    starts : tuple of states, each with its last time and its phases in order
    e : tuple of str
        e on Sigma, as Python text in z[0], z[1].
    """

    motion: Motion
    starts: tuple[tuple[tuple[float, ...], float, tuple[str, ...]], ...]
    e: tuple[str, str]


_SLIDES, _G = ("slip", "slide"), 9.81
TOLD = {
    "ball": Told(
        MOTIONS["ball"],
        (
            ((-1.0, 0.3, 10.0, 0.0), 3.0, _SLIDES),
            ((1.0, 0.0, 3.0, 0.0), 3.0, _SLIDES),
            ((0.5, -0.4, 2.0, 1.0), 2.0, _SLIDES),
        ),
        (f"-2*z[0]/{3.5 * 0.2 * _G!r}", f"-2*z[1]/{3.5 * 0.2 * _G!r}"),
    ),
    "block": Told(
        MOTIONS["block"],
        (((0.3, 0.1, 0.1), 5.0, _SLIDES), ((-0.2, 0.3, 0.05), 5.0, _SLIDES)),
        (
            f"{math.cos(0.5) / 0.3!r}*sin(z[0])/cos(z[0])",
            f"{math.sin(0.5) / 0.6!r}*sin(z[0])/cos(z[0])",
        ),
    ),
    "non-unique sliding": Told(
        MOTIONS["non-unique sliding"],
        (((0.25, 0.3, 0.0), 2.0, _SLIDES), ((0.02, 0.01, 0.1), 1.0, _SLIDES)),
        ("0.5*(1 + 2*z[0]*z[0])/(1 + z[0]*z[0])", "0.0*z[0]"),
    ),
    "forced": Told(
        MOTIONS["forced"],
        (((0.3, 0.2, 0.0), 3.9, _SLIDES), ((0.3, 0.2, 0.0), 10.0, _SLIDES * 3)),
        ("1.3*sin(z[0])", "0.4*cos(2*z[0])"),
    ),
    "so(2,1)": Told(
        MOTIONS["so(2,1)"], (((0.3, 0.2), 10.0, ("slip",)), ((-0.5, 0.1), 20.0, ("slip",))), ("0.0", "0.0")
    ),
    "typed": Told(OWN, ((OWN.start, 4.0, _SLIDES), ((-0.8, 0.5, 1.0), 4.0, _SLIDES)), ("0.15*sin(z[0])", "0.0*z[0]")),
}  # fmt: skip


def compiled(told: Told) -> tuple[Callable[..., Array], ...]:
    """The slip and the slide, and where each ends: functions of (t, q, close), on Sigma of (t, z, close)."""
    names = {"sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "pack": np.array}
    slip = njit(error_model="numpy")(told.motion.field(**names))
    source = "\n".join(
        [
            "def e_of(z):",
            f"    return {told.e[0]}, {told.e[1]}",
            "def slide(t, z, close):",
            "    q = (0.0, 0.0)",
            "    c, s = e_of(z)",
            f"    return pack([{', '.join(told.motion.rows[2:])}])",
            "def inside(t, z, close):",
            "    c, s = e_of(z)",
            "    return 1.0 - c*c - s*s",
        ]
    )
    scope: dict[str, object] = {**names}
    exec(source, scope)  # the formulas above
    scope["e_of"] = njit(error_model="numpy")(scope["e_of"])
    slide, inside = (njit(error_model="numpy")(scope[name]) for name in ("slide", "inside"))
    limit = njit(error_model="numpy")(lambda t, q, close: slip(t, q, 0.0))
    distance = njit(error_model="numpy")(lambda t, q, close: math.sqrt(q[0] * q[0] + q[1] * q[1]) - close)
    return limit, distance, slide, inside, scope["e_of"]  # type: ignore[return-value]


def by_hand(told: Told, parts: tuple[Callable[..., Array], ...], start, t_end: float, kinds, method: str):
    """SciPy at a tolerance."""
    limit, distance, slide, inside, e_of = parts
    shrinking, open_ = _event(distance), _event(inside)

    def run(tolerance: float) -> Array:
        t, q, close, ends = 0.0, np.array(start), max(1e-3 * tolerance, 1e-14), list[float]()
        options = {"method": method, "rtol": max(tolerance, 3e-14), "atol": tolerance, "args": (close,)}
        for kind in kinds:
            if kind == "slip":
                # x and y go down to `close`: that is what atol must resolve
                fine = {**options, "atol": np.array([0.1 * close] * 2 + [tolerance] * (len(q) - 2))}
                found = solve_ivp(limit, (t, t_end), q, events=shrinking, **(fine if len(kinds) > 1 else options))
                t, q = float(found.t[-1]), found.y[:, -1].copy()
                if found.status == 1:  # the rest of the way is straight
                    rate, rho = limit(t, q, close), math.hypot(q[0], q[1])
                    rest = -rho * rho / float(q[0] * rate[0] + q[1] * rate[1])
                    t, q = t + rest, q + rest * rate
                    q[:2] = 0.0
            elif t < t_end:
                found = solve_ivp(slide, (t, t_end), q[2:], events=open_, **options)
                t, q[2:] = float(found.t[-1]), found.y[:, -1]
                if found.status == 1:  # U = g(z) - e: it leaves along g, as fast as |g| - 1, which has just been 0
                    q[2:] += LEAVING * slide(t, q[2:], close)
                    t += LEAVING
                    g = np.array(e_of(q[2:]))
                    size = math.hypot(*g)
                    q[:2] = 0.5 * LEAVING * (size - 1.0) * g / size
            ends.append(t)
            if found.status < 0:
                break
        whole = t >= t_end * (1.0 - 1e-12)
        return np.array([*q, *ends[:-1]]) if whole else np.full(len(q) + len(kinds) - 1, math.inf)

    return run


def _event(function: Callable[..., float]) -> Callable[..., float]:
    def event(t: float, q: Array, close: float) -> float:
        return function(t, q, close)

    event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
    return event


def row(name: str, turns: int, which: int) -> tuple[str, list[float]]:
    """One motion from one start, and its ratios."""
    told = TOLD[name]
    start, t_end, kinds = told.starts[which]
    system: AnySystem = told.motion.system
    shape, parts = psi.constant(), compiled(told)

    def ours(tolerance: float) -> Array:
        run = simulate_nonsmooth(system, start, (0.0, t_end), shape, rtol=tolerance, atol=tolerance)
        return np.array([*run.states[-1], *(phase.t_end for phase in run.phases[:-1])])

    for _ in range(20):  # until it is compiled
        run = simulate_nonsmooth(system, start, (0.0, t_end), shape, rtol=1e-13, atol=1e-15)
    assert [phase.kind for phase in run.phases] == list(kinds), (name, [phase.kind for phase in run.phases])
    exact = ours(1e-13)
    own = costs(ours, exact, 10.0 ** -np.arange(2.0, 13.1, 0.5), turns + 1)
    longest = PATIENCE * max(1e-3, max((taken for taken, _ in own.values() if taken < math.inf), default=0.0))
    theirs = {}
    for method in METHODS:
        run_by_hand = by_hand(told, parts, start, t_end, kinds, method)
        run_by_hand(1e-3)  # compiles
        theirs[method] = costs(run_by_hand, exact, 10.0 ** -np.arange(3.0, 13.1, 1.0), turns, longest)
    nearest = min(error for found in theirs.values() for _, error in found.values())
    cells, ratios = [], []
    for asked in ERRORS:
        (best, error), method = min((found[asked], method) for method, found in theirs.items())
        taken, own_error = own[asked]
        ratios.append(best / taken if math.isfinite(taken) else math.nan)
        told_in = f"{1e3 * best:.2g} {method} {error:.0e}" if math.isfinite(best) else "none"
        cells.append(f"{1e3 * taken:.2g} {own_error:.0e} / {told_in} (**{best / taken:.1f}**)")
    return f"| {name}: {', '.join(kinds)} | {nearest:.0e} | " + " | ".join(cells) + " |", ratios


def many(count: int) -> str:
    """Motions at once."""
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4)) * (1.0, 1.0, 5.0, 5.0)
    system, shape = MOTIONS["ball"].system, psi.constant()
    simulate_nonsmooth(system, states[:20], (0.0, 2.0), shape, rtol=1e-6, atol=1e-8)
    wall, cpu = time.perf_counter(), time.process_time()
    simulate_nonsmooth(system, states, (0.0, 2.0), shape, rtol=1e-6, atol=1e-8)
    wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
    return f"{count} motions of the ball in the limit to t = 2 at 1e-6: {wall:.2f} s ({cpu:.2f} s of processor time)."


def report(quick: bool = False) -> str:
    """Return times and ratios as Markdown."""
    lines = [
        "| motion | SciPy to the reference | "
        + " | ".join(f"{e:.0e}: ms, true error: ours / best of SciPy (ratio)" for e in ERRORS)
        + " |",
        "|" + "---|" * (2 + len(ERRORS)),
    ]
    ratios: list[list[float]] = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # LSODA gives up loudly
        for name, told in TOLD.items():
            for which in range(1 if quick else len(told.starts)):
                line, found = row(name, 1 if quick else 3, which)
                lines.append(line)
                ratios.append(found)
    lines += ["", summary("limit ε → 0, SciPy with compiled functions and told all events by hand", ratios, METHODS)]
    return "\n".join([*lines, "", many(1000 if quick else 10_000)])


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
