"""The families of Psi that have no parameter: 1, 1/(1+s), exp(-s) and that of tanh, Figure 5."""

from __future__ import annotations

import math
from dataclasses import dataclass
from math import expm1
from typing import Any

import numpy as np

from .record import UNDERFLOW_BOUND, Array, Family, Kernel


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


def constant_gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    return 1.0 / math.sqrt(max(r2 + w * w, UNDERFLOW_BOUND))


CONSTANT = Family(
    name="constant", title="1", formula="1", kernel=Constant, gain=constant_gain,
    compared=(0.0,), identity=True,
)  # fmt: skip


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


def rational_gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    w2 = w * w
    return 1.0 / math.sqrt(max(r2 + w2 * w2 / max(r2 + w2, UNDERFLOW_BOUND), UNDERFLOW_BOUND))


RATIONAL = Family(
    name="rational", title="1/(1 + s)", formula="1/(1+s)", kernel=Rational, gain=rational_gain,
    compared=(0.0,),
)  # fmt: skip


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
        s = lib.maximum(L * (1.0 - lib.log1p(L) / (2.0 + L)), UNDERFLOW_BOUND)  # Winitzki's guess, within 2 %
        for _ in range(2):  # Newton on s + ln s = ln q
            s = s / (1.0 + s) * (1.0 + log_q - lib.log(s))
        # small s: the rounding of ln q is as large as s, and zeta = w exp(-s/2) needs s only roughly
        zeta = lib.where(s > 0.05, lib.sqrt(lib.maximum(s, 0.0)), w * (1.0 - 0.5 * lib.minimum(s, 0.1)))
        return self.polish(lib, self.polish(lib, zeta, w), w)


def exponential_gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``."""
    w2 = w * w
    s = min(r2 / max(w2, UNDERFLOW_BOUND), 700.0)
    return 1.0 / math.sqrt(max(r2 + w2 * (1.0 + expm1(-s)), UNDERFLOW_BOUND))


EXPONENTIAL = Family(
    name="exponential", title="exp(−s)", formula="exp(-s)", kernel=Exponential, gain=exponential_gain,
    compared=(0.0,),
)  # fmt: skip


_CONTOUR = np.exp(2j * np.pi * np.arange(32) / 32)


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
        z = lib.maximum(lib.minimum(zeta, 1e4), UNDERFLOW_BOUND)
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


def tanh_derivatives(s: Array, _: float) -> tuple[Array, Array, Array]:
    """First three derivatives of Psi, analytic for s > -pi^2: Cauchy's integral on a unit circle."""
    w = s[:, None] + _CONTOUR
    root = np.sqrt(w)
    decay = np.exp(-2.0 * root)
    values = 4.0 * w * decay / (1.0 - decay) ** 2
    first, second, third = (math.factorial(j) * (values * _CONTOUR**-j).mean(axis=1).real for j in (1, 2, 3))
    return first, second, third


def tanh_gain(r2, w, _):
    """``e_Psi = gain p`` at ``|p|^2 = r2``: e = tanh(zeta) p/|p|, with zeta = |p|/w."""
    r = max(math.sqrt(r2), 1e-150)
    m = expm1(-2.0 * min(r / max(abs(w), UNDERFLOW_BOUND), 350.0))
    return -m / ((2.0 + m) * r)


TANH = Family(
    name="tanh", title="s/sinh²√s", formula="s/sinh(sqrt(s))**2", kernel=Tanh, gain=tanh_gain,
    derivatives=tanh_derivatives, compared=(0.0,),
)  # fmt: skip
