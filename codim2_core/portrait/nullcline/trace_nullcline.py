"""Follow one curve on which a component of U vanishes, by predictor and corrector; compiled.

The curve lives in the closed e-disc, or outside it in the picture, where U may read x and y. Its gradient is exact.
Steps are short where it bends, and where its gradient changes much: there a neighbour is close. A curve is followed to
the border, to where it began, or to a small circle around a crossing (`crossings`).
"""

from __future__ import annotations

import math

import numpy as np

from ...formulas.interpreter import gradients
from ...formulas.jit import kernel

RHO, THETA, U1, U2 = range(4)  # kinds
MAX_STEP, MIN_STEP = 0.04, 1e-6  # steps, in units of the disc
BEND = 0.12  # radians between neighbouring points
UNEVEN = 1e-3  # a step times the radians by which it bends otherwise than the last: 100 errors of a cubic over it
BORDER, CLOSED_CURVE, CROSSING, STUCK = range(4)  # how a curve ends


@kernel
def _component_rows(op, left, right, number, roots, outside, X, Y, seed, work, rows):
    """Rows of U and their derivatives by X and Y, at a point of the e-disc or of the picture outside."""
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


@kernel
def _of_kind(kind, seed, rows):
    """Return the component and its derivatives, from the rows of U."""
    if kind >= U1:
        i = kind - U1
        return rows[i, 0], rows[i, 1], rows[i, 2]
    c, s = seed[0, 0], seed[1, 0]
    u, v = rows[0, 0], rows[1, 0]
    if kind == RHO:
        first = seed[0, 1] * u + c * rows[0, 1] + seed[1, 1] * v + s * rows[1, 1]
        second = seed[0, 2] * u + c * rows[0, 2] + seed[1, 2] * v + s * rows[1, 2]
        return c * u + s * v, first, second
    first = seed[0, 1] * v + c * rows[1, 1] - seed[1, 1] * u - s * rows[0, 1]
    second = seed[0, 2] * v + c * rows[1, 2] - seed[1, 2] * u - s * rows[0, 2]
    return c * v - s * u, first, second


@kernel
def _component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows):
    """Return a component of U and its derivatives by X and Y; seed (4, 3), work (n, 3), rows (2, 3) are scratch."""
    _component_rows(op, left, right, number, roots, outside, X, Y, seed, work, rows)
    return _of_kind(kind, seed, rows)


@kernel
def sample(op, left, right, number, roots, outside, points):
    """All four components with their derivatives at points (k, 2), (4, 3, k); NaN well beyond the disc."""
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    out = np.empty((4, 3, len(points)))
    for i in range(len(points)):
        if not outside and math.hypot(points[i, 0], points[i, 1]) > 1.07:
            out[:, :, i] = math.nan
            continue
        _component_rows(op, left, right, number, roots, outside, points[i, 0], points[i, 1], seed, work, rows)
        for kind in range(4):
            out[kind, 0, i], out[kind, 1, i], out[kind, 2, i] = _of_kind(kind, seed, rows)
    return out


@kernel
def flat_cells(parts, width):
    """Mark the cells, of that size, of a net in which a component and its gradient, parts (3, n, m), may vanish."""
    n, m = parts.shape[1] - 1, parts.shape[2] - 1
    out = np.zeros((n, m), np.bool_)
    for i in range(n):
        for j in range(m):
            steep = 0.0
            flat = True
            for k in (1, 2):
                a, b, c, d = parts[k, i, j], parts[k, i + 1, j], parts[k, i, j + 1], parts[k, i + 1, j + 1]
                low, high = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
                margin = 0.5 * (high - low)
                # so much more than the corners show, as the gradient is not quite linear; not so where it is NaN
                flat &= low - margin <= 0.0 <= high + margin
                steep += max(abs(low), abs(high))
            if not flat or not steep > 0.0:
                continue
            a, b, c, d = parts[0, i, j], parts[0, i + 1, j], parts[0, i, j + 1], parts[0, i + 1, j + 1]
            low, high = min(min(a, b), min(c, d)), max(max(a, b), max(c, d))
            out[i, j] = low <= steep * width and high >= -steep * width
    return out


