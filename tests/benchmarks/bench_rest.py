"""What it costs to prove that nothing is stepped over: ``python -m tests.benchmarks rest``.

Each motion is followed with and without the inspection of its steps, in turns; medians of the processor time. Without
it pulses may be lost, so loads here are smooth enough that both give the same motion.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from unittest.mock import patch

import numpy as np

import codim2_core as c2
from codim2_core import psi
from codim2_core.motion.initial_value.motion_steps import Inspection

TURNS, MS = 41, 1e3
BUDGET = 0.3  # of a motion without


def motions() -> list[tuple[str, Callable[[], object]]]:
    """Return what each row is called, and a call."""
    one, span = psi.constant(), (0.0, 20.0)
    block = lambda load: c2.System(U=(f"-c + {load} - 0.5*z1", "-s"), W=("x",))
    loads = ("0.8*sin(t)", "1.5*sin(t)", "0.9*cos(0.3*t)", "1.2*sin(t) + 0.5*sin(2.3*t)", "0.75*(1 + tanh(3*(t - 10)))")
    rows: list[tuple[str, Callable[[], object]]] = []
    for load in loads:
        system = block(load)
        rows.append((f"block, {load}, limit", lambda s=system: c2.simulate_nonsmooth(s, (0.0, 0.0, 0.0), span, one)))
        rows.append((f"block, {load}, eps", lambda s=system: c2.simulate(s, one, (0.0, 0.0, 0.0), span, eps=1e-5)))
    ball = c2.examples.ball_in_pool()
    rows.append(("ball in a pool, limit", lambda: c2.simulate_nonsmooth(ball, (1.0, 0.2, 1.0, 0.0), (0.0, 4.0), one)))
    rows.append(("ball in a pool, eps", lambda: c2.simulate(ball, one, (1.0, 0.2, 1.0, 0.0), (0.0, 4.0), eps=1e-5)))
    return rows


def report() -> str:
    """Return the table as Markdown."""
    load, lines = os.getloadavg()[0], ["| motion | ms | without, ms | adds |", "|---|---|---|---|"]
    shares = []
    for what, call in motions():
        taken: dict[bool, list[float]] = {True: [], False: []}
        for turn in range(2 * TURNS + 2):
            inspected = turn % 2 == 0
            began = time.process_time()
            if inspected:
                call()
            else:
                with patch.object(Inspection, "look", lambda *_: None):
                    call()
            if turn > 1:
                taken[inspected].append(time.process_time() - began)
        with_it, without = (MS * float(np.median(taken[flag])) for flag in (True, False))
        shares.append(with_it / without - 1.0)
        over = " (over)" if shares[-1] > BUDGET else ""
        lines.append(f"| {what} | {with_it:.3g} | {without:.3g} | {100.0 * shares[-1]:.0f} %{over} |")
    lines += ["", f"Median {100.0 * float(np.median(shares)):.0f} %; the budget is {100.0 * BUDGET:.0f} %."]
    return "\n".join([*lines, "", f"Load of the machine before: {load:.1f}."])
