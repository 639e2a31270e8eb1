"""Periodic motions of dry-friction oscillators in closed form: Den Hartog's, a circle, and one on a belt."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from codim2_core import System

#: q'' + q = F cos(w t) - mu q'/|q'| in one dimension, as the line y = 0; z = (q, t).
LINE = System(
    U=("-z1 - mu*c + F*cos(w*z2)", "-mu*s"), W=("x", "1"), parameters={"mu": 0.1, "F": 1.0, "w": 0.6}
)  # fmt: skip
#: The same in two, pushed along x; z = (q1, q2, t).
PLANE = System(
    U=("-z1 - mu*c + F*cos(w*z3)", "-z2 - mu*s"), W=("x", "y", "1"), parameters={"mu": 0.1, "F": 1.0, "w": 0.6}
)
#: Pushed round, with viscous friction d besides, on springs, or with k < 0 on a hilltop.
CIRCLE = System(
    U=("-k*z1 - mu*c - d*x + F*cos(w*z3)", "-k*z2 - mu*s - d*y + F*sin(w*z3)"),
    W=("x", "y", "1"),
    parameters={"mu": 0.3, "d": 0.0, "F": 0.5, "w": 2.0, "k": 1.0},
)
#: On a belt of speed v, with friction mu - k |slip|; z = (q1, q2), (x, y) = q' - (v, 0).
BELT = System(U=("-z1 - mu*c + k*x", "-z2 - mu*s + k*y"), W=("x + v", "y"), parameters={"mu": 1.0, "k": 0.1, "v": 1.0})


@dataclass(frozen=True)
class DenHartog:
    """The symmetric motion without a stop, J. P. Den Hartog, Trans. ASME 53 (1931), APM-53-9.

    From its maximum, at time 0, ``q = mu (1 - cos t - tan(pi/2w) sin t) + P cos(w t + phi)`` for half a period, with
    P = F/(1 - w^2): q'(0) = q'(pi/w) = 0 and q(pi/w) = -q(0). So ``P w sin phi = -mu tan(pi/2w)``, and the amplitude is
    P cos phi. It turns if the force there is larger than mu: w^2 P cos phi > mu.

    Near it (q, q') turns by pi/w in half a period, and where q' = 0 the rate q'' jumps from a- to a+: the multipliers
    are those of ``(diag(1, a+/a-) R(pi/w))^2``, with a+- = +-mu - w^2 P cos phi.
    """

    mu: float
    F: float
    w: float

    @property
    def P(self) -> float:
        return self.F / (1.0 - self.w**2)

    @property
    def tangent(self) -> float:
        return math.tan(0.5 * math.pi / self.w)

    @property
    def amplitude(self) -> float:
        return math.sqrt(self.P**2 - (self.mu * self.tangent / self.w) ** 2)

    def at_clock(self, time: float) -> tuple[float, float]:
        """(q', q) at a time of the forcing."""
        phi = math.atan2(-self.mu * self.tangent / (self.P * self.w), self.amplitude / self.P)
        half = math.pi / self.w
        t = (time - phi / self.w) % (2.0 * half)
        sign, t = (1.0, t) if t < half else (-1.0, t - half)
        a = self.w * t + phi
        q = self.mu * (1.0 - math.cos(t) - self.tangent * math.sin(t)) + self.P * math.cos(a)
        rate = self.mu * (math.sin(t) - self.tangent * math.cos(t)) - self.P * self.w * math.sin(a)
        return sign * rate, sign * q

    @property
    def multipliers(self) -> np.ndarray:
        angle, pull = math.pi / self.w, self.w**2 * self.amplitude
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        half = np.diag([1.0, (pull - self.mu) / (pull + self.mu)]) @ turn
        return np.linalg.eigvals(half @ half)


@dataclass(frozen=True)
class Rotating:
    """The motion r = Re(iw t) of CIRCLE on a circle, R complex.

    Friction is against the velocity iwR, of modulus a: ``(k - w^2) R + (d + mu/h) iwR = F``, where h = a in the limit
    and sqrt(a^2 + eps^2) for Psi = 1. In the turning frame r = u e^(iwt) motions next to it obey a linear equation with
    constant coefficients: ``u'' + 2iw u' + (k - w^2) u + (d + mu D)(u' + iwu) = 0`` with ``D = (1 - v v'/h^2)/h``.
    """

    mu: float
    d: float
    F: float
    w: float
    eps: float = 0.0
    k: float = 1.0

    @property
    def speed(self) -> float:
        if self.eps == 0.0 and self.d == 0.0:
            return math.sqrt(self.F**2 - self.mu**2) * abs(self.w / (self.k - self.w**2))
        drag = lambda a: self.d * a + self.mu * a / math.hypot(a, self.eps)
        short = lambda a: abs(complex((self.k - self.w**2) / self.w * a, drag(a)))
        return brentq(lambda a: short(a) - self.F, 1e-12, 1e3, xtol=1e-15, rtol=1e-15)

    @property
    def R(self) -> complex:
        pull = self.d + self.mu / math.hypot(self.speed, self.eps)
        return self.F / complex(self.k - self.w**2, pull * self.w)

    @property
    def start(self) -> tuple[float, ...]:
        v = 1j * self.w * self.R
        return (v.real, v.imag, self.R.real, self.R.imag, 0.0)

    @property
    def multipliers(self) -> np.ndarray:
        v, h = np.array(self.start[:2]), math.hypot(self.speed, self.eps)
        drag = self.d * np.eye(2) + self.mu * (np.eye(2) - np.outer(v, v) / h**2) / h
        turn = self.w * np.array([[0.0, -1.0], [1.0, 0.0]])
        matrix = np.block(
            [[np.zeros((2, 2)), np.eye(2)], [(self.w**2 - self.k) * np.eye(2) - drag @ turn, -2.0 * turn - drag]]
        )
        return np.exp(np.linalg.eigvals(matrix) * math.tau / self.w)


@dataclass(frozen=True)
class StickSlip:
    """The stick-slip motion of BELT along it.

    It sticks till q = mu; then ``u = q - (mu - k v)`` obeys u'' - k u' + u = 0 from (u, u') = (k v, v), until u' = v
    again, at the time `slips`; then it sticks for (mu - q)/v.
    """

    mu: float
    k: float
    v: float

    def slip(self, t: float) -> tuple[float, float]:
        """(q, q') at a time after it began to slip."""
        root = cmath.exp(1j * math.acos(0.5 * self.k))  # k/2 + i sqrt(1 - k^2/4)
        # u = Re(C e^(root t))
        real = self.k * self.v
        C = complex(real, (real * root.real - self.v) / root.imag)
        u = C * cmath.exp(root * t)
        return u.real + self.mu - self.k * self.v, (root * u).real

    @property
    def slips(self) -> float:
        return brentq(lambda t: self.slip(t)[1] - self.v, math.pi, math.tau, xtol=1e-14)

    @property
    def period(self) -> float:
        return self.slips + (self.mu - self.slip(self.slips)[0]) / self.v
