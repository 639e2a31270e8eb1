"""The ray from a critical set to the equator, and the first turn of orbits from it."""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import Array
from ..layer_problem.critical import CriticalSet
from ..psi.function import Psi
from ..systems.frozen import FrozenSystem
from .equator_pull import EquatorPull, equator_pull
from .global_section import COARSE_RTOL, integrate_turn

INNER_RADIUS, OUTER_HEIGHT, SAMPLE_SPACING = (
    1e-4,
    1e-5,
    0.2,
)  # of the reach; ebar of the last sample; of samples in ln(r/(reach - r))
MAX_STEPS, MAX_TURN_TIME = 2000, 1e6  # steps tried, and T in units of 1/max |U|
INNER_CAPTURE_RATIO = 1e-3  # of the innermost sample: gone
AT_REST = 1e-4  # distance from a critical set, or ebar, at which an orbit that never turned has settled
NOISE = 10.0  # times the tolerance: error in p of a turn
RAY_DIRECTIONS = 16


class TurnSection:
    """A ray from a critical set to the equator, and the map of first turns on it; as `global_section.Section`.

    Parameters
    ----------
    at : Frozen
    psi : Psi
    critical : CriticalSet
        Where the ray starts.
    others : tuple of CriticalSet
        All critical sets; the ray keeps away from the others.
    """

    def __init__(self, at: FrozenSystem, psi: Psi, critical: CriticalSet, others: tuple[CriticalSet, ...]) -> None:
        self.at, self.psi, self.critical = at, psi, critical
        self.rate = at.speed
        self._rests = np.array([C.p for C in others])
        self.u = self._direction([C.p - critical.p for C in others if C is not critical])
        along = float(self.u @ critical.p)
        gap = 1.0 / (1.0 + float(critical.x2 @ critical.x2))  # 1 - |p|^2, to all digits
        root = math.sqrt(along * along + gap)
        # |p + r u|^2 - 1 = (r - reach)(r + other)
        self.reach = gap / (root + along) if along > 0.0 else root - along
        self.other = gap / self.reach

    def _direction(self, away: list[Array]) -> Array:
        angle = 2.0 * math.pi * (np.arange(RAY_DIRECTIONS) + 0.25) / RAY_DIRECTIONS
        u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        room = np.full(RAY_DIRECTIONS, 2.0)
        for d in away:
            part = np.maximum(u @ d, 0.0)
            room = np.minimum(room, np.hypot(*(d - part[:, None] * u).T))
        return u[int(np.argmax(room))]

    @cached_property
    def kernel(self) -> Any:
        """The compiled first turn: its module, and what its compiled field keeps alive."""
        from ..stepping import right_hand_side
        from . import ray_section_kernel

        return ray_section_kernel, right_hand_side.problem(self.at, self.psi)

    @cached_property
    def pull(self) -> EquatorPull:
        """Return the first-order return map of orbits close to the equator."""
        return equator_pull(self.at, None)

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
        self, states: Array, rtol: float, backward: bool = False, record: int = 0, limit: int = MAX_STEPS
    ) -> tuple[Array, Array, Any, Any]:
        """Follow one turn: ends (n, 3), times, codes and recorded steps of `ray_section_kernel.first_turns`."""
        module, function = self.kernel

        def follow(states: Array, sunk: float) -> tuple[Array, Array, Any, Any]:
            return module.first_turns(
                states,
                self.field_parameters(backward),
                function.address,
                np.array(self.critical.p),
                INNER_CAPTURE_RATIO * INNER_RADIUS * self.reach,
                sunk,
                MAX_TURN_TIME,
                rtol,
                limit,
                record,
            )

        return integrate_turn(self, follow, states, backward, record > 0)

    def displacement(self, xi: Array, rtol: float = COARSE_RTOL, backward: bool = False) -> Array:
        """Displacement of q over a turn (n,): -inf to the critical set, +inf elsewhere, NaN undecided."""
        module, _ = self.kernel
        states, q = self.states(xi)
        ends, _, codes, _ = self.turn(states, rtol, backward)
        shift = self.coordinate(ends) - q
        gaps = np.hypot(*(ends[:, None, :2] - self._rests[None]).T).T
        inward = (codes == module.TO_CRITICAL_SET) | (np.hypot(*(ends[:, :2] - self.critical.p).T) < AT_REST)
        settled = (gaps.min(axis=1) < AT_REST) | (ends[:, 2] < AT_REST) | (codes == module.OUTWARD)
        # What the tolerance cannot tell from zero is zero: in a band of closed orbits noise has both signs.
        shift[np.abs(shift) < NOISE * rtol * (1.0 + (1.0 + np.exp(-q)) / self.reach)] = 0.0
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
