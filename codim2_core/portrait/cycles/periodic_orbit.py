"""A limit cycle as an orbit: period, multiplier and means, by Gauss quadrature on the steps of one return.

The states at the Gauss nodes of each step are computed by steps of their own from its start, so they are as accurate
as the integration; the quadrature has order 2 STEP_NODES in each step. The multiplier comes from the collocation
method of the same order for ``Y' = J(tau) Y``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ...results.arrays import Array
from .ray_section import FINE_RTOL, FixedPoint, TurnSection

STEP_NODES = 6
MOST_STEPS = 8000
CLOSURE_DISTANCE, MORE_TURNS = 2e-14, 2  # on the sphere; turns after the first one to come so near
MIN_MULTIPLIER = 1e-300  # multiplier of a relaxation cycle: one that repels more strongly is reported with its inverse


@dataclass(frozen=True)
class Orbit:
    """One closed orbit, see `limit_cycles.LimitCycle`; `divergence` is the integral of the divergence over tau.

    A mean over the period is ``share @ values(e)``: `e` (n, 2) at the nodes, `share` (n,) of the period at each.
    """

    points: Array
    period: float
    period_T: float
    multiplier: float
    divergence: float
    mean_e: Array
    closure: float
    e: Array
    share: Array


@lru_cache(maxsize=2)
def gauss(count: int = STEP_NODES) -> tuple[Array, Array, Array]:
    """Nodes, weights on [0, 1] and the collocation matrix ``a_ij``, the integral of l_j from 0 to c_i."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    c, w = 0.5 * (nodes + 1.0), 0.5 * weights
    powers = np.arange(count)
    vandermonde = nodes[:, None] ** powers
    integrals = (nodes[:, None] ** (powers + 1) - (-1.0) ** (powers + 1)) / (powers + 1)
    return c, w, 0.5 * integrals @ np.linalg.inv(vandermonde)


@dataclass(frozen=True)
class TurnQuadrature:
    """One return as nodes of a quadrature; k steps with STEP_NODES nodes each, scaled coefficients; its own time."""

    first: Array  # (k, 3) States where steps start
    h: Array  # (k,) Lengths of the steps in T
    inner: Array  # (k NODES, 3) States at the nodes
    weight: Array  # (k NODES,) Quadrature weights of tau
    end: Array  # (3,) The state on return
    time: float  # t of the return


def path(section: TurnSection, start: Array, rtol: float, backward: bool) -> TurnQuadrature | None:
    """Follow one return from a state (3,) of the section; None if MOST_STEPS steps do not bring it round."""
    from .ray_section_kernel import RETURNED, single_step

    ends, times, codes, steps = section.turn(start[None, :], rtol, backward, MOST_STEPS, MOST_STEPS)
    if codes[0] != RETURNED:
        return None
    first, h = np.ascontiguousarray(steps[:, :3]), np.ascontiguousarray(steps[:, 3])
    nodes, weights, _ = gauss(STEP_NODES)
    _, function = section.kernel
    places = np.repeat(first, STEP_NODES, axis=0)
    inner = single_step(places, np.outer(h, nodes).ravel(), section.field_parameters(backward), function.address)
    return TurnQuadrature(first, h, inner, np.outer(h, weights).ravel() / inner[:, 2], ends[0], float(times[0]))


def linearisation(section: TurnSection, states: Array) -> tuple[Array, Array]:
    """Compute e (n, 2) and ``D_e U D e_Psi`` (n, 2, 2) in kappa_2, for the scaled field."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    radial, tangential = section.psi.jacobian_factors(zeta)
    D = tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * (
        unit[:, :, None] * unit[:, None, :]
    )
    e = unit * section.psi.modulus(zeta)[:, None]
    return e, section.derivative(e) @ D


def _normal_growth(J: Array, h: Array, across: Array) -> float:
    """Growth over all steps of a deviation across the orbit.

    J (k, NODES, 2, 2) is already times dtau/dT, h (k,) in T, `across` (k, 2) the unit normals where steps start. The
    flow direction is carried into itself, so in frames along and across the orbit the fundamental matrix of each step
    is triangular, and the multiplier is the product of its entries across: to full relative accuracy.
    """
    _, weights, matrix = gauss(STEP_NODES)
    k, size = len(h), 2 * STEP_NODES
    # Stage slopes K_i solve K_i = J_i (1 + h sum_j a_ij K_j).
    coupling = h[:, None, None, None, None] * J[:, :, :, None, :] * matrix[None, :, None, :, None]
    left = np.eye(size) - coupling.reshape(k, size, size)
    first = (J @ across[:, None, :, None]).reshape(k, size, 1)
    slopes = np.linalg.solve(left, first).reshape(k, STEP_NODES, 2)
    after = across + h[:, None] * np.einsum("i,kim->km", weights, slopes)
    return float(np.prod(np.sum(np.roll(across, -1, axis=0) * after, axis=1)))


def orbit(section: TurnSection, crossing: FixedPoint) -> Orbit | None:
    """Follow the cycle through a fixed point of the return map once round; None where MOST_STEPS do not suffice."""
    start, _ = section.states(np.array([crossing.xi]))
    backward = crossing.repelling  # so that errors fade
    sign = -1.0 if backward else 1.0
    begin = start[0]
    way = path(section, begin, FINE_RTOL, backward)
    for _ in range(MORE_TURNS):
        if way is None or math.dist(way.end, begin) <= CLOSURE_DISTANCE:
            break
        # The way it is followed the orbit attracts: once more round, from where it came.
        begin = way.end
        way = path(section, begin, FINE_RTOL, backward)
    if way is None:
        return None
    first, h, inner, weight = way.first, way.h, way.inner, way.weight
    k = len(first)
    every, everywhere = linearisation(section, np.concatenate([first, inner]))
    e, J = every[k:], everywhere[k:]
    per_T = 1.0 / inner[:, 2]  # dtau/dT
    period = float(weight.sum())
    mean_e = (weight @ e) / period
    divergence = float(weight @ (J[:, 0, 0] + J[:, 1, 1]))
    velocity = section.field(every[:k])
    across = velocity[:, ::-1] * (-1.0, 1.0) / np.linalg.norm(velocity, axis=1)[:, None]
    multiplier = _normal_growth((sign * J * per_T[:, None, None]).reshape(-1, STEP_NODES, 2, 2), h, across)
    if backward:
        multiplier = 1.0 / max(multiplier, MIN_MULTIPLIER)
    line = np.concatenate([first[:, None, :], inner.reshape(-1, STEP_NODES, 3)], axis=1).reshape(-1, 3)[:, :2]
    closed, share = np.concatenate([line, line[:1]])[:: int(sign)].copy(), weight / period
    for array in (closed, mean_e, e, share):
        array.flags.writeable = False
    return Orbit(
        closed,
        period / section.rate,
        way.time / section.rate,
        multiplier,
        divergence,
        mean_e,
        math.dist(way.end, begin),
        e,
        share,
    )
