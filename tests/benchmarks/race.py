"""Timing in turns, and what it costs to reach an error: rows of (error, seconds), ratios paired turn by turn."""

from __future__ import annotations

import itertools
import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

DECADES = tuple(10.0**-k for k in range(3, 13))


@dataclass
class Curve:
    """One method on one problem: at each setting, such as a tolerance, an error, and the seconds of every turn."""

    settings: list[float] = field(default_factory=list)
    errors: list[float] = field(default_factory=list)
    times: list[list[float]] = field(default_factory=list)

    @property
    def points(self) -> list[tuple[float, float]]:
        """(error, median seconds), for drawing."""
        return [(e, statistics.median(t)) for e, t in zip(self.errors, self.times, strict=True)]

    def cost(self, error: float, turn: int | None = None) -> float:
        """Seconds for an error, interpolated in logarithms between settings; infinite where none is as good.

        A setting counts for all errors that it meets: the cost is the lowest that reaches the error.
        """
        rows = sorted(
            (max(e, 1e-18), t[turn] if turn is not None else statistics.median(t))
            for e, t in zip(self.errors, self.times, strict=True)
            if math.isfinite(e)
        )
        best = min((t for e, t in rows if e <= error), default=math.inf)
        for (e0, t0), (e1, t1) in itertools.pairwise(rows):
            if e0 <= error < e1:
                part = math.log(error / e0) / math.log(e1 / e0)
                best = min(best, math.exp(math.log(t0) + part * (math.log(t1) - math.log(t0))))
        return best


@dataclass
class Runner:
    """What is raced: a run of each setting."""

    name: str
    run: Callable[[float], object]
    settings: Sequence[float]  # from cheap to costly
    share: float = 1.0  # part of the work that a run does; its time is divided by it
    repeats: int = 1  # runs in one turn, of which the median counts


def clock(run: Callable[[float], object], setting: float, repeats: int = 1) -> float:
    """Median seconds of some runs."""
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        run(setting)
        taken.append(time.perf_counter() - start)
    return statistics.median(taken)


def race(
    runners: Sequence[Runner], error_of: Callable[[object], float], turns: int = 5, longest: float = 0.5
) -> dict[str, Curve]:
    """Time all runners in turns.

    A runner's settings stop after the first run that takes `longest` seconds or more (of its real work), and slow
    settings (over a tenth of it) are timed in two turns only.
    """
    curves: dict[str, Curve] = {}
    for runner in runners:
        curve = curves[runner.name] = Curve()
        for setting in runner.settings:
            result = runner.run(setting)  # compiles
            first = clock(runner.run, setting)
            curve.settings.append(setting)
            curve.errors.append(error_of(result))
            curve.times.append([])
            if first >= longest:
                break
            curve.times[-1] = [math.nan] if first >= 0.1 * longest else []
    for turn in range(turns):
        for runner in runners:
            curve = curves[runner.name]
            for setting, times in zip(curve.settings, curve.times, strict=True):
                slow = times and math.isnan(times[0])
                if slow and turn > 1:
                    times.append(times[1 + turn % 2])
                else:
                    times.append(clock(runner.run, setting, runner.repeats) / runner.share)
    for curve in curves.values():
        curve.times = [times[-turns:] for times in curve.times]
    return curves


def ratio(theirs: Curve, ours: Curve, error: float) -> float:
    """Cost of theirs over ours at an error: median of the turns' ratios; NaN where ours does not reach it."""
    turns = range(len(ours.times[0]))
    pairs = [(theirs.cost(error, k), ours.cost(error, k)) for k in turns]
    if not all(math.isfinite(own) for _, own in pairs):
        return math.nan
    return statistics.median(cost / own for cost, own in pairs)
