"""Classes on a quadtree over two parameters: small cells only where the class changes or may change unseen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .classes import Classes

__all__ = ["THIN", "Spans", "Tree", "crossings", "tree"]

Array = NDArray[np.float64]
Codes = NDArray[np.int64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]
Spans = tuple[tuple[float, float], tuple[float, float]]

THIN = 2  # further ones, at most, where something thinner than a cell shows
_INSET = 1e-7  # of the span: what lies on its very edge is decided just inside


@dataclass(frozen=True, eq=False)
class Tree:
    """Leaves of a balanced quadtree, and the classes at their corners and centres.

    Attributes
    ----------
    place : ndarray (k, 2)
        Points at which the class was computed.
    index : ndarray of int (k, 2)
        The same in units of half the smallest possible cell.
    last : int
        Largest index.
    codes : ndarray of int (k,)
    corners : ndarray of int (m, 4)
        Vertices of the leaves, anticlockwise from the lower left.
    middles : ndarray of int (m, 4)
        Vertex in the middle of the side that starts at each corner; -1 if the neighbour there is not smaller.
    centres : ndarray of int (m,)
    size : ndarray (m,)
        Side of each leaf as a fraction of the spans.
    """

    place: Array
    index: Indices
    last: int
    codes: Codes
    corners: Indices
    middles: Indices
    centres: Indices
    size: Array


class _Vertices:
    """Points of a fine lattice with their classes and the functions that decide them, computed when first asked for."""

    def __init__(self, classes: Classes, spans: Spans, last: int) -> None:
        self.classes, self.spans, self.last = classes, spans, last
        self.table = np.full((last + 1) ** 2, -1, np.int32)
        self.keys = np.zeros(0, np.intp)
        self.codes = np.zeros(0, np.int64)
        self.functions = np.zeros((0, 0))

    def place(self, keys: Indices) -> Array:
        """Points; slightly off an even lattice, as degenerate systems like to lie on round numbers and diagonals."""
        out = np.empty((len(keys), 2))
        for axis, i in enumerate(np.divmod(keys, self.last + 1)):
            u = i / self.last
            u = u + 0.02 * u * (1.0 - u) * np.sin(5.0 * u + 1.0 + axis)
            low, high = self.spans[axis]
            out[:, axis] = low + (high - low) * (_INSET * (1 + axis) + (1.0 - _INSET * (3 + 3 * axis)) * u)
        return out

    def ask(self, keys: Indices) -> Indices:
        """Positions of some keys, which are computed if they are new."""
        new = keys[self.table[keys] < 0]
        if len(new):
            count = np.arange(len(new), dtype=np.int32)
            self.table[new] = count  # of equal keys the last one stays
            new = new[self.table[new] == count]
            self.table[new] = len(self.keys) + np.arange(len(new), dtype=np.int32)
            codes, functions = self.classes.measured(self.place(new))
            self.keys = np.concatenate([self.keys, new])
            self.codes = np.concatenate([self.codes, codes])
            known = self.functions if self.functions.shape[1] else functions[:, :0]
            self.functions = np.concatenate([known, functions], axis=1)
        return self.table[keys].astype(np.intp)


def tree(classes: Classes, spans: Spans, coarse: int, plain: int, thin: int) -> Tree:
    """Quadtree with smaller cells where the class changes, and still smaller ones where these are not enough.

    Parameters
    ----------
    classes : Classes
        Over two names.
    spans : ((low, high), (low, high))
    coarse : int
        The largest cells are so many to a side.
    plain : int
        How often those are halved in which the class changes or may change unseen.
    thin : int
        Further halvings at thin places, 0 to `THIN`.

    Returns
    -------
    Tree
        Neighbouring leaves differ by one halving at most.
    """
    depth = plain + thin
    unit = [2 << (depth - level) for level in range(depth + 1)]  # index units of a cell of each level
    vertices = _Vertices(classes, spans, coarse * unit[0])
    refined = [np.zeros((coarse << level, coarse << level), bool) for level in range(depth + 1)]
    exists = [np.ones((coarse, coarse), bool)]
    total = coarse * coarse
    for level in range(depth):
        cells = np.nonzero(exists[level])
        refined[level][cells] = _flagged(vertices, cells, unit[level], level < plain)
        total += 4 * int(refined[level].sum())
        exists.append(_children(refined[level]))
        if total > classes.most_cells or not refined[level].any():
            break
    while True:
        _balance(refined)
        exists = [exists[0], *(_children(r) for r in refined[:-1])]
        again = False
        for level in range(plain):  # a new corner may have shown another class
            cells = np.nonzero(exists[level] & ~refined[level])
            at = vertices.ask(_lattice(cells, unit[level], vertices.last))
            around = vertices.codes[at]
            mixed = (around != around[:, :1]).any(axis=1)
            refined[level][cells] = mixed
            again |= bool(mixed.any())
        if not again:
            break
    return _leaves(vertices, exists, refined, unit, coarse)


def _children(refined: Flags) -> Flags:
    return np.repeat(np.repeat(refined, 2, axis=0), 2, axis=1)


def _lattice(cells: tuple[Indices, ...], unit: int, last: int) -> Indices:
    """Keys of the corners, anticlockwise, and of the centre of cells, (m, 5)."""
    x, y = cells[0] * unit, cells[1] * unit
    half = unit // 2
    xs = np.stack([x, x + unit, x + unit, x, x + half], axis=1)
    ys = np.stack([y, y, y + unit, y + unit, y + half], axis=1)
    return xs * (last + 1) + ys


def _flagged(vertices: _Vertices, cells: tuple[Indices, ...], unit: int, plain: bool) -> Flags:
    """Cells to be halved.

    At first every cell in which the class changes, or in which a function may come to zero. Later only those in which
    more than one thing happens at once, or a function comes so near to zero that, being curved, it may pass it twice.
    """
    at = vertices.ask(_lattice(cells, unit, vertices.last))
    codes, functions = vertices.codes[at], vertices.functions[:, at]
    mixed = (codes != codes[:, :1]).any(axis=1)
    with np.errstate(invalid="ignore"):  # nan: not known at all five points
        least = abs(functions).min(axis=2)
        same = abs(np.sign(functions).sum(axis=2)) == 5
        bend = abs(functions[:, :, 4] - functions[:, :, :4].mean(axis=2))
        near = (same & (least < (4.0 if plain else 2.0) * bend)).any(axis=0)
    if plain:
        return mixed | near
    for i in np.flatnonzero(mixed & ~near).tolist():
        found = {int(c) for c in codes[i]}
        one = found.pop()
        near[i] = any(len(vertices.classes.happening(one, other)) > 1 for other in found)
    return near


def _balance(refined: list[Flags]) -> None:
    """Halve further cells until neighbouring leaves differ by one halving at most."""
    for level in range(len(refined) - 1, 0, -1):
        if not refined[level].any():
            continue
        need = refined[level].copy()
        need[1:] |= refined[level][:-1]
        need[:-1] |= refined[level][1:]
        need[:, 1:] |= refined[level][:, :-1]
        need[:, :-1] |= refined[level][:, 1:]
        refined[level - 1] |= need[::2, ::2] | need[1::2, ::2] | need[::2, 1::2] | need[1::2, 1::2]


def _leaves(vertices: _Vertices, exists: list[Flags], refined: list[Flags], unit: list[int], coarse: int) -> Tree:
    rows: list[Indices] = []
    keys: list[Indices] = []
    sizes: list[Array] = []
    for level, (here, split) in enumerate(zip(exists, refined, strict=True)):
        cells = np.nonzero(here & ~split)
        if not len(cells[0]):
            continue
        lattice = _lattice(cells, unit[level], vertices.last)
        framed = np.pad(split, 1)
        i, j = cells[0] + 1, cells[1] + 1
        smaller = np.stack([framed[i, j - 1], framed[i + 1, j], framed[i, j + 1], framed[i - 1, j]], axis=1)
        middle = (lattice[:, :4] + np.roll(lattice[:, :4], -1, axis=1)) // 2
        rows.append(lattice)
        keys.append(np.where(smaller, middle, -1))
        sizes.append(np.full(len(lattice), 1.0 / (coarse << level)))
    lattice, middle = np.concatenate(rows), np.concatenate(keys)
    at = vertices.ask(lattice)
    middles = np.where(middle >= 0, vertices.ask(np.maximum(middle, 0)), -1)
    index = np.stack(np.divmod(vertices.keys, vertices.last + 1), axis=1)
    return Tree(
        vertices.place(vertices.keys), index, vertices.last, vertices.codes,
        at[:, :4], middles, at[:, 4], np.concatenate(sizes),
    )  # fmt: skip


def crossings(
    classes: Classes, start: Array, end: Array, before: Codes, after: Codes, halvings: int
) -> tuple[Array, Codes]:
    """Where the class changes along edges, by bisection of all of them at once.

    Parameters
    ----------
    classes : Classes
    start, end : ndarray (k, 2)
    before, after : ndarray of int (k,)
        Different classes at the ends.
    halvings : int

    Returns
    -------
    place : ndarray (k, 2)
        A change from `before`.
    beyond : ndarray of int (k,)
        The class just behind it: not `after` where an edge crosses something thinner than itself.
    """
    low, high = np.zeros(len(start)), np.ones(len(start))
    beyond = after.copy()
    for _ in range(halvings):
        t = 0.5 * (low + high)
        here = classes.decided(start + t[:, None] * (end - start))
        same = here == before
        low, high = np.where(same, t, low), np.where(same, high, t)
        beyond = np.where(same, beyond, here)
    t = 0.5 * (low + high)
    return start + t[:, None] * (end - start), beyond
