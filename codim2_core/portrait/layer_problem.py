"""The layer problem at one z under one Psi: what stands still in it, and where its orbits end."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..cycles.limit_cycles import LimitCycles, limit_cycles
from ..layer_problem.critical import CriticalSet, critical_sets
from ..layer_problem.equator import EquatorEquilibria
from ..orbits.trajectories import Trajectories, continuation, trajectories
from ..psi.function import Psi
from ..systems.frozen import AtZ
from .endings import CAPTURE, CONNECTION, Ending, critical_label, drawn_time, endings

Array = NDArray[np.float64]
RTOL = 1e-8
FAN = 0.02  # radius, in (theta, ebar), of the half circle of starts around a Q that many orbits leave


@dataclass(frozen=True)
class LayerProblem:
    """The layer problem eq:LP at one z under one regularisation: what stands still in it, and where orbits end.

    Attributes
    ----------
    at : Coefficients or Frozen
    psi : Psi
    equator : EquatorEquilibria
    critical : tuple of CriticalSet
    cycles : LimitCycles
    """

    at: AtZ
    psi: Psi
    equator: EquatorEquilibria
    critical: tuple[CriticalSet, ...]
    cycles: LimitCycles

    def ends(self, lines: Trajectories) -> list[Ending]:
        """Say where trajectories end."""
        return endings(self.at, self.psi, lines, self.equator, self.critical, self.cycles, rtol=RTOL)

    def followed(self, points: Array) -> Trajectories:
        """Follow points of the picture (k, 2) until they have ended somewhere."""
        time = drawn_time(self.at, self.equator)
        return trajectories(
            self.at, self.psi, points, t_max=time, rtol=RTOL, atol=0.1 * RTOL, capture=CAPTURE, samples="ends"
        )

    def from_equator(self, i: int) -> Trajectories:
        """Follow the orbit that leaves the limit direction i (from 0) up the hemisphere."""
        time = drawn_time(self.at, self.equator)
        return continuation(
            self.at,
            self.psi,
            self.equator.theta[i : i + 1],
            t_max=time,
            rtol=RTOL,
            atol=0.1 * RTOL,
            capture=CAPTURE,
            samples="ends",
        )

    def judge(self, ends: Sequence[Ending], many: str) -> tuple[str, str | None, float | None, Array | None, str]:
        """(verdict, onto, leaving, slow flow, reason) of trajectories that end so."""
        labels = list(dict.fromkeys(end.label for end in ends))
        if len(labels) > 1:
            return "undecided", None, None, None, f"{many}, and they end at different places: {', '.join(labels)}."
        end = ends[0]
        label = end.label
        if end.sentence == CONNECTION:
            return "undecided", None, None, None, f"They run into the saddle {label}: which side is left to ε."
        for i, C in enumerate(self.critical):
            if label == critical_label(self.critical, i):
                return "slide", label, None, C.slow_flow, f"They reach the critical set {label}, a {C.kind}: sliding."
        if label.startswith("cycle"):
            cycle = self.cycles[int(label.split()[1]) - 1]
            reason = "They wind onto a limit cycle around C: sliding, with the slow flow of C on average (prop:LC)."
            if self.at.normal_form is None:
                reason = "They wind onto a limit cycle: sliding, with the mean slow flow over the cycle."
            return "cycle", label, None, cycle.slow_flow, reason
        if label.startswith("Q"):
            return "cross", label, end.angle, None, f"They leave along θ = {end.angle:.4g} ({label}): crossing."
        if label == "equator":
            return "cross", label, None, None, "They come down to the closed equator and spiral away: crossing."
        return "undecided", None, None, None, f"They were not followed to an end: {end.sentence}"

    def arriving(self, i: int) -> tuple[str, str | None, float | None, Array | None, str]:
        """Judge what arrives at Q_{i+1}, where lambda_rho < 0."""
        main = self.ends(self.from_equator(i))
        if self.equator.multiplicity[i] == 1 and self.equator.lambda_theta[i] < 0.0:
            return self.judge(main, "")
        angle = np.radians([15.0, 45.0, 75.0, 105.0, 135.0, 165.0])
        theta, height = float(self.equator.theta[i]) + FAN * np.cos(angle), FAN * np.sin(angle)
        around = np.sqrt(1.0 - height**2)[:, None] * np.stack([np.cos(theta), np.sin(theta)], axis=-1)
        return self.judge([*main, *self.ends(self.followed(around))], "A whole family of orbits leaves Q")

    def spiralling(
        self, many: str = "Orbits leave the closed equator at all angles"
    ) -> tuple[str, str | None, float | None, Array | None, str]:
        """Judge what leaves the equator at all angles."""
        angle = 2.0 * math.pi * np.arange(8) / 8.0
        ring = 0.9995 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        return self.judge(self.ends(self.followed(ring)), many)


def layer_problem(at: AtZ, psi: Psi, equator: EquatorEquilibria) -> LayerProblem:
    """Gather what stands still in the layer problem; the equator does not depend on Psi."""
    return LayerProblem(at, psi, equator, critical_sets(at, psi), limit_cycles(at, psi))
