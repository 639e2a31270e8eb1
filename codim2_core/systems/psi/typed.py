"""A Psi that the user typed: evaluation, a table for inverting |e_Psi|, and whether it can be used at all."""

from __future__ import annotations

import bisect
import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formulas.expression import Expression
from ...results.arrays import Array
from .families.record import SCALAR, UNDERFLOW_BOUND, VECTOR, Kernel

# Where Psi is probed: s = 0 and a dense grid, about 100 points a decade.
PROBES: Array = np.concatenate([[0.0], np.geomspace(1e-16, 1e16, 3201)])
PROBES.flags.writeable = False
TINY_PSI = 1e-290
NEGLIGIBLE = 1e-13  # Psi(s) < NEGLIGIBLE s vanishes in s + Psi(s)
VERDICT = "Ψ cannot be used: "


@dataclass(frozen=True)
class Custom(Kernel):
    """Psi given by a formula in s, up to the s at which ``|e_Psi|`` is 1; from there on Psi is 0."""

    expression: Expression
    saturation: float = math.inf

    @cached_property
    def _rate(self) -> Expression:
        return self.expression.derivative("s")

    def _evaluate(self, lib: Any, s: Any) -> Any:
        values = self.expression.evaluate({"s": s})
        return values if self.saturation == math.inf else lib.where(s < self.saturation, values, 0.0)

    def value(self, lib: Any, s: Any) -> Any:
        return lib.where(s == math.inf, self.limit, self._evaluate(lib, s))

    def slope(self, lib: Any, s: Any) -> Any:
        rate = self._rate.evaluate({"s": s})
        if not lib.all(rate == rate):
            # 0/0 at s = 0, as for 1/cosh(sqrt(s)); inf/inf in a tail that has long become 0, as for 1/(1+exp(s))
            nearby = self._rate.evaluate({"s": lib.maximum(s, 1e-12)})
            rate = lib.where(rate == rate, rate, lib.where(nearby == nearby, nearby, 0.0))
        return rate if self.saturation == math.inf else lib.where(s < self.saturation, rate, 0.0)

    def root(self, lib: Any, zeta: Any) -> Any:
        return lib.sqrt(lib.maximum(self._evaluate(lib, self._square(lib, zeta)), 0.0))

    def kappa(self, lib: Any, zeta: Any) -> Any:
        s = self._square(lib, zeta)
        values = self._evaluate(lib, s)
        used = (values > TINY_PSI) & (s > 0.0)
        ratio = -s * self.slope(lib, s) / lib.where(used, values, 1.0)
        return lib.where(used, ratio, 0.0)

    @staticmethod
    def _square(lib: Any, zeta: Any) -> Any:
        z = lib.minimum(zeta, 1e150)
        return z * z

    @cached_property
    def limit(self) -> float:  # type: ignore[override]
        """Psi_1(0): the formula at s = inf if IEEE arithmetic knows it, else extrapolated from large s."""
        if self.saturation < math.inf:
            return 0.0
        at_infinity = self.expression.evaluate({"s": math.inf})
        last = [self.expression.evaluate({"s": s}) for s in (1e12, 1e14, 1e16)]
        if at_infinity == math.inf or abs(at_infinity - last[2]) <= abs(at_infinity - last[1]):
            return at_infinity
        first, second = last[1] - last[0], last[2] - last[1]
        if abs(second) < 0.9 * abs(first):  # Aitken
            return max(last[2] + second * second / (first - second), 0.0)
        return last[2]

    @cached_property
    def _table(self) -> tuple[Array, Array, Array, list[float], list[float], list[float]]:
        """Tabulate ln w, ln zeta and d ln zeta/d ln w at the probes where all are known; as arrays and as lists."""
        zeta = np.sqrt(PROBES[1:])
        with np.errstate(all="ignore"):
            values = self._evaluate(VECTOR, PROBES[1:])
            good = values > TINY_PSI
            log_w = np.log(zeta) - 0.5 * np.log(np.where(good, values, 1.0))
            rate = 1.0 / np.maximum(1.0 + self.kappa(VECTOR, zeta), 1e-3)
        good &= log_w > np.concatenate([[-np.inf], np.maximum.accumulate(np.where(good, log_w, -np.inf))[:-1]])
        columns = log_w[good], np.log(zeta)[good], rate[good]
        return (*columns, *(column.tolist() for column in columns))  # type: ignore[return-value]

    def inverse(self, lib: Any, w: Any) -> Any:
        """Cubic interpolation in a table, and Newton for ln zeta, kept within the table's cell."""
        scalar = lib is SCALAR
        x, y, rate, xs, ys, rates = self._table
        last = len(xs) - 1
        log_w = lib.log(lib.maximum(w, UNDERFLOW_BOUND))
        if scalar:
            x, y, rate = xs, ys, rates
            i = min(max(bisect.bisect_right(xs, log_w), 1), last)
        else:
            i = np.clip(np.searchsorted(x, log_w, side="right"), 1, last)
        x0, lo, hi, width = x[i - 1], y[i - 1], y[i], x[i] - x[i - 1]
        u = lib.minimum(lib.maximum((log_w - x0) / width, 0.0), 1.0)
        v = 1.0 - u
        t = lo * v + hi * u + u * v * (v * (width * rate[i - 1] - (hi - lo)) - u * (width * rate[i] - (hi - lo)))
        t = lib.minimum(lib.maximum(t, lo), hi)
        zeta = lib.exp(t)
        if (xs[0] <= log_w <= xs[last]) if scalar else (log_w.min() >= xs[0] and log_w.max() <= xs[last]):
            for _ in range(2):
                new = self.polish(lib, zeta, w)
                done = lib.all(abs(new - zeta) <= 1e-8 * zeta)
                zeta = new
                if done:
                    return zeta
        return self._search(lib, w, log_w, t, lo, hi)

    def _search(self, lib: Any, w: Any, log_w: Any, t: Any, lo: Any, hi: Any) -> Any:
        """Go the slow road: outside the table, or where Psi bends within a cell; Newton with bisection."""
        first, last = self._table[3][0], self._table[3][-1]
        # below the table zeta is proportional to w; above it Psi is negligible or tends to its limit
        lo = lib.where(log_w < first, log_w - 400.0, lo)
        t = lib.where(log_w < first, log_w + (self._table[4][0] - first), t)
        hi = lib.where(log_w > last, lib.minimum(lib.maximum(log_w, t) + 400.0, 0.5 * math.log(self.saturation)), hi)
        for _ in range(100):
            zeta = lib.exp(t)
            root = lib.maximum(self.root(lib, zeta), 1e-170)
            miss = lib.log(zeta / root) - log_w
            lo, hi = lib.where(miss < 0.0, t, lo), lib.where(miss > 0.0, t, hi)
            new = t - miss / lib.maximum(1.0 + self.kappa(lib, zeta), 1e-3)
            new = lib.where((new >= lo) & (new <= hi), new, 0.5 * (lo + hi))
            done = lib.all(lib.maximum(abs(new - t), abs(miss)) < 1e-7)
            t = new
            if done:
                break
        small = w < 1e-100  # there ln w carries fewer digits than w, and s = zeta^2 is negligible against 1
        zeta = lib.where(small, w * self.root(lib, 0.0 * w), lib.exp(t))
        polished = self.polish(lib, zeta, lib.maximum(w, UNDERFLOW_BOUND))
        return lib.where(abs(polished - zeta) <= 1e-3 * zeta, polished, zeta)

    def polish(self, lib: Any, zeta: Any, w: Any) -> Any:
        """Polish a root as every family does, with Psi evaluated once."""
        s = zeta * zeta
        values = self._evaluate(lib, s)
        used = values > TINY_PSI
        values = lib.where(used, values, TINY_PSI)
        kappa = lib.where(used, -s * self.slope(lib, s) / values, 0.0)
        return zeta * (1.0 - (zeta / (w * lib.sqrt(values)) - 1.0) / lib.maximum(1.0 + kappa, 1e-3))


