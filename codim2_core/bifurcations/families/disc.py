"""The plane of a constant force, U = A e + f: places given by the critical set, and curves in closed form.

Over f the critical set is e = -A^-1 f, so all but saddle-nodes of limit directions happens in the disc |e| < 1. There
everything has the size 1, however narrow the ellipse |A^-1 f| = 1 is. With n = e and t across it the borders are

    saddle-nodes f = (t.A t - n.A n) n - (t.A n) t,    critical sets at the equator f = -A n    (Section 4.4).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ...results.arrays import Array
from .family import SystemFamily

MIN_DETERMINANT = 1e-12  # of the square of the largest entry: a matrix with less counts as singular
BORDER_ANGLES = 361  # along each border
MEETING_SHARE = 1e-12  # relative, of what has two zeros that have all but met
MIN_BORDER_SIZE = 1e-12  # of the largest entry: the curve of saddle-nodes is a point where all of it is smaller


def force_matrix(family: SystemFamily) -> tuple[Array, Array, Array] | None:
    """Return A, f0 and F of U = A e + f0 + F v over parameters v, F regular; None for any other family.

    Shapes: A (2, 2), f0 (2,), F (2, 2).
    """
    if not family.affine or any(family.of_psi) or len(family.names) != 2:
        return None
    A = [[row.derivative(name) for name in "cs"] for row in family.rows]
    F = [[row.derivative(name) for name in family.names] for row in family.rows]
    if any(entry.names for row in (*A, *F) for entry in row):
        return None
    nothing = dict.fromkeys(("c", "s", *family.names), 0.0)
    f0 = [float(row.evaluate({name: nothing[name] for name in row.names})) for row in family.rows]
    matrix, forces = (np.array([[float(v.evaluate({})) for v in row] for row in rows]) for rows in (A, F))
    return (matrix, np.array(f0), forces) if _relative_determinant(forces) > MIN_DETERMINANT else None


def disc_family(family: SystemFamily) -> SystemFamily | None:
    """Return the family over the square of its critical sets, |e1|, |e2| <= 1; None if it has no such chart."""
    found = force_matrix(family)
    if found is None:
        return None
    A, f0, F = found
    if not _relative_determinant(A) > MIN_DETERMINANT:
        return None
    at = np.linalg.solve(F, A)  # v = -F^-1 (f0 + A e), e = 2 u - 1
    return replace(family, slant=(at.sum(axis=1) - np.linalg.solve(F, f0), -2.0 * at))


def _relative_determinant(M: Array) -> float:
    return abs(M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0]) / max(float(np.abs(M).max()) ** 2, 1e-300)


def saddle_node_force(A: Array, theta: Array) -> Array:
    """Return f (k, 2) with a double zero of Theta at angles (k,), (4.12)."""
    c, s = np.cos(theta), np.sin(theta)
    n, t = np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
    An, At = n @ A.T, t @ A.T
    along = (t * At).sum(axis=-1) - (n * An).sum(axis=-1)
    return along[..., None] * n - (t * An).sum(axis=-1)[..., None] * t


def cusps(A: Array) -> list[float]:
    """Return the angles in [0, 2 pi) at which Theta has a triple zero, four or none; two where it is fourfold.

    On the curve of saddle-nodes Theta'' is what A turns, less 3 times what it shears.
    """
    turning, shear, stretch = 0.5 * (A[1, 0] - A[0, 1]), 0.5 * (A[0, 1] + A[1, 0]), 0.5 * (A[1, 1] - A[0, 0])
    return _zeros(turning, -3.0 * shear, -3.0 * stretch)


def corners(A: Array) -> list[float]:
    """Return the angles in [0, 2 pi) at which the borders touch, lambda_rho = t.A t = 0: four, two or none."""
    shear, stretch = 0.5 * (A[0, 1] + A[1, 0]), 0.5 * (A[1, 1] - A[0, 0])
    return _zeros(0.5 * (A[0, 0] + A[1, 1]), stretch, -shear)


def _zeros(mean: float, cosine: float, sine: float) -> list[float]:
    """Zeros in [0, 2 pi) of ``mean + cosine cos 2 theta + sine sin 2 theta``; two that have all but met are one."""
    size, phase = math.hypot(cosine, sine), math.atan2(sine, cosine)
    if size == 0.0 or not abs(mean) <= size * (1.0 + MEETING_SHARE):
        return []
    ratio = -mean / size
    half = 0.0 if 1.0 - ratio <= MEETING_SHARE else math.pi if 1.0 + ratio <= MEETING_SHARE else math.acos(ratio)
    ways = (1.0,) if half in (0.0, math.pi) else (1.0, -1.0)
    return sorted((0.5 * (phase + way * half) + turn) % math.tau for way in ways for turn in (0.0, math.pi))


def border_points(family: SystemFamily) -> tuple[Array, Array]:
    """Return cusps (k, 3) and corners (m, 3) of the borders of a family with `force_matrix`, as (theta, u, v)."""
    found = force_matrix(family)
    assert found is not None
    A, f0, F = found
    both = []
    for angles in (cusps(A), corners(A)):
        theta = np.array(angles)
        f = saddle_node_force(A, theta)
        both.append(np.column_stack([theta, family.units(np.asarray(np.linalg.solve(F, (f - f0).T).T, float))]))
    return both[0], both[1]


def borders(family: SystemFamily) -> tuple[Array, Array]:
    """Return both borders over the square of a family with `force_matrix`, as (theta, u, v), closed.

    Saddle-nodes of limit directions, none where these are one point; and critical sets at the equator, none where A is
    singular: there the whole of a line of them comes at once. Shapes: (m, 3) each.
    """
    found = force_matrix(family)
    assert found is not None
    A, f0, F = found

    def line(theta: Array, f: Array) -> Array:
        places = np.column_stack([theta, family.units(np.asarray(np.linalg.solve(F, (f - f0).T).T, float))])
        places[-1, 1:] = places[0, 1:]
        return places

    nothing, even = np.zeros((0, 3)), np.linspace(0.0, 2.0 * math.pi, BORDER_ANGLES)
    theta = np.unique([*even, *corners(A)])
    ellipse = line(theta, -np.stack([np.cos(theta), np.sin(theta)], axis=-1) @ A.T)
    theta = np.unique([*theta, *cusps(A)])
    f = saddle_node_force(A, theta)
    return (
        line(theta, f) if np.abs(f).max() > MIN_BORDER_SIZE * np.abs(A).max() else nothing,
        ellipse if _relative_determinant(A) > MIN_DETERMINANT else nothing,
    )
