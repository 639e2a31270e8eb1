"""Over the slow variables: the slow flow on a net of a plane of z, and the limit directions along one z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...results.arrays import Array
from ...systems.bounds import slow_values
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ..layer_problem.critical import critical_sets
from ..layer_problem.equator import equator_equilibria


@dataclass(frozen=True, eq=False)
class SlowPlane:
    """The slow flow on every critical set over a net of two slow variables; arrays are read-only."""

    # (k, 2) (z1, z2) of each critical set found: none where Sigma is crossed, several where sliding is not unique
    z: Array
    flow: Array  # (k, m) z' on it
    stable: NDArray[np.bool_]  # (k,) Whether the layer problem attracts to it


def slow_plane(
    system: AnySystem,
    psi: Psi,
    spans: tuple[tuple[float, float], tuple[float, float]],
    rest: ArrayLike = (),
    count: int = 15,
) -> SlowPlane:
    """Slow flow, (2.29), over a net in the plane of the first two slow variables.

    Raises ValueError: The system has fewer than two slow variables, or `rest` has not m - 2 values. Shapes: rest (m -
    2,).
    """
    if system.m < 2:
        raise ValueError(f"the system has m = {system.m} slow variable(s); a plane needs two or more.")
    others = slow_values(rest, system.m - 2)
    nets = [np.linspace(low, high, count).tolist() for low, high in spans]
    found = [(z1, z2, C) for z2 in nets[1] for z1 in nets[0] for C in critical_sets(system, psi, (z1, z2, *others))]
    z = np.array([(z1, z2) for z1, z2, _ in found]).reshape(-1, 2)
    flow = np.array([C.slow_flow for *_, C in found]).reshape(-1, system.m)
    stable = np.array([C.kind.startswith("stable") for *_, C in found], bool)
    for array in (z, flow, stable):
        array.flags.writeable = False
    return SlowPlane(z, flow, stable)


@dataclass(frozen=True, eq=False)
class DirectionsAlong:
    """Limit directions over values of one slow variable; arrays (k,) are read-only."""

    z: Array  # (k,)
    theta: Array
    lambda_rho: Array
    lambda_theta: Array


def directions_along(
    system: AnySystem, span: tuple[float, float], z: ArrayLike = (), axis: int = 0, count: int = 121
) -> DirectionsAlong:
    """Limit directions (zeros of Theta on the equator) at even values of one slow variable.

    Shapes: z (m,).
    """
    others = slow_values(z if np.size(z) else (0.0,) * system.m, system.m)
    columns: list[tuple[float, float, float, float]] = []
    for value in np.linspace(*span, count).tolist():
        found = equator_equilibria(system, (*others[:axis], value, *others[axis + 1 :]))
        columns += [(value, *row) for row in zip(found.theta, found.lambda_rho, found.lambda_theta, strict=True)]
    arrays = np.array(columns, float).reshape(-1, 4).T.copy()
    arrays.flags.writeable = False
    return DirectionsAlong(*arrays)
