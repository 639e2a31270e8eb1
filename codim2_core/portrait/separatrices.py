"""Separatrices: the skeleton of a portrait, as a graph from saddles to where their branches end.

On the hemisphere an equilibrium Q of the equator has the eigenvalues lambda_theta along the equator and -lambda_rho
up it (thm:geneps0(b)), outside it lambda_theta and lambda_rho: it is a half-saddle on the hemisphere where
``lambda_theta lambda_rho > 0`` and outside where ``lambda_theta lambda_rho < 0``. Outside, the branch is exactly
the ray theta = theta_i, unless U depends on x or y. Where Theta has a multiple zero, its branch bounds the sectors
there and is followed too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..cycles.limit_cycles import LimitCycles, cycles_of
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria
from ..layer_problem.problem import LayerProblem
from ..orbits.trajectories import Status, Trajectories, continuation, joined, trajectories
from ..psi.function import Psi
from ..systems.frozen import AtZ
from ..systems.kinds import AnySystem
from .endings import (
    CAPTURE,
    CONNECTION,
    SLOW,
    SPEEDS,
    critical_label,
    drawn_time,
    endings,
    half_saddle,
    radially_neutral,
)
from .saddle_manifold import starts

__all__ = ["Separatrices", "Separatrix", "separatrices"]

Array = NDArray[np.float64]

PIXEL = 1.0 / 180.0
EXTENSIONS = 6  # times that a branch is followed on to where it ends, four times longer each
NEAR_END = 0.02  # distance to the end that is drawn straight: followed further, an orbit would all but stand still
ARC = 0.05  # radians between points of the equator
NEAR_SIGMA = 1e-4  # rho at which a bent branch outside starts: its expansion is off by rho^2 there


@dataclass(frozen=True, eq=False)
class Separatrix:
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

    origin: str
    direction: str
    end: str
    points: Array
    departure_angle: float
    arrival_angle: float | None
    inside: bool
    connection: bool
    gap: float | None
    status: str


@dataclass(frozen=True, eq=False)
class Separatrices:
    """All separatrices; iterates over them.

    Attributes
    ----------
    branches : tuple of Separatrix
    notes : tuple of str
        What has no separatrix because it is degenerate, saddle connections, branches left undecided.
    """

    branches: tuple[Separatrix, ...]
    notes: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[Separatrix]:
        return iter(self.branches)

    def __len__(self) -> int:
        return len(self.branches)

    def __getitem__(self, i: int) -> Separatrix:
        return self.branches[i]

    @property
    def graph(self) -> tuple[tuple[str, str], ...]:
        """(from, to) of each branch, in the direction of time."""
        return tuple((b.origin, b.end) if b.direction == "unstable" else (b.end, b.origin) for b in self.branches)


def separatrices(
    system: AnySystem,
    psi: Psi,
    z: ArrayLike = (),
    *,
    t_max: float | None = None,
    rtol: float = 1e-9,
    view: float = 2.0,
    pixel: float = PIXEL,
    tolerance: float = 1e-6,
    cycles: LimitCycles | None = None,
) -> Separatrices:
    """Separatrices of the critical sets that are saddles, and of the half-saddles on the equator, thm:geneps0(b).

    Branches of C start on a polynomial of order `saddle_manifold.ORDER` (5) of the invariant manifold, those of Q
    on an expansion of order 2 in ebar (`orbits.departures`), each at a distance where its error is below rtol.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    t_max : float, optional
        Longest time T drawn of a branch; default 600 over the unit of speed, |(a, b, d, f1, f2)| or max |U|. Where it
        ends is decided beyond that.
    rtol : float
    view, pixel : float
        As in `trajectories`.
    tolerance : float
        Distance in the disc within which the branches of two saddles count as a connection.
    cycles : LimitCycles, optional
        Of the same system, where they are known already.

    Returns
    -------
    Separatrices
    """
    problem = LayerProblem(system.at(z), psi).give(cycles_of, cycles)
    return separatrices_of(problem, t_max=t_max, rtol=rtol, view=view, pixel=pixel, tolerance=tolerance)


def separatrices_of(
    problem: LayerProblem,
    *,
    t_max: float | None = None,
    rtol: float = 1e-9,
    view: float = 2.0,
    pixel: float = PIXEL,
    tolerance: float = 1e-6,
) -> Separatrices:
    """Separatrices of a layer problem, with the parameters of `separatrices`."""
    at, psi, equator, critical = problem.at, problem.psi, problem.equator, problem.critical
    cycles = problem.keep(cycles_of)
    longest = drawn_time(at, equator) if t_max is None else t_max

    def inside(pixel: float) -> list[Separatrix]:
        parts = [
            _inside(at, psi, equator, critical, cycles, longest, rtol, pixel, backward) for backward in (False, True)
        ]
        return parts[0] + parts[1]

    branches = inside(pixel)
    gaps = _gaps(branches)
    if gaps and min(gaps.values()) < 2.0 * pixel:
        # Drawn lines are too coarse to tell a connection from a near miss.
        gaps = _gaps(inside(min(pixel, tolerance)))
    branches = _connected(branches, gaps, tolerance)
    rays = [i for i in range(len(equator)) if _outside_half_saddle(equator, i)]
    if at.reads_position:
        branches += [_bent(at, psi, equator, i, longest, rtol, view, pixel) for i in rays]
    else:
        branches += [_ray(equator, i, view) for i in rays]
    for branch in branches:
        branch.points.flags.writeable = False
    return Separatrices(tuple(branches), _notes(equator, branches))


def _inside(
    at: AtZ,
    psi: Psi,
    equator: EquatorEquilibria,
    critical: tuple[CriticalSet, ...],
    cycles: LimitCycles,
    t_max: float,
    rtol: float,
    pixel: float,
    backward: bool,
) -> list[Separatrix]:
    """All branches on the hemisphere that leave their saddle forward, or backward, in time."""
    fine: Any = {"rtol": rtol, "atol": 0.1 * rtol, "pixel": pixel, "capture": CAPTURE, "backward": backward}
    owners = [i for i in range(len(equator)) if half_saddle(equator, i) and (equator.lambda_rho[i] > 0.0) == backward]
    origins = [f"Q{i + 1}" for i in owners]
    angles = equator.theta[owners].tolist()
    firsts = [np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
    # A slow branch needs more time than another should be drawn for.
    unit = at.speed
    parts = []
    for i in owners:
        own = min(t_max, SPEEDS / unit + SLOW / abs(float(equator.lambda_rho[i])))
        parts.append(continuation(at, psi, equator.theta[i : i + 1], t_max=own, **fine))
    for k, C in enumerate(critical):
        if C.kind == "saddle":
            value = float(C.eigenvalues.real[1 if backward else 0])
            points, tangents = starts(at, psi, C, value, 0.1 * rtol)
            parts.append(trajectories(at, psi, points, t_max=t_max, **fine))
            origins += [critical_label(critical, k)] * 2
            angles += np.arctan2(tangents[:, 1], tangents[:, 0]).tolist()
            firsts += [C.p, C.p]
    if not parts:
        return []
    lines = joined(parts)
    branches = []
    ends = endings(at, psi, lines, equator, critical, lambda: cycles, rtol=rtol, backward=backward)
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
    at: AtZ, psi: Psi, lines: Trajectories, ends: list[Array | None], rtol: float, pixel: float, backward: bool
) -> list[list[Array]]:
    """Points from where each line was left to the point where it ends; none where it ends at no point.

    Lines that their time cut off, or that were captured at a distance, are followed to where they stop, in ever longer
    times, and end where they come nearest to the point.
    """
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
        on = trajectories(at, psi, left[open_], t_max=time, **fine)
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
        time *= 4.0
    for i, end in enumerate(ends):
        if end is None:
            continue
        gap = math.dist(end, left[i])
        if gap > pixel and min(np.hypot(*end), np.hypot(*left[i])) > 1.0 - 1e-7:
            tails[i].append(_along_equator(at, left[i], end, backward))
        elif gap <= NEAR_END:
            tails[i].append(end[None, :])
    return tails


def _along_equator(at: AtZ, p: Array, end: Array, backward: bool) -> Array:
    """Points of the equator from beside p to an equilibrium there, in the sense in which orbits move."""
    first, last = math.atan2(p[1], p[0]), math.atan2(end[1], end[0])
    U = at.U(p / np.hypot(*p))
    turn = (last - first) % (2.0 * math.pi)
    if (float(p[0] * U[1] - p[1] * U[0]) < 0.0) != backward:
        turn -= 2.0 * math.pi
    angles = first + turn * np.linspace(0.0, 1.0, math.ceil(abs(turn) / ARC) + 1)[1:]
    return np.concatenate([np.stack([np.cos(angles), np.sin(angles)], axis=-1)[:-1], end[None, :]])


def _outside_half_saddle(equator: EquatorEquilibria, i: int) -> bool:
    """As `half_saddle`, for the side rho > 0, where the radial eigenvalue is lambda_rho."""
    if radially_neutral(equator, i):
        return False
    return int(equator.multiplicity[i]) % 2 == 0 or not half_saddle(equator, i)


def _ray(equator: EquatorEquilibria, i: int, view: float) -> Separatrix:
    angle = float(equator.theta[i])
    u = np.array([math.cos(angle), math.sin(angle)])
    far = view / max(abs(u[0]), abs(u[1]))
    stable = equator.lambda_rho[i] < 0.0
    points = np.array([far * u, u] if stable else [u, far * u])
    sentence = f"The ray θ = θ_{i + 1} itself, as f is constant: " + ("it arrives." if stable else "it leaves.")
    direction = "stable" if stable else "unstable"
    return Separatrix(f"Q{i + 1}", direction, "outside", points, angle, angle, False, False, None, sentence)


def _bent(
    at: AtZ, psi: Psi, equator: EquatorEquilibria, i: int, t_max: float, rtol: float, view: float, pixel: float
) -> Separatrix:
    """Follow the branch outside where U depends on x or y: ``theta = theta_i + k rho + ...``, rho' = rho lambda_rho."""
    angle, growth = float(equator.theta[i]), float(equator.lambda_rho[i])
    u, across = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    change = float(across @ (at.U(u, NEAR_SIGMA * u) - at.U(u, -NEAR_SIGMA * u))) / (2.0 * NEAR_SIGMA)
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
    sentence = f"Outside, from Q{i + 1}: " + ("it arrives." if stable else "it leaves.")
    if line.status[0] is not Status.LEFT_VIEW:
        sentence += f" {line.status[0].value}"
    ordered = np.ascontiguousarray(points[::-1] if stable else points)
    return Separatrix(f"Q{i + 1}", direction, "outside", ordered, angle, far, False, False, None, sentence)