@lru_cache(maxsize=64)
def custom_kernel(expression: Expression) -> Custom:
    """Kernel of a typed Psi."""
    values = expression.evaluate({"s": PROBES})
    kernel = Custom(expression, _find_saturation(expression, values))
    values = np.where(kernel.saturation > PROBES, values, 0.0)
    bad = ~np.isfinite(values)
    if bad.any():
        s, value = _first_bad(bad), values[int(np.argmax(bad))]
        raise ValueError(
            f"{VERDICT}{expression.text} is {value} at s = {s:.6g}. It must be finite for all s ≥ 0; "
            "rewrite it so that it can be computed from s = 0 to 1e16, e.g. exp(-s) for 1/exp(s)."
        )
    place = first_not_positive(expression, values) if kernel.saturation == math.inf else None
    if place is not None:
        value = expression.evaluate({"s": place})
        raise ValueError(
            f"{VERDICT}{expression.text} is {value:.6g} at s = {place:.6g}. It must be positive, or fall to 0 and stay "
            "there, or |e_Ψ| exceeds 1; choose e.g. 1/(1+s), or max(1-s, 0) for a friction that saturates."
        )
    if values[-1] > 1e-6 * PROBES[-1]:
        top = 1.0 / math.sqrt(1.0 + float(values[-1] / PROBES[-1]))
        raise ValueError(
            f"{VERDICT}with {expression.text}, |e_Ψ| rises to {top:.6g} only. It must tend to 1 as ζ grows, "
            "so Ψ must stay small against s; a Ψ that never rises (R4) is always right."
        )
    with np.errstate(all="ignore"):
        kappa = kernel.kappa(VECTOR, np.sqrt(PROBES))
    matters = (values > NEGLIGIBLE * PROBES) & (PROBES > 0.0)
    falling = matters & ~(kappa > -1.0 + 1e-9)
    if not falling.any():  # the formula's own values may jump down between the probes
        with np.errstate(all="ignore"):
            q = np.where(matters, PROBES / np.where(matters, values, 1.0), np.inf)
        falling[1:] = matters[1:] & (q[1:] <= np.maximum.accumulate(np.where(matters, q, 0.0))[:-1])
        falling[:2] = False
    if falling.any():
        raise ValueError(
            f"{VERDICT}with {expression.text}, |e_Ψ| = ζ/√(ζ² + Ψ(ζ²)) does not rise at "
            f"s = ζ² = {_first_bad(falling):.6g}. Ψ must not grow as fast as s there; a Ψ that never rises "
            "(R4) is always right, e.g. 1/(1+s)."
        )
    return kernel


