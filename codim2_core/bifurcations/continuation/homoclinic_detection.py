"""Loops that a branch has passed unseen: on its two sides cycles go round different critical sets.

Where a cycle becomes a loop through a saddle, the map of first turns goes on to larger cycles, or smaller ones, on the
other side of the saddle: so steps may lead over it. Which critical sets a cycle surrounds tells.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...portrait.cycles.limit_cycles import surrounds
from ...results.arrays import Array
from .corrector import BranchTracer
from .section_base import Problems
from .turns import ContinuationPoint, ContinuationPoints, ReturnMapPoint, TurnGuess

MAX_HALVINGS = 40  # of the step that leads over a loop
LOOP_TOLERANCE = 1e-9  # of the span: how near to it that is


def line_of(tracer: BranchTracer, turn: ReturnMapPoint) -> Array | None:
    """Return a cycle as a closed line; None if it is lost."""
    course = tracer.family.course(turn.xi, turn.value, turn.exponent > 0.0)
    return None if course is None else np.concatenate([[turn.p], course.states[:, :2], [turn.p]])


def split_at_homoclinic(
    tracer: BranchTracer, trace: ContinuationPoints, problem: Problems
) -> tuple[ContinuationPoints, ContinuationPoints] | None:
    """Part a trace at the first loop that it has passed; None if it has passed none.

    Both with points close to the loop.
    """
    rounds = [_count_surrounded(tracer, point.turn, problem) for point in trace.points]
    for i in range(1, len(rounds)):
        one, two = rounds[i - 1], rounds[i]
        if one is None or two is None or one[1] != two[1] or one[0] == two[0]:
            continue
        before, after = list(trace.points[:i]), list(trace.points[i:])
        for _ in range(MAX_HALVINGS):
            here, there = before[-1], after[0]
            if abs(here.nu - there.nu) < LOOP_TOLERANCE:
                break
            found = _middle_point(tracer, here, there)
            inside = None if found is None else _count_surrounded(tracer, found.turn, problem)
            if found is None or inside not in (one, two):
                break
            if inside == one:
                before.append(found)
            else:
                after.insert(0, found)
        added = len(after) - (len(trace.points) - i) - i  # to the index of each fold
        ahead = replace(trace, points=tuple(after), folds=tuple(k + added for k in trace.folds if k >= i))
        return ContinuationPoints(tuple(before), tuple(k for k in trace.folds if k < i), "stuck"), ahead
    return None


def _count_surrounded(tracer: BranchTracer, turn: ReturnMapPoint, problem: Problems) -> tuple[int, int] | None:
    """Count the critical sets that a cycle surrounds, and all; None if there is nothing to tell."""
    critical = problem(turn.value).critical
    line = line_of(tracer, turn) if len(critical) > 1 else None
    return None if line is None else (sum(surrounds(line, C.p) for C in critical), len(critical))


def _middle_point(tracer: BranchTracer, here: ContinuationPoint, there: ContinuationPoint) -> ContinuationPoint | None:
    """Find the point of the branch half way between two."""
    dx, dn = there.turn.xi - here.turn.xi, there.nu - here.nu
    guess = TurnGuess(
        0.5 * (here.turn.xi + there.turn.xi), 0.5 * (here.nu + there.nu), (dx, dn), here.turn.exponent > 0.0
    )
    found = tracer.closed(guess)
    return None if found is None else tracer.point(found, here.tangent)
