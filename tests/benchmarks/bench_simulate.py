"""Error beside time for simulated motions: ``python -m tests.benchmarks.bench_simulate``.

The regularised motion is held against the nonsmooth limit for eps = 1e-1 ... 1e-10: the error falls as eps (after an
exit through the equator as a lower power, which Psi decides), and the time hardly grows.
"""

import time

import numpy as np

from codim2_core import examples, psi
from codim2_core.motion.nonsmooth import simulate_nonsmooth
from codim2_core.motion.regularised import simulate

EPS = 10.0 ** -np.arange(1, 11)
COURSES = {
    "ball: slip, slide": (examples.ball_in_pool(K=2.0), psi.constant(), (-1.0, 0.3, 10.0, 0.0), 3.0),
    "ball: slip, cross, slip, slide": (examples.ball_in_pool(K=2.0), psi.hill(2), (1.0, 0.0, 12.0, 0.0), 3.0),
    "block: slip, slide": (examples.tilting_block(), psi.constant(), (0.3, 0.1, 0.1), 5.0),
    "block: slip, slide, slip; Ψ = 1": (examples.tilting_block(), psi.constant(), (0.3, 0.1, 0.1), 12.0),
    "block: slip, slide, slip; Ψ = exp(−s)": (examples.tilting_block(), psi.exponential(), (0.3, 0.1, 0.1), 12.0),
    "non-unique sliding: slip, slide": (examples.nonunique_sliding(), psi.tanh(), (0.02, 0.01, 0.1), 0.2),
}


def timed(function, repeats=5):
    """Return the result and the shortest of some times, in ms."""
    best, result = np.inf, None
    for _ in range(repeats):
        start = time.perf_counter()
        result = function()
        best = min(best, time.perf_counter() - start)
    return result, 1e3 * best


def row(name: str) -> str:
    """One course at all eps."""
    system, shape, state0, t = COURSES[name]
    limit = simulate_nonsmooth(system, state0, (0.0, t), shape, rtol=1e-12, atol=1e-14)
    _, event = timed(lambda: simulate_nonsmooth(system, state0, (0.0, t), shape))
    errors, times, evaluations = [], [], []
    for eps in EPS:
        exact = simulate(system, shape, float(eps), state0, (0.0, t), rtol=1e-12, atol=1e-14)
        errors.append(np.abs(exact.states[-1] - limit.states[-1]).max())
        run, ms = timed(lambda eps=eps: simulate(system, shape, float(eps), state0, (0.0, t)))
        times.append(ms)
        evaluations.append(run.evaluations)
    slope = np.polyfit(np.log10(EPS[2:]), np.log10(errors[2:]), 1)[0]
    shown = ", ".join(f"{error:.0e}" for error in errors)
    return (
        f"| {name} | {shown} | {slope:.3f} | {times[2]:.0f} | {times[9]:.0f} | {times[9] / times[2]:.1f} | "
        f"{evaluations[2]} | {evaluations[9]} | {event:.0f} |"
    )


def report() -> str:
    """Return errors, slopes and times as Markdown."""
    lines = [
        "| motion | error at ε = 1e-1 … 1e-10 (rtol 1e-12) | slope from 1e-3 | ms at ε = 1e-3 (rtol 1e-8) | "
        "ms at 1e-10 | ratio | evaluations at 1e-3 | at 1e-10 | nonsmooth limit, ms (rtol 1e-10) |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    return "\n".join([*lines, *(row(name) for name in COURSES)])


if __name__ == "__main__":
    print(report())
