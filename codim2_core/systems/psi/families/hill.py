"""Psi = 3/(3 + (4s)^n), the family of case III, Figure 17."""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import expm1, log
from typing import Any

import numpy as np

from ..condition import Condition
from .record import UNDERFLOW_BOUND, VECTOR, Array, Family, Kernel, Parameter

SQRT3 = math.sqrt(3.0)
LN3 = math.log(3.0)


@dataclass(frozen=True)
class Hill(Kernel):
    """Psi = 3/(3 + (4s)^n), the family of case III."""

    n: float = 1.0

    def value(self, lib: Any, s: Any) -> Any:
        return 3.0 / (3.0 + lib.power(4.0 * s, self.n))

    def slope(self, lib: Any, s: Any) -> Any:
        # from either side of 4s = 1, so that nothing overflows
        n, x = self.n, 4.0 * s
        low = lib.minimum(x, 1.0)
        h = lib.power(low, n)
        if n < 1.0:  # noqa: SIM108 (n - 1 has rounded, which a small s would magnify)
            rate = lib.where(low > 0.0, h / lib.maximum(low, 5e-324), math.inf)
        else:
            rate = lib.power(low, n - 1.0)
        below = -12.0 * n * rate / ((3.0 + h) * (3.0 + h))
        high = lib.maximum(x, 1.0)
        p = lib.power(1.0 / high, n)
        u = 1.0 + 3.0 * p
        above = -12.0 * n * p / high / (u * u)
        return lib.where(x <= 1.0, below, above)

    def root(self, lib: Any, zeta: Any) -> Any:
        return 1.0 / lib.hypot(1.0, lib.power(2.0 * zeta, self.n) / SQRT3)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        return self.root_and_kappa(lib, zeta)[1]

    def root_and_kappa(self, lib: Any, zeta: Any) -> tuple[Any, Any]:
        u = lib.power(2.0 * zeta, self.n) / SQRT3
        v = u / lib.hypot(1.0, lib.minimum(u, 1e160))
        return 1.0 / lib.hypot(1.0, u), self.n * lib.minimum(v * v, 1.0)

    def inverse(self, lib: Any, w: Any) -> Any:
        n = self.n
        if isinstance(n, float) and n == 1.0:  # s (1 + 4s/3) = w^2; `sweep` gives an array of n
            return w * lib.sqrt(2.0 / (1.0 + lib.hypot(1.0, 4.0 / SQRT3 * w)))
        # x + n ln(1 + e^x) = X for x = ln((4s)^n/3), X = ln((4 w^2)^n/3): convex, slope at least 1
        X = 2.0 * n * lib.log(lib.maximum(2.0 * w, UNDERFLOW_BOUND)) - LN3
        log_y = lib.log(n * math.log(2.0)) + X  # as ln(1 + e^x) >= ln(2) e^x for x <= 0
        L = lib.where(log_y > 30.0, log_y, lib.log1p(lib.exp(lib.minimum(log_y, 30.0))))
        guess = X - L * (1.0 - lib.log1p(L) / (2.0 + L))
        x = lib.where(guess < 0.0, guess, lib.maximum(X / (1.0 + n), 0.0))
        for _ in range(3):  # Halley's steps: 0.7 off at most to begin with, then 0.05, 1e-5, rounding
            E = lib.exp(lib.minimum(x, 709.0))
            logistic = E / (1.0 + E)
            slope = 1.0 + n * logistic
            ratio = (x + n * lib.log1p(E) - X) / slope
            x = x - ratio / (1.0 - 0.5 * ratio * (slope - 1.0) / (slope * (1.0 + E)))
        # ln zeta = ln w - ln(1 + e^x)/2 where e^x is small, ln zeta = (x + ln 3)/(2n) - ln 2 where it is not
        small = lib.minimum(x, 0.0)
        zeta = lib.where(
            x < 0.0,
            w * lib.exp(-0.5 * lib.log1p(lib.exp(small))),
            0.5 * lib.exp((lib.maximum(x, 0.0) + LN3) / (2.0 * n)),
        )
        return self.polish(lib, zeta, w)


def derivatives(s: Array, n: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi = 1/(1 + v), v = (4s)^n/3, by s dPsi/ds = -n Psi Q, Q = 1 - Psi.

    With ``R_jk = Q^j/s^k``, of which each is a power where s is small, and not a difference of what is nearly equal.
    """
    P = np.asarray(Hill(n=n).value(VECTOR, s))
    x = np.minimum(4.0 * s, 1.0)

    def R(j: int, k: int) -> Array:
        near = 4.0**k * (P / 3.0) ** j * np.power(x, j * n - k)
        return np.where(4.0 * s < 1.0, near, (1.0 - P) ** j / np.maximum(s, 0.25) ** k)

    def times(coefficient: float, j: int, k: int) -> Array | float:
        return coefficient * R(j, k) if coefficient else 0.0

    with np.errstate(divide="ignore", invalid="ignore"):  # at s = 0 some are infinite
        second = times(1.0 - n, 1, 2) + 2.0 * n * R(2, 2)
        third = times((n - 1.0) * (n - 2.0), 1, 3) - times(6.0 * n * (n - 1.0), 2, 3) + 6.0 * n * n * R(3, 3)
        return -n * P * R(1, 1), n * P * second, -n * P * third


def gain(r2, w, n):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    w2 = w * w
    power = n * log(max(min(4.0 * r2 / max(w2, UNDERFLOW_BOUND), 1e300), UNDERFLOW_BOUND))
    return 1.0 / math.sqrt(max(r2 + 3.0 * w2 / (4.0 + expm1(max(min(power, 700.0), -700.0))), UNDERFLOW_BOUND))


def gain_whole(r2, w, n):
    """Do the same for a whole n up to 255 (eight bits), the power by squaring; infinity is a good power."""
    w2 = w * w
    base = 4.0 * r2 / max(w2, UNDERFLOW_BOUND)
    power = 1.0
    for bit in range(8):
        power = power * base if (n >> bit) & 1 else power
        base = base * base
    return 1.0 / math.sqrt(max(r2 + 3.0 * w2 / (3.0 + power), UNDERFLOW_BOUND))


def failed_conditions(n: float, text: str) -> tuple[Condition, ...]:
    """Return those of R1 to R5 that fail: Psi is smooth at s = 0 and s = inf for whole n only."""
    if float(n).is_integer():
        return ()
    k = math.ceil(n)
    return (
        Condition(
            "R1", False, 0.0,
            f"Ψ = {text} is not smooth at s = 0: s^{n:g} has no finite derivative of order {k} there. "
            "Smooth for whole n only; it is used all the same.",
        ),
        Condition(
            "R5", False, math.inf,
            f"Ψ(1/s) tends to 0 as s^{n:g}, which has no finite derivative of order {k} at s = 0. "
            "Smooth for whole n only.",
        ),
    )  # fmt: skip


HILL = Family(
    name="hill", title="3/(3 + (4s)ⁿ)", formula="3/(3+(4*s)**n)", kernel=Hill, batched=True,
    gain=gain, gain_whole=gain_whole, derivatives=derivatives, broken=failed_conditions,
    parameter=Parameter("n", 1e-2, 1000.0, shown=(0.5, 6.0), default=2.0, note="the paper uses 1 to 4"),
    compared=(1.0, 2.0, 3.0, 4.0),
)  # fmt: skip