def _find_saturation(expression: Expression, values: Array) -> float:
    """Find the s at which ``|e_Psi|`` reaches 1, that is Psi falls to 0 from a visible size; inf if it never does.

    There Psi/s has its minimum, 0; what the formula says beyond, unless it is negative, is not used (`Custom`).
    """
    with np.errstate(all="ignore"):
        falls = np.diff(values[1:] / PROBES[1:]) < 0.0
    i = int(np.argmin(falls))
    if falls[i] or i == 0:
        return math.inf
    rate = expression.derivative("s")

    def falling(s: float) -> bool:
        value = expression.evaluate({"s": s})
        return value > 0.0 and s * rate.evaluate({"s": s}) < value

    place = refine(falling, float(PROBES[i]), float(PROBES[i + 2]))
    rounding = 1e-13 * max(1.0, float(values[0]))
    reaches_zero = abs(expression.evaluate({"s": place})) <= NEGLIGIBLE * place
    fades = expression.evaluate({"s": 0.99 * place}) < rounding
    negative = bool((values[place < PROBES] < -rounding).any())
    return place if reaches_zero and not fades and not negative else math.inf


def first_not_positive(expression: Expression, values: Array) -> float | None:
    """Find the first s where Psi <= 0 (R3), or None; Psi that fades gradually to 0 in rounding is positive."""
    bad = values <= 0.0
    if not bad.any():
        return None
    i = int(np.argmax(bad))
    if i == 0:
        return 0.0
    place = refine(lambda s: expression.evaluate({"s": s}) > 0.0, float(PROBES[i - 1]), float(PROBES[i]))
    # exp(-s) underflows and 1 - tanh(s) rounds to 0 only after fading; 1 - s falls through 0 from a visible size
    just_before = float(expression.evaluate({"s": 0.99 * place}))
    rounding = 1e-13 * max(1.0, float(values[0]))
    if just_before < rounding and not (values < -rounding).any():
        return None
    if just_before < rounding:
        return _first_bad(values < -rounding)
    return place


def refine(holds: Any, good: float, bad: float) -> float:
    """Find the smallest s where `holds` is false, between a good s and a bad one, by bisection."""
    for _ in range(200):
        middle = 0.5 * (good + bad)
        if not good < middle < bad:
            break
        if holds(middle):
            good = middle
        else:
            bad = middle
    return bad


def _first_bad(bad: NDArray[np.bool_]) -> float:
    return float(PROBES[int(np.argmax(bad))])
