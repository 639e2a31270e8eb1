"""Follow one curve on which a component of U vanishes, by predictor and corrector; compiled.

The curve lives in the closed e-disc, or outside it in the picture, where U may read x and y. Its gradient is exact.
Steps are short where it bends, a step that would leave the curve for a neighbour is halved, and through a crossing
(where the gradient vanishes) the direction is kept.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .tape_kernels import gradients

RHO, THETA, U1, U2 = range(4)  # kinds
LONGEST, SHORTEST = 0.04, 1e-6  # steps, in units of the disc
CLOSE = 2e-3  # distance of two branches that is taken for a crossing: a third of a pixel
BEND = 0.12  # radians between neighbouring points
BORDER, CLOSED, STUCK = range(3)  # how a curve ends


@njit(cache=True, nogil=True, error_model="numpy")
def component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows):
    """Return a component of U and its derivatives by X and Y, at a point of the e-disc or of the picture outside.

    seed : (4, 3), work : (n, 3), rows : (2, 3), all scratch.
    """
    seed[:] = 0.0
    if not outside:
        seed[0, 0], seed[0, 1] = X, 1.0
        seed[1, 0], seed[1, 2] = Y, 1.0
    else:
        r = math.hypot(X, Y)
        c, s = X / r, Y / r
        rho = r - 1.0
        seed[0, 0], seed[0, 1], seed[0, 2] = c, s * s / r, -c * s / r
        seed[1, 0], seed[1, 1], seed[1, 2] = s, -c * s / r, c * c / r
        seed[2, 0], seed[2, 1], seed[2, 2] = rho * c, c * c + rho * s * s / r, c * s - rho * c * s / r
        seed[3, 0], seed[3, 1], seed[3, 2] = rho * s, c * s - rho * c * s / r, s * s + rho * c * c / r
    gradients(op, left, right, number, roots, seed, work, rows)
    if kind >= U1:
        i = kind - U1
        return rows[i, 0], rows[i, 1], rows[i, 2]
    c, s = seed[0, 0], seed[1, 0]
    u, v = rows[0, 0], rows[1, 0]
    first, second = 0.0, 0.0
    if kind == RHO:
        first = seed[0, 1] * u + c * rows[0, 1] + seed[1, 1] * v + s * rows[1, 1]
        second = seed[0, 2] * u + c * rows[0, 2] + seed[1, 2] * v + s * rows[1, 2]
        return c * u + s * v, first, second
    first = seed[0, 1] * v + c * rows[1, 1] - seed[1, 1] * u - s * rows[0, 1]
    second = seed[0, 2] * v + c * rows[1, 2] - seed[1, 2] * u - s * rows[0, 2]
    return c * v - s * u, first, second


@njit(cache=True, nogil=True, error_model="numpy")
def _corrected(op, left, right, number, roots, kind, outside, X, Y, reach, floor, seed, work, rows):
    """Newton's method along the gradient; (ok, X, Y, gradient), not ok farther than `reach` away.

    floor : size of the gradient below which a point is taken as a crossing of branches and left where it is.
    """
    X0, Y0 = X, Y
    g, gx, gy = 0.0, 0.0, 0.0
    for _ in range(10):
        g, gx, gy = component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows)
        square = gx * gx + gy * gy
        if not math.isfinite(g + square):
            return False, X, Y, gx, gy
        if square <= floor * floor:
            return abs(g) <= floor * reach, X, Y, 0.0, 0.0
        dX, dY = g * gx / square, g * gy / square
        X, Y = X - dX, Y - dY
        if abs(X - X0) + abs(Y - Y0) > reach:
            return False, X, Y, gx, gy
        if abs(dX) + abs(dY) < 1e-14:
            break
    return True, X, Y, gx, gy


@njit(cache=True, nogil=True, error_model="numpy")
def settle(op, left, right, number, roots, kind, outside, X, Y, reach, size):
    """Bring a point near a curve onto it; (ok, X, Y, tangent)."""
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    floor = 1e-9 * size
    ok, X, Y, gx, gy = _corrected(op, left, right, number, roots, kind, outside, X, Y, reach, floor, seed, work, rows)
    length = math.hypot(gx, gy)
    if length == 0.0:
        return False, X, Y, 0.0, 0.0
    return ok, X, Y, -gy / length, gx / length


@njit(cache=True, nogil=True, error_model="numpy")
def follow(op, left, right, number, roots, kind, outside, X, Y, tx, ty, largest, size, out):
    """Follow a curve from a point on it, in the direction (tx, ty).

    Parameters
    ----------
    op, left, right, number, roots
        A `Program` with two rows.
    kind : RHO, THETA, U1 or U2
    outside : bool
        In the annulus between 1 and `largest` rather than the disc of radius 1.
    size : float
        Of U: what a vanishing gradient is measured by.
    out : (n, 4)
        Filled with points and unit tangents.

    Returns
    -------
    count : int
    ending : BORDER, CLOSED or STUCK
    """
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    floor = 1e-9 * size
    most = largest if outside else 1.0
    out[0, 0], out[0, 1], out[0, 2], out[0, 3] = X, Y, tx, ty
    count, h, slope_X, slope_Y = 1, 0.25 * LONGEST, 0.0, 0.0
    while count < len(out):
        ok, nX, nY, gx, gy = _corrected(
            op, left, right, number, roots, kind, outside, X + h * tx, Y + h * ty, 0.3 * h, floor, seed, work, rows
        )
        length = math.hypot(gx, gy)
        nx, ny, turn = tx, ty, 0.0
        if ok and length > 0.0:
            nx, ny = -gy / length, gx / length
            if nx * tx + ny * ty < 0.0:
                nx, ny = -nx, -ny
            turn = abs(math.atan2(tx * ny - ty * nx, tx * nx + ty * ny))
        # a gradient that changes much tells of another branch close by; closer than CLOSE is as good as a crossing
        change = math.hypot(gx - slope_X, gy - slope_Y)
        leap = count > 1 and h > CLOSE and change > 0.5 * min(length, math.hypot(slope_X, slope_Y))
        if not ok or turn > BEND or leap:
            h *= 0.5
            if h < SHORTEST:
                return count, STUCK
            continue
        r = math.hypot(nX, nY)
        if r > most or (outside and r < 1.0):
            return _to_border(
                op,
                left,
                right,
                number,
                roots,
                kind,
                outside,
                X,
                Y,
                tx,
                ty,
                h,
                most,
                floor,
                seed,
                work,
                rows,
                out,
                count,
            )
        X, Y, tx, ty, slope_X, slope_Y = nX, nY, nx, ny, gx, gy
        out[count, 0], out[count, 1], out[count, 2], out[count, 3] = X, Y, tx, ty
        count += 1
        home_X, home_Y = out[0, 0] - X, out[0, 1] - Y
        if count > 3 and math.hypot(home_X, home_Y) < h and tx * out[0, 2] + ty * out[0, 3] > 0.8:
            ahead = home_X * tx + home_Y * ty
            if abs(home_X * ty - home_Y * tx) < 0.3 * h:
                if ahead < 0.25 * h:  # the last point is at home or past it
                    count -= 1
                out[count] = out[0]
                return count + 1, CLOSED
        if turn < 0.4 * BEND:
            h = min(1.5 * h, LONGEST)
    return count, STUCK


@njit(cache=True, nogil=True, error_model="numpy")
def _to_border(
    op, left, right, number, roots, kind, outside, X, Y, tx, ty, h, most, floor, seed, work, rows, out, count
):
    """Shorten the last step so that it ends on the border."""
    low, high = 0.0, h
    bX, bY, bx, by = X, Y, tx, ty
    for _ in range(40):
        middle = 0.5 * (low + high)
        ok, nX, nY, gx, gy = _corrected(
            op, left, right, number, roots, kind, outside, X + middle * tx, Y + middle * ty, 0.3 * h, floor, seed,
            work, rows,
        )  # fmt: skip
        r = math.hypot(nX, nY)
        if not ok or r > most or (outside and r < 1.0):
            high = middle
            continue
        low, bX, bY = middle, nX, nY
        length = math.hypot(gx, gy)
        if length > 0.0:
            bx, by = -gy / length, gx / length
            if bx * tx + by * ty < 0.0:
                bx, by = -bx, -by
    out[count, 0], out[count, 1], out[count, 2], out[count, 3] = bX, bY, bx, by
    return count + 1, BORDER
