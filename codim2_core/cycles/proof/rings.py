"""Rings of a certificate: about C, where there is no cycle, and about each cycle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .fields import fields, mean_divergence
from .flow import Flow, Place, Undecided
from .mesh import Way, closed, directions, mesh, sampled, spread
from .weights import weights

Array = NDArray[np.float64]

#: How much a step along a turned orbit may turn: a part of its angle, and at most. It may be exceeded by 1.3, and no
#: edge may turn by the whole angle.
TURNED, LONGEST = 0.75, 0.2
GAP = 0.05  # in `height`, of the angle: what is left open where a loop is closed by hand
WIDTHS = (0.4, 0.2, 0.1, 0.05, 0.025, 0.0125)  # of a ring about a cycle, to either side, in `height`
MESHES = ((2, 100), (4, 400), (8, 1200))  # strips, and places along each way inside: as fine as it must be
SMOOTH = 0.01  # turning of an edge of an orbit that is followed to be sampled
ROUND = 0.06  # how much an edge of a ring about a cycle may turn
DEFINITE = 0.2  # of the divergence at C
NARROWER = 0.6


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
        From the inside to the outside; C alone is the innermost of a ring about it.
    h : list of lists
        The weight at each corner.
    paths : list of list of int
        For each two neighbours which of them goes on, triangle by triangle: 0 the inner one, 1 the outer one.
    sign : int
        Of what is shown to have one sign.
    kind : (k, j)
        (1, 0): the divergence with the weight exp(h); (0, -2): the derivative of ln h - 2 ln q.
    middle : (x, y)
        Seen from there, each layer goes on to the left.
    """

    inner: Loop
    outer: Loop
    layers: list[list[list[float]]]
    h: list[list[float]]
    paths: list[list[int]]
    sign: int
    kind: tuple[int, int]
    middle: tuple[float, float]


def loop(flow: Flow, r: float, angle: float, longest: float = LONGEST) -> Loop | None:
    """Follow the turned orbit that closes at r, as a polygon that all orbits cross; None where it does not close."""
    places, end = flow.turn(r, angle, min(TURNED * abs(angle), longest))
    if not 0.0 < end < flow.reach or abs(flow.height(end) - flow.height(r)) > GAP * abs(angle):
        return None
    return Loop(r, [*places[:-1], places[0]])


def about_C(flow: Flow, first: float) -> Ring:
    """Find a ring about C, inside the first cycle, in which the divergence has one sign."""
    C = np.array(flow.C)
    at_C = float(fields(flow.psi, flow.numbers, C[None])[1][0])
    sign = 1 if at_C > 0.0 else -1
    r = min(0.5 * first, 0.3 * flow.reach)
    while r > 1e-5 * flow.reach:
        way = loop(flow, r, flow.closing(r))
        places = np.array([] if way is None else way.places).reshape(-1, 2)
        inside = np.concatenate([C + share * (places - C) for share in (0.3, 0.65, 1.0)])
        if way is not None and (sign * fields(flow.psi, flow.numbers, inside)[1]).min() > DEFINITE * abs(at_C):
            layers = [[[*flow.C, 1.0]], [[x, y, 1.0] for x, y in way.places]]
            path = [1] * (len(places) - 1)
            return Ring(Loop(0.0, []), way, layers, [[0.0], [0.0] * len(places)], [path], sign, (1, 0), flow.C)
        r *= NARROWER
    raise Undecided("proof fails at C")


def about(flow: Flow, height: float, room_in: float, room_out: float) -> Ring:
    """Find a ring about a cycle at this height, in which the weighted divergence has one sign."""
    orbit = _orbit(flow, height, 0.0)
    middle, mean = orbit[:-1].mean(axis=0), mean_divergence(flow.psi, flow.numbers, orbit)
    toward = directions(flow, orbit, middle)
    if toward is None:
        raise Undecided("proof fails at a cycle")
    for width in WIDTHS:
        first, last = height - min(width, room_in), height + min(width, room_out)
        ends = [_end(flow, one) for one in (first, last)]
        inner, outer = (one for one, _ in ends)
        if inner is None or outer is None or ends[0][1] * ends[1][1] >= 0.0:
            continue
        walls = [closed(flow, np.array(one.places), middle, toward[0]) for one in (inner, outer)]
        for strips, count in MESHES:
            at = spread(flow, orbit, toward, count)
            between = [_layer(flow, one, middle, at) for one in np.linspace(first, last, strips + 1)[1:-1].tolist()]
            ways = [walls[0], *between, walls[1]]
            known = [way for way in ways if way is not None]
            if len(known) < len(ways):
                break
            found = mesh(known)
            h = weights(flow, found, mean)
            if h is not None:
                layers = [[[x, y, 1.0] for x, y in way.places.tolist()] for way in known]
                sign, center = 1 if mean > 0.0 else -1, (float(middle[0]), float(middle[1]))
                return Ring(inner, outer, layers, h, found.paths, sign, (1, 0), center)
    raise Undecided("proof fails at a cycle")


def _end(flow: Flow, height: float) -> tuple[Loop | None, float]:
    r = flow.at_height(height)
    angle = flow.closing(r)
    return loop(flow, r, angle, ROUND), angle


def _orbit(flow: Flow, height: float, angle: float) -> Array:
    """Return the closed orbit of the turned field through a place, at many places."""
    places, _ = flow.turn(flow.at_height(height), angle, SMOOTH)
    return np.array([*places[:-1], places[0]])


def _layer(flow: Flow, height: float, middle: Array, at: Array) -> Way | None:
    """Return a way inside a ring at a height of the section, in these directions."""
    orbit = _orbit(flow, height, flow.closing(flow.at_height(height)))
    way = closed(flow, orbit, middle, float(at[0]))
    return None if way is None else sampled(way, at)
