"""Fixed points of the return map of an e-linear layer problem by brute force, sharing no code with the library.

Orbits of ``x2' = A e_Psi(x2) + f`` (Hill family) in the plane kappa_2, by the method of Dormand and Prince of order 5,
from many points of a ray ``e = e_C + r u`` on which u is perpendicular to A u; extrema towards zero are sampled closer.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit


@njit(cache=True)
def _field(x, y, q):
    s = x * x + y * y
    gain = 1.0 / math.sqrt(s + 3.0 / (3.0 + (4.0 * s) ** q[5]))
    return gain * (q[0] * x - q[1] * y) + q[3], gain * (q[1] * x + q[2] * y) + q[4]


@njit(cache=True)
def _modulus(zeta, n):
    s = zeta * zeta
    return zeta / math.sqrt(s + 3.0 / (3.0 + (4.0 * s) ** n))


@njit(cache=True)
def _zeta(modulus, n):
    low, high = 0.0, 1.0
    while _modulus(high, n) < modulus and high < 1e9:
        high *= 2.0
    for _ in range(100):
        middle = 0.5 * (low + high)
        if _modulus(middle, n) < modulus:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@njit(cache=True)
def _step(x, y, h, q, ax, ay):
    bx, by = _field(x + h * ax / 5, y + h * ay / 5, q)
    cx, cy = _field(x + h * (3 * ax + 9 * bx) / 40, y + h * (3 * ay + 9 * by) / 40, q)
    dx, dy = _field(
        x + h * (44 / 45 * ax - 56 / 15 * bx + 32 / 9 * cx), y + h * (44 / 45 * ay - 56 / 15 * by + 32 / 9 * cy), q
    )
    ex, ey = _field(
        x + h * (19372 / 6561 * ax - 25360 / 2187 * bx + 64448 / 6561 * cx - 212 / 729 * dx),
        y + h * (19372 / 6561 * ay - 25360 / 2187 * by + 64448 / 6561 * cy - 212 / 729 * dy),
        q,
    )
    fx, fy = _field(
        x + h * (9017 / 3168 * ax - 355 / 33 * bx + 46732 / 5247 * cx + 49 / 176 * dx - 5103 / 18656 * ex),
        y + h * (9017 / 3168 * ay - 355 / 33 * by + 46732 / 5247 * cy + 49 / 176 * dy - 5103 / 18656 * ey),
        q,
    )
    nx = x + h * (35 / 384 * ax + 500 / 1113 * cx + 125 / 192 * dx - 2187 / 6784 * ex + 11 / 84 * fx)
    ny = y + h * (35 / 384 * ay + 500 / 1113 * cy + 125 / 192 * dy - 2187 / 6784 * ey + 11 / 84 * fy)
    gx, gy = _field(nx, ny, q)
    wx = 71 / 57600 * ax - 71 / 16695 * cx + 71 / 1920 * dx - 17253 / 339200 * ex + 22 / 525 * fx - gx / 40
    wy = 71 / 57600 * ay - 71 / 16695 * cy + 71 / 1920 * dy - 17253 / 339200 * ey + 22 / 525 * fy - gy / 40
    return nx, ny, gx, gy, h * math.hypot(wx, wy)


@njit(cache=True)
def _return(x, y, q, u, centre, sense, tolerance):
    """ln of the distance from the centre along u on the first return; infinite where there is none."""
    start = math.hypot(x - centre[0], y - centre[1])
    first = max(1.0, math.hypot(x, y))
    ax, ay = _field(x, y, q)
    h, phase = 0.05 * start / math.hypot(ax, ay), 0
    for _ in range(20000):
        nx, ny, gx, gy, error = _step(x, y, h, q, ax, ay)
        away = math.hypot(nx - centre[0], ny - centre[1])
        factor = min(5.0, max(0.2, 0.9 * (error / (tolerance * max(min(away, start), 1e-12)) + 1e-30) ** -0.2))
        if factor < 0.9:
            h *= factor
            continue
        along = u[0] * gx + u[1] * gy
        if phase == 0 and sense * (u[0] * gy - u[1] * gx) < 0.0:
            phase = 1
        if phase == 1 and along > 0.0:
            phase = 2
        elif phase == 2 and along <= 0.0:
            low, high = 0.0, h
            for _ in range(60):
                middle = 0.5 * (low + high)
                mx, my, vx, vy, _ = _step(x, y, middle, q, ax, ay)
                if u[0] * vx + u[1] * vy > 0.0:
                    low = middle
                else:
                    high = middle
            return math.log(max(u[0] * (mx - centre[0]) + u[1] * (my - centre[1]), 1e-300))
        x, y, ax, ay = nx, ny, gx, gy
        if away < 1e-5 * start:
            return -math.inf
        if math.hypot(x, y) > 1e8 * first:
            return math.inf
        h *= factor
    return math.nan


@njit(cache=True)
def _displacements(xi, q, u, e, reach, sense, tolerance):
    out = np.empty(len(xi))
    size = math.hypot(e[0], e[1])
    zeta = _zeta(size, q[5])
    centre = (zeta * e[0] / max(size, 1e-300), zeta * e[1] / max(size, 1e-300))
    for i in range(len(xi)):
        r = reach / (1.0 + math.exp(-xi[i]))
        c, s = e[0] + r * u[0], e[1] + r * u[1]
        size = math.hypot(c, s)
        zeta = _zeta(min(size, 1.0 - 1e-15), q[5])
        x, y = zeta * c / size, zeta * s / size
        first = math.log(u[0] * (x - centre[0]) + u[1] * (y - centre[1]))
        out[i] = _return(x, y, q, u, centre, sense, tolerance) - first
    return out


def fixed_points(abd, f, n, samples=300, last=12.0):
    """Brackets in ln(r/(R - r)) of the fixed points with r/R between about 1e-4 and 1 - 1e-5, by sign changes."""
    a, b, d = abd
    A = np.array([[a, -b], [b, d]])
    e = -np.linalg.solve(A, f)
    w = np.sqrt([abs(d), abs(a)]) / math.sqrt(abs(a) + abs(d))
    rays = []
    for signs in ((1, 1), (-1, 1), (-1, -1), (1, -1)):
        along = float(w * signs @ e)
        rays.append((math.sqrt(along * along + 1.0 - e @ e) - along, *(w * signs)))
    reach, *u = max(rays)
    q = np.array([a, b, d, *f, float(n)])
    q[:5] /= np.linalg.norm(q[:5])

    def g(xi, tolerance):
        return _displacements(xi, q, tuple(u), tuple(e.tolist()), reach, math.copysign(1.0, b), tolerance)

    xi = np.linspace(-9.0, last, samples)
    shift = g(xi, 1e-10)
    for _ in range(3):
        y0, y1, y2 = shift[:-2], shift[1:-1], shift[2:]
        s = np.sign(y1)
        dips = (s * y1 <= np.minimum(s * y0, s * y2)) & (abs(y1) < 1e-3)
        places = np.flatnonzero(dips & np.isfinite(y0) & np.isfinite(y2)) + 1
        if not len(places):
            break
        more = np.concatenate([np.linspace(xi[i - 1], xi[i + 1], 23)[1:-1] for i in places])
        xi, at = np.unique(np.concatenate([xi, more]), return_index=True)
        shift = np.concatenate([shift, g(more, 1e-12)])[at]
    both = np.isfinite(shift[:-1]) & np.isfinite(shift[1:]) & ((shift[:-1] < 0.0) != (shift[1:] < 0.0))
    return [(float(xi[i]), float(xi[i + 1])) for i in np.flatnonzero(both)]
