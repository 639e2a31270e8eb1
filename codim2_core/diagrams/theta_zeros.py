"""Zeros of Theta at many parameter values at once, and where along the parameter they meet.

``Theta = b + f2 cos - f1 sin + (d - a) sin cos`` (eq:equator_zeros).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..numerics.trigonometric import real_zeros, tangential_zeros
from .test_functions import Plane, SystemPath

__all__ = ["MultipleZero", "lambda_rho", "multiple_zeros", "theta_slope", "theta_value", "theta_zeros"]


_NET_STEP = 2.0 * math.pi / 256
_NET_ANGLES = _NET_STEP * (np.arange(256) + 0.2719)
_TRIGONOMETRIC_NET = np.stack(
    [np.ones(256), np.cos(_NET_ANGLES), np.sin(_NET_ANGLES), 0.5 * np.sin(2.0 * _NET_ANGLES)], axis=1
)


class MultipleZero(NamedTuple):
    """A multiple zero of Theta: its kind, the parameter's value and the direction."""

    kind: str
    value: float
    theta: float


def theta_value(plane: Plane, theta: Array) -> Array:
    """Theta; theta of shape (k,) or (k, j)."""
    a, b, d, f1, f2 = _plane_columns(plane, theta)
    c, s = np.cos(theta), np.sin(theta)
    return b + f2 * c - f1 * s + (d - a) * s * c


def theta_slope(plane: Plane, theta: Array) -> Array:
    """lambda_theta = dTheta/dtheta."""
    a, _, d, f1, f2 = _plane_columns(plane, theta)
    c, s = np.cos(theta), np.sin(theta)
    return (d - a) * (c - s) * (c + s) - f2 * s - f1 * c


def lambda_rho(plane: Plane, theta: Array) -> Array:
    """lambda_rho = e.U."""
    a, _, d, f1, f2 = _plane_columns(plane, theta)
    c, s = np.cos(theta), np.sin(theta)
    return a * c * c + d * s * s + f1 * c + f2 * s


def _plane_columns(plane: Plane, theta: Array) -> tuple[Array, ...]:
    return tuple(v[:, None] for v in plane.arrays) if theta.ndim == 2 else plane.arrays


def theta_zeros(plane: Plane, count: int) -> Array:
    """All zeros at each value, where it is known that there are `count` simple ones.

    Parameters
    ----------
    plane : Plane
    count : int

    Returns
    -------
    ndarray (k, count)
        In [0, 2 pi), increasing.
    """
    k = len(plane)
    if not count or not k:
        return np.zeros((k, count))
    values = _theta_rows(plane) @ _TRIGONOMETRIC_NET.T
    row, place = np.nonzero(values * np.roll(values, -1, axis=1) <= 0.0)
    seen = (np.bincount(row, minlength=k) == count)[row]
    theta = np.full((k, count), np.nan)
    theta[np.unique(row[seen])] = _NET_ANGLES[place[seen]].reshape(-1, count) + 0.5 * _NET_STEP
    with np.errstate(all="ignore"):
        for _ in range(6):
            theta = theta - np.clip(theta_value(plane, theta) / theta_slope(plane, theta), -_NET_STEP, _NET_STEP)
        size = np.sum([abs(v) for v in plane.arrays], axis=0)
        off = abs(theta_value(plane, theta)) > 1e-12 * size[:, None]
        theta = np.sort(theta % (2.0 * math.pi), axis=1)
        gaps = np.diff(theta, axis=1, append=theta[:, :1] + 2.0 * math.pi)
        doubtful = off.any(axis=1) | ~np.isfinite(theta).all(axis=1) | (gaps < 1e-5).any(axis=1)
    for i in np.flatnonzero(doubtful):
        a, b, d, f1, f2 = (float(v[i]) for v in plane.arrays)
        exact = tangential_zeros(a, b, d, f1, f2)
        found = [t for t, m in zip(exact.theta, exact.multiplicity, strict=True) for _ in range(m)]
        theta[i] = np.resize(found or [0.0], count) if len(found) != count else found
    return theta


