"""Points of a branch of cycles, and guesses of the next ones."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise


@dataclass(frozen=True)
class ReturnMapPoint:
    """One turn from a ray, at parameter value `value`; times in tau."""

    xi: float  # where on the section, and the parameter's value
    value: float
    shift: float  # xi after the turn minus before it; zero on a cycle
    by_xi: float  # derivatives of `shift`, at fixed value and at fixed xi
    by_value: float
    exponent: float  # ln of the Floquet multiplier
    period: float
    amplitude: float  # largest ``|p - p_C|`` on it in the projected disc
    height: float  # smallest ebar on it: how near to the equator it comes
    rate: float  # d chi/d xi
    chi: float  # the place on the section, in [0, 1): r over the reach
    p: tuple[float, float]  # where it crosses the section, in the projected disc


@dataclass(frozen=True)
class ContinuationPoint:
    """A point of a branch: a turn that closes, its nu, and the unit tangent (chi, nu)."""

    turn: ReturnMapPoint
    nu: float
    tangent: tuple[float, float]

    def xi(self, chi: float) -> float:
        """Find the xi of a chi nearby."""
        here = self.turn
        chi = min(max(chi, 0.05 * here.chi), 1.0 - 0.05 * (1.0 - here.chi))
        return here.xi + math.log(chi / (1.0 - chi)) - math.log(here.chi / (1.0 - here.chi))


@dataclass(frozen=True)
class TurnGuess:
    """A guess of a closed turn, on the line through (xi, nu) across the covector `along` (xi, nu)."""

    xi: float
    nu: float
    along: tuple[float, float]
    backward: bool


@dataclass(frozen=True)
class ContinuationPoints:
    """Points in order, folds among them by index, and why it stopped: "C", "equator", "span", "closed" or "stuck"."""

    points: tuple[ContinuationPoint, ...]
    folds: tuple[int, ...]
    reason: str


def reversed_trace(trace: ContinuationPoints) -> ContinuationPoints:
    """Return the same points in the opposite order, tangents turned; `reason` is dropped."""
    points = tuple(replace(p, tangent=(-p.tangent[0], -p.tangent[1])) for p in reversed(trace.points))
    last = len(points) - 1
    return ContinuationPoints(points, tuple(sorted(last - i for i in trace.folds)), "")


def points_at_value(trace: ContinuationPoints, nu: float) -> list[tuple[float, TurnGuess]]:
    """Return the chi at which a branch passes nu, between its points, and guesses of its cycles there."""
    found = []
    for one, two in pairwise(trace.points):
        low, high = sorted((one.nu, two.nu))
        if low - 1e-9 <= nu <= high + 1e-9:
            part = (nu - one.nu) / (two.nu - one.nu) if two.nu != one.nu else 0.5
            chi, near = one.turn.chi + part * (two.turn.chi - one.turn.chi), one if part < 0.5 else two
            guess = TurnGuess(near.xi(chi), nu, (0.0, 1.0), near.turn.exponent > 0.0)
            found.append((chi, guess))
    return found