@kernel
def stationary(op, left, right, number, roots, kind, outside, X, Y, reach):
    """Find a zero of the gradient by Newton's method; (ok, X, Y, value there), not ok farther than `reach` away."""
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    X0, Y0, h, step = X, Y, 1e-6, math.inf
    value, gx, gy = 0.0, 0.0, 0.0
    for _ in range(40):
        value, gx, gy = _component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows)
        _, ax, ay = _component(op, left, right, number, roots, kind, outside, X + h, Y, seed, work, rows)
        _, bx, by = _component(op, left, right, number, roots, kind, outside, X - h, Y, seed, work, rows)
        _, cx, cy = _component(op, left, right, number, roots, kind, outside, X, Y + h, seed, work, rows)
        _, dx, dy = _component(op, left, right, number, roots, kind, outside, X, Y - h, seed, work, rows)
        xx, xy, yy = (ax - bx) / (2.0 * h), (ay - by + cx - dx) / (4.0 * h), (cy - dy) / (2.0 * h)
        det = xx * yy - xy * xy
        if not (det != 0.0 and math.isfinite(det)):
            break
        sX, sY = (gx * yy - gy * xy) / det, (gy * xx - gx * xy) / det
        size = abs(sX) + abs(sY)
        if size < 1e-13 or (size < 1e-9 and size >= step):
            return True, X, Y, value
        step = size
        X, Y = X - sX, Y - sY
        if not abs(X - X0) + abs(Y - Y0) <= reach:
            return False, X, Y, value
    # three and more curves that cross make convergence slow, and then the second derivatives vanish
    return step < 1e-7 or abs(gx) + abs(gy) <= 1e-14, X, Y, value


@kernel
def _newton_along_gradient(op, left, right, number, roots, kind, outside, X, Y, reach, floor, seed, work, rows):
    """Newton's method along the gradient, within `reach`; a point of a gradient below `floor` stays where it is."""
    X0, Y0 = X, Y
    gx, gy = 0.0, 0.0
    for _ in range(10):
        g, gx, gy = _component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows)
        square = gx * gx + gy * gy
        if not math.isfinite(g + square):
            return False, X, Y, gx, gy
        if square <= floor * floor:
            return abs(g) <= floor * reach, X, Y, 0.0, 0.0
        dX, dY = g * gx / square, g * gy / square
        X, Y = X - dX, Y - dY
        if abs(X - X0) + abs(Y - Y0) > reach:
            return False, X, Y, gx, gy
        if abs(dX) + abs(dY) < 1e-10:
            break
    return True, X, Y, gx, gy


@kernel
def settle(op, left, right, number, roots, kind, outside, X, Y, reach, size):
    """Bring a point near a curve onto it; (ok, X, Y, tangent)."""
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    floor = 1e-9 * size
    ok, X, Y, gx, gy = _newton_along_gradient(
        op, left, right, number, roots, kind, outside, X, Y, reach, floor, seed, work, rows
    )
    length = math.hypot(gx, gy)
    if length == 0.0:
        return False, X, Y, 0.0, 0.0
    return ok, X, Y, -gy / length, gx / length


@kernel
def _entered_crossing(crossings, X, Y):
    """Return the crossing within whose circle a point lies, or -1."""
    for i in range(len(crossings)):
        if math.hypot(X - crossings[i, 0], Y - crossings[i, 1]) < crossings[i, 2]:
            return i
    return -1


@kernel
def _short_of(crossings, X, Y, h):
    """Return a step, at most h, that does not leap over the circle around a crossing."""
    for i in range(len(crossings)):
        gap = math.hypot(X - crossings[i, 0], Y - crossings[i, 1]) - crossings[i, 2]
        h = min(h, max(gap, 0.0) + crossings[i, 2])
    return h


@kernel
def _tangent(gx, gy, tx, ty):
    """Return the unit vector across a gradient, in the sense of a tangent before, and the angle from that to it."""
    length = math.hypot(gx, gy)
    if length == 0.0:
        return tx, ty, 0.0
    nx, ny = -gy / length, gx / length
    if nx * tx + ny * ty < 0.0:
        nx, ny = -nx, -ny
    return nx, ny, math.atan2(tx * ny - ty * nx, tx * nx + ty * ny)


@kernel
def _leaps(gx, gy, slope_X, slope_Y):
    """Whether a gradient has changed so much that another branch is close by."""
    change = math.hypot(gx - slope_X, gy - slope_Y)
    return change > 0.5 * min(math.hypot(gx, gy), math.hypot(slope_X, slope_Y))


@kernel
def _home_ahead(home, X, Y, tx, ty, h):
    """Whether the curve, at a point with that tangent, closes within a step at `home`; and how far ahead that is."""
    away_X, away_Y = home[0] - X, home[1] - Y
    near = math.hypot(away_X, away_Y) < h and tx * home[2] + ty * home[3] > 0.8
    return near and abs(away_X * ty - away_Y * tx) < 0.3 * h, away_X * tx + away_Y * ty


