"""Motions against SciPy: error next to time, for eps > 0 and in the limit: ``python -m tests.benchmarks motions``.

SciPy's right-hand sides are compiled by Numba. For eps > 0: the five motions of `motions` from 1e-1 to 1e-12, each
method with two absolute tolerances, against the stored ends. In the limit SciPy is told what we have to find out: which
phases follow one another, where each ends (a terminal event: the distance to Sigma, or |e| = 1), and e on Sigma in
closed form; errors are of the end and of the times of all phases, the reference is our own run at 1e-13, and how near
SciPy comes to it is printed: the two share nothing.

All run in turns in one process. For each true error that is asked, the processor time of the cheapest setting that
meets it; the ratio is that of the best of SciPy to ours (inf where none of its settings meets it within 30 times our
longest run). Last, ten thousand motions at once.
"""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from scipy.integrate import solve_ivp

from codim2_core import System, psi, simulate, simulate_nonsmooth

from .motions import EPS, MOTIONS, Motion, ends, key

METHODS = ("LSODA", "Radau", "DOP853", "BDF")
TOLD_METHODS = METHODS[:3]
ERRORS = (1e-3, 1e-6, 1e-9, 1e-12)
PATIENCE = 30.0  # times our longest run (at least 1 ms) that a setting may take; no tighter one is tried then
LEAVING = 1e-6  # the time after which a motion that left Sigma is handed on
Array = np.ndarray
Run = Callable[[float], Array]
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
    run: Run, exact: Array, tolerances: Sequence[float], turns: int, longest: float = math.inf
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


def raced(ours: Run, exact: Array, theirs: Sequence[tuple[str, Run]], turns: int) -> tuple[str, list[float], float]:
    """Cells of a row, ratios, and the least error of theirs."""
    own = costs(ours, exact, 10.0 ** -np.arange(2.0, 13.1, 0.5), turns + 1)
    longest = PATIENCE * max(1e-3, max((taken for taken, _ in own.values() if taken < math.inf), default=0.0))
    found = [(method, costs(run, exact, 10.0 ** -np.arange(3.0, 13.1, 1.0), turns, longest)) for method, run in theirs]
    cells, ratios = [], []
    for asked in ERRORS:
        (best, error), method = min((each[asked], method) for method, each in found)
        taken, own_error = own[asked]
        ratios.append(best / taken if math.isfinite(taken) else math.nan)
        told = f"{1e3 * best:.2g} {method} {error:.0e}" if math.isfinite(best) else f"none in {1e3 * longest:.0f}"
        cells.append(f"{1e3 * taken:.2g} {own_error:.0e} / {told} (**{best / taken:.1f}**)")
    return " | ".join(cells), ratios, min(error for _, each in found for _, error in each.values())


def scipy(field: Callable[..., Array], start: Sequence[float], t: float, eps: float, method: str, fine: bool):
    """solve_ivp at a tolerance; with an absolute tolerance in the size of x and y on Sigma, or not."""

    def run(tolerance: float) -> Array:
        atol = tolerance * min(1.0, eps) if fine else tolerance
        found = solve_ivp(field, (0.0, t), start, method, args=(eps,), rtol=max(tolerance, 3e-14), atol=atol)
        return found.y[:, -1] if found.status == 0 else np.full(len(start), math.inf)

    return run


def regularised(name: str, eps: float, turns: int) -> tuple[str, list[float]]:
    """One motion at one eps, and its ratios."""
    motion = MOTIONS[name]
    field = njit(error_model="numpy")(motion.field(sqrt=math.sqrt, sin=math.sin, cos=math.cos, pack=np.array))
    system, shape, start, span = motion.system, psi.constant(), motion.start, (0.0, motion.t_end)
    simulate(system, shape, [start] * 8, span, eps=eps)  # compiles
    field(0.0, np.array(start), eps)

    def ours(tolerance: float) -> Array:
        return simulate(system, shape, start, span, eps=eps, rtol=tolerance, atol=tolerance, max_steps=10**6).states[-1]

    # DOP853 would take steps of length eps
    methods = [one for one in METHODS if one != "DOP853" or eps >= 1e-4 or name == "so(2,1)"]
    theirs = [(m, scipy(field, start, motion.t_end, eps, m, fine)) for m in methods for fine in (True, False)]
    cells, ratios, _ = raced(ours, ends()[key(name, eps)], theirs, turns)
    return f"| {name} | {eps:.0e} | {cells} |", ratios


_OWN = System(U=("-2*c + 0.3*sin(z1) - x/4", "-s*(1 + c/5)"), W=("cos(z1) - c",))
OWN = Motion(_OWN, (0.6, -0.4, 0.2), 4.0, ("-2*c + 0.3*sin(z[0]) - q[0]/4", "-s*(1 + c/5)", "cos(z[0]) - c"))