def multiple_zeros(path: SystemPath, span: tuple[float, float], near: Array, step: float) -> list[MultipleZero]:
    """Find where zeros of Theta meet, near some values of the parameter.

    From each extremum of Theta that is small enough, Newton's method solves Theta = Theta' = 0 (saddle-node). Where
    that is singular or does not settle, Theta = Theta' = Theta'' = 0 is tried (triple: least squares), and
    Theta' = dTheta/dv = 0 (zeros that pass through each other). All starts are worked on at once.

    Parameters
    ----------
    path : callable
        From values (k,) to Plane.
    span : (float, float)
    near : ndarray (k,)
        Values to start from.
    step : float
        How far from `near` a meeting may be.

    Returns
    -------
    list of MultipleZero
        By increasing value; kinds "saddle-node", "triple", "exchange", and "touch" if no other zero is near beside it.
    """
    theta0, value0 = _starts(path, near, step, span)
    if not len(theta0):
        return []
    width = span[1] - span[0]
    found: list[MultipleZero] = []

    def add(kind: str, theta: Array, value: Array, good: NDArray[np.bool_]) -> None:
        for t, v in zip(theta[good].tolist(), value[good].tolist(), strict=True):
            for m in found:
                apart, turn = abs(m.value - v) / width, abs(math.remainder(m.theta - t, 2.0 * math.pi))
                # Newton's method is blurred about the zeros of higher order, which were found first
                if (apart <= 1e-10 and turn <= 1e-6) or (m.kind != kind and apart <= 1e-5 and turn <= 1e-2):
                    break
            else:
                found.append(MultipleZero(_name_crossing(kind, path, span, t, v), v, t % (2.0 * math.pi)))

    plain = _solve("saddle-node", path, span, theta0, value0, 1.5 * step)
    rest = ~plain.regular
    if rest.any():
        for kind in ("triple", "exchange"):
            special = _solve(kind, path, span, theta0[rest], value0[rest], 1.5 * step)
            add(kind, special.theta, special.value, special.good)
    add("saddle-node", plain.theta, plain.value, plain.good)
    return sorted(found, key=lambda m: (m.value, m.theta))


def _starts(path: SystemPath, near: Array, step: float, span: tuple[float, float]) -> tuple[Array, Array]:
    """Extrema of Theta that may become zero within a step."""
    rows, first, second = _theta_coefficients(path, span, near)
    most = 2.0 * abs(first).sum(axis=1) * step + 4.0 * abs(second).sum(axis=1) * step**2 + 1e-9 * abs(rows).sum(axis=1)
    theta: list[float] = []
    value: list[float] = []
    for i, v in enumerate(near.tolist()):
        b, f2, f1, k = rows[i].tolist()
        for t in real_zeros(0.0, f1, -f2, k, 0.0).theta:
            if abs(b + f2 * math.cos(t) + f1 * math.sin(t) + 0.5 * k * math.sin(2.0 * t)) <= most[i]:
                theta.append(t)
                value.append(v)
    return np.array(theta), np.array(value)


def _name_crossing(kind: str, path: SystemPath, span: tuple[float, float], theta: float, value: float) -> str:
    """Tell two zeros that pass through each other from two that exist at one value only: a saddle or an extremum."""
    if kind != "exchange":
        return kind
    rows, first, second = _theta_coefficients(path, span, np.array([value]))
    basis = _basis(np.array([theta]))
    bend = (basis[2] * rows).sum() * (basis[0] * second).sum() - (basis[1] * first).sum() ** 2
    return "exchange" if bend <= 0.0 else "touch"


def _theta_rows(plane: Plane) -> Array:
    """Coefficients (k, 4) of Theta in 1, cos, sin, sin cos."""
    a, b, d, f1, f2 = plane.arrays
    return np.stack([b, f2, -f1, d - a], axis=1)


def _basis(theta: Array) -> Array:
    """1, cos, sin, sin cos and their first three derivatives, (4, k, 4)."""
    c, s, c2, s2 = np.cos(theta), np.sin(theta), np.cos(2.0 * theta), np.sin(2.0 * theta)
    one, zero = np.ones_like(c), np.zeros_like(c)
    return np.stack(
        [
            np.stack([one, c, s, 0.5 * s2], axis=-1),
            np.stack([zero, -s, c, c2], axis=-1),
            np.stack([zero, -c, -s, -2.0 * s2], axis=-1),
            np.stack([zero, s, -c, -4.0 * c2], axis=-1),
        ]
    )


