"""Rings of a certificate: about C and at the equator, where there is no cycle, and about each cycle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .flow import Flow, Place, Undecided
from .weights import VARIES, fields, mean_divergence, refined, weights, zipped

Array = NDArray[np.float64]

TURNED, LONGEST = 0.7, 0.2  # how much an edge of a turned orbit may turn: a part of its angle, and at most
GAP = 0.05  # in `height`, of the angle: what is left open where a loop is closed by hand
LAYERS = 4
WIDEST, LEAST_WIDTH, NARROWER = 0.4, 2e-3, 0.6  # of a ring about a cycle, to either side, in `height`
DEFINITE = 0.2  # of the divergence at C, and of the mean on the equator
OUTER = np.arange(1.0, 27.0, 1.0)  # heights where a ring at the equator may begin
DIRECTIONS = 2048
FINE = 0.08  # of the mean on the equator: the angle of an edge there


@dataclass(frozen=True)
class Loop:
    """A closed polygon that all orbits cross to one side; it starts on the section, at the distance r from C in e."""

    r: float
    places: list[Place]


@dataclass(frozen=True)
class Ring:
    """What lies between two closed ways: about C, between two loops, or between a loop and the equator.

    Attributes
    ----------
    inner, outer : Loop
        C itself, and the equator, have r = 0 and r = reach, and no places.
    layers : list of closed ways, each corner (X, Y, W)
        All of one length, from the inside to the outside: places are repeated where another way goes on.
    h : list of lists
        The weight at each corner.
    sign : int
        Of what is shown to have one sign.
    kind : (k, j)
        (1, 0): the divergence with the weight exp(h); (0, -2): the derivative of ln h - 2 ln q.
    """

    inner: Loop
    outer: Loop
    layers: list[list[list[float]]]
    h: list[list[float]]
    sign: int
    kind: tuple[int, int]


def loop(flow: Flow, r: float, angle: float) -> Loop | None:
    """Follow the turned orbit that closes at r, as a polygon that all orbits cross; None where it does not close."""
    places, end = flow.turn(r, angle, min(TURNED * abs(angle), LONGEST))
    if not 0.0 < end < flow.reach or abs(flow.height(end) - flow.height(r)) > GAP * abs(angle):
        return None
    return Loop(r, [*places[:-1], places[0]])


def indices(ways: list[list[Place]]) -> list[tuple[int, ...]]:
    """Return places of all ways at once, from neighbour to neighbour: one of the ways goes on at a time."""
    found: list[tuple[int, ...]] = [(i,) for i in range(len(ways[0]))]
    for near, far in pairwise(ways):
        beside: list[list[int]] = [[] for _ in near]
        for i, j in zip(*zipped(near, far), strict=True):
            beside[i].append(j)
        joined = []
        for one, after in zip(found, [*found[1:], None], strict=True):
            i = one[-1]
            joined.append((*one, beside[i][0]))
            if after is None or after[-1] != i:
                joined += [(*one, j) for j in beside[i][1:]]
        found = joined
    return found


def split(places: list[Place], angle: float) -> list[Place]:
    """Add places to the straight edges of a closed way until each is seen from the origin under a small angle."""
    found = []
    for (x, y), (X, Y) in pairwise(places):
        count = max(1, math.ceil(abs(math.atan2(x * Y - X * y, x * X + y * Y)) / angle))
        found += [(x + (X - x) * k / count, y + (Y - y) * k / count) for k in range(count)]
    return [*found, places[0]]


def about_C(flow: Flow, first: float) -> Ring:
    """Find a ring about C, inside the first cycle, in which the divergence has one sign."""
    C = np.array(flow.C)
    at_C = float(fields(flow, C[None])[1][0])
    sign = 1 if at_C > 0.0 else -1
    r = min(0.5 * first, 0.3 * flow.reach)
    while r > 1e-5 * flow.reach:
        way = loop(flow, r, flow.closing(r))
        places = np.array([] if way is None else way.places).reshape(-1, 2)
        inside = np.concatenate([C + share * (places - C) for share in (0.3, 0.65, 1.0)])
        if way is not None and (sign * fields(flow, inside)[1]).min() > DEFINITE * abs(at_C):
            layers = [[[*flow.C, 1.0]] * len(places), [[x, y, 1.0] for x, y in way.places]]
            return Ring(Loop(0.0, []), way, layers, [[0.0] * len(places)] * 2, sign, (1, 0))
        r *= NARROWER
    raise Undecided("proof fails at C")


def about(flow: Flow, height: float, room_in: float, room_out: float) -> Ring:
    """Find a ring about a cycle at this height, in which the weighted divergence has one sign."""
    orbit, _ = flow.turn(flow.at_height(height), 0.0, 0.03)
    mean = mean_divergence(flow, [*orbit[:-1], orbit[0]])
    width = WIDEST
    while width > LEAST_WIDTH:
        ends = height - min(width, room_in), height + min(width, room_out)
        r = [flow.at_height(one) for one in np.linspace(*ends, LAYERS + 1).tolist()]
        angles = [flow.closing(one) for one in r]
        width *= NARROWER
        if angles[0] * angles[-1] >= 0.0:
            continue
        ends_closed = loop(flow, r[0], angles[0]), loop(flow, r[-1], angles[-1])
        if ends_closed[0] is None or ends_closed[1] is None:
            continue
        inner, outer = (Loop(one.r, refined(flow, one.places, VARIES * abs(mean))) for one in ends_closed if one)
        ways = [inner.places]
        for one, angle in zip(r[1:-1], angles[1:-1], strict=True):
            places, _ = flow.turn(one, angle)
            ways.append(refined(flow, [*places[:-1], places[0]], VARIES * abs(mean)))
        ways.append(outer.places)
        h = weights(flow, ways, mean)
        if h is not None:
            along = indices(ways)
            layers = [[[*ways[k][one[k]], 1.0] for one in along] for k in range(len(ways))]
            spread = [[h[k][one[k]] for one in along] for k in range(len(ways))]
            return Ring(inner, outer, layers, spread, 1 if mean > 0.0 else -1, (1, 0))
    raise Undecided("proof fails at a cycle")


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
        places = np.array(split(refined(flow, way.places, VARIES * abs(mean)), max(FINE * abs(mean), 0.002)))
        angle = np.arctan2(places[:, 1], places[:, 0]) % math.tau
        h = np.hypot(*places.T) * np.exp(np.interp(angle, theta, H))
        h[-1] = h[0]
        if (_rise(flow, places, h) * -mean).min() > DEFINITE * mean * mean:
            points = places.tolist()
            layers = [[[x, y, w] for x, y in points for _ in range(2)] for w in (1.0, 0.0)]
            layers = [layers[0][1:], layers[1][:-1]]
            spread = [[one for one in h.tolist() for _ in range(2)] for _ in range(2)]
            inner = Loop(r, [(x, y) for x, y in points])
            return [
                Ring(
                    inner,
                    Loop(flow.reach, []),
                    layers,
                    [spread[0][1:], spread[1][:-1]],
                    -1 if mean > 0.0 else 1,
                    (0, -2),
                )
            ]
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
            F, _ = fields(flow, far * end)
            beta, q = _flat(flow, far * end)
            e = far * end / q[:, None]
            U = F / q[:, None]
            found.append((slope * U).sum(axis=1) / (slope * e).sum(axis=1) - 2.0 * beta * (e * U).sum(axis=1))
    return np.concatenate(found)


def _flat(flow: Flow, places: Array) -> tuple[Array, Array]:
    """Return 1 + Psi' and q at x2."""
    from ...psi.kernel import VECTOR

    s = (places**2).sum(axis=1)
    with np.errstate(all="ignore"):
        slope, value = flow.psi.kernel.slope(VECTOR, s), flow.psi.kernel.value(VECTOR, s)
    return 1.0 + slope, np.sqrt(s + value)
