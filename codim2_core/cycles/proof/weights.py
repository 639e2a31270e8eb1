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

from .fields import fields
from .flow import Flow
from .mesh import Mesh

Array = NDArray[np.float64]

ROUNDS = 12
ASKED = 0.3  # of the mean: the least that is asked for at the corners


def weights(flow: Flow, mesh: Mesh, mean: float) -> list[list[float]] | None:
    """Find g at the corners of a ring; None where no divergence of the sign of the mean is found.

    Parameters
    ----------
    flow : Flow
    mesh : Mesh
    mean : float

    Returns
    -------
    list of list of float, or None
        For each way, at each of its places.
    """
    from scipy.sparse import csr_matrix, diags_array, identity
    from scipy.sparse.linalg import spsolve

    corners = mesh.corners
    places = np.concatenate([way.places[:-1] for way in mesh.ways])
    P = places[corners]
    first, second = P[:, 1] - P[:, 0], P[:, 2] - P[:, 0]
    size = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    if not (size > 0.0).all():
        return None
    hats = np.zeros((len(corners), 3, 2))
    hats[:, 1] = np.stack([second[:, 1], -second[:, 0]], axis=1) / size[:, None]
    hats[:, 2] = np.stack([-first[:, 1], first[:, 0]], axis=1) / size[:, None]
    hats[:, 0] = -hats[:, 1] - hats[:, 2]
    F, divergence = fields(flow.psi, flow.numbers, places)
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
            cuts = np.cumsum([len(way.places) - 1 for way in mesh.ways])[:-1]
            return [[*part.tolist(), float(part[0])] for part in np.split(g, cuts)]
        counts = reached < asked
    return None