@kernel
def trace_nullcline(op, left, right, number, roots, kind, outside, start, home, crossings, largest, size, out):
    """Follow a curve from a point on it."""
    seed, work, rows = np.zeros((4, 3)), np.empty((len(op), 3)), np.empty((2, 3))
    floor = 1e-9 * size
    most = largest if outside else 1.0
    X, Y, tx, ty = start[0], start[1], start[2], start[3]
    out[0] = start
    _, slope_X, slope_Y = _component(op, left, right, number, roots, kind, outside, X, Y, seed, work, rows)
    leaving = _entered_crossing(crossings, X, Y)  # by rounding, at its circle
    count, h, bend = 1, 0.25 * MAX_STEP, 0.0
    from_home = home[0] == start[0] and home[1] == start[1]
    while count < len(out) - 1:
        h = _short_of(crossings, X, Y, h)
        ok, nX, nY, gx, gy = _newton_along_gradient(
            op, left, right, number, roots, kind, outside, X + h * tx, Y + h * ty, 0.3 * h, floor, seed, work, rows
        )
        nx, ny, turn = _tangent(gx, gy, tx, ty)
        uneven = count > 1 and abs(turn - bend * h) * h > UNEVEN
        if not ok or abs(turn) > BEND or _leaps(gx, gy, slope_X, slope_Y) or uneven:
            h *= 0.5
            if h < MIN_STEP:
                return count, STUCK, -1
            continue
        r = math.hypot(nX, nY)
        which = _entered_crossing(crossings, nX, nY)
        if which >= 0 and which == leaving and count == 1:
            which = -1
        if r > most or (outside and r < 1.0) or which >= 0:
            ending = CROSSING if which >= 0 else BORDER
            cX, cY, radius = 0.0, 0.0, most if r > most else 1.0
            if which >= 0:
                cX, cY, radius = crossings[which, 0], crossings[which, 1], crossings[which, 2]
            out[count] = out[count - 1]
            _to_circle(
                op, left, right, number, roots, kind, outside, h, cX, cY, radius, floor, seed, work, rows, out[count]
            )
            return count + 1, ending, which
        X, Y, tx, ty, slope_X, slope_Y = nX, nY, nx, ny, gx, gy
        out[count, 0], out[count, 1], out[count, 2], out[count, 3] = X, Y, tx, ty
        count += 1
        closes, ahead = _home_ahead(home, X, Y, tx, ty, h)
        if closes and (count > 3 or not from_home):
            if ahead < 0.25 * h and count > 1:  # the last point is at home or past it
                count -= 1
            out[count] = home
            return count + 1, CLOSED_CURVE, -1
        bend = turn / h
        if abs(turn) < 0.4 * BEND:
            h = min(1.5 * h, MAX_STEP)
    return count, STUCK, -1


@kernel
def _to_circle(op, left, right, number, roots, kind, outside, h, cX, cY, radius, floor, seed, work, rows, last):
    """Move the last point on along the curve, by less than h, to where it meets a circle."""
    X, Y, tx, ty = last[0], last[1], last[2], last[3]
    outwards = math.hypot(X - cX, Y - cY) <= radius
    pX, pY = X + 0.5 * h * tx, Y + 0.5 * h * ty
    converged = False
    gx, gy = 0.0, 0.0
    for _ in range(12):
        g, gx, gy = _component(op, left, right, number, roots, kind, outside, pX, pY, seed, work, rows)
        qx, qy = pX - cX, pY - cY
        q = 0.5 * (qx * qx + qy * qy - radius * radius)
        det = gx * qy - gy * qx
        if not (det != 0.0 and math.isfinite(det + g)):
            break
        dX, dY = (g * qy - q * gy) / det, (q * gx - g * qx) / det
        pX, pY = pX - dX, pY - dY
        if not math.hypot(pX - X, pY - Y) < 1.5 * h:
            break
        if abs(dX) + abs(dY) < 1e-12:
            converged = (pX - X) * tx + (pY - Y) * ty > -1e-9
            break
    if not converged:
        low, high = 0.0, h
        pX, pY = X, Y
        for _ in range(40):
            middle = 0.5 * (low + high)
            ok, nX, nY, ax, ay = _newton_along_gradient(
                op, left, right, number, roots, kind, outside, X + middle * tx, Y + middle * ty, 0.3 * h, floor, seed,
                work, rows,
            )  # fmt: skip
            if not ok or (math.hypot(nX - cX, nY - cY) <= radius) != outwards:
                high = middle
            else:
                low, pX, pY, gx, gy = middle, nX, nY, ax, ay
    last[0], last[1] = pX, pY
    last[2], last[3], _ = _tangent(gx, gy, tx, ty)
