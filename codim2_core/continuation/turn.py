"""One turn of the return map of the layer problem with its exact derivatives, for the continuation of cycles.

The section is the ray ``e = e_C + r u`` of `cycles.search`, ``r = R/(1 + exp(-xi))``; all of it depends on the value
mu of the parameter that varies. With ``F = x2'``, ``D = D e_Psi`` and ``F x v = F1 v2 - F2 v1``, a deviation obeys

    F x delta(end) = exp(E) F x delta(0) + M,    E = int div dtau,    M = int exp(E(tau, end)) F x U_mu dtau

(Liouville's formula, Melnikov's integral), and both ends lie on the section: along ``t = D^-1 u`` when r changes, along
``s = D^-1 (e_C' + r u') (and Psi')`` when mu changes at fixed r. Hence ``dr(end)/dr = exp(E)`` where the map has a
fixed point, and ``dr(end)/dmu = ((exp(E) - 1) F x s + M)/(F x t)`` at fixed r.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..cycles.orbit import NODES, gauss, path
from ..cycles.section import Section
from ..layer_problem.location import Existence
from ..layer_problem.problem import LayerProblem
from ..psi.function import Psi
from ..systems.coefficients import Coefficients

Array = NDArray[np.float64]

RTOL = 1e-12  # of one turn
STEP = 1e-5  # of the differences for derivatives of coefficients: they are smooth, mostly linear
MOST_EXPONENT = 600.0
KEPT = 1024  # values whose coefficients are kept: more than those at which a span is looked at for several things
SMALLEST = 1e-280  # eigenvalue of D e_Psi

At = Callable[[float], tuple[Coefficients, Psi]]


@dataclass(frozen=True)
class Turn:
    """One turn from the section, at parameter value `value`; times in tau.

    Attributes
    ----------
    xi, value : float
        Where on the section, and the parameter's value.
    shift : float
        ``ln u.(x2 - C)`` after the turn minus before it; zero on a cycle.
    by_xi, by_value : float
        Derivatives of `shift`, at fixed value and at fixed xi.
    exponent : float
        ln of the Floquet multiplier.
    period : float
    amplitude : float
        Largest ``|p - p_C|`` on it in the projected disc.
    height : float
        Smallest ebar on it: how near to the equator it comes.
    rate : float
        d chi/d xi, where chi = y/(1 + y) is the place on the section, in [0, 1), ``y = u.(x2 - C)``.
    drift : float
        d chi/d value at fixed xi.
    chi : float
    p : (float, float)
        Where it crosses the section, in the projected disc.
    """

    xi: float
    value: float
    shift: float
    by_xi: float
    by_value: float
    exponent: float
    period: float
    amplitude: float
    height: float
    rate: float
    drift: float
    chi: float
    p: tuple[float, float]


class VariedSystem:
    """A system in which one parameter varies, and the section that goes with it.

    Parameters
    ----------
    at : callable
        value -> (Coefficients, Psi).
    scale : float
        Size of changes of the value.
    bounds : (float, float), optional
        What the parameter may be.
    """

    def __init__(self, at: At, scale: float, bounds: tuple[float, float] = (-math.inf, math.inf)) -> None:
        self.at, self.scale, self.bounds = lru_cache(maxsize=KEPT)(at), scale, bounds
        self.problem = lru_cache(maxsize=KEPT)(self._problem)
        self.ray: int | None = None

    def _problem(self, value: float) -> LayerProblem:
        """Make the layer problem at one value: what stands still in it is found once."""
        return LayerProblem(*self.at(value))

    def allows(self, value: float) -> bool:
        """Whether a, d differ in sign and C exists with det A > 0: else no theorem leaves room for cycles."""
        if not self.bounds[0] <= value <= self.bounds[1]:
            return False
        a, b, d = self.at(value)[0].plane[:3]
        if not (a * d < 0.0 and a * d + b * b > 0.0):
            return False
        location = self.problem(value).location
        return location is not None and location.existence is Existence.INSIDE

    def section(self, value: float) -> Section:
        """Make the section at one value; all sections of a family are on rays of the same signs."""
        problem = self.problem(value)
        return Section(*self.at(value), problem.critical[0], self.ray, location=problem.location)

    def turn(self, xi: float, value: float, backward: bool = False) -> Turn | None:
        """Follow one turn; None where it does not return, or where there is no section.

        Parameters
        ----------
        xi, value : float
        backward : bool
            Followed backward in time, which is accurate where the cycle repels. The result is the same.
        """
        if not self.allows(value):
            return None
        section = self.section(value)
        r = section.reach / (1.0 + math.exp(-xi))
        rest = section.reach / (1.0 + math.exp(xi))
        gap = rest * (r + section.other)
        e = section.e + r * section.u
        modulus = min(math.hypot(*e.tolist()), 1.0)
        zeta = float(section.psi.radius(modulus, min(max(gap, 1e-300), 1.0)))
        x2 = zeta / max(modulus, 1e-300) * e
        start = np.array([*x2.tolist(), 1.0]) / math.hypot(1.0, zeta)
        way = path(section, start, RTOL, backward)
        if way is None:
            return None
        outermost = max(zeta, math.hypot(way.end[0], way.end[1]) / way.end[2])
        if section.psi.jacobian_factors(float(outermost))[0] < SMALLEST:
            return None  # the section has no room left before the equator
        derivative = self._derivative(value, section)
        F, U_mu, divergence = _along(section, np.concatenate([way.inner, [start, way.end]]), derivative)
        first = _Place(section, derivative, x2, r)
        last = _Place(section, derivative, way.end[:2] / way.end[2], float(np.hypot(*(F[-1] @ section.inverse))))
        if first.y <= 0.0 or last.y <= 0.0:
            return None
        sign = -1.0 if backward else 1.0
        exponent = float(sign * way.weight @ divergence[:-2])
        if abs(exponent) > MOST_EXPONENT:
            return None
        later = exponent - _accumulated(way.h, sign * divergence[:-2] / way.inner[:, 2])
        cross = F[:, 0] * U_mu[:, 1] - F[:, 1] * U_mu[:, 0]
        melnikov = float((way.weight * np.exp(np.minimum(later, MOST_EXPONENT))) @ cross[:-2])
        (F0, F1), multiplier = sign * F[-2:], math.exp(exponent)
        by_r = r * rest / section.reach  # dr/dxi
        q_xi, across = first.rise * by_r, _cross(F1, last.t)
        # the start moves along s_0 with mu: xi is fixed there, and so is 1 - |e|^2 but for its factors
        share = derivative.reach / section.reach
        turned = derivative.centre + r * (derivative.u + share * section.u)
        widened = gap * (share + (r * share + derivative.other) / (r + section.other))
        s_0 = first.moved(-0.5 * widened / modulus, turned)
        q_0 = (float(section.u @ s_0) + first.still) / first.y
        end = multiplier * _cross(F0, s_0) + melnikov - _cross(F1, last.level())
        size = way.inner[:, :2] - section.critical.p
        return Turn(
            xi=xi,
            value=value,
            shift=math.log(last.y / first.y),
            by_xi=last.rise * multiplier * _cross(F0, first.t) * by_r / across - q_xi,
            by_value=last.rise * end / across - q_0,
            exponent=sign * exponent,
            period=float(way.weight.sum()) / section.rate,
            amplitude=_largest(np.hypot(size[:, 0], size[:, 1])),
            height=float(way.inner[:, 2].min()),
            rate=q_xi * first.y / (1.0 + first.y) ** 2,
            drift=q_0 * first.y / (1.0 + first.y) ** 2,
            chi=first.y / (1.0 + first.y),
            p=(float(start[0]), float(start[1])),
        )

    def _derivative(self, value: float, section: Section) -> _Derivative:
        """Differentiate what depends on the parameter, in units of the section's rate of time."""
        h = STEP * self.scale
        before, after = max(value - h, self.bounds[0]), min(value + h, self.bounds[1])
        width = after - before
        (low, psi_low), (high, psi_high) = self.at(before), self.at(after)
        plane = (np.array(high.plane) - np.array(low.plane)) / (width * section.rate)

        def modulus(zeta: Array) -> Array:
            # by 1 - |e|^2, which keeps its digits where |e| is all but 1
            change = (psi_high.complement(zeta) - psi_low.complement(zeta)) / width
            return -0.5 * change / np.maximum(section.psi.modulus(zeta), 1e-300)

        return _Derivative(plane, *_ray_moves(section, plane), None if psi_low is psi_high else modulus)


