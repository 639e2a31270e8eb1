"""Branches of invariant manifolds, each followed from its saddle to where it ends.

On the hemisphere an equilibrium Q of the equator has the eigenvalues lambda_theta along the equator and -lambda_rho
up it (Theorem 3.1(b)), outside it lambda_theta and lambda_rho: it is a half-saddle on the hemisphere where
``lambda_theta lambda_rho > 0`` and outside where ``lambda_theta lambda_rho < 0``. Outside, the branch is exactly
the ray theta = theta_i, unless U depends on x or y. Where Theta has a multiple zero, its branch bounds the sectors
there and is followed too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from ..results.arrays import Array
from ..results.result import Pictured, Several, Tabled, result_rows
from ..results.tables import paragraphs
from ..results.words import say
from ..systems.frozen import FrozenSystem
from ..systems.psi.function import Psi
from .cycles.limit_cycles import cycles_of
from .layer_problem.critical import CriticalSet
from .layer_problem.eigendirections import to_disc
from .layer_problem.equator import EquatorEquilibria
from .layer_problem.problem import LayerProblem
from .omega_limits import (
    BRANCH_DURATION,
    CAPTURE,
    CONNECTION,
    RISE_DURATION,
    critical_label,
    half_saddle,
    omega_limits,
    radially_neutral,
)
from .orbits.trajectories import Status, Trajectories, concatenate, continuation, trajectories


@dataclass(frozen=True, eq=False)
class Separatrix(Tabled):
    """One branch of an invariant manifold; arrays are read-only.

    Attributes
    ----------
    origin : str
        The saddle it belongs to: "C" ("C1", "C2", ... where there are several), "Q1", ...
    direction : str
        "unstable" (it leaves the origin) or "stable" (it enters it).
    end : str
        Where its other end lies: "C", "Q2", "equator" (the closed one), "cycle 1", "outside", or "undecided".
    points : ndarray (m, 2)
        The picture, in order of increasing time; includes origin and end where they are points.
    departure_angle : float
        Angle of its tangent at the origin, leaving it, radians; at the equator that of the direction Q.
    arrival_angle : float or None
        At the other end: theta on the equator, or the angle from C of the tangent at a node or saddle.
    inside : bool
        On the hemisphere; otherwise outside.
    connection : bool
        The other end is a saddle too: a saddle connection, within `gap`.
    gap : float or None
        Distance in the disc by which the two saddles' branches miss each other, where that was measured.
    status : str
        One sentence.
    """

    _head_ = ("of", "branch", "other end", "where")

    origin: str
    direction: str
    end: str
    points: Array = field(repr=False)
    departure_angle: float
    arrival_angle: float | None
    inside: bool
    connection: bool
    gap: float | None
    status: str

    def _row_(self) -> tuple[str, ...]:
        return self.origin, self.direction, self.end, "hemisphere" if self.inside else "outside"


@dataclass(frozen=True, eq=False)
class Separatrices(Several[Separatrix], Pictured):
    """All separatrices; iterates over them.

    Attributes
    ----------
    branches : tuple of Separatrix
    notes : tuple of str
        What has no separatrix because it is degenerate, saddle connections, branches left undecided.
    """

    _held_ = "branches"

    branches: tuple[Separatrix, ...]
    notes: tuple[str, ...] = ()

    def _tables_(self) -> str:
        return result_rows(self) + paragraphs(self.notes)

    @property
    def graph(self) -> tuple[tuple[str, str], ...]:
        """(from, to) of each branch, in the direction of time."""
        return tuple((b.origin, b.end) if b.direction == "unstable" else (b.end, b.origin) for b in self.branches)


# Local invariant manifolds of a saddle of the layer problem, as polynomials of order ORDER.
#
# In kappa_2, ``x2' = F(x2) = U(e_Psi(x2))``, in the e-linear system ``A (e_Psi(x2) - e_C)``. The manifold along
# the eigenvector v with eigenvalue lambda is the curve ``W(sigma) = C + sigma v + h_2 sigma^2 + ...`` up to order ORDER
# on which sigma' = lambda sigma: ``F(W(sigma)) = lambda sigma W'(sigma)``. Order by order
# ``(J - k lambda) h_k = -N_k``, N_k the coefficients of the nonlinear part of F along the curve, read off at
# Chebyshev nodes: no second derivative of Psi is needed. At a saddle J - k lambda is regular for k >= 2. The error at
# sigma is of order sigma^(ORDER + 1).
ORDER = 5
FITTED = 9  # nodes the coefficients are read off at
FIRST_DISTANCE, MIN_DISTANCE = 0.2, 1e-6  # start distances tried, in units of hypot(1, |x2|) of the saddle


@lru_cache(maxsize=1)
def _fit() -> tuple[Array, Array]:
    """Nodes t on [-1, 1], and the matrix from N(t)/t^2 there to the coefficients N_2 .. N_ORDER."""
    t = np.cos(math.pi * (np.arange(FITTED - 1) + 0.5) / (FITTED - 1))  # an even number: none is 0
    powers = t[:, None] ** np.arange(FITTED - 1)
    return t, (np.linalg.inv(powers) / t[None, :] ** 2)[: ORDER - 1]


def _projected_velocity(at: FrozenSystem, psi: Psi, critical: CriticalSet, x2: Array) -> Array:
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    e = x2 * (psi.modulus(zeta) / np.maximum(zeta, 1e-300))[:, None]
    if at.as_given is not None:
        return (e - critical.e) @ at.as_given.A.T
    return at.U(e) - at.U(critical.e)  # what rounding leaves of U at C would be amplified


def expansion(
    at: FrozenSystem, psi: Psi, critical: CriticalSet, eigenvalue: float, reach: float
) -> tuple[Array, float]:
    """Coefficients (ORDER + 1, 2) of W in powers of sigma, and its relative defect at |sigma| = reach."""
    J = critical.jacobian
    # The longer row of J - lambda has the eigenvector across it.
    rows = J - eigenvalue * np.eye(2)
    row = rows[int(np.argmax(np.hypot(rows[:, 0], rows[:, 1])))]
    vector = np.array([-row[1], row[0]]) / math.hypot(row[0], row[1])
    t, fit = _fit()
    scaled = np.zeros((ORDER + 1, 2))  # h_k reach^k
    scaled[0], scaled[1] = critical.x2, vector * reach
    inverses = [np.linalg.inv(J - k * eigenvalue * np.eye(2)) for k in range(2, ORDER + 1)]
    powers = t[:, None] ** np.arange(ORDER + 1)
    for _ in range(ORDER):  # each round settles one more order
        x2 = powers @ scaled
        nonlinear = _projected_velocity(at, psi, critical, x2) - (x2 - critical.x2) @ J.T
        parts = fit @ nonlinear
        before = scaled.copy()
        for k in range(2, ORDER + 1):
            scaled[k] = -inverses[k - 2] @ parts[k - 2]
        if np.abs(scaled - before).max() <= 1e-17 * reach:
            break
    ends = np.array([-1.0, 1.0])[:, None] ** np.arange(ORDER + 1)
    slope = ends @ (scaled * np.arange(ORDER + 1)[:, None])
    defect = _projected_velocity(at, psi, critical, ends @ scaled) - eigenvalue * slope
    order = np.arange(ORDER + 1)[:, None]
    return scaled / reach**order, float(np.abs(defect).max() / abs(eigenvalue))


def manifold_starts(
    at: FrozenSystem, psi: Psi, critical: CriticalSet, eigenvalue: float, tolerance: float
) -> tuple[Array, Array]:
    """Points of the disc (2, 2) on the two halves of a manifold, and unit tangents (2, 2) there at C."""
    scale = math.hypot(1.0, float(np.hypot(*critical.x2)))
    reach = FIRST_DISTANCE * scale
    terms, defect = expansion(at, psi, critical, eigenvalue, reach)
    for _ in range(6):
        ratio = defect / (tolerance * scale)
        if ratio <= 1.0 or reach <= MIN_DISTANCE * scale:
            break
        reach = max(MIN_DISTANCE * scale, 0.8 * reach * max(ratio ** (-1.0 / (ORDER + 1)), 1e-2))
        terms, defect = expansion(at, psi, critical, eigenvalue, reach)
    sigma = np.array([-reach, reach])
    x2 = (sigma[:, None] ** np.arange(ORDER + 1)) @ terms
    points = x2 / np.hypot(1.0, np.hypot(x2[:, :1], x2[:, 1:]))
    tangent = np.array(to_disc(critical.x2, (float(terms[1, 0]), float(terms[1, 1]))))
    return points, np.array([-tangent, tangent])


EXTENSIONS = 6  # times that a branch is followed on to where it ends, sixteen times longer each
NEAR_END = 0.02  # distance to the end that is drawn straight: an orbit that went further would hardly move
ARC = 0.05  # radians between points of the equator
NEAR_SIGMA = 1e-4  # rho at which a bent branch outside starts: its expansion is off by rho^2 there


def branches_inside(problem: LayerProblem, t_max: float, rtol: float, pixel: float, backward: bool) -> list[Separatrix]:
    """All branches on the hemisphere that leave their saddle forward, or backward, in time."""
    at, psi, equator, critical = problem.at, problem.psi, problem.equator, problem.critical
    fine: Any = {
        "rtol": rtol, "atol": 0.1 * rtol, "pixel": pixel, "capture": CAPTURE, "backward": backward, "stiff": True
    }  # fmt: skip
    owners = [i for i in range(len(equator)) if half_saddle(equator, i) and (equator.lambda_rho[i] > 0.0) == backward]
    origins = [f"Q{i + 1}" for i in owners]
    angles = equator.theta[owners].tolist()
    firsts = [np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
    # A slow branch needs more time than another should be drawn for.
    unit = at.speed
    parts = []
    for i in owners:
        own = min(t_max, BRANCH_DURATION / unit + RISE_DURATION / abs(float(equator.lambda_rho[i])))
        parts.append(continuation(at, psi, equator.theta[i : i + 1], t_max=own, **fine))
    for k, C in enumerate(critical):
        if C.kind == "saddle":
            value = float(C.eigenvalues.real[1 if backward else 0])
            points, tangents = manifold_starts(at, psi, C, value, 0.1 * rtol)
            parts.append(trajectories(at, psi, points, t_max=t_max, **fine))
            origins += [critical_label(critical, k)] * 2
            angles += np.arctan2(tangents[:, 1], tangents[:, 0]).tolist()
            firsts += [C.p, C.p]
    if not parts:
        return []
    lines = concatenate(parts)
    branches = []
    ends = omega_limits(at, psi, lines, equator, critical, lambda: cycles_of(problem), rtol=rtol, backward=backward)
    places = {critical_label(critical, k): C.p for k, C in enumerate(critical)}
    places |= {f"Q{k + 1}": np.array([math.cos(t), math.sin(t)]) for k, t in enumerate(equator.theta.tolist())}
    tails = _tails(at, psi, lines, [places.get(ending.label) for ending in ends], rtol, pixel, backward)
    for i, ending in enumerate(ends):
        line = np.concatenate([firsts[i][None, :], lines.points[i], *tails[i]])
        direction = "stable" if backward else "unstable"
        points = np.ascontiguousarray(line[::-1] if backward else line)
        connection = ending.sentence == CONNECTION
        branches.append(
            Separatrix(
                origins[i],
                direction,
                ending.label,
                points,
                angles[i],
                ending.angle,
                True,
                connection,
                None,
                ending.sentence,
            )
        )
    return branches


def _tails(
    at: FrozenSystem, psi: Psi, lines: Trajectories, ends: list[Array | None], rtol: float, pixel: float, backward: bool
) -> list[list[Array]]:
    """Points from where each line was left to the point where it ends; none where it ends at no point."""
    tails: list[list[Array]] = [[] for _ in ends]
    left = np.array([points[-1] if len(points) else [math.nan, math.nan] for points in lines.points])
    away = [math.inf if end is None else math.dist(end, p) for end, p in zip(ends, left, strict=True)]
    open_ = [i for i, end in enumerate(ends) if end is not None and away[i] > pixel]
    time = 100.0 / at.speed
    for _ in range(EXTENSIONS):
        # a point of the disc says nothing of an ebar below 1e-7
        open_ = [i for i in open_ if float(lines.ends[i, 2]) > 1e-7 and np.hypot(*left[i]) < 1.0 - 1e-14]
        if not open_:
            break
        fine: Any = {"rtol": rtol, "atol": 0.1 * rtol, "pixel": pixel, "capture": CAPTURE, "backward": backward}
        on = trajectories(at, psi, left[open_], t_max=time, stiff=True, **fine)
        still = []
        for k, i in enumerate(open_):
            points, end = on.points[k], ends[i]
            assert end is not None
            gaps = np.hypot(*(points - end).T)
            nearest = int(np.argmin(gaps))
            tails[i].append(points[1 : nearest + 1])
            left[i] = points[nearest]
            cut_off = on.status[k] in (Status.T_MAX, Status.STEP_LIMIT) and nearest == len(points) - 1
            if cut_off and gaps[nearest] > pixel:
                still.append(i)
        open_ = still
        time *= 16.0
    for i, end in enumerate(ends):
        if end is None:
            continue
        gap = math.dist(end, left[i])
        if gap > pixel and min(np.hypot(*end), np.hypot(*left[i])) > 1.0 - 1e-7:
            tails[i].append(_along_equator(at, left[i], end, backward))
        elif gap <= NEAR_END:
            tails[i].append(end[None, :])
    return tails


def _along_equator(at: FrozenSystem, p: Array, end: Array, backward: bool) -> Array:
    """Points of the equator from next to p to an equilibrium there, in the sense in which orbits move."""
    first, last = math.atan2(p[1], p[0]), math.atan2(end[1], end[0])
    U = at.U(p / np.hypot(*p))
    turn = (last - first) % (2.0 * math.pi)
    if (float(p[0] * U[1] - p[1] * U[0]) < 0.0) != backward:
        turn -= 2.0 * math.pi
    angles = first + turn * np.linspace(0.0, 1.0, math.ceil(abs(turn) / ARC) + 1)[1:]
    return np.concatenate([np.stack([np.cos(angles), np.sin(angles)], axis=-1)[:-1], end[None, :]])


def outside_half_saddle(equator: EquatorEquilibria, i: int) -> bool:
    """Return whether Q is a `half_saddle` on the side rho > 0, where the radial eigenvalue is lambda_rho."""
    if radially_neutral(equator, i):
        return False
    return int(equator.multiplicity[i]) % 2 == 0 or not half_saddle(equator, i)


def ray(equator: EquatorEquilibria, i: int, view: float) -> Separatrix:
    """Return the branch outside where U does not depend on x or y: the ray itself."""
    angle = float(equator.theta[i])
    u = np.array([math.cos(angle), math.sin(angle)])
    far = view / max(abs(u[0]), abs(u[1]))
    stable = equator.lambda_rho[i] < 0.0
    points = np.array([far * u, u] if stable else [u, far * u])
    sentence = say("ray arrives" if stable else "ray leaves", Q=f"Q{i + 1}")
    direction = "stable" if stable else "unstable"
    return Separatrix(f"Q{i + 1}", direction, "outside", points, angle, angle, False, False, None, sentence)


def bent_branch(problem: LayerProblem, i: int, t_max: float, rtol: float, view: float, pixel: float) -> Separatrix:
    """Follow the branch outside where U depends on x or y: ``theta = theta_i + k rho + ...``, rho' = rho lambda_rho."""
    at, psi, equator = problem.at, problem.psi, problem.equator
    angle, growth = float(equator.theta[i]), float(equator.lambda_rho[i])
    u, across = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    change = float(across @ at.U_rho(u))
    lean = change / (growth - float(equator.lambda_theta[i]))  # of opposite signs at a half-saddle
    start = angle + NEAR_SIGMA * lean
    first = (1.0 + NEAR_SIGMA) * np.array([[math.cos(start), math.sin(start)]])
    stable = growth < 0.0
    time = t_max + 2.0 * abs(math.log(NEAR_SIGMA) / growth)
    options: dict[str, Any] = {"rtol": rtol, "atol": 0.1 * rtol, "view": view, "pixel": pixel, "backward": stable}
    line = trajectories(at, psi, first, t_max=time, **options)
    points = np.concatenate([u[None, :], line.points[0]])
    far = math.atan2(points[-1, 1], points[-1, 0])
    direction = "stable" if stable else "unstable"
    sentence = say("branch arrives" if stable else "branch leaves", Q=f"Q{i + 1}")
    if line.status[0] is not Status.LEFT_VIEW:
        sentence += f" {line.status[0].value}"
    ordered = np.ascontiguousarray(points[::-1] if stable else points)
    return Separatrix(f"Q{i + 1}", direction, "outside", ordered, angle, far, False, False, None, sentence)
