"""Cutting arcs until a trigonometric polynomial has no zero or one on each; compiled. Used by `fourier_zeros`."""

from __future__ import annotations

import cmath
import math

import numpy as np
from numba import njit


@njit(cache=True, nogil=True, error_model="numpy")
def _value(c, t):
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


@njit(cache=True, nogil=True, error_model="numpy")
def cut(c, theta, h, least, most, tolerance, first, fourth, simple):
    """Decide arcs, cutting the undecided ones in four, until none is left or they are shorter than `least`.

    Parameters
    ----------
    c : ndarray of complex (n + 1,)
    theta : ndarray (k,)
        Middles of arcs of half-width h.
    least : float
        Half-width.
    most : int
        Undecided arcs at which to give up.
    tolerance : float
        Of f.
    first, fourth : float
        Bounds of f' and f''''.
    simple : ndarray
        Filled with the zeros on arcs where f is monotone, from its beginning; NaN after them.

    Returns
    -------
    theta : ndarray
        Middles of the arcs that are left.
    h : float
        Their half-width.
    """
    found = 0
    while True:
        left = np.empty(len(theta))
        count = 0
        for i in range(len(theta)):
            t = theta[i]
            f, d, w, q = _value(c, t)
            second = abs(w) + h * abs(q) + 0.5 * h * h * fourth  # bound of f'' on the arc
            if abs(f) > h * abs(d) + 0.5 * h * h * second + tolerance:
                continue
            if abs(d) <= h * second + 1.2e-16 * first:
                left[count] = t
                count += 1
                continue
            x = t
            for _ in range(8):
                f, d, _, _ = _value(c, x)
                step = f / d if d != 0.0 else 0.0
                # on a monotone arc f' is at least half of that at the middle: a longer step leaves the arc
                x = min(max(x - step, t - 1.5 * h), t + 1.5 * h)
                if abs(step) < 1e-12:
                    break
            if abs(x - t) <= h * (1.0 + 1e-9) + 1e-14 and found < len(simple):
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


@njit(cache=True, nogil=True, error_model="numpy")
def lowest_extremum(c, theta, h):
    """Return the smallest |f| at an extremum, of those one Newton step from the net; inf if there is none."""
    lowest = math.inf
    for t in theta:
        _, d, w, _ = _value(c, t)
        if w != 0.0 and abs(d) <= 2.0 * h * abs(w):
            f, d, w, _ = _value(c, t - d / w)
            lowest = min(lowest, abs(f - 0.5 * d * d / w) if w != 0.0 else abs(f))
    return lowest