def _theta_coefficients(path: SystemPath, span: tuple[float, float], value: Array) -> tuple[Array, Array, Array]:
    """Coefficients of Theta with their first and second derivative along the path, by differences of order 6."""
    if path.affine:
        unit = np.array([[float(path.names[0] == name) for name in ("b", "f2", "f1", "d")]]) * [1.0, 1.0, -1.0, 1.0]
        unit[0, 3] -= path.names[0] == "a"
        return _theta_rows(path(value)), np.repeat(unit, len(value), axis=0), np.zeros((len(value), 4))
    width = span[1] - span[0]
    step = np.clip(np.minimum(value - span[0], span[1] - value) / 3.0, 1e-6 * width, 2e-3 * width)
    at = value + step * np.arange(-3, 4)[:, None]
    rows = _theta_rows(path(at.ravel())).reshape(7, len(value), 4)
    first = np.tensordot(np.array([-1, 9, -45, 0, 45, -9, 1]) / 60.0, rows, 1) / step[:, None]
    second = np.tensordot(np.array([2, -27, 270, -490, 270, -27, 2]) / 180.0, rows, 1) / step[:, None] ** 2
    return rows[3], first, second


class _SettledZeros(NamedTuple):
    theta: Array
    value: Array
    good: NDArray[np.bool_]  # Theta has a multiple zero there
    regular: NDArray[np.bool_]  # and the equations are far from singular


def _solve(
    kind: str, path: SystemPath, span: tuple[float, float], theta: Array, value: Array, reach: float
) -> _SettledZeros:
    """Newton's or Gauss and Newton's method."""
    start, width = value, span[1] - span[0]
    for _ in range(10):
        rows, first, second = _theta_coefficients(path, span, value)
        basis = _basis(theta)
        t0, t1, t2, t3 = (basis * rows).sum(axis=-1)
        v0, v1, v2, _ = (basis * first).sum(axis=-1)
        # rows of the system: residual, derivative by theta, derivative by value
        if kind == "saddle-node":
            r, x, y = np.stack([[t0, t1], [t1, t2], [v0, v1]])
        elif kind == "triple":
            r, x, y = np.stack([[t0, t1, t2], [t1, t2, t3], [v0, v1, v2]])
        else:
            r, x, y = np.stack([[t1, v0], [t2, v1], [v1, (basis[0] * second).sum(axis=-1)]])
        if kind == "triple":
            xx, xy, yy, rx, ry = (x * x).sum(0), (x * y).sum(0), (y * y).sum(0), (r * x).sum(0), (r * y).sum(0)
            det, up, across = xx * yy - xy * xy, rx * yy - ry * xy, xx * ry - xy * rx
        else:
            det, up, across = x[0] * y[1] - x[1] * y[0], r[0] * y[1] - r[1] * y[0], x[0] * r[1] - x[1] * r[0]
        safe = np.where(det != 0.0, det, np.inf)
        up, across = np.clip(up / safe, -0.5, 0.5), np.clip(across / safe, -0.1 * width, 0.1 * width)
        theta, value = theta - up, np.clip(value - across, *span)
        if (abs(up).max() < 1e-15) and (abs(across).max() <= 1e-16 * width):
            break
    rows, first, _ = _theta_coefficients(path, span, value)
    basis = _basis(theta)
    t0, t1, t2, _ = abs((basis * rows).sum(axis=-1))
    v0 = abs((basis[0] * first).sum(axis=-1)) * width
    size, change = abs(rows).sum(axis=1) + 1e-300, abs(first).sum(axis=1) * width
    good = (t0 <= 1e-13 * size) & (t1 <= 1e-10 * size) & (abs(value - start) <= reach) & (abs(rows).max(axis=1) > 0.0)
    if kind == "triple":
        good &= t2 <= 1e-9 * size
    if kind == "exchange":
        good &= v0 <= 1e-10 * (change + size)
    regular = good & (t2 > 1e-3 * size) & (v0 > np.maximum(1e-3 * change, 1e-4 * size))
    return _SettledZeros(theta, value, good, regular)
