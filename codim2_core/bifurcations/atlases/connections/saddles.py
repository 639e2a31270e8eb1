"""Branches of saddles of the layer problem: followed over the plane of two parameters, and followed as orbits.

A saddle is a critical set, with two branches either way, or a half-saddle of the equator, with one (Theorem 3.1(b)):
its branch leaves up the hemisphere where both its eigenvalues are negative, and enters where both are positive.

An orbit that follows a branch of a critical set begins on its tangent, at a distance `START_DISTANCE`: its error
across the branch is the square of that, and fades; how far along it begins is but a matter of time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....numerics.curves.arclength import newton
from ....portrait.layer_problem.critical import CriticalSet, set_at
from ....portrait.layer_problem.eigendirections import to_disc
from ....portrait.layer_problem.problem import LayerProblem
from ....portrait.orbits.trajectories import Trajectories, continuation, trajectories
from ....results.arrays import Array
from ....systems.frozen import FrozenSystem
from ....systems.psi.function import Psi
from ...continuation.section_base import correct_zero

RTOL, ROUGH_RTOL = 1e-12, 1e-7  # of branches, and of those that are drawn alone
START_DISTANCE = 1e-6  # in units of hypot(1, |x2|)
MAX_BRANCH_LENGTH, MAX_BRANCH_TIME = 5.0, 1e4  # how far they are followed, in the disc and in T of 1/max |U|
#: Of their lines: the first, but finer for what is small, of its size.
LINE_PIXEL, RELATIVE_PIXEL, MIN_PIXEL = 5e-4, 1e-3, 1e-8
SAME_SADDLE_DISTANCE = 1e-6  # in the disc: found twice
ANGLE_TOLERANCE = 3e-7  # last step of Newton's method for theta: its error is the square
MAX_SADDLE_SHIFT = 0.1  # the way to a saddle's next place


@dataclass(frozen=True, eq=False)
class Branch:
    """One branch of a saddle at one place of the plane."""

    at: FrozenSystem
    psi: Psi  # what it is a branch of
    backward: bool  # it enters the saddle
    p: Array  # (2,) The saddle, in the projected disc
    way: Array  # (2,) Unit tangent there, away from it; zero of a half-saddle, whose branch goes straight up
    start: Array  # (2,) Where the orbit begins that follows it from a critical set
    critical: CriticalSet | None
    theta: float  # of a half-saddle
    ratio: float  # of its eigenvalues: that by which orbits enter over that by which they leave

    @property
    def signature(self) -> Array:
        """Return four numbers (4,) by which branches differ."""
        return np.concatenate([self.p, self.way])

    def among(self, others: Sequence[Branch]) -> list[int]:
        """Return which of others, at a place nearby, belong to the same saddle, by its critical set or theta."""
        if not others:
            return []
        at = others[0].at
        if self.critical is None:
            theta = _zero_of_theta(at, self.theta)
            return [
                i
                for i, one in enumerate(others)
                if abs(math.remainder(one.theta - theta, 2.0 * math.pi)) < SAME_SADDLE_DISTANCE
            ]
        e = correct_zero(at, self.critical.e)
        sets = [one.critical for one in others]
        return (
            []
            if e is None
            else [i for i, C in enumerate(sets) if C is not None and math.dist(C.e, e) < SAME_SADDLE_DISTANCE]
        )

    def same_saddle(self, other: Branch) -> bool:
        """Whether both belong to one saddle, at one place of the plane."""
        return math.dist(self.p, other.p) < SAME_SADDLE_DISTANCE

    def followed(self, at: FrozenSystem, psi: Psi) -> Branch | None:
        """Return the same branch of another system nearby; None where its saddle is none any more."""
        if self.critical is None:
            return _half_saddle(at, psi, _zero_of_theta(at, self.theta), self.backward)
        e = correct_zero(at, self.critical.e)
        if e is None:
            return None
        C = set_at(at, psi, e)
        found = _branches_of(at, psi, C, self.backward) if C.kind == "saddle" else ()
        return max(found, key=lambda one: float(one.way @ self.way), default=None)

    def line(self, scale: float) -> tuple[Array, Array]:
        """Follow it as a line (m, 2) that can be drawn, with the time from its start (m,) at each point.

        What matters in it is of a size `scale`, in the disc.
        """
        # where an orbit rises from the equator depends on the tolerance: times must have one beginning
        found = _integrate_branches([self], RTOL if self.critical is None else ROUGH_RTOL, scale)
        return found.points[0], np.abs(found.times[0])

    def state(self, time: float) -> Array:
        """Follow it to a time, to all digits: (p, ebar)."""
        return np.array(_integrate_branches([self], RTOL, t_max=time).ends[0])


def lines_of(found: Sequence[Branch], scale: float) -> list[Array]:
    """Lines of some branches of one layer problem, as `Branch.line`."""
    out: list[Array] = [np.zeros((0, 2))] * len(found)
    for backward in (False, True):
        ours = [i for i, one in enumerate(found) if one.backward == backward]
        ours.sort(key=lambda i: found[i].critical is not None)  # as `_integrate_branches` has them
        if ours:
            for i, line in zip(
                ours, _integrate_branches([found[i] for i in ours], ROUGH_RTOL, scale).points, strict=True
            ):
                out[i] = line
    return out


def _integrate_branches(
    ours: Sequence[Branch], rtol: float, scale: float = 1.0, t_max: float | None = None
) -> Trajectories:
    """Follow branches of one layer problem, all leaving or all entering, half-saddles first."""
    one = ours[0]
    options: dict[str, Any] = {
        "rtol": rtol, "atol": 0.1 * rtol, "backward": one.backward, "length": MAX_BRANCH_LENGTH,
        "pixel": min(max(RELATIVE_PIXEL * scale, MIN_PIXEL), LINE_PIXEL),
        "t_max": MAX_BRANCH_TIME / one.at.speed if t_max is None else t_max,
        "samples": None if t_max is None else "ends",
    }  # fmt: skip
    thetas = [one.theta for one in ours if one.critical is None]
    starts = np.array([one.start for one in ours if one.critical is not None]).reshape(-1, 2)
    if not thetas:
        return trajectories(one.at, one.psi, starts, **options)
    return continuation(one.at, one.psi, thetas, more_starts=starts if len(starts) else None, **options)


def branches(problem: LayerProblem) -> list[Branch]:
    """All branches of the saddles of a layer problem, on the hemisphere."""
    found: list[Branch] = []
    for C in problem.critical:
        if C.kind == "saddle":
            found += [one for backward in (False, True) for one in _branches_of(problem.at, problem.psi, C, backward)]
    equator = problem.equator
    for i, theta in enumerate(equator.theta.tolist()):
        if equator.multiplicity[i] == 1 and not equator.radially_degenerate[i]:
            rim = _half_saddle(problem.at, problem.psi, theta, bool(equator.lambda_rho[i] > 0.0))
            found += [rim] if rim is not None else []
    return found


def _eigenvalue(C: CriticalSet, backward: bool) -> float:
    return float(C.eigenvalues.real[1 if backward else 0])


def _branches_of(at: FrozenSystem, psi: Psi, C: CriticalSet, backward: bool) -> list[Branch]:
    rows = C.jacobian - _eigenvalue(C, backward) * np.eye(2)
    row = rows[int(np.argmax(np.hypot(*rows.T)))]  # the eigenvector is across it
    vector = np.array([-row[1], row[0]]) / math.hypot(*row)
    tangent = np.array(to_disc(C.x2, (float(vector[0]), float(vector[1]))))
    out, into = C.eigenvalues.real.tolist()
    found = []
    for sign in (1.0, -1.0):
        x2 = C.x2 + sign * START_DISTANCE * math.hypot(1.0, *C.x2) * vector
        start = x2 / math.hypot(1.0, *x2)
        found.append(Branch(at, psi, backward, C.p, sign * tangent, start, C, math.nan, -into / out))
    return found


def _zero_of_theta(at: FrozenSystem, start: float) -> float:
    """Newton's method for Theta = 0; NaN if it is not found nearby."""

    def turning(v: Array) -> tuple[Array, Array]:
        e, t, U, D = _equator_saddle(at, float(v[0]))
        return np.array([t @ U]), np.array([[t @ D @ t - e @ U]])

    found = newton(turning, np.array([start]), MAX_SADDLE_SHIFT, ANGLE_TOLERANCE)
    return math.nan if found is None else float(found[0])


def _equator_saddle(at: FrozenSystem, theta: float) -> tuple[Array, Array, Array, Array]:
    e, t = np.array([math.cos(theta), math.sin(theta)]), np.array([-math.sin(theta), math.cos(theta)])
    return e, t, at.U(e), at.DU(e)


def _half_saddle(at: FrozenSystem, psi: Psi, theta: float, backward: bool) -> Branch | None:
    if math.isnan(theta):
        return None
    e, t, U, D = _equator_saddle(at, theta)
    radial = float(e @ U)
    along = float(t @ D @ t) - radial
    if not (radial * along > 0.0 and (radial > 0.0) == backward):
        return None
    return Branch(at, psi, backward, e, np.zeros(2), e, None, theta, radial / along if backward else along / radial)
