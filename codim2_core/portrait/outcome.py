"""The types of approach outcomes: one for each limit direction along which trajectories reach the discontinuity set."""

from __future__ import annotations

import bisect
import math
from dataclasses import dataclass, field

import numpy as np

from ..results.arrays import Array
from ..results.result import Several, Tabled, result_rows
from ..results.tables import point, table_number
from ..results.words import say
from ..systems.frozen import FrozenSystem
from .layer_problem.equator import EquatorEquilibria, arcs_of

__all__ = ["Outcome", "Outcomes"]


AT_ZERO = 1e-9  # angle to a limit direction that counts as that direction


@dataclass(frozen=True, eq=False)
class Outcome(Tabled):
    """The outcome for trajectories that arrive along one limit direction (or spiral onto the closed equator).

    Attributes
    ----------
    theta : float or None
        The limit direction, radians; None for the closed equator and where every direction is one.
    label : str
        "Q1", ...; "equator"; "every direction".
    arrives : str
        "open set" (angularly attracting), "one side", "single direction" (angularly repelling), or "nothing".
    verdict : str
        "slide", "cycle" (sliding around a limit cycle), "cross", "undecided", or "misses" (never reaches Sigma).
    onto : str or None
        What it slides on ("C", or "C1", "C2", ... where there are several; "cycle 1") or leaves along ("Q2",
        "equator").
    leaving : float or None
        Direction in which it leaves Sigma, for "cross".
    slow_flow : ndarray (m,) or None
        z' while sliding; on a cycle its mean, in the e-linear system the same by Proposition 4.2.
    reason : str
    depends_on_psi : bool or None
        Whether other regularisations give another outcome; None where they were not asked.
    families : tuple of (Psi as a menu writes it, verdict, onto)
        What they give; empty where a theorem makes asking needless.
    slides_alike : bool
        It depends on Psi what it slides on, C or a cycle around it, but not how: the slow flow is the same.
    why : str
        Of "undecided": "several" (the orbits have more than one ending, or run into a saddle), "neutral" (to first
        order nothing arrives or leaves), or "unfollowed" (the computation gave up); "" else.
    """

    _head_ = ("limit direction", "θ", "arrives", "verdict", "onto", "leaves at θ", "slow flow z′", "why")

    theta: float | None
    label: str
    arrives: str
    verdict: str
    onto: str | None
    leaving: float | None
    slow_flow: Array | None
    reason: str
    depends_on_psi: bool | None = False
    families: tuple[tuple[str, str, str | None], ...] = ()
    slides_alike: bool = False
    why: str = ""

    def _row_(self) -> tuple[str, ...]:
        theta, leaving = ("–" if angle is None else table_number(angle) for angle in (self.theta, self.leaving))
        flow = "–" if self.slow_flow is None else point(self.slow_flow)
        return self.label, theta, self.arrives, self.verdict, self.onto or "–", leaving, flow, self.reason

    @property
    def slides(self) -> bool | None:
        """Whether it ends up sliding; crossing includes turning away from Sigma, as in Section 5.2.

        None where it is undecided.
        """
        return None if self.verdict == "undecided" else self.verdict in ("slide", "cycle")


@dataclass(frozen=True, eq=False)
class Outcomes(Several[Outcome]):
    """Outcomes of all limit directions that trajectories arrive along, open sets first; iterates over them.

    Attributes
    ----------
    outcomes : tuple of Outcome
    directions : tuple of Outcome
        The same for each of Q1, Q2, ... in order, also those that nothing arrives along ("misses").
    equator : EquatorEquilibria
    whole : Outcome or None
        That of all angles, where no Q decides (closed equator, or every direction is a limit direction).
        None where there are limit directions Q.
    """

    _held_ = "outcomes"

    outcomes: tuple[Outcome, ...]
    directions: tuple[Outcome, ...] = field(repr=False)
    equator: EquatorEquilibria = field(repr=False)
    whole: Outcome | None
    _at: FrozenSystem = field(repr=False)

    def _tables_(self) -> str:
        return result_rows(self) or result_rows(self.directions)

    def destination(self, theta: float) -> int | None:
        """Index (from 0) of the limit direction that a trajectory outside, now at angle theta, tends to.

        None where no Q decides: where there is none, or theta leads to a whole arc of limit directions. Raises
        ValueError: theta is not finite.
        """
        if not math.isfinite(theta):
            raise ValueError(f"theta is {theta}; give a finite angle in radians.")
        if self.whole is not None:
            return None
        angle = theta % math.tau
        for i, zero in enumerate(self.equator.theta.tolist()):
            if abs(math.remainder(angle - zero, math.tau)) <= AT_ZERO:
                return i
        if any((angle - first) % math.tau <= (last - first) % math.tau for first, last in self.equator.arcs.tolist()):
            return None
        cuts = self._cuts
        after = bisect.bisect([cut for cut, _ in cuts], angle) % len(cuts)
        (begin, before), (end, beyond) = cuts[after - 1], cuts[after]
        # Theta has one sign between its zeros; near a multiple one rounding would decide
        middle = 0.5 * (begin + end + (0.0 if end > begin else math.tau))
        c, s = math.cos(middle), math.sin(middle)
        u, v = self._at.U(np.array([c, s])).tolist()
        return beyond if c * v > s * u else before

    @property
    def _cuts(self) -> list[tuple[float, int | None]]:
        """Limit directions (angle, index) and the ends of whole arcs of them (angle, None), in order."""
        ends = [(end, None) for end in self.equator.arcs.ravel().tolist()]
        cuts = [*((zero, i) for i, zero in enumerate(self.equator.theta.tolist())), *ends]
        return sorted(cuts, key=lambda cut: cut[0])

    def outcome(self, theta: float) -> Outcome:
        """Outcome for a trajectory that starts outside at angle theta (radians).

        At any distance, or near Sigma if U depends on x or y.
        """
        if self.whole is not None:
            return self.whole
        i = self.destination(theta)
        return on_arcs(self.equator) if i is None else self.directions[i]

    @property
    def arcs(self) -> tuple[tuple[float, float, Outcome], ...]:
        """The circle of approach angles, cut at the limit directions: (from, to, outcome), to > from."""
        if self.whole is not None:
            return ((0.0, math.tau, self.whole),)
        angles = [angle for angle, _ in self._cuts]
        ends = [*angles[1:], angles[0] + math.tau]
        return tuple((t, e, self.outcome(0.5 * (t + e))) for t, e in zip(angles, ends, strict=True))


def on_arcs(equator: EquatorEquilibria) -> Outcome:
    """Say of angles that they lead to a whole arc of limit directions, as a Theta with kinks may have."""
    reason = " ".join(arcs_of(equator.arcs)) or say("no directions found")
    return Outcome(None, "equator", "nothing", "undecided", None, None, None, reason, why="unfollowed")
