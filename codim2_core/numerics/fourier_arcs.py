"""Cutting arcs until a trigonometric polynomial has no zero or one on each; compiled. Used by `fourier_zeros`."""

from __future__ import annotations

import cmath
import math

import numpy as np

from ..formulas.jit import kernel


@kernel
def _evaluate_series(c, t):
    """``f = Re sum c_k exp(i k t)`` with three derivatives."""
    turn = cmath.exp(1j * t)
    wave = 1.0 + 0.0j
    f, d, w, q = 0.0, 0.0, 0.0, 0.0
    for k in range(len(c)):
        term = c[k] * wave
        f += term.real
        d -= k * term.imag
        w -= k * k * term.real
        q += k * k * k * term.imag
        wave *= turn
    return f, d, w, q


@kernel
def _only_zero(c, low, high, rising, tolerance):
    """Return (whether there is one, the zero) on an arc where f is monotone, by its signs at the two ends."""
    first, last = _evaluate_series(c, low)[0], _evaluate_series(c, high)[0]
    if not rising:
        first, last = -first, -last
    if first > 0.0 or last < 0.0:
        # where an end is a zero within rounding, its sign is not known
        if abs(first) <= tolerance:
            return True, low
        return abs(last) <= tolerance, high
    x = 0.5 * (low + high)
    for _ in range(60):
        f, d, _, _ = _evaluate_series(c, x)
        if (f > 0.0) == rising:
            high = x
        else:
            low = x
        step = f / d if d != 0.0 else math.inf
        if abs(step) < 1e-12:
            x -= step
            break
        x -= step
        if not low < x < high:
            x = 0.5 * (low + high)
    return True, x


@kernel
def decide_arcs(c, theta, h, least, most, tolerance, first, fourth, simple):
    """Decide arcs of c (n + 1,), cutting the undecided in four; those shorter than `least` are left: theta, h."""
    found = 0
    while True:
        left = np.empty(len(theta))
        count = 0
        for i in range(len(theta)):
            t = theta[i]
            f, d, w, q = _evaluate_series(c, t)
            second = abs(w) + h * abs(q) + 0.5 * h * h * fourth  # bound of f'' on the arc
            if abs(f) > h * abs(d) + 0.5 * h * h * second + tolerance:
                continue
            wide = h * (1.0 + 1e-9) + 1e-14  # arcs overlap a little: a zero between two of them lies on both
            if abs(d) <= wide * second + 1.2e-16 * first:
                left[count] = t
                count += 1
                continue
            ok, x = _only_zero(c, t - wide, t + wide, d > 0.0, tolerance)
            if ok and found < len(simple):
                simple[found] = x
                found += 1
        if count == 0 or h < least or count > most:
            simple[found:] = np.nan
            return left[:count], h
        h *= 0.25
        theta = np.empty(4 * count)
        for i in range(count):
            for j in range(4):
                theta[4 * i + j] = left[i] + (2 * j - 3) * h


@kernel
def lowest_extremum(c, theta, h):
    """Return the smallest |f| at an extremum, of those one Newton step from the net; inf if there is none."""
    lowest = math.inf
    for t in theta:
        _, d, w, _ = _evaluate_series(c, t)
        if w != 0.0 and abs(d) <= 2.0 * h * abs(w):
            f, d, w, _ = _evaluate_series(c, t - d / w)
            lowest = min(lowest, abs(f - 0.5 * d * d / w) if w != 0.0 else abs(f))
    return lowest
