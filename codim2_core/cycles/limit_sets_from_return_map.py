"""Predict limit sets of e-linear orbits from samples of the return map, without integrating them.

The return map of the global section (`global_section`) increases. So an orbit on the section goes, turn by turn, to
the first fixed point in the sense of its displacement, and along the section that sense changes at fixed points only:
where samples resolve the map (`displacement_sampling`), they tell it. They place no fixed point and integrate no cycle,
which costs more.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..layer_problem.problem import LayerProblem, found_once
from .fixed_point_search import ReturnMapSamples
from .global_section import COARSE_RTOL
from .limit_cycles import return_map_samples_of

ON_C = -1


def predicted_limit_sets(problem: LayerProblem, states: Array) -> list[int | None]:
    """Say to which cycle (from 0, innermost first) orbits go, or `ON_C`; None where the samples do not decide it.

    Parameters
    ----------
    problem : LayerProblem
    states : ndarray (n, 3)
        (p_x, p_y, ebar) on the hemisphere.
    """
    told, question = _predictions(problem), states.tobytes()
    if question not in told:
        told[question] = _answer(problem, states)
    return told[question]


@found_once()
def _predictions(_: LayerProblem) -> dict[bytes, list[int | None]]:
    """Begin to note what has been said of a problem, by the states asked for: the same are asked for again."""
    return {}


def _answer(problem: LayerProblem, states: Array) -> list[int | None]:
    at = problem.at
    samples = "" if at.normal_form is None or at.as_given is None else return_map_samples_of(problem)
    certain = -1 if isinstance(samples, str) else samples.certain
    if isinstance(samples, str) or certain < 0:
        return [None] * len(states)
    section = samples.section
    ends, _, codes, _ = section.turn(np.ascontiguousarray(states), COARSE_RTOL, elsewhere=True)
    returned = (codes == section.kernel[0].RETURNED).tolist()
    inmost = ON_C if section.critical.kind.startswith("stable") else None
    led = [_follow_signs(samples, q, inmost) for q in section.coordinate(ends).tolist()]
    return [k if back and k is not None and k < certain else None for k, back in zip(led, returned, strict=True)]


def _follow_signs(samples: ReturnMapSamples, q: float, inmost: int | None) -> int | None:
    """Follow the signs of the samples from q on the section to a change of sign, or to the `inmost` place."""
    after = int(np.searchsorted(samples.q, q))
    if not 0 < after < len(samples.q):
        return None
    for k, (i, j) in enumerate(samples.changes):
        if samples.q[i] <= q <= samples.q[j]:
            return k if samples.shift[i] > 0.0 else None
    inward = bool(samples.shift[after] < 0.0)
    if (samples.shift[after - 1] < 0.0) != inward:
        return None
    if inward:
        return max((k for k, (_, j) in enumerate(samples.changes) if j < after), default=inmost)
    return min((k for k, (i, _) in enumerate(samples.changes) if i >= after), default=None)
