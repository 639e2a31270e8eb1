"""All real zeros of a trigonometric polynomial of any degree, with multiplicity, and a proof that none was missed.

With f = Re sum c_k exp(i k theta) every derivative is bounded by M_j = sum k^j |c_k|. Over an arc of half-width h about
t, |f''| is at most S = |f''(t)| + h |f'''(t)| + h^2 M_4/2, so there is no zero if |f(t)| > h |f'(t)| + h^2 S/2, and at
most one, simple, if |f'(t)| > h S. Arcs that are neither are cut in four. At a multiple zero that never ends: there the
derivatives decide, within rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..results.arrays import Array

UNIT = 2.0**-53
ROUNDINGS = 16.0  # of the terms of f: what a zero's multiplicity is decided within
MIN_ARC = 2e-3  # half-width of an arc below which a multiple zero is looked for
FINEST = 1e-11
SAME_ZERO_DISTANCE = 1e-6  # a multiple zero found twice differs by less
OFFSET = 0.1234567  # so that no arc of the first net ends at a multiple of pi/2, where zeros like to be
HIGHEST = 8  # multiplicity


@dataclass(frozen=True, eq=False)
class Series:
    """``f = Re sum_k c_k exp(i k theta)``."""

    c: NDArray[np.complex128]  # (n + 1,)
    size: float  # size of the terms f was summed from: it is known to within a few units of rounding of this
    resolved: bool  # what was dropped lies within that rounding
    exact: bool  # f is known to be a trigonometric polynomial of no higher degree

    @property
    def degree(self) -> int:
        """The largest k."""
        return len(self.c) - 1

    def bound(self, j: int) -> float:
        """``sum k^j |c_k|``, which no j-th derivative exceeds."""
        return float(np.arange(len(self.c), dtype=float) ** j @ np.abs(self.c))

    @cached_property
    def tolerance(self) -> float:
        """Values of f below this are zero within rounding."""
        return ROUNDINGS * UNIT * self.size

    @property
    def vanishes(self) -> bool:
        """Whether f is zero everywhere, within rounding."""
        return float(np.abs(self.c).sum()) <= self.tolerance

    def derivatives(self, theta: Array, orders: range) -> Array:
        """Return the derivatives of the given orders at each theta; (len(orders), k)."""
        waves = np.exp(1j * np.multiply.outer(theta, np.arange(len(self.c))))
        return (waves @ self.columns[:, orders.start : orders.stop]).real.T

    @cached_property
    def columns(self) -> NDArray[np.complex128]:
        """Coefficients of f and of its derivatives, a column for each order."""
        k = 1j * np.arange(len(self.c))
        return self.c[:, None] * k[:, None] ** np.arange(HIGHEST + 2)


@dataclass(frozen=True, slots=True)
class Zeros:
    """Zeros of a `Series` in [0, 2 pi), increasing."""

    theta: Array  # (k,)
    multiplicity: NDArray[np.int64]  # (k,)
    # every arc without a zero was shown to have none, and every simple zero lies on an arc where f is monotone
    proven: bool
    distance: float  # estimate of the smallest relative change of f that makes a zero multiple: 0.0 if one is


def series(values: Array, size: float, degree: int | None = None) -> Series:
    """Fourier series of values (N,) of a function at an even number N of equally spaced angles from 0."""
    n = len(values)
    c = np.asarray(np.fft.rfft(values) * (2.0 / n), np.complex128)
    c[0] *= 0.5
    small = np.abs(c) <= 4.0 * UNIT * size
    if degree is None:
        resolved = bool(small[n // 3 :].all())
    else:
        resolved = True
        small[degree + 1 :] = True
    kept = np.flatnonzero(~small)
    return Series(c[: (kept[-1] if len(kept) else 0) + 1], size, resolved, degree is not None)


def zeros(f: Series) -> Zeros:
    """All zeros of f, by cutting arcs until each is decided; none if f vanishes identically."""
    from .fourier_arcs import decide_arcs, lowest_extremum  # on first use: it loads the compiler

    none = Zeros(np.zeros(0), np.zeros(0, np.int64), True, math.inf)
    if f.vanishes:
        return none
    first, fourth = f.bound(1), f.bound(4)
    cells = 16 * max(2, f.degree)
    h = math.pi / cells
    theta = OFFSET + h * (1.0 + 2.0 * np.arange(cells))
    distance = float(lowest_extremum(f.c, theta, h)) / f.size
    simple: list[float] = []
    multiple: list[tuple[float, int, float]] = []
    proven, least, most = True, MIN_ARC, 16 * (f.degree + 32)
    while True:
        at = np.empty(2 * f.degree + 16)
        theta, h = decide_arcs(f.c, theta, h, least, most, f.tolerance, first, fourth, at)
        simple += at[~np.isnan(at)].tolist()
        if len(theta) and len(theta) <= most:
            least = h / 50.0  # by then what lies close together has come apart
            _add_multiple(f, theta, h, multiple)
            for centre, _, radius in multiple:
                theta = theta[np.abs(np.remainder(theta - centre + math.pi, 2 * math.pi) - math.pi) > radius - 1.5 * h]
        if not len(theta):
            break
        if h < FINEST or len(theta) > most:
            proven = False
            break
        h *= 0.25
        theta = (theta[:, None] + h * np.array([-3.0, -1.0, 1.0, 3.0])).ravel()
    return _collect_zeros(f, simple, multiple, proven, distance)


def _add_multiple(f: Series, theta: Array, h: float, found: list[tuple[float, int, float]]) -> None:
    """Add multiple zeros in clusters of undecided arcs: (where, multiplicity, radius without another zero)."""
    theta = np.sort(np.remainder(theta, 2 * math.pi))
    breaks = np.flatnonzero(np.diff(theta) > 3.0 * h)
    for cluster in np.split(theta, breaks + 1):
        middle, width = 0.5 * (cluster[0] + cluster[-1]), 0.5 * (cluster[-1] - cluster[0]) + 4.0 * h
        for m in range(HIGHEST, 1, -1):
            x = middle
            for _ in range(8):
                u, rate = f.derivatives(np.array([x]), range(m - 1, m + 1))[:, 0]
                step = u / rate if rate != 0.0 else math.inf
                x -= step
                if abs(step) < 1e-15 or not abs(x - middle) <= width:
                    break
            if not abs(x - middle) <= width:
                continue
            taylor = f.derivatives(np.array([x]), range(m + 1))[:, 0]
            if not abs(taylor[m]) > 1e-9 * f.bound(m):
                continue
            # f is rounding as far as `reach` from an m-fold zero: so are zeros that its lower terms part there
            # (Chebyshev's polynomials of degree 3 and 4: below 3 times the rounding)
            reach = (f.tolerance * math.factorial(m) / abs(taylor[m])) ** (1.0 / m)
            if all(
                abs(taylor[j])
                <= max(ROUNDINGS * UNIT * max(f.size, f.bound(j)), 3.0 * f.tolerance * math.factorial(j) / reach**j)
                for j in range(m - 1)
            ):
                radius = 0.5 * (m + 1) * abs(taylor[m]) / f.bound(m + 1)
                if not any(
                    abs(math.remainder(x - other, 2 * math.pi)) < max(r, SAME_ZERO_DISTANCE) for other, _, r in found
                ):
                    found.append((x, m, radius))
                break


def _collect_zeros(
    f: Series, simple: list[float], multiple: list[tuple[float, int, float]], proven: bool, distance: float
) -> Zeros:
    # what lies as near to a multiple zero as its own rounding blurs it is that zero
    angles = [t for t in simple if all(abs(math.remainder(t - c, 2 * math.pi)) > r for c, _, r in multiple)]
    slopes = f.derivatives(np.array(angles), range(1, 2))[0].tolist() if angles else []
    entries = [(turn(t), 1, slope) for t, slope in zip(angles, slopes, strict=True)]
    entries += [(turn(c), m, 0.0) for c, m, _ in multiple]
    entries.sort()
    if not entries:
        return Zeros(np.zeros(0), np.zeros(0, np.int64), proven, distance)
    kept: list[tuple[float, int, float]] = []
    for entry in entries:
        if not (kept and _is_same_zero(f, kept[-1], entry)):
            kept.append(entry)
    if len(kept) > 1 and _is_same_zero(f, kept[-1], (kept[0][0] + 2.0 * math.pi, *kept[0][1:])):
        kept.pop()
    proven = proven and _alternate(kept)
    return Zeros(
        np.array([t for t, _, _ in kept], float),
        np.array([m for _, m, _ in kept], np.int64),
        proven,
        0.0 if multiple else distance,
    )


def _alternate(found: list[tuple[float, int, float]]) -> bool:
    """Whether signs of f fit together around the circle: they change at odd zeros, each way by turns."""
    first = next((i for i, (_, m, _) in enumerate(found) if m == 1), None)
    if first is None:
        return sum(m % 2 for _, m, _ in found) % 2 == 0
    rises = found[first][2] > 0.0
    for _, m, slope in (*found[first:], *found[:first]):
        if m == 1 and (slope > 0.0) != rises:
            return False
        rises = rises != bool(m % 2)
    return rises == (found[first][2] > 0.0)


def _is_same_zero(f: Series, one: tuple[float, int, float], next_: tuple[float, int, float]) -> bool:
    """Whether neighbours are one simple zero, found from both of the arcs that it lies between: both rise or fall."""
    (t, m, slope), (u, n, other) = one, next_
    if not m == n == 1 or (slope > 0.0) != (other > 0.0):
        return False
    blur = 4.0 * f.tolerance / max(min(abs(slope), abs(other)), 1e-300)
    return u - t < max(1e-9, min(blur, SAME_ZERO_DISTANCE))


def turn(theta: float) -> float:
    """Return the angle in [0, 2 pi); just below 0 within rounding is 0."""
    theta = math.remainder(theta, 2.0 * math.pi)
    if theta < 0.0:
        theta += 2.0 * math.pi
    return 0.0 if theta >= 2.0 * math.pi - 4e-16 else theta
