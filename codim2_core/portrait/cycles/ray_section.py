"""The ray from a critical set to the equator, and the first turn of orbits from it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ...results.arrays import Array
from ..layer_problem.critical import CriticalSet
from ..layer_problem.problem import LayerProblem
from .equator_pull import EQUATOR_CAPTURE_HEIGHT, MIN_HEIGHT, UNDERFLOW_HEIGHT, EquatorPull, equator_pull
from .heteroclinic_arcs import heteroclinic_arcs

COARSE_RTOL, FINE_RTOL = 1e-9, 1e-13  # tolerances
#: Of the reach; ebar of the last sample; of samples in ln(r/(reach - r)).
INNER_RADIUS, OUTER_HEIGHT, SAMPLE_SPACING = 1e-4, 1e-5, 0.2
MAX_STEPS, MAX_TURN_TIME = 2000, 1e6  # steps tried, and T in units of 1/max |U|
INNER_CAPTURE_RATIO = 1e-3  # of the innermost sample: gone
AT_REST = 1e-4  # distance from a critical set, or ebar, at which an orbit that never turned has settled
NOISE = 10.0  # times the tolerance: error in p of a turn
RAY_DIRECTIONS = 16


@dataclass(frozen=True)
class FixedPoint:
    """A fixed point of the map of first turns: its parameter, and how the displacement meets zero there.

    `born`: just born in a Hopf bifurcation, too small for the sampled map and placed by its expansion at C.
    """

    xi: float
    repelling: bool = False
    touching: bool = False
    born: bool = False


def room(foot: HemispherePoint | CriticalSet, u: Array) -> tuple[float, float]:
    """Return reach and other of a ray: ``|p + r u|^2 - 1 = (r - reach)(r + other)``."""
    along, gap = float(u @ foot.p), 1.0 / (1.0 + float(foot.x2 @ foot.x2))  # 1 - |p|^2, to all digits
    root = math.sqrt(along * along + gap)
    reach = gap / (root + along) if along > 0.0 else root - along
    return reach, gap / reach


@dataclass(frozen=True)
class HemispherePoint:
    """A point of the hemisphere: in the projected disc, and x2."""

    p: Array
    x2: Array


class TurnSection:
    """A ray from a critical set to the equator, and the map of first turns on it."""

    def __init__(self, problem: LayerProblem, critical: CriticalSet) -> None:
        self.problem, self.at, self.psi, self.critical = problem, problem.at, problem.psi, critical
        self.rate = problem.at.speed
        self._rests = np.array([C.p for C in problem.critical])
        self.u = self._direction([C.p - critical.p for C in problem.critical if C is not critical])
        self.reach, self.other = room(critical, self.u)

    def _direction(self, away: list[Array]) -> Array:
        """Choose the ray that keeps farthest from other critical sets; of equal ones the longest."""
        angle = 2.0 * math.pi * (np.arange(RAY_DIRECTIONS) + 0.25) / RAY_DIRECTIONS
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        free = np.full(RAY_DIRECTIONS, 2.0)
        for d in away:
            part = np.maximum(u @ d, 0.0)
            free = np.minimum(free, np.hypot(*(d - part[:, None] * u).T))
        reach = np.array([room(self.critical, way)[0] for way in u])
        end = self.critical.p + reach[:, None] * u
        # cycles next to a loop through the equator lie so low there that samples on a ray would not show them
        theta = np.arctan2(end[:, 1], end[:, 0])
        hidden = np.any([arc.spans(theta) for arc in heteroclinic_arcs(self.problem)], axis=0)
        return u[np.lexsort((reach, free, ~hidden & np.ones(len(u), bool)))[-1]]

    @cached_property
    def kernel(self) -> Any:
        """The compiled first turn: its module, and what its compiled field keeps alive."""
        from ..stepping import right_hand_side
        from . import ray_section_kernel

        return ray_section_kernel, right_hand_side.problem(self.at, self.psi)

    @cached_property
    def pull(self) -> EquatorPull:
        """Return the first-order return map of orbits close to the equator."""
        return equator_pull(self.at, self.problem.location)

    def field_parameters(self, backward: bool) -> Array:
        """Parameters of the compiled field that `kernel` keeps alive."""
        _, kept = self.kernel
        return np.array(kept.reversed.shared if backward else kept.shared)

    def field(self, e: Array) -> Array:
        """U (n, 2) in units of `rate`."""
        return self.at.U(e) / self.rate

    def derivative(self, e: Array) -> Array:
        """D_e U (n, 2, 2) in units of `rate`."""
        return self.at.DU(e) / self.rate

    def states(self, xi: Array) -> tuple[Array, Array]:
        """States (n, 3) = (p_x, p_y, ebar) and q = xi (n,), at ``r = reach/(1 + exp(-xi))``."""
        inner, rest = self.reach / (1.0 + np.exp(-xi)), self.reach / (1.0 + np.exp(xi))
        height = np.sqrt(rest * (inner + self.other))
        return np.column_stack([self.critical.p + inner[:, None] * self.u, height]), np.array(xi, float)

    def coordinate(self, states: Array) -> Array:
        """``q = ln(r/(reach - r))``, (n,)."""
        r = np.maximum((states[:, :2] - self.critical.p) @ self.u, 1e-300)
        return np.log(r) - np.log(np.maximum(states[:, 2] ** 2 / (r + self.other), 1e-300))

    def turn(
        self,
        states: Array,
        rtol: float,
        backward: bool = False,
        record: int = 0,
        limit: int = MAX_STEPS,
        goal: Array | None = None,
        sense: int = 0,
    ) -> tuple[Array, Array, Any, Any]:
        """Follow one turn: ends (n, 3), times, codes and recorded steps of `ray_section_kernel.first_turns`.

        Or less than a turn: by the angles `goal` (n,), in one sense.
        """
        module, function = self.kernel
        states = np.ascontiguousarray(states)
        away = float(np.hypot(*(states[:, :2] - self.critical.p).T).min(initial=math.inf))
        floor = INNER_CAPTURE_RATIO * min(INNER_RADIUS * self.reach, away)

        def follow(rows: Any, sunk: float) -> tuple[Array, Array, Any, Any]:
            return module.first_turns(
                states[rows],
                self.field_parameters(backward),
                function.address,
                np.array(self.critical.p),
                np.full(len(states), math.tau)[rows] if goal is None else goal[rows],
                sense,
                floor,
                sunk,
                MAX_TURN_TIME,
                rtol,
                limit,
                record,
            )

        lost = min(
            EQUATOR_CAPTURE_HEIGHT,
            max(UNDERFLOW_HEIGHT, MIN_HEIGHT / max(MIN_HEIGHT, float(states[:, 2].min(initial=1.0)))),
        )
        if record:
            return follow(slice(None), lost)
        ends, times, codes, steps = follow(slice(None), EQUATOR_CAPTURE_HEIGHT)
        close = np.flatnonzero(codes == module.OUTWARD)
        if len(close):  # those that the equator may not draw in are followed on, however close they come to it
            again = close[self.pull.may_return(ends[close], self.field, backward)]
            if len(again):
                ends[again], times[again], codes[again], _ = follow(again, lost)
        return ends, times, codes, steps

    def displacement(self, xi: Array, rtol: float = COARSE_RTOL, backward: bool = False, noise: float = NOISE) -> Array:
        """Displacement of q over a turn (n,): -inf to the critical set, +inf elsewhere, NaN undecided.

        It is 0 where it is within `noise` times what the tolerance leaves open.
        """
        module, _ = self.kernel
        states, q = self.states(xi)
        ends, _, codes, _ = self.turn(states, rtol, backward)
        shift = self.coordinate(ends) - q
        gaps = np.hypot(*(ends[:, None, :2] - self._rests[None]).T).T
        inward = (codes == module.TO_CRITICAL_SET) | (np.hypot(*(ends[:, :2] - self.critical.p).T) < AT_REST)
        settled = (gaps.min(axis=1) < AT_REST) | (ends[:, 2] < AT_REST) | (codes == module.OUTWARD)
        # What the tolerance cannot tell from zero is zero: in a band of closed orbits noise has both signs.
        shift[np.abs(shift) < noise * rtol * (1.0 + (1.0 + np.exp(-q)) / self.reach)] = 0.0
        open_ = codes != module.RETURNED
        shift[open_ & settled] = np.inf
        shift[open_ & inward] = -np.inf
        shift[open_ & ~settled & ~inward] = np.nan
        return shift

    def grid(self) -> Array:
        """Choose samples: even in ln(r/(reach - r))."""
        last = math.log(self.reach * (self.reach + self.other)) - 2.0 * math.log(OUTER_HEIGHT)
        first = math.log(INNER_RADIUS)
        return np.linspace(first, last, int((last - first) / SAMPLE_SPACING))
