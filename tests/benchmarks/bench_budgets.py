"""Budgets: what a call may take, and what it takes, warm: ``python -m tests.benchmarks budgets``.

Medians of the processor time of calls that no cache answers, each with another setting.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator
from itertools import count

import numpy as np

import codim2_core as c2
from codim2_core import psi

CUBIC = (
    "p*c + 0.416*c - 1.717*s - 0.291*c*c + 0.343*c*s - 0.478*s*s - 0.696*c**3",
    "0.155*c + (0.592 + p/2)*s - 0.024*c*c - 0.302*c*s + 0.755*s*s - 0.408*s**3",
)
TURNS, FEW = 25, 5
MS = 1e3


def _shift() -> Iterator[float]:
    """Return ever other small numbers, so that nothing is found in a cache."""
    return (1e-7 * k for k in count(1))


def budgets() -> list[tuple[str, float, int, Callable[[float], object]]]:
    """Return what each row is called, its budget in ms, how often it is measured, and a call with a setting."""
    own = psi.hill(3)
    case3 = lambda by: c2.ELinear(172.0, 186.0, -200.0, (-86.0 + by, -93.0))
    near = lambda by: c2.ELinear(-2.0 + by, 0.3, -1.0, (-0.5, 0.0))
    cubic = lambda by: c2.System(U=CUBIC, parameters={"p": 0.1 + by})
    two = lambda by: c2.System(U=(CUBIC[0] + " + q", CUBIC[1]), parameters={"p": by, "q": 0.0})
    ball, repelling = c2.examples.ball_in_pool(), c2.examples.attracting_repelling()
    belt = c2.System(U=("-z1 - 0.5*c", "-s"), W=("x+0.3",))
    limit = lambda system, start, end: (
        lambda by: c2.simulate_nonsmooth(system, (start[0] + by, *start[1:]), (0.0, end), psi.constant())
    )
    drawn = ("equator", "critical", "inside", "outside", "nullclines_inside", "nullclines_outside", "name")
    frame = lambda by: [c2.Scene(near(by), psi.constant())[layer] for layer in drawn]
    branches = lambda system, name, span, cycles: (
        lambda by: c2.branches(system(by), own, name, span, with_cycles=cycles).special
    )
    atlas = lambda system, names, spans: lambda by: c2.atlas(system(by), own, dict(zip(names, spans, strict=True)))
    return [
        ("layers of the opening portrait", 3.0, TURNS, frame),
        ("limit_cycles, Case III", 15.0, TURNS, lambda by: c2.limit_cycles(case3(by), own)),
        ("limit_cycles, a typed cubic", 15.0, TURNS, lambda by: c2.limit_cycles(cubic(by), own)),
        ("branches, e-linear, without cycles", 100.0, FEW, branches(case3, "f1", (-120.0, 120.0), False)),
        ("branches, a typed cubic, without cycles", 100.0, FEW, branches(cubic, "p", (-1.0, 1.0), False)),
        ("branches, e-linear, with cycles", 300.0, FEW, branches(case3, "f1", (-120.0, -60.0), True)),
        ("branches, a typed cubic, with cycles", 300.0, FEW, branches(cubic, "p", (-1.0, 1.0), True)),
        ("atlas, e-linear, b and d", 300.0, FEW, atlas(near, ("b", "d"), ((-2.0, 2.0), (-3.0, 1.0)))),
        ("atlas, e-linear, f1 and f2", 300.0, FEW, atlas(case3, ("f1", "f2"), ((-240.0, 240.0), (-240.0, 240.0)))),
        ("atlas, a typed cubic, p and q", 500.0, FEW, atlas(two, ("p", "q"), ((-1.0, 1.0), (-1.0, 1.0)))),
        ("a motion of the ball", 2.0, TURNS, limit(ball, (1.0, 0.2, 1.0, 0.0), 4.0)),
        ("a motion, attracting to repelling", 0.4, TURNS, limit(repelling, (0.6, 0.3, 0.1), 3.0)),
        ("a belt, some twenty stick-slips", 10.0, TURNS, limit(belt, (0.4, 0.0, 0.1), 20.0)),
    ]


def report() -> str:
    """Return the table as Markdown."""
    load, by = os.getloadavg()[0], _shift()
    lines = ["| call | ms | budget, ms |", "|---|---|---|"]
    for what, budget, turns, call in budgets():
        taken = []
        call(next(by))
        for _ in range(turns):
            began = time.process_time()
            call(next(by))
            taken.append(time.process_time() - began)
        median = MS * float(np.median(taken))
        lines.append(f"| {what} | {median:.3g}{'' if median <= budget else ' (over)'} | {budget:g} |")
    return "\n".join([*lines, "", f"Load of the machine before: {load:.1f}."])
