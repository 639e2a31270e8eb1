"""The borders of the plane (f1, f2) as lines: saddle-nodes of limit directions, and the ellipse |A^-1 f| = 1."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from ...portrait.layer_problem.linearisation import determinant_sign
from ...results.arrays import Array, read_only
from ...systems.coefficients import Coefficients
from ..families.disc import cusps, saddle_node_force

MAX_TURN = math.tau / 360  # the tangent turns by at most this from point to point

PlaneMatrix = tuple[float, float, float]


def coefficients_of(matrix: PlaneMatrix, f: tuple[float, float] | Array = (0.0, 0.0)) -> Coefficients:
    """Return the system of a matrix and f, with numbers only."""
    return Coefficients(*matrix, float(f[0]), float(f[1]), read_only(np.zeros((0, 2))), read_only(np.zeros(0)))


def border_places(entries: PlaneMatrix, angles: Callable[[Array], list[float]]) -> list[tuple[float, float]]:
    """Return the places on the curve of saddle-nodes at its cusps, or its corners."""
    a, b, d = entries
    A = np.array([[a, -b], [b, d]])
    return [(float(f1) + 0.0, float(f2) + 0.0) for f1, f2 in saddle_node_force(A, np.array(angles(A)))]


def saddle_node_lines(entries: PlaneMatrix) -> list[Array]:
    """Return the curve of saddle-nodes in pieces (m, 2) between its cusps; a point where nothing turns at f = 0."""
    a, b, d = entries
    if a == d and b == 0.0:
        return [np.zeros((1, 2))]
    A = np.array([[a, -b], [b, d]])
    tips = cusps(A) or [0.0]
    found = []
    for start, end in pairwise([*tips, tips[0] + math.tau]):
        theta = np.linspace(start, end, max(2, math.ceil((end - start) / MAX_TURN) + 1))
        found.append(saddle_node_force(A, theta))
    found[-1][-1] = found[0][0]
    return found


def critical_lines(entries: PlaneMatrix) -> list[Array]:
    """Return the ellipse |A^-1 f| = 1; a segment, or a point, where det A = 0. Shapes: (m, 2)."""
    a, b, d = entries
    A = np.array([[a, -b], [b, d]])
    if determinant_sign(a, b, d) == 0:
        left, sizes, _ = np.linalg.svd(A)
        end = sizes[0] * left[:, 0]
        return [np.stack([-end, end]) if sizes[0] else np.zeros((1, 2))]
    theta = np.linspace(0.0, math.tau, round(math.tau / MAX_TURN) + 1)
    line = -np.stack([np.cos(theta), np.sin(theta)], axis=-1) @ A.T
    line[-1] = line[0]
    return [line]


def border_reach(entries: PlaneMatrix) -> float:
    """Return the largest coordinate on both borders, or 1 where they are the point f = 0."""
    a, b, d = entries
    step = abs(a - d)
    # |f1| <= |b| sin(t) + |a - d| cos(t)^3 on the saddle-nodes, largest at t = 0, or where the slope first vanishes
    t = 0.5 * math.asin(min(2.0 * abs(b) / (3.0 * step), 1.0)) if step else 0.5 * math.pi
    on_fold = max(abs(b), abs(b) * math.sin(t) + step * math.cos(t) ** 3)
    return max(math.hypot(a, b), math.hypot(b, d), on_fold) or 1.0
