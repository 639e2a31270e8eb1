"""The arithmetic of the built-in families of Psi, def:Psi, for one float or for arrays.

Everything about ``|e_Psi|`` is written in zeta with two functions that neither overflow nor cancel,

    root(zeta) = sqrt(Psi(zeta^2)),    kappa(zeta) = -s Psi'(s)/Psi(s) at s = zeta^2,

because then, with ``w = zeta/root`` (the tangent of the angle whose sine is ``|e_Psi|``),

    |e_Psi| = zeta/hypot(zeta, root),    1 - |e_Psi|^2 = (root/hypot)^2,    d ln w/d ln zeta = 1 + kappa,

and R4 says kappa >= 0, so that ``ln w`` as a function of ``ln zeta`` has slope at least 1 and is inverted safely.
"""

# ruff: noqa: D102, ARG002 (every family offers the methods of `Kernel`, which documents them, with one signature)
from __future__ import annotations

import math
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np

SQRT3 = math.sqrt(3.0)
LN3 = math.log(3.0)
TINY = 1e-300


def _power(base: float, exponent: float) -> float:
    try:
        return math.pow(base, exponent)
    except (OverflowError, ValueError):  # ValueError: 0 to a negative power
        return math.inf


def _scalar_log(x: float) -> float:
    return math.log(x) if x > 0.0 else -math.inf


# One formula serves floats (math.* is ten times faster there) and arrays.
SCALAR = SimpleNamespace(
    exp=math.exp, expm1=math.expm1, log=_scalar_log, log1p=math.log1p, sqrt=math.sqrt, asinh=math.asinh,
    hypot=math.hypot, power=_power, minimum=min, maximum=max, all=bool,
    where=lambda condition, yes, no: yes if condition else no,
)  # fmt: skip
VECTOR = SimpleNamespace(
    exp=np.exp, expm1=np.expm1, log=np.log, log1p=np.log1p, sqrt=np.sqrt, asinh=np.arcsinh,
    hypot=np.hypot, power=np.power, minimum=np.minimum, maximum=np.maximum, where=np.where, all=np.all,
)  # fmt: skip


class Kernel:
    """What a family must offer; `lib` is `SCALAR` or `VECTOR`, called inside ``np.errstate(all="ignore")``."""

    limit: float = 0.0  # Psi_1(0), R5

    def value(self, lib: Any, s: Any) -> Any:
        """Psi(s)."""
        raise NotImplementedError

    def slope(self, lib: Any, s: Any) -> Any:
        """Psi'(s)."""
        raise NotImplementedError

    def root(self, lib: Any, zeta: Any) -> Any:
        """sqrt(Psi(zeta^2))."""
        raise NotImplementedError

    def kappa(self, lib: Any, zeta: Any) -> Any:
        """-s Psi'(s)/Psi(s) at s = zeta^2."""
        raise NotImplementedError

    def inverse(self, lib: Any, w: Any) -> Any:
        """Find the zeta with ``zeta/root(zeta) = w``."""
        raise NotImplementedError

    def polish(self, lib: Any, zeta: Any, w: Any) -> Any:
        """One Newton step on ``zeta/(w root) = 1`` for d ln zeta: relative accuracy down to the smallest zeta."""
        return zeta * (1.0 - (zeta / (w * self.root(lib, zeta)) - 1.0) / (1.0 + self.kappa(lib, zeta)))


@dataclass(frozen=True)
class Constant(Kernel):
    """Psi = 1: e_Psi is the projection of the hemisphere itself."""

    limit: float = 1.0

    def value(self, lib: Any, s: Any) -> Any:
        return 0.0 * lib.minimum(s, 0.0) + 1.0

    def slope(self, lib: Any, s: Any) -> Any:
        return 0.0 * lib.minimum(s, 0.0)

    def root(self, lib: Any, zeta: Any) -> Any:
        return 0.0 * zeta + 1.0

    def kappa(self, lib: Any, zeta: Any) -> Any:
        return 0.0 * zeta

    def inverse(self, lib: Any, w: Any) -> Any:
        return w


