"""A triangulated ring between closed ways, and weights on it under which the divergence has one sign: Dulac's function.

``div(exp(g) F) = exp(g) (div F + F.grad g)`` for ``F = q U``, the velocity with time changed by q > 0. With g linear on
each triangle the second factor is linear in what g is at the corners, and one that makes it nearly constant is found by
least squares, in which only corners count where it is not yet what is asked for. On a hyperbolic cycle the constant is
its mean: ln multiplier by the period.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...psi.kernel import VECTOR
from .flow import Flow, Place

Array = NDArray[np.float64]

ROUNDS = 12
ASKED = 0.3  # of the mean: the least that is asked for at the corners
VARIES = 0.5  # of the mean: by how much the divergence may vary along an edge


def fields(flow: Flow, places: Array) -> tuple[Array, Array]:
    """Return F (n, 2) and its divergence (n,) at x2 (n, 2)."""
    a, b, c, d, f, g = flow.numbers
    s = (places**2).sum(axis=1)
    kernel = flow.psi.kernel
    with np.errstate(all="ignore"):
        value, slope = kernel.value(VECTOR, s), kernel.slope(VECTOR, s)
    q = np.sqrt(s + value)
    e = places / q[:, None]
    U = np.stack([a * e[:, 0] + b * e[:, 1] + f, c * e[:, 0] + d * e[:, 1] + g], axis=1)
    return q[:, None] * U, a + d + (1.0 + slope) * (e @ (f, g))


def mean_divergence(flow: Flow, places: list[Place]) -> float:
    """Return the mean of div F over a closed orbit, in the time of F."""
    P = np.array(places)
    step = np.hypot(*np.diff(P, axis=0).T)
    F, divergence = fields(flow, 0.5 * (P[1:] + P[:-1]))
    time = step / np.hypot(*F.T)
    return float(divergence @ time / time.sum())


def refined(flow: Flow, places: list[Place], varies: float) -> list[Place]:
    """Add places to the straight edges of a closed way until the divergence varies little along each."""
    P = np.array(places)
    _, divergence = fields(flow, P)
    parts = np.maximum(np.ceil(np.abs(np.diff(divergence)) / varies), 1).astype(int).tolist()
    found = []
    for (x, y), (X, Y), count in zip(places[:-1], places[1:], parts, strict=True):
        found += [(x + (X - x) * k / count, y + (Y - y) * k / count) for k in range(count)]
    return [*found, places[0]]


def zipped(near: list[Place], far: list[Place]) -> tuple[list[int], list[int]]:
    """Return indices of equal number into two closed ways: one of the two goes on at a time, along the shorter way."""
    i, j, first, second = 0, 0, [0], [0]
    while i < len(near) - 1 or j < len(far) - 1:
        outer = i == len(near) - 1 or (
            j < len(far) - 1 and math.dist(near[i], far[j + 1]) <= math.dist(near[i + 1], far[j])
        )
        i, j = (i, j + 1) if outer else (i + 1, j)
        first.append(i)
        second.append(j)
    return first, second


def triangles(ways: list[list[Place]]) -> tuple[Array, NDArray[np.intp]]:
    """Return places (n, 2) and triangles (t, 3) between neighbouring closed ways."""
    starts = np.cumsum([0] + [len(way) - 1 for way in ways]).tolist()
    found = []
    for near, far, start, then in zip(ways, ways[1:], starts, starts[1:], strict=False):
        first, second = zipped(near, far)
        i, j = start + np.array(first) % (len(near) - 1), then + np.array(second) % (len(far) - 1)
        outer = np.diff(second) == 1
        third = np.where(outer, j[1:], i[1:])
        found.append(np.stack([i[:-1], j[:-1], third], axis=1))
    return np.array([place for way in ways for place in way[:-1]]), np.concatenate(found)


def weights(flow: Flow, ways: list[list[Place]], mean: float) -> list[list[float]] | None:
    """Find g at the corners of a ring; None where no divergence of the sign of the mean is found, or none is asked for.

    Parameters
    ----------
    flow : Flow
    ways : list of closed ways
        From the inner one to the outer one.
    mean : float
    """
    from scipy.sparse import csr_matrix, diags_array, identity
    from scipy.sparse.linalg import spsolve

    places, corners = triangles(ways)
    P = places[corners]
    first, second = P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]
    size = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    if not (size > 0.0).all():
        return None
    hats = np.zeros((len(corners), 3, 2))
    hats[:, 1] = np.stack([second[:, 1], -second[:, 0]], axis=1) / size[:, None]
    hats[:, 2] = np.stack([-first[:, 1], first[:, 0]], axis=1) / size[:, None]
    hats[:, 0] = -hats[:, 1] - hats[:, 2]
    F, divergence = fields(flow, places)
    sign, asked = math.copysign(1.0, mean), abs(mean)
    values = sign * np.einsum("tkx,tvx->tvk", hats, F[corners]).reshape(-1, 3)
    rows = np.repeat(np.arange(3 * len(corners)), 3)
    columns = np.repeat(corners, 3, axis=0).ravel()
    matrix = csr_matrix((values.ravel(), (rows, columns)), shape=(3 * len(corners), len(places)))
    given = sign * divergence[corners].ravel()
    counts = np.ones(len(given), bool)
    for _ in range(ROUNDS):
        share = diags_array(np.where(counts, 1.0, 1e-3))
        normal = matrix.T @ share @ matrix + 1e-8 * identity(len(places))
        g = np.asarray(spsolve(normal.tocsc(), matrix.T @ (share @ (asked - given))))
        reached = given + matrix @ g
        if reached.min() > ASKED * asked:
            cuts = np.cumsum([len(way) - 1 for way in ways])[:-1]
            return [[*part.tolist(), float(part[0])] for part in np.split(g, cuts)]
        counts = reached < asked
    return None
