"""Nullclines of a general system as branches: rho' = 0, theta' = 0, U1 = 0 and U2 = 0.

Branches begin at the zeros on the equator, which are known with proof, and are followed (`nullcline_trace`) to where
they end. What a net of the disc still shows as sign changes belongs to closed loops. Where branches cross, each goes
straight on. A loop smaller than a cell of the net, and a curve that a component touches without a change of sign, are
not found.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .compiled_tape import Program, program
from .equator_general import component_zeros, directions
from .general import Frozen
from .nullcline_trace import CLOSED, follow, settle

Array = NDArray[np.floating[Any]]
Kind = Literal["rho", "theta", "U1", "U2"]
KINDS: tuple[Kind, ...] = ("rho", "theta", "U1", "U2")  # in the order of the numbers in `nullcline_trace`

CELLS = 48  # of the net along a side
MOST_POINTS = 4000  # of a branch
ALL_POINTS = 30_000  # of the branches of one kind; a picture with more shows no curve any more
NOTHING = 1e-14  # of U: a component this small everywhere is zero, and has no nullcline
LEFT, BELOW, SIDE = -1.0137, -1.0211, 2.047  # the net lies off centre: zeros on the axes would fall on its nodes


@dataclass(frozen=True, eq=False, slots=True)
class Traced:
    """A branch as a curve.

    Attributes
    ----------
    points, tangents : ndarray (n, 2)
        Between neighbours a cubic with these ends is off by less than 1e-5.
    """

    points: Array
    tangents: Array

    @property
    def straight(self) -> bool:
        """Whether the branch is the segment between its ends, to rounding."""
        start, end = self.points[0], self.points[-1]
        along = end - start
        if not along.any():
            return False
        away = self.points - start
        sag = np.abs(away[:, 0] * along[1] - away[:, 1] * along[0])
        return bool(sag.max() <= 1e-12 * (along @ along))

    @property
    def turning(self) -> float:
        """Radians through which the tangent turns, without sign."""
        a, b = self.tangents[:-1], self.tangents[1:]
        cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
        return float(np.abs(np.arctan2(cross, (a * b).sum(axis=1))).sum())

    def __call__(self, t: Array) -> Array:
        """Points (k, 2) at parameters in [0, 1], which go with the length."""
        P, T = self.points, self.tangents
        length = np.hypot(*(P[1:] - P[:-1]).T)
        at = np.concatenate([[0.0], np.cumsum(length)])
        i = np.clip(np.searchsorted(at, t * at[-1], side="right") - 1, 0, len(length) - 1)
        h = length[i]
        u = (t * at[-1] - at[i]) / np.where(h == 0.0, 1.0, h)
        v = 1.0 - u
        weights = (v * v * (1.0 + 2.0 * u), u * u * (3.0 - 2.0 * u), h * u * v * v, -h * u * u * v)
        parts = (P[i], P[i + 1], T[i], T[i + 1])
        curve = sum(w[:, None] * part for w, part in zip(weights, parts, strict=True))
        # the ends exactly: they are zeros on the equator
        curve = np.where((t <= 0.0)[:, None], P[0], curve)
        return np.where((t >= 1.0)[:, None], P[-1], curve)


def inside_curves(at: Frozen) -> list[tuple[Kind, Traced]]:
    """All branches in the closed e-disc."""
    run, size = program(at.key), at.size
    nodes_c = LEFT + SIDE / CELLS * np.arange(CELLS + 1)
    nodes_s = BELOW + SIDE / CELLS * np.arange(CELLS + 1)
    points = np.stack(np.meshgrid(nodes_c, nodes_s, indexing="ij"), axis=-1)
    U = run.at(points.reshape(-1, 2))[:, :, 0].reshape(*points.shape)
    inside = (points**2).sum(axis=-1) < 1.0
    found: list[tuple[Kind, Traced]] = []
    for kind in KINDS:
        net = _Net(_part(kind, points, U), inside, nodes_c, nodes_s)
        for branch in _branches(at.key, run, size, kind, net, 0.0):
            found.append((kind, branch))  # noqa: PERF401 (a comprehension loses the type of kind)
    return found


def outside_curves(at: Frozen, reach: float) -> list[tuple[Kind, Traced]]:
    """All branches outside, up to that distance from the middle: rays unless U reads x or y."""
    if not at.system.reads_position():
        rays: list[tuple[Kind, Traced]] = []
        for kind in KINDS:
            for u in directions(component_zeros(at.key, kind)[0]):
                rays.append((kind, Traced(np.stack([u, reach * u]), np.stack([u, u]))))  # noqa: PERF401 (type of kind)
        return rays
    run, size = program(at.key), at.size
    radii = np.linspace(1.0, reach, CELLS + 1)
    angles = 1e-3 + 2.0 * math.pi * np.arange(4 * CELLS + 1) / (4 * CELLS)
    e = directions(angles)
    points = radii[:, None, None] * e
    U = at.U(np.broadcast_to(e, points.shape), points - e)
    found: list[tuple[Kind, Traced]] = []
    for kind in KINDS:
        net = _Net(_part(kind, np.broadcast_to(e, points.shape), U), np.ones(points.shape[:2], bool), radii, angles)
        for branch in _branches(at.key, run, size, kind, net, reach):
            found.append((kind, branch))  # noqa: PERF401 (a comprehension loses the type of kind)
    return found


def _part(kind: Kind, e: Array, U: Array) -> Array:
    if kind == "rho":
        return (e * U).sum(axis=-1)
    if kind == "theta":
        return e[..., 0] * U[..., 1] - e[..., 1] * U[..., 0]
    return U[..., 0 if kind == "U1" else 1]


_AROUND = np.array([(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)])


class _Net:
    """Cells of a net in which a component changes sign and that no branch has passed yet."""

    def __init__(self, values: Array, usable: NDArray[np.bool_], first: Array, second: Array) -> None:
        positive = (values > 0.0).astype(np.int8)
        corners = positive[:-1, :-1] + positive[1:, :-1] + positive[:-1, 1:] + positive[1:, 1:]
        usable = usable & np.isfinite(values)
        whole = usable[:-1, :-1] & usable[1:, :-1] & usable[:-1, 1:] & usable[1:, 1:]
        self.largest = float(np.abs(values[usable]).max(initial=0.0))
        self.open = (corners > 0) & (corners < 4) & whole
        self.first, self.second = first, second
        self.steps = np.array([first[1] - first[0], second[1] - second[0]])
        self.polar = len(second) > len(first)

    def _cell(self, points: Array) -> NDArray[np.int64]:
        if self.polar:
            angle = np.remainder(np.arctan2(points[:, 1], points[:, 0]) - self.second[0], 2.0 * math.pi)
            places = np.stack([np.hypot(*points.T) - self.first[0], angle], axis=-1)
        else:
            places = points - (self.first[0], self.second[0])
        return np.floor(places / self.steps).astype(np.int64)

    def passed(self, branch: Traced) -> None:
        """Close the cells along a branch, and their neighbours: a step of the branch is no longer than a cell."""
        i, j = (self._cell(branch.points)[:, None, :] + _AROUND).reshape(-1, 2).T
        if self.polar:
            j = j % self.open.shape[1]
        ok = (i >= 0) & (i < self.open.shape[0]) & (j >= 0) & (j < self.open.shape[1])
        self.open[i[ok], j[ok]] = False

    def seeds(self) -> Iterator[tuple[Array, float]]:
        """Middles of open cells, one after another, with the size of a cell; a cell that is asked for is closed."""
        while True:
            left = np.argwhere(self.open)
            if not len(left):
                return
            i, j = left[0]
            self.open[i, j] = False
            first, second = self.first[i] + 0.5 * self.steps[0], self.second[j] + 0.5 * self.steps[1]
            if self.polar:
                yield first * directions(np.array([second]))[0], float(max(self.steps[0], first * self.steps[1]))
            else:
                yield np.array([first, second]), float(self.steps.max())


def _branches(key: Hashable, run: Program, size: float, kind: Kind, net: _Net, reach: float) -> list[Traced]:
    """Branches of one kind: from the equator, then from what the net shows besides; reach 0 means inside."""
    outside, number = reach > 0.0, KINDS.index(kind)
    if net.largest <= NOTHING * size:
        return []
    angles, multiplicity = component_zeros(key, kind)
    ends = directions(angles[multiplicity % 2 == 1])
    waiting = np.ones(len(ends), bool)
    found: list[Traced] = []
    for i, u in enumerate(ends):
        if not waiting[i] or _enough(found):
            continue
        waiting[i] = False
        ok, _, _, tx, ty = settle(*run.arrays, number, outside, u[0], u[1], 0.01, size)
        if not ok:
            continue
        if (tx * u[0] + ty * u[1] > 0.0) != outside:
            tx, ty = -tx, -ty
        branch, ending = _followed(run, size, number, outside, reach, u, np.array([tx, ty]))
        if len(branch.points) > 1:
            found.append(_joined(branch, ending, ends, waiting))
            net.passed(branch)
    for middle, cell in net.seeds():
        if _enough(found):
            break
        ok, X, Y, tx, ty = settle(*run.arrays, number, outside, middle[0], middle[1], 2.0 * cell, size)
        start = np.array([X, Y])
        r = math.hypot(X, Y)
        if not ok or not (1.0 <= r <= reach if outside else r <= 1.0) or np.abs(start - middle).max() > cell:
            continue
        branch, ending = _followed(run, size, number, outside, reach, start, np.array([tx, ty]))
        if ending != CLOSED:
            branch = _joined(branch, ending, ends, waiting)
            back, other = _followed(run, size, number, outside, reach, start, np.array([-tx, -ty]))
            back = _joined(back, other, ends, waiting)
            branch = Traced(
                np.concatenate([back.points[:0:-1], branch.points]),
                np.concatenate([-back.tangents[:0:-1], branch.tangents]),
            )
        if len(branch.points) > 1:
            found.append(branch)
            net.passed(branch)
    return found


def _enough(found: list[Traced]) -> bool:
    return sum(len(branch.points) for branch in found) > ALL_POINTS


def _followed(
    run: Program, size: float, kind: int, outside: bool, reach: float, start: Array, tangent: Array
) -> tuple[Traced, int]:
    out = np.empty((MOST_POINTS, 4))
    count, ending = follow(*run.arrays, kind, outside, start[0], start[1], tangent[0], tangent[1], reach, size, out)
    return Traced(out[:count, :2].copy(), out[:count, 2:].copy()), ending


def _joined(branch: Traced, ending: int, ends: Array, waiting: NDArray[np.bool_]) -> Traced:
    """End a branch that has reached the equator exactly at the zero there."""
    last = branch.points[-1]
    if ending == CLOSED or not len(ends) or abs(math.hypot(*last) - 1.0) > 1e-4:
        return branch
    distance = np.hypot(*(ends - last).T)
    nearest = int(np.argmin(distance))
    if distance[nearest] > 1e-3:
        return branch
    waiting[nearest] = False
    branch.points[-1] = ends[nearest]
    return branch
