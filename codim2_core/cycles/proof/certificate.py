"""A certificate of limit cycles: ways that all orbits cross to one side, and rings between them, from C to the equator.

Along the section the angle that closes an orbit (`flow`) has one sign between cycles. There an orbit of the field that
is turned by half of it spirals from one ring to the next, and back along the section, where orbits cross to the same
side: a closed way. Beyond the last ring it spirals to a ring at the closed equator, or until it can be led round an
attracting, or repelling, limit direction onto the equator.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from ...layer_problem.problem import LayerProblem
from .equator_ring import at_equator
from .flow import Flow, Place, Undecided
from .rings import LONGEST, TURNED, Ring, about, about_C

BEYOND = 3.0  # |x2| from which on a way may be led to the equator
LEAVES = 0.02  # of the size of U: how fast orbits go out there, and on the equator round

Way = list[list[float]]
Written = dict[str, Any]


def finite(places: list[Place]) -> Way:
    """Return places of the plane as the certificate writes them."""
    return [[x, y, 1.0] for x, y in places]


def spiral(flow: Flow, r: float, until: float, outward: bool) -> tuple[list[Place], float]:
    """Follow U in kappa_2, turned by half of what would close it, from the distance r beyond another."""
    places, angle = [flow.place(r)], 0.0
    while r < until if outward else r > until:
        angle = flow.closing(r, angle, 0.02)
        if (angle > 0.0) != outward:
            raise Undecided("proof meets a cycle")
        found, r = flow.turn(r, 0.5 * angle, min(TURNED * 0.5 * abs(angle), LONGEST))
        if r in (0.0, flow.reach):
            raise Undecided("proof meets a cycle")
        places += found[1:]
    return places, r


def between(flow: Flow, inner: Ring, outer: Ring, outward: bool) -> Way:
    """Join the outer way of a ring and the inner way of the next by one closed way that orbits cross to one side."""
    first, then = (inner.outer, outer.inner) if outward else (outer.inner, inner.outer)
    places, r = spiral(flow, first.r, then.r, outward)
    back = flow.way(r, then.r)[:-1] if r != then.r else []
    home = flow.way(then.r, first.r)[:-1]
    return finite([*first.places, *places[1:], *back, *then.places, *home, first.places[0]])


def led_out(flow: Flow, x: float, y: float, outward: bool) -> Way | None:
    """Lead a way from a place far out along a circle, and then straight to the equator; None if it cannot be led."""
    radius, angle = math.hypot(x, y), math.atan2(y, x)
    if radius < BEYOND:
        return None
    a, b, c, d, f, g = flow.numbers
    step, found = 0.02 if outward else -0.02, Way()
    for k in range(200):
        cosine, sine = math.cos(angle + k * step), math.sin(angle + k * step)
        if k:
            found.append([radius * cosine, radius * sine, 1.0])
        u, v = flow.velocity(radius * cosine, radius * sine)
        out, turning = u * cosine + v * sine, v * cosine - u * sine
        at_last = (c * cosine + d * sine + g) * cosine - (a * cosine + b * sine + f) * sine
        if max(turning, at_last) < -LEAVES:
            return [*found, [radius * cosine, radius * sine, 0.0]]
        if (out if outward else -out) < LEAVES:
            return None
    return None


def to_equator(flow: Flow, inner: Ring, outward: bool) -> Way:
    """Lead a way from the equator along the section to the last ring, round it, and on to the equator again."""
    r, angle, spiralled, led = inner.outer.r, 0.0, Way(), []

    def stop(x: float, y: float) -> bool:
        found = led_out(flow, x, y, outward)
        led.extend(found or [])
        return bool(found)

    while not led:
        angle = flow.closing(r, angle, 0.02)
        if (angle > 0.0) != outward:
            raise Undecided("proof meets a cycle")
        found, r = flow.turn(r, 0.5 * angle, min(TURNED * 0.5 * abs(angle), LONGEST), not outward, stop)
        spiralled += finite(found[1:])
        if not led and r in (0.0, flow.reach):
            raise Undecided("proof does not reach the equator")
    along = finite(flow.way(inner.outer.r, flow.reach * (1.0 - 1e-3)))
    end = math.hypot(along[-1][0], along[-1][1])
    last = [end * (flow.e_C[i] + flow.reach * flow.u[i]) for i in (0, 1)]
    section, loop = [*along, [*last, 0.0]], finite(inner.outer.places)
    if outward:  # crossed from the left to the right
        return [*section[::-1], *loop, *spiralled, *led]
    return [*led[::-1], *spiralled[::-1], *loop, *section]


def _written(problem: LayerProblem, flow: Flow, walks: list[Any], rings: list[Any]) -> Written:
    """Write a certificate; where the plane is mirrored, all ways go back, so that they go round as before."""
    if flow.mirror < 0:
        walks = [[_mirrored(way), sense] for way, sense in walks]
        rings = [
            [[_mirrored(row) for row in rows], [path[::-1] for path in paths], *rest, [x, -y]]
            for rows, paths, *rest, (x, y) in rings
        ]
    return head(problem) | {"walks": walks, "rings": rings}


def _mirrored(way: Way) -> Way:
    return [[x, -y, *rest] for x, y, *rest in reversed(way)]


def head(problem: LayerProblem) -> Written:
    """Return what a certificate says of its system: numbers as they were given, not rounded."""
    a, b, c, d, f, g = problem.at.affine or (0.0,) * 6
    return {
        "A": [[a, b], [c, d]],
        "f": [f, g],
        "psi": [problem.psi.family, problem.psi.parameter],
    }


def written(problem: LayerProblem, flow: Flow, crossings: list[float]) -> Written:
    """Write a certificate that there are just the cycles that cross the section at these distances from C."""
    rings = [about_C(flow, crossings[0] if crossings else flow.reach)]
    heights = [flow.height(rings[0].outer.r), *map(flow.height, crossings), math.inf]
    for before, here, after in zip(heights, heights[1:], heights[2:], strict=False):
        rings.append(about(flow, here, 0.5 * (here - before), 0.5 * (after - here)))
    rings += at_equator(flow, rings[-1].outer.r)
    walks, outward = [], rings[0].sign > 0
    for inner, outer in pairwise(rings):
        walks.append([between(flow, inner, outer, outward), flow.sense * (-1 if outward else 1)])
        outward = not outward
    if rings[-1].outer.places:
        walks.append([to_equator(flow, rings[-1], outward), flow.sense * (-1 if outward else 1)])
    return _written(problem, flow, walks, [_ring(flow, ring, k) for k, ring in enumerate(rings)])


def alone(problem: LayerProblem, flow: Flow, crossing: float) -> Written:
    """Write a certificate that there is exactly one cycle in a ring about this one."""
    ring = about(flow, flow.height(crossing), math.inf, math.inf)
    outward = ring.sign < 0  # inside a cycle that attracts
    ways = (ring.inner, outward), (ring.outer, not outward)
    walks = [[finite(way.places), flow.sense * (-1 if out else 1)] for way, out in ways]
    return _written(problem, flow, walks, [_ring(flow, ring, 1)])


def _ring(flow: Flow, ring: Ring, k: int) -> list[Any]:
    corners = [[[*p, h] for p, h in zip(*one, strict=True)] for one in zip(ring.layers, ring.h, strict=True)]
    return [corners, ring.paths, [k - 1, k], flow.sense * ring.sign, list(ring.kind), list(ring.middle)]
