"""From classes on a quadtree to regions and the curves between them, by marching through triangles.

Each leaf is a fan of triangles about its centre. A triangle with two classes holds one piece of a boundary, between
the points where its edges cross it; one with three classes holds a junction of three pieces.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .classes import Classes
from .grid import Spans, Tree, crossings

__all__ = ["Boundaries", "chains", "rings", "traced"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_ROUNDS = 8  # slivers beside slivers vanish one after the other


class Boundaries(NamedTuple):
    """Pieces of the boundaries.

    Attributes
    ----------
    points : ndarray (k, 2)
        Where edges are crossed, then junctions, then the corners of the spans.
    pieces : ndarray of int (m, 4)
        From point, to point, region on the left, region on the right (-1: outside the spans).
    codes, region : ndarray of int
        Class and region of each vertex of the tree, without those too thin to be drawn.
    seen : dict
        Classes that were seen in places too thin to be drawn only, and one such place.
    """

    points: Array
    pieces: Indices
    codes: NDArray[np.int64]
    region: Indices
    seen: dict[int, tuple[float, float]]


def _sides(tree: Tree) -> Indices:
    """All sides of leaves, halved where the neighbour is smaller: leaf, from vertex, to vertex."""
    out = []
    leaf = np.arange(len(tree.corners))
    for k in range(4):
        start, middle, end = tree.corners[:, k], tree.middles[:, k], tree.corners[:, (k + 1) % 4]
        halved = middle >= 0
        out.append(np.stack([leaf, start, np.where(halved, middle, end)], axis=1))
        out.append(np.stack([leaf, middle, end], axis=1)[halved])
    return np.concatenate(out)


def _regions(codes: NDArray[np.int64], edges: Indices) -> Indices:
    """Give each connected set of vertices of equal class a number."""
    from scipy.sparse import coo_array  # imported late: it takes longer than drawing a first picture
    from scipy.sparse.csgraph import connected_components

    u, v = edges[(codes[edges[:, 0]] == codes[edges[:, 1]])].T
    k = len(codes)
    graph = coo_array((np.ones(len(u), np.int8), (u, v)), shape=(k, k))
    return np.asarray(connected_components(graph, directed=False)[1], np.intp)


def _without_slivers(tree: Tree, edges: Indices) -> tuple[NDArray[np.int64], Indices, list[int]]:
    """Classes and regions after sets of vertices that fill no leaf anywhere were given to a neighbour.

    What is thinner than that comes out torn to pieces. Returned as well: one vertex of each class that vanished.
    """
    codes = tree.codes
    region = _regions(codes, edges)
    lost: dict[int, int] = {}
    least, many = int(codes.min()), int(codes.max() - codes.min()) + 1
    for _ in range(_ROUNDS):
        whole = (region[tree.corners] == region[tree.centres][:, None]).all(axis=1)
        wide = np.zeros(int(region.max()) + 1, bool)
        wide[region[tree.centres[whole]]] = True
        away = edges[wide[region[edges[:, 0]]] != wide[region[edges[:, 1]]]]
        if not len(away):
            break
        thin_first = ~wide[region[away[:, 0]]]
        thin, beside = np.where(thin_first, away.T, away.T[::-1])
        for i in thin.tolist():
            lost.setdefault(int(tree.codes[i]), i)
        # the class that most of the sliver's neighbours have
        votes, count = np.unique(region[thin] * many + codes[beside] - least, return_counts=True)
        order = np.argsort(count, kind="stable")
        given = np.full(len(wide), least - 1)
        given[votes[order] // many] = votes[order] % many + least
        codes = np.where(given[region] >= least, given[region], codes)
        region = _regions(codes, edges)
    return codes, region, [i for code, i in lost.items() if not (codes == code).any()]


def traced(classes: Classes, tree: Tree, spans: Spans, halvings: int) -> Boundaries:
    """March through all triangles in which the class changes."""
    sides = _sides(tree)
    spokes = np.stack([tree.centres[sides[:, 0]], sides[:, 1]], axis=1)
    codes, region, lost = _without_slivers(tree, np.concatenate([sides[:, 1:], spokes]))
    triangles = np.concatenate([spokes, sides[:, 2:]], axis=1)
    own = codes[triangles]
    mixed = (own != own[:, :1]).any(axis=1)
    triangles = triangles[mixed]
    k = len(codes)
    u, v = triangles, np.roll(triangles, -1, axis=1)
    keys = np.minimum(u, v) * k + np.maximum(u, v)
    unique, edge = np.unique(keys, return_inverse=True)
    start, end = np.divmod(unique, k)
    crossed = np.flatnonzero(codes[start] != codes[end])
    start, end = start[crossed], end[crossed]
    points, beyond = crossings(classes, tree.place[start], tree.place[end], codes[start], codes[end], halvings)
    strange = np.flatnonzero((beyond != codes[end]) & ~np.isin(beyond, codes))
    seen = {int(beyond[i]): (float(points[i, 0]), float(points[i, 1])) for i in strange}
    for axis in (0, 1):  # points on the outermost lines are put on the edge of the spans
        for line, value in ((0, spans[axis][0]), (tree.last, spans[axis][1])):
            points[(tree.index[start, axis] == line) & (tree.index[end, axis] == line), axis] = value
    seen |= {int(tree.codes[i]): (float(tree.place[i, 0]), float(tree.place[i, 1])) for i in lost}
    number = np.full(len(unique), -1)
    number[crossed] = np.arange(len(crossed))
    pieces, junctions = _march(region[triangles], number[edge.reshape(triangles.shape)], points)
    points = np.concatenate([points, junctions])
    table = dict(zip(unique[crossed].tolist(), range(len(crossed)), strict=True))
    frame, corners = _frame(tree, sides, region, table, spans, len(points))
    return Boundaries(np.concatenate([points, corners]), np.concatenate([pieces, frame]), codes, region, seen)


def _march(region: Indices, on: Indices, points: Array) -> tuple[Indices, Array]:
    """Pieces of boundary in triangles, given the regions of their corners and the points on edges k to k + 1."""
    cut = on >= 0
    three = cut.all(axis=1)
    hub = len(points) + np.arange(int(three.sum()))
    out = []
    for k in range(3):
        # corner k alone on its side: from the edge that leaves it to the edge that arrives, it lies on the left
        alone = ~three & cut[:, k] & cut[:, k - 1]
        out.append(np.stack([on[alone, k], on[alone, k - 1], region[alone, k], region[alone, (k + 1) % 3]], axis=1))
        # from the junction to the edge between corners k and k + 1: corner k + 1 lies on the left
        out.append(np.stack([hub, on[three, k], region[three, (k + 1) % 3], region[three, k]], axis=1))
    return np.concatenate(out), points[on[three]].mean(axis=1)


def _frame(
    tree: Tree, sides: Indices, region: Indices, table: dict[int, int], spans: Spans, first: int
) -> tuple[Indices, Array]:
    """Close the regions along the edge of the spans, anticlockwise; the corners of the spans are new points."""
    (x0, x1), (y0, y1) = spans
    k = len(tree.codes)
    out = []
    for side, (axis, line) in enumerate(((1, 0), (0, tree.last), (1, tree.last), (0, 0))):
        on = np.unique(sides[:, 1:][(tree.index[sides[:, 1:], axis] == line).all(axis=1)])
        on = on[np.argsort(tree.index[on, 1 - axis])]
        if side >= 2:
            on = on[::-1]
        r = region[on]
        last = first + side
        for i in np.flatnonzero(r[1:] != r[:-1]).tolist():
            u, v = sorted((int(on[i]), int(on[i + 1])))
            out.append((last, table[u * k + v], int(r[i]), -1))
            last = table[u * k + v]
        out.append((last, first + (side + 1) % 4, int(r[-1]), -1))
    return np.array(out), np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]])


def chains(pairs: Indices) -> list[list[int]]:
    """Join pieces (from, to) to lines as long as they go on without a fork; closed ones repeat their first point."""
    near: dict[int, list[int]] = {}
    for u, v in pairs.tolist():
        near.setdefault(u, []).append(v)
        near.setdefault(v, []).append(u)
    lines = []
    for start in [u for u, others in near.items() if len(others) != 2] + list(near):
        while near[start]:
            line = [start]
            while near[line[-1]]:
                here = line[-1]
                then = near[here].pop()
                near[then].remove(here)
                line.append(then)
                if len(near[then]) != 1:
                    break
            lines.append(line)
    return lines


def rings(pairs: Indices) -> list[list[int]]:
    """Join directed pieces (from, to) to closed rings: each point has one piece that leaves it."""
    then = dict(pairs.tolist())
    out = []
    while then:
        first, here = then.popitem()
        ring = [first]
        while here != first:
            ring.append(here)
            here = then.pop(here)
        out.append(ring)
    return out
