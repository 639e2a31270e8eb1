"""The ring of a certificate at the closed equator, where a function rises, or falls, along all orbits."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...psi.kernel import VECTOR
from .fields import fields
from .flow import Flow, Place, Undecided
from .rings import Loop, Ring, loop

Array = NDArray[np.float64]

OUTER = np.arange(1.0, 27.0, 1.0)  # heights where a ring at the equator may begin
DIRECTIONS = 2048
FINE = (0.2, 0.05, 0.0125, 0.003)  # the angle of an edge there: as fine as it must be
DEFINITE = 0.2  # of the mean


def split(places: list[Place], angle: float) -> list[Place]:
    """Add places to the straight edges of a closed way until each is seen from the origin under a small angle."""
    found = []
    for (x, y), (X, Y) in pairwise(places):
        count = max(1, math.ceil(abs(math.atan2(x * Y - X * y, x * X + y * Y)) / angle))
        found += [(x + (X - x) * k / count, y + (Y - y) * k / count) for k in range(count)]
    return [*found, places[0]]


def at_equator(flow: Flow, beyond: float) -> list[Ring]:
    """Find a ring at the closed equator, beyond a distance from C, along which a function rises or falls; else [].

    On the equator ``d ln|x2| = lambda_rho/Theta dtheta``. With ``h(x2)`` of degree 1 and ``ln h = ln|x2| + H(theta)``,
    ``ln h - 2 ln q`` has the derivative ``-mean`` there if ``Theta dH/dtheta = lambda_rho - mean``.
    """
    a, b, c, d, f, g = flow.numbers
    theta = np.linspace(0.0, math.tau, DIRECTIONS + 1)
    cosine, sine = np.cos(theta), np.sin(theta)
    u, v = a * cosine + b * sine + f, c * cosine + d * sine + g
    radial, turning = cosine * u + sine * v, cosine * v - sine * u
    if not (turning > 0.0).all():
        return []

    def integral(values: Array) -> Array:
        steps = 0.5 * (values[1:] + values[:-1]) * (math.tau / DIRECTIONS)
        return np.concatenate([[0.0], np.cumsum(steps)])

    growth, time = integral(radial / turning), integral(1.0 / turning)
    mean = float(growth[-1] / time[-1])
    H = growth - mean * time
    for height in OUTER.tolist():
        r = flow.at_height(height)
        if r <= beyond:
            continue
        way = loop(flow, r, flow.closing(r))
        if way is None:
            continue
        for fine in FINE:
            places = np.array(split(way.places, fine))
            angle = np.arctan2(places[:, 1], places[:, 0]) % math.tau
            h = np.hypot(*places.T) * np.exp(np.interp(angle, theta, H))
            h[-1] = h[0]
            if (_rise(flow, places, h) * -mean).min() > DEFINITE * mean * mean:
                inner = Loop(r, [(x, y) for x, y in places.tolist()])
                layers = [[[x, y, w] for x, y in inner.places] for w in (1.0, 0.0)]
                path, sign = [0, 1] * (len(places) - 1), -1 if mean > 0.0 else 1
                return [Ring(inner, Loop(flow.reach, []), layers, [h.tolist()] * 2, [path], sign, (0, -2), (0.0, 0.0))]
    raise Undecided("proof fails at the equator")


def _rise(flow: Flow, places: Array, h: Array) -> Array:
    """Return the derivative of ln h - 2 ln q at some places of the sectors between neighbouring directions."""
    (x, y), (X, Y) = places[:-1].T, places[1:].T
    size = x * Y - X * y
    if not (size > 0.0).all():
        return np.zeros(1)
    slope = np.stack([h[:-1] * Y - h[1:] * y, x * h[1:] - X * h[:-1]], axis=1) / size[:, None]
    found = []
    for far in (1.0, 1.5, 3.0, 10.0, 100.0, 1e5):
        for end in (places[:-1], places[1:]):
            F, _ = fields(flow.psi, flow.numbers, far * end)
            beta, q = _flat(flow, far * end)
            e = far * end / q[:, None]
            U = F / q[:, None]
            found.append((slope * U).sum(axis=1) / (slope * e).sum(axis=1) - 2.0 * beta * (e * U).sum(axis=1))
    return np.concatenate(found)


def _flat(flow: Flow, places: Array) -> tuple[Array, Array]:
    """Return 1 + Psi' and q at x2."""
    s = (places**2).sum(axis=1)
    with np.errstate(all="ignore"):
        slope, value = flow.psi.kernel.slope(VECTOR, s), flow.psi.kernel.value(VECTOR, s)
    return 1.0 + slope, np.sqrt(s + value)
