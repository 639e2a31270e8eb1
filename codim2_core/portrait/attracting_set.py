"""Find the attracting set of the layer problem along which a motion slides: a critical set, or a limit cycle."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .cycles.limit_cycles import LimitCycle
from .layer_problem.critical import CriticalSet


@dataclass(frozen=True)
class Attracting:
    """An attracting set, and the slow flow along it; arrays are read-only."""

    name: str  # "C", or "C1", "C2", … in the order of `critical_sets`; "cycle 1", … in that of `limit_cycles`
    e: NDArray[np.float64]  # (2,) (c, s) on it; its mean over a period of a cycle
    slow_flow: NDArray[np.float64]  # (m,) z' on it (4.17), over a cycle the mean (Proposition 4.2)


def attracting_set(
    critical: Sequence[CriticalSet], cycles: Callable[[], Iterable[LimitCycle]], last: ArrayLike | None = None
) -> Attracting | None:
    """Return the attracting set that sliding is on, or goes on with when z drifts.

    None where no critical set and no limit cycle is stable: sliding ends there. Shapes: last (2,).
    """
    stable = [(i, C) for i, C in enumerate(critical) if C.kind.startswith("stable")]
    if stable:
        i, C = stable[0]
        if last is not None:
            i, C = min(stable, key=lambda one: float(np.hypot(*(one[1].e - np.asarray(last, float)))))
        return Attracting("C" if len(critical) == 1 else f"C{i + 1}", C.e, C.slow_flow)
    for k, cycle in enumerate(cycles()):
        if cycle.kind == "stable":
            return Attracting(f"cycle {k + 1}", cycle.mean_e, cycle.slow_flow)
    return None
