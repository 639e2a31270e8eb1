"""The plane of a constant force, U = A e + f: its places told by the critical set, and its curves in closed form.

Over f the critical set is e = -A^-1 f, so all but saddle-nodes of limit directions happens in the disc |e| < 1. There
everything has the size 1, however narrow the ellipse |A^-1 f| = 1 is. With n = e and t across it the borders are

    saddle-nodes    f = (t.A t - n.A n) n - (t.A n) t,        critical sets at the equator    f = -A n  (sec:bifurcations).
"""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..arrays import Array
from ..numerics.root_between import root_between
from .family import SystemFamily

MIN_DETERMINANT = 1e-12  # of the square of the largest entry: a matrix with less counts as singular
BORDER_ANGLES = 361  # along each border
MIN_BORDER_SIZE = 1e-12  # of the largest entry: the curve of saddle-nodes is a point where all of it is smaller


def force_matrix(family: SystemFamily) -> tuple[Array, Array, Array] | None:
    """Return A, f0 and F of U = A e + f0 + F v over parameters v, None for any other family.

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
    return matrix, np.array(f0), forces


def disc_family(family: SystemFamily) -> SystemFamily | None:
    """Return the family over the square of its critical sets, |e1|, |e2| <= 1; None if it has no such chart."""
    found = force_matrix(family)
    if found is None:
        return None
    A, f0, F = found
    if min(_relative_determinant(A), _relative_determinant(F)) < MIN_DETERMINANT:
        return None
    at = np.linalg.solve(F, A)  # v = -F^-1 (f0 + A e), e = 2 u - 1
    return replace(family, slant=(at.sum(axis=1) - np.linalg.solve(F, f0), -2.0 * at))


def _relative_determinant(M: Array) -> float:
    return abs(M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0]) / max(float(np.abs(M).max()) ** 2, 1e-300)


def saddle_node_force(A: Array, theta: Array) -> Array:
    """Return f (k, 2) with a double zero of Theta at angles (k,), eq:tangencies."""
    c, s = np.cos(theta), np.sin(theta)
    n, t = np.stack([c, s], axis=-1), np.stack([-s, c], axis=-1)
    An, At = n @ A.T, t @ A.T
    along = (t * At).sum(axis=-1) - (n * An).sum(axis=-1)
    return along[..., None] * n - (t * An).sum(axis=-1)[..., None] * t


def cusps(A: Array) -> list[float]:
    """Return the angles in [0, 2 pi] at which Theta has a triple zero: Theta'' = 0 on the curve of saddle-nodes.

    There Theta'' is 3 t.(A + A^T) n/2 more than the average turning (A21 - A12)/2, up to its sign.
    """
    turning, shear = 0.5 * (A[1, 0] - A[0, 1]), 0.5 * (A[0, 1] + A[1, 0])

    def third(theta: float) -> float:
        c, s = math.cos(2.0 * theta), math.sin(2.0 * theta)
        return turning - 3.0 * (shear * c + 0.5 * (A[1, 1] - A[0, 0]) * s)

    grid = np.linspace(0.0, 2.0 * math.pi, BORDER_ANGLES)
    values = [third(theta) for theta in grid.tolist()]
    return [
        root_between(third, low, high, 1e-15)
        for (low, one), (high, two) in pairwise(zip(grid.tolist(), values, strict=True))
        if (one < 0.0) != (two < 0.0)
    ]


def borders(family: SystemFamily) -> tuple[Array, Array]:
    """Return both borders over the square of critical sets, as (theta, u, v): saddle-nodes, and the unit circle.

    Shapes: (m, 3) each, closed; the first one is empty where it is one point.
    """
    found = force_matrix(family)
    assert found is not None
    A = found[0]
    theta = np.linspace(0.0, 2.0 * math.pi, BORDER_ANGLES)
    circle = np.column_stack([theta, 0.5 * (1.0 + np.stack([np.cos(theta), np.sin(theta)], axis=-1))])
    circle[-1, 1:] = circle[0, 1:]
    theta = np.unique([*theta, *cusps(A)])
    f = saddle_node_force(A, theta)
    if not np.abs(f).max() > MIN_BORDER_SIZE * np.abs(A).max():
        return np.zeros((0, 3)), circle
    f[-1] = f[0]
    return np.column_stack([theta, 0.5 * (1.0 - np.linalg.solve(A, f.T).T)]), circle