@dataclass(frozen=True)
class _Derivative:
    """d/dmu of (a, b, d, f1, f2), of e_C, reach, other and u of `rays`, and of |e_Psi| at given zeta."""

    plane: Array
    centre: Array
    reach: float
    other: float
    u: Array
    modulus: Callable[[Array], Array] | None


class _Place:
    """A point x2 of the section, ``e = e_C + r u``, in the frame along and across x2.

    Far out ``dx2/dr`` and dx2/dmu at fixed r are huge, both along x2, while orbits see only small differences of them.
    """

    def __init__(self, section: Section, derivative: _Derivative, x2: Array, r: float) -> None:
        self.derivative, self.u, self.r = derivative, section.u, r
        zeta = math.hypot(*x2.tolist())
        self.radial, self.tangential = section.psi.jacobian_factors(zeta)
        self.unit = x2 / zeta if zeta > 0.0 else np.array([1.0, 0.0])
        self.swelling = 0.0  # d|e|/dmu at fixed x2
        if derivative.modulus is not None:
            self.swelling = float(derivative.modulus(np.array([zeta]))[0])
        self.y = self.still = 0.0
        if r > 0.0:
            away = x2 - section.critical.x2
            self.y = float(section.u @ away)
            self.t = self.lifted(float(self.unit @ section.u), section.u)  # dx2/dr
            self.rise = float(section.u @ self.t) / self.y  # d ln y/dr
            centre = _Place(section, derivative, section.critical.x2, 0.0)
            moved = centre.moved(float(centre.unit @ derivative.centre), derivative.centre)
            self.still = float(derivative.u @ away) - float(section.u @ moved)  # dy/dmu at fixed x2

    def lifted(self, along: float, v: Array) -> Array:
        """Find dx2 for a change v of e whose part along x2 is given apart, so that it keeps its digits."""
        across = _cross(self.unit, v) / self.tangential
        return along / self.radial * self.unit + across * np.array([-self.unit[1], self.unit[0]])

    def moved(self, along: float, v: Array) -> Array:
        """Find dx2/dmu for a change v of e."""
        return self.lifted(along - self.swelling, v)

    def level(self) -> Array:
        """Find dx2/dmu on the section at fixed y."""
        v = self.derivative.centre + self.r * self.derivative.u
        vr, vp = float(self.unit @ v) - self.swelling, _cross(self.unit, v)
        ur, up = float(self.unit @ self.u), _cross(self.unit, self.u)
        size = ur * ur + self.radial / self.tangential * up * up
        twist = (vr * up - vp * ur) / self.tangential
        along = (twist * up - self.still * ur) / size
        across = -(twist * ur + self.radial / self.tangential * self.still * up) / size
        return along * self.unit + across * np.array([-self.unit[1], self.unit[0]])