def _gap(one: Array, other: Array) -> float:
    """Distance of the middle of `other`, by arc length, from the polyline `one`."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(other, axis=0).T))])
    at = np.array([np.interp(0.5 * length[-1], length, other[:, k]) for k in range(2)])
    start, along = one[:-1], np.diff(one, axis=0)
    part = np.clip(((at - start) * along).sum(axis=1) / np.maximum((along**2).sum(axis=1), 1e-300), 0.0, 1.0)
    return float(np.hypot(*(start + part[:, None] * along - at).T).min())


def _gaps(branches: list[Separatrix]) -> dict[tuple[int, int], float]:
    """Distances between each unstable branch and each stable one of another saddle, by their places in the list."""
    gaps = {}
    for i, leaving in enumerate(branches):
        for j, entering in enumerate(branches):
            if leaving.direction != "unstable" or entering.direction != "stable" or leaving.origin == entering.origin:
                continue
            gaps[i, j] = min(_gap(leaving.points, entering.points), _gap(entering.points, leaving.points))
    return gaps


def _connected(branches: list[Separatrix], gaps: dict[tuple[int, int], float], tolerance: float) -> list[Separatrix]:
    """Name saddle connections: an unstable branch that coincides with a stable one of another saddle."""
    out = list(branches)
    for (i, j), gap in gaps.items():
        if gap <= tolerance:
            leaving, entering = branches[i].origin, branches[j].origin
            sentence = f"Saddle connection from {leaving} to {entering}, within {gap:.1e}."
            out[i] = replace(out[i], end=entering, connection=True, gap=gap, status=sentence)
            out[j] = replace(out[j], end=leaving, connection=True, gap=gap, status=sentence)
            continue
        for k in (i, j):
            known = out[k].gap
            if known is None or gap < known:
                out[k] = replace(out[k], gap=gap)
    return out


def _notes(equator: EquatorEquilibria, branches: list[Separatrix]) -> tuple[str, ...]:
    notes = [b.status for b in branches if b.connection and b.direction == "unstable"]
    notes += [
        f"Q{i + 1} is radially non-hyperbolic (a critical set comes to the equator): its branches are not followed."
        for i in range(len(equator))
        if radially_neutral(equator, i)
    ]
    notes += [f"A branch of {b.origin} is undecided: {b.status}" for b in branches if b.end == "undecided"]
    if equator.all_directions:
        notes.append("Every direction is a limit direction: the equator is a line of equilibria, with no separatrices.")
    return tuple(dict.fromkeys(notes))
