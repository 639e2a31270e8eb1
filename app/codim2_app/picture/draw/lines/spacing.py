"""Evenly spaced orbits: each ends where it would come too near to another, so that no two run together.

After Jobard and Lefer, Creating evenly-spaced streamlines of arbitrary density, 1997; with the starts of the scene, so
that what is drawn moves with the sliders and does not jump.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from codim2_core.formulas.jit import kernel, spliced_kernel

from ..layers import Pieces
from .arrowheads import of_one_type

#: In px: how near orbits come to one another, and how long a part of one is at least.
SEPARATION, MIN_PIECE = 9.0, 44.0


def evenly(
    offsets: NDArray[np.int64],
    points: NDArray[np.float64],
    pixel: float,
    window: tuple[float, float, float, float],
    guards: Pieces | None = None,
) -> Pieces:
    """Leave out what of each curve is nearer than `SEPARATION` to one that was there before, or to the equator.

    Parameters
    ----------
    offsets : ndarray (k + 1,)
    points : ndarray (n, 2)
        Curve i is ``points[offsets[i]:offsets[i + 1]]``.
    pixel : float
        Size of a pixel in picture units.
    window : (left, right, bottom, top)
        What is seen; what is beyond is left out too.
    guards : (offsets, points), optional
        Other curves from which to keep away, such as limit cycles.

    Returns
    -------
    offsets, points : ndarray
        Of the parts that are left.
    """
    others = EQUATOR_GUARD if guards is None else _both_directions(guards)
    order = _order(len(offsets) - 1)
    return _kept_pieces(
        *of_one_type(offsets, points),
        *of_one_type(*others),
        order,
        SEPARATION * pixel,
        MIN_PIECE * pixel,
        *map(float, window),
    )


_CIRCLE_ANGLES = np.linspace(0.0, 2.0 * np.pi, 361)
EQUATOR_GUARD: Pieces = (
    np.array([0, len(_CIRCLE_ANGLES)]),
    np.column_stack([np.cos(_CIRCLE_ANGLES), np.sin(_CIRCLE_ANGLES)]),
)


def _both_directions(guards: Pieces) -> Pieces:
    offsets, points = guards
    return np.append(EQUATOR_GUARD[0], EQUATOR_GUARD[0][-1] + offsets[1:]), np.concatenate([EQUATOR_GUARD[1], points])


@lru_cache(maxsize=64)
def _order(count: int) -> NDArray[np.int64]:
    """Return an order in which the first few curves are already spread over all, by bits in reverse."""
    bits = max(1, (count - 1).bit_length())
    found = [int(f"{i:0{bits}b}"[::-1], 2) for i in range(1 << bits)]
    order = np.array([i for i in found if i < count], np.int64)
    order.flags.writeable = False
    return order


@spliced_kernel
def _steps(dx, dy, step):
    """Return the number of steps in which a piece of a curve is walked; pieces far outside the picture take few."""
    return 1 + int(min(math.hypot(dx, dy) / step, 1e4))


@spliced_kernel
def _store(x, y, stored, places, older, newest, left, bottom, apart, rows):
    """Note a place in its cell; the number of places that are noted."""
    cell = (int((x - left) / apart) + 1) * rows + int((y - bottom) / apart) + 1
    stored += 1
    places[stored, 0], places[stored, 1] = x, y
    older[stored] = newest[cell]
    newest[cell] = stored
    return stored


@kernel
def _kept_pieces(offsets, points, guards, others, order, apart, shortest, left, right, bottom, top):
    """Walk along each curve in steps of half the distance; a grid of cells of that distance tells what is near."""
    columns, rows = int((right - left) / apart) + 3, int((top - bottom) / apart) + 3
    newest = np.zeros(columns * rows, np.int64)  # of the places in a cell, from 1; `older` leads to the one before
    step, most, longest = 0.5 * apart, 1, 1
    for piece in range(len(offsets) - 1):
        before = most
        for i in range(offsets[piece] + 1, offsets[piece + 1]):
            most += _steps(points[i, 0] - points[i - 1, 0], points[i, 1] - points[i - 1, 1], step)
        longest = max(longest, most - before)
    guarded = 1
    for i in range(1, len(others)):
        guarded += _steps(others[i, 0] - others[i - 1, 0], others[i, 1] - others[i - 1, 1], step)
    places, older = np.empty((most + guarded + 1, 2)), np.zeros(most + guarded + 1, np.int64)
    run = np.empty((longest + 1, 2))
    kept_points = np.empty((len(points) + 2 * most, 2))
    kept_offsets = np.zeros(most + 2, np.int64)
    stored = pieces = written = near = 0
    for piece in range(len(guards) - 1):
        for i in range(guards[piece], guards[piece + 1] - 1):
            dx, dy = others[i + 1, 0] - others[i, 0], others[i + 1, 1] - others[i, 1]
            steps = _steps(dx, dy, step)
            for j in range(steps):
                x, y = others[i, 0] + dx * j / steps, others[i, 1] + dy * j / steps
                if left <= x <= right and bottom <= y <= top:
                    stored = _store(x, y, stored, places, older, newest, left, bottom, apart, rows)
    for k in range(len(order)):
        piece = order[k]
        first, last = offsets[piece], offsets[piece + 1]
        ran = 0  # places of this curve that are free, to be stored at its end: it does not stop itself
        begun, began, travelled = written, 0, 0.0
        for i in range(first, last - 1):
            x0, y0 = points[i, 0], points[i, 1]
            dx, dy = points[i + 1, 0] - x0, points[i + 1, 1] - y0
            steps = _steps(dx, dy, step)
            for j in range(steps + (i == last - 2)):
                x, y = x0 + dx * j / steps, y0 + dy * j / steps
                free = left <= x <= right and bottom <= y <= top
                if free and near > 0:  # what the place before was too near to, this one mostly is
                    away_x, away_y = places[near, 0] - x, places[near, 1] - y
                    free = away_x * away_x + away_y * away_y >= apart * apart
                if free:
                    cell = (int((x - left) / apart) + 1) * rows + int((y - bottom) / apart) + 1
                    for below in (cell, cell - rows, cell + rows):
                        for neighbour in range(below - 1, below + 2):
                            other = newest[neighbour]
                            while other > 0 and free:
                                away_x, away_y = places[other, 0] - x, places[other, 1] - y
                                free = away_x * away_x + away_y * away_y >= apart * apart
                                near, other = other, older[other]
                        if not free:
                            break
                if free:
                    if written > begun:
                        px, py = run[ran - 1, 0], run[ran - 1, 1]
                        travelled += math.hypot(x - px, y - py)
                    if j == 0 or written == begun:
                        kept_points[written, 0], kept_points[written, 1] = x, y
                        written += 1
                    run[ran, 0], run[ran, 1] = x, y
                    ran += 1
                ends = not free or (i == last - 2 and j == steps)
                if ends and written > begun:
                    if not free or j > 0:
                        kept_points[written, 0], kept_points[written, 1] = run[ran - 1, 0], run[ran - 1, 1]
                        written += 1
                    if travelled >= shortest:
                        pieces += 1
                        kept_offsets[pieces] = begun = written
                        began = ran
                    else:
                        written, ran = begun, began
                    travelled = 0.0
        for j in range(ran):
            stored = _store(run[j, 0], run[j, 1], stored, places, older, newest, left, bottom, apart, rows)
    return kept_offsets[: pieces + 1].copy(), kept_points[:written].copy()