@dataclass(frozen=True)
class Rational(Kernel):
    """Psi = 1/(1+s)."""

    def value(self, lib: Any, s: Any) -> Any:
        return 1.0 / (1.0 + s)

    def slope(self, lib: Any, s: Any) -> Any:
        u = 1.0 / (1.0 + s)
        return -u * u

    def root(self, lib: Any, zeta: Any) -> Any:
        return 1.0 / lib.hypot(1.0, zeta)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        u = zeta / lib.hypot(1.0, zeta)
        return u * u

    def inverse(self, lib: Any, w: Any) -> Any:
        # s (1 + s) = w^2
        return w * lib.sqrt(2.0 / (1.0 + lib.hypot(1.0, 2.0 * w)))


@dataclass(frozen=True)
class Exponential(Kernel):
    """Psi = exp(-s): s = W(w^2), Lambert's function."""

    def value(self, lib: Any, s: Any) -> Any:
        return lib.exp(-s)

    def slope(self, lib: Any, s: Any) -> Any:
        return -lib.exp(-s)

    def root(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e3)  # exp(-z^2/2) is 0 from 39 on
        return lib.exp(-0.5 * z * z)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e150)
        return z * z

    def inverse(self, lib: Any, w: Any) -> Any:
        log_w = lib.log(lib.maximum(w, 1e-140))  # for smaller w only `w` itself is used, below
        log_q = 2.0 * log_w
        # ln(1 + q), without forming q = w^2 where it would overflow
        L = lib.where(log_q > 600.0, log_q, lib.log1p(lib.exp(lib.minimum(log_q, 600.0))))
        s = lib.maximum(L * (1.0 - lib.log1p(L) / (2.0 + L)), TINY)  # Winitzki's guess, within 2 %
        for _ in range(2):  # Newton on s + ln s = ln q
            s = s / (1.0 + s) * (1.0 + log_q - lib.log(s))
        # small s: the rounding of ln q is as large as s, and zeta = w exp(-s/2) needs s only roughly
        zeta = lib.where(s > 0.05, lib.sqrt(lib.maximum(s, 0.0)), w * (1.0 - 0.5 * lib.minimum(s, 0.1)))
        return self.polish(lib, self.polish(lib, zeta, w), w)


@dataclass(frozen=True)
class Tanh(Kernel):
    """Psi = s/sinh(sqrt s)^2: |e_Psi| = tanh(zeta)."""

    def value(self, lib: Any, s: Any) -> Any:
        u = self.root(lib, lib.sqrt(s))
        return u * u

    def slope(self, lib: Any, s: Any) -> Any:
        s = lib.minimum(s, 1e9)  # exp(-2 sqrt s) is 0 long before
        return -self.value(lib, s) * self._kappa_over_s(lib, s)

    def root(self, lib: Any, zeta: Any) -> Any:
        # zeta/sinh(zeta) by expm1, which neither cancels at 0 nor overflows
        z = lib.maximum(lib.minimum(zeta, 1e4), TINY)
        return 2.0 * z * lib.exp(-z) / -lib.expm1(-2.0 * z)

    def kappa(self, lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e150)
        return z * z * self._kappa_over_s(lib, z * z)

    @staticmethod
    def _kappa_over_s(lib: Any, s: Any) -> Any:
        """(zeta coth zeta - 1)/zeta^2: Lambert's continued fraction (no cancellation) for s < 4."""
        t = lib.minimum(s, 4.0)
        fraction = 23.0
        for odd in (21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0):
            fraction = odd + t / fraction
        zeta = lib.sqrt(lib.maximum(s, 4.0))
        coth_part = (zeta * (1.0 + 2.0 / lib.expm1(lib.minimum(2.0 * zeta, 700.0))) - 1.0) / lib.maximum(s, 4.0)
        return lib.where(s < 4.0, 1.0 / fraction, coth_part)

    def inverse(self, lib: Any, w: Any) -> Any:
        return lib.asinh(w)


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
        u = lib.power(2.0 * zeta, self.n) / SQRT3
        v = u / lib.hypot(1.0, lib.minimum(u, 1e160))
        return self.n * lib.minimum(v * v, 1.0)

    def inverse(self, lib: Any, w: Any) -> Any:
        n = self.n
        if isinstance(n, float) and n == 1.0:  # s (1 + 4s/3) = w^2; `sweep` gives an array of n
            return w * lib.sqrt(2.0 / (1.0 + lib.hypot(1.0, 4.0 / SQRT3 * w)))
        # x + n ln(1 + e^x) = X for x = ln((4s)^n/3), X = ln((4 w^2)^n/3): convex, slope at least 1
        X = 2.0 * n * lib.log(lib.maximum(2.0 * w, TINY)) - LN3
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
