"""One turn about a point of the layer problem of any system, with its derivatives by place and parameter.

As `continuation.turns`, for a ray ``p = p_0 + r u`` whose foot p_0 moves with the parameter mu while u stays: both
ends of a turn lie on it. With ``F = x2'`` and ``F x v = F1 v2 - F2 v1`` a deviation obeys ``F x delta(end) =
exp(E) F x delta(0) + M``, ``E = int div dtau`` (Liouville), ``M = int exp(E(tau, end)) F x F_mu dtau`` (Melnikov).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ...cycles.periodic_orbit import STEP_NODES, gauss, path
from ...psi.function import Psi
from ...systems.frozen import FrozenSystem
from ..turn_quadratures import MAX_EXPONENT
from ..turns import RTOL, ReturnMapPoint
from .ray import Ray
from .section_base import Array, HemispherePoint


@dataclass(frozen=True)
class FiniteDifference:
    """System and Psi at two values beside one, how these differ, and how the ray moves between them."""

    low: tuple[FrozenSystem, Psi]
    high: tuple[FrozenSystem, Psi]
    width: float
    moved: Array  # d p_0/d mu
    widened: float  # d reach/d mu


@dataclass(frozen=True)
class TurnOrbit:
    """A turn and the states along it (k, 3)."""

    turn: ReturnMapPoint
    states: Array


def turn(
    ray: Ray, xi: float, value: float, beside: FiniteDifference | None, centre: HemispherePoint, backward: bool
) -> TurnOrbit | None:
    """Follow one turn from a place on a ray; None if it does not return.

    Parameters
    ----------
    ray : Ray
        At this value.
    xi, value : float
    beside : FiniteDifference, or None
        Without it no derivative by the parameter is told.
    centre : Place
        From where the amplitude is measured.
    backward : bool
        Followed backward in time, which is accurate where the cycle repels. The result is the same.
    """
    start, _ = ray.states(np.array([xi]))
    way = path(ray, start[0], RTOL, backward)
    if way is None:
        return None
    sign = -1.0 if backward else 1.0
    _, weights, matrix = gauss()
    e, D = _regularised_direction(ray.psi, np.concatenate([way.inner, start, way.end[None]]))
    F = sign * ray.field(e)
    J = ray.derivative(e[:-2]) @ D[:-2]
    rates = (sign * (J[:, 0, 0] + J[:, 1, 1]) / way.inner[:, 2]).reshape(-1, STEP_NODES)
    whole = way.h * (rates @ weights)
    exponent = float(whole.sum())
    if not abs(exponent) < MAX_EXPONENT:
        return None
    past = np.concatenate([[0.0], np.cumsum(whole)[:-1]])
    left = exponent - past[:, None] - way.h[:, None] * (rates @ matrix.T)
    growth = np.exp(np.minimum(left.ravel(), MAX_EXPONENT))
    multiplier = math.exp(exponent)

    def cross_with_change(k: int, state: Array, v: Array) -> float:
        """Cross F with the change of x2 that the change v of p makes."""
        p, h = state[:2], float(state[2])
        return float(_cross(F[k], (v + p * (p @ v) / (h * h)) / h))

    begin, end = start[0], way.end
    chi, r = 1.0 / (1.0 + math.exp(-xi)), ray.reach / (1.0 + math.exp(-xi))
    last = float((end[:2] - ray.critical.p) @ ray.u)
    rest = float(end[2]) ** 2 / (last + ray.other)
    across = cross_with_change(-1, end, ray.u)
    if not (last > 0.0 and rest > 0.0 and across != 0.0):
        return None
    steep = 1.0 / last + 1.0 / rest
    by_r = multiplier * cross_with_change(-2, begin, ray.u) / across
    by_value = math.nan
    if beside is not None:
        melnikov = float(way.weight @ (growth * _cross(sign * F[:-2], _change(way.inner, beside) / ray.rate)))
        came = multiplier * cross_with_change(-2, begin, beside.moved + chi * beside.widened * ray.u) + melnikov
        by_value = steep * (came - cross_with_change(-1, end, beside.moved)) / across - beside.widened / rest
    found = ReturnMapPoint(
        xi=xi, value=value, shift=math.log(last / rest) - xi,
        by_xi=steep * by_r * r * (1.0 - chi) - 1.0, by_value=by_value,
        exponent=sign * exponent, period=float(way.weight.sum()) / ray.rate,
        amplitude=_farthest(way.inner[:, :2], centre.p), height=float(way.inner[:, 2].min()),
        rate=chi * (1.0 - chi), drift=0.0, chi=chi, p=(float(begin[0]), float(begin[1])),
        steps=len(way.h),
    )  # fmt: skip
    return TurnOrbit(found, way.inner)


def _cross(v: Array, w: Array) -> Array:
    return v[..., 0] * w[..., 1] - v[..., 1] * w[..., 0]


def _regularised_direction(psi: Psi, states: Array) -> tuple[Array, Array]:
    """Compute e_Psi (n, 2) and its derivative by x2 (n, 2, 2) at states (n, 3)."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    radial, tangential = psi.jacobian_factors(zeta)
    along = unit[:, :, None] * unit[:, None, :]
    return unit * psi.modulus(zeta)[:, None], (
        tangential[:, None, None] * np.eye(2) + (radial - tangential)[:, None, None] * along
    )


def _change(states: Array, beside: FiniteDifference) -> Array:
    """Differentiate U(e_Psi(x2)) (n, 2) by the parameter at fixed x2."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    low, high = (at.U(unit * psi.modulus(zeta)[:, None]) for at, psi in (beside.low, beside.high))
    return (high - low) / beside.width


def _farthest(points: Array, centre: Array) -> float:
    """Return the largest distance of points of a closed curve from a point, by a parabola about it."""
    away = np.hypot(*(points - centre).T)
    i = int(away.argmax())
    before, top, after = away[i - 1], away[i], away[(i + 1) % len(away)]
    bend = before - 2.0 * top + after
    return float(top if bend >= 0.0 else top - (after - before) ** 2 / (8.0 * bend))