def _cross(v: Array, w: Array) -> float:
    return float(v[0] * w[1] - v[1] * w[0])


def _ray_moves(section: Section, plane: Array) -> tuple[Array, float, float, Array]:
    """Differentiate e_C, reach, other and u, given those of (a, b, d, f1, f2)."""
    da, db, dd, d1, d2 = plane.tolist()
    a, _, d = section.plane[:3].tolist()
    e, u, R, S = section.e, section.u, section.reach, section.other
    centre = -(np.array([[da, -db], [db, dd]]) @ e + (d1, d2)) @ section.inverse
    angle = 0.5 * (da / a - dd / d) * float(u[0] * u[1])
    turned = angle * np.array([-u[1], u[0]])
    here, there = e + R * u, e - S * u  # both on the equator
    reach = -float(here @ (centre + R * turned)) / float(here @ u)
    other = float(there @ (centre - S * turned)) / float(there @ u)
    return centre, reach, other, turned


def _along(section: Section, states: Array, derivative: _Derivative) -> tuple[Array, Array, Array]:
    """``F = x2'`` (n, 2), U_mu (n, 2) and the divergence (n,) at states (n, 3), per tau."""
    x2 = states[:, :2] / states[:, 2:]
    zeta = np.hypot(x2[:, 0], x2[:, 1])
    unit = x2 / np.maximum(zeta, 1e-300)[:, None]
    radial, tangential = section.psi.jacobian_factors(zeta)
    a, _, d = section.plane[:3].tolist()
    divergence = tangential * (a + d) + (radial - tangential) * (a * unit[:, 0] ** 2 + d * unit[:, 1] ** 2)
    e = unit * section.psi.modulus(zeta)[:, None]
    A = section.matrix
    F = (e - section.e) @ A.T
    da, db, dd, d1, d2 = derivative.plane.tolist()
    U_mu = e @ np.array([[da, db], [-db, dd]]) + (d1, d2)
    if derivative.modulus is not None:
        U_mu = U_mu + derivative.modulus(zeta)[:, None] * (unit @ A.T)
    return F, U_mu, divergence


def _accumulated(h: Array, rate: Array) -> Array:
    """Integral (n,) over T up to each node of `rate` (n,), given per T at the nodes."""
    _, weights, matrix = gauss()
    steps = rate.reshape(-1, NODES)
    before = np.concatenate([[0.0], np.cumsum(h * (steps @ weights))[:-1]])
    return (before[:, None] + h[:, None] * (steps @ matrix.T)).ravel()


def _largest(values: Array) -> float:
    """Largest of values along a closed line, by a parabola through its three neighbours."""
    i = int(np.argmax(values))
    before, top, after = values[i - 1], values[i], values[(i + 1) % len(values)]
    bend = before - 2.0 * top + after
    return float(top if bend >= 0.0 else top - (after - before) ** 2 / (8.0 * bend))