@dataclass(frozen=True)
class Told:
    """What is known of a motion by hand."""

    motion: Motion
    starts: tuple[tuple[tuple[float, ...], float, tuple[str, ...]], ...]  # states, last times, phases in order
    e: tuple[str, str]  # on Sigma, as Python text in z[0], z[1]


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
    lines = [
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
    scope: dict[str, object] = {**names}
    exec("\n".join(lines), scope)
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


def limit(name: str, which: int, turns: int) -> tuple[str, list[float]]:
    """One motion in the limit from one of its starts, and its ratios."""
    told = TOLD[name]
    start, t_end, kinds = told.starts[which]
    shape, parts = psi.constant(), compiled(told)

    def ours(tolerance: float) -> Array:
        run = simulate_nonsmooth(told.motion.system, start, (0.0, t_end), shape, rtol=tolerance, atol=tolerance)
        return np.array([*run.states[-1], *(phase.t_end for phase in run.phases[:-1])])

    for _ in range(20):  # until it is compiled
        run = simulate_nonsmooth(told.motion.system, start, (0.0, t_end), shape, rtol=1e-13, atol=1e-15)
    assert [phase.kind for phase in run.phases] == list(kinds), (name, [phase.kind for phase in run.phases])
    theirs = [(method, by_hand(told, parts, start, t_end, kinds, method)) for method in TOLD_METHODS]
    for _, run_by_hand in theirs:
        run_by_hand(1e-3)  # compiles
    cells, ratios, nearest = raced(ours, ours(1e-13), theirs, turns)
    return f"| {name}: {', '.join(kinds)} | {nearest:.0e} | {cells} |", ratios


def summary(what: str, ratios: Sequence[Sequence[float]], methods: Sequence[str] = METHODS) -> str:
    """The median and the least of the ratios, those of each motion a row, at each error that is asked; as Markdown."""
    of = np.array(ratios)
    cells = [f"{np.nanmedian(column):.1f} (least {np.nanmin(column):.1f})" for column in (*of.T, of.ravel())]
    head = f"| {what}, time / ours at true error | {' | '.join(f'{asked:.0e}' for asked in ERRORS)} | all |"
    return "\n".join(
        [head, "|" + "---|" * (len(ERRORS) + 2), f"| best of {', '.join(methods)} | {' | '.join(cells)} |"]
    )


def readme(text: str) -> str:
    """What of a report is kept on the page of all: the summaries, and what follows them."""
    return text.split("\n\n", 2)[2]


def many(count: int) -> str:
    """Motions at once."""
    states = np.random.default_rng(0).uniform(-1.0, 1.0, (count, 4)) * (1.0, 1.0, 5.0, 5.0)
    system, shape, span, said = MOTIONS["ball"].system, psi.constant(), (0.0, 2.0), []
    for eps in (1e-2, 1e-4, 1e-6, 0.0):

        def run(some: Array, eps: float = eps) -> object:
            if eps:
                return simulate(system, shape, some, span, eps=eps, rtol=1e-6, atol=1e-8)
            return simulate_nonsmooth(system, some, span, shape, rtol=1e-6, atol=1e-8)

        run(states[:20])
        wall, cpu = time.perf_counter(), time.process_time()
        run(states)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        said.append(f"{f'at ε = {eps:.0e}' if eps else 'in the limit'} {wall:.2f} s ({cpu:.2f} s of processor time)")
    return f"{count} motions of the ball to t = 2 at 1e-6: {', '.join(said)}."


def table(second: str, rows: Sequence[str]) -> str:
    """Rows under their head."""
    asked = " | ".join(f"{e:.0e}: ms, true error: ours / best of SciPy (ratio)" for e in ERRORS)
    return "\n".join([f"| motion | {second} | {asked} |", "|" + "---|" * (2 + len(ERRORS)), *rows])


def report(quick: bool = False) -> str:
    """Return times and ratios as Markdown."""
    turns = 1 if quick else 3
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # LSODA gives up loudly
        some = [regularised(name, eps, turns) for name in MOTIONS for eps in ((1e-1, 1e-3, 1e-8) if quick else EPS)]
        others = [limit(name, k, turns) for name, told in TOLD.items() for k in range(1 if quick else len(told.starts))]
    parts = [
        table("ε", [row for row, _ in some]),
        table("SciPy to the reference", [row for row, _ in others]),
        summary("SciPy with a compiled right-hand side, 5 motions, ε from 1e-1 to 1e-12", [r for _, r in some]),
        summary(
            "limit ε → 0, SciPy with compiled functions and told all events by hand",
            [r for _, r in others],
            TOLD_METHODS,
        ),
        many(1000 if quick else 10_000),
    ]
    return "\n\n".join(parts)
