"""All zeros of U(e) in the open disc |e| < 1 of a general system, checked by the index.

Independent of Psi, which only places them in the picture. `numerics.disc_search` proves the list complete; the sum of
the indices, sign det D_e U, must in addition be the degree of U on the equator, found independently there.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formulas.arrays import ONE_SIDED_DIRECTIONS, ONE_SIDED_DISTANCE, Program, program
from ...numerics.fourier_zeros import UNIT
from ...results.arrays import Array
from .equator_zeros import component_series, equator_zeros

# Times a box may be cut, boxes open at once, and operations in all; the second where the first leaves a doubt.
EFFORTS = ((25, 1500, 1_000_000), (32, 6_000, 3_000_000))
TOGETHER = 1e-6  # critical sets closer than this, and not separated by the search, count as one
CURVE = 200  # undecided boxes that are no mere neighbours of a point,
MIN_CURVE_EXTENT = 0.02  # if they extend this far
REGULAR = 1e-4  # det D_e U, in units of |D_e U|^2, of a zero that is not multiple
FLAT = 1e-6  # D_e U, in units of U, below which rounding decides its entries at such a zero
ROUGH = 1e-2  # change of D_e U over `ONE_SIDED_DISTANCE`, in units of itself, of a U that is not differentiable
INDEX_RADIUS = 2e-6  # radius of the circle around a rough zero on which its index is counted
CROWDED = 100  # zeros: more effort would only find more of them


@dataclass(frozen=True, eq=False, slots=True)
class DiscZeros:
    """Zeros of U in the disc |e| <= 1 at one z."""

    e: Array  # (k, 2) In the open disc, by increasing c, then s
    DU: Array  # (k, 2, 2) D_e U there, exact
    # (k,) D_e U is singular within rounding: critical sets that have just met (a fold, or a higher degeneracy); or
    # rough
    degenerate: NDArray[np.bool_]
    # (k,) U is not differentiable there, and its slopes on the sides (infinite, or of either orientation) give no
    # index
    rough: NDArray[np.bool_]
    # (k,) Sign of det D_e U; for one degenerate zero what the degree leaves for it, 0 for a fold
    index: NDArray[np.int64]
    # angles of zeros on |e| = 1 within rounding, where a critical set reaches the equator (not in `e`)
    on_equator: tuple[float, ...]
    curve: bool  # whole curves of zeros; `e` then has only the isolated zeros found next to them
    everything: bool  # u vanishes identically
    degree: int | None  # of U on the equator; None where U vanishes there
    proven: bool  # no box was left undecided, or those left hold one degenerate zero each

    @property
    def consistent(self) -> bool | None:
        """Whether the indices add up to the degree; None where that says nothing."""
        if self.degree is None or self.curve or self.everything:
            return None
        return int(self.index.sum()) == self.degree


@lru_cache(maxsize=128)
def disc_zeros(key: Hashable) -> DiscZeros:
    """All zeros of U in the disc; `key` is `Frozen.key`."""
    size = component_series(key, "theta").size
    if size == 0.0 and np.all(program(key).evaluate(_SIZE_NET)[:, :, 0] == 0.0):
        nothing = np.zeros((0, 2))
        return DiscZeros(
            nothing, np.zeros((0, 2, 2)), np.zeros(0, bool), np.zeros(0, bool), np.zeros(0, np.int64), (), False, True,
            None, True,
        )  # fmt: skip
    degree = equator_zeros(key).degree
    first = _search_boxes(program(key), size, degree, *EFFORTS[0])
    if (first.consistent is not False and first.proven) or len(first.e) >= CROWDED:
        return first
    return _search_boxes(program(key), size, degree, *EFFORTS[1])


_CIRCLE_ANGLES = 2.0 * math.pi * (np.arange(256) + 0.5) / 256
_UNIT_CIRCLE = np.stack([np.cos(_CIRCLE_ANGLES), np.sin(_CIRCLE_ANGLES)], axis=-1)
_SIZE_NET = np.stack(np.meshgrid(np.linspace(-0.7, 0.7, 9), np.linspace(-0.7, 0.7, 9)), axis=-1).reshape(-1, 2)


def _search_boxes(run: Program, size: float, degree: int | None, levels: int, most: int, operations: int) -> DiscZeros:
    from ...numerics.disc_search import CAPACITY, search  # on first use: it loads the compiler

    found, rest = np.empty((CAPACITY, 3)), np.empty((most, 2))
    budget = 1000 + operations // len(run.op)
    count, undecided, half, complete = search(*run.arrays, levels, most, budget, found, rest)
    points = found[:count, :2]
    degenerate = np.zeros(count, bool)
    curve, proven = False, complete and count < CAPACITY
    if undecided:
        places, curve, left = _classify_undecided(run, rest[:undecided], half, max(size, _field_size(run)))
        proven = curve or (proven and not left)
        # a place where a proven zero lies is that zero
        places = [p for p in places if not count or np.abs(points - p).max(axis=1).min() > TOGETHER]
        points = np.concatenate([points, np.array(places).reshape(-1, 2)])
        degenerate = np.concatenate([degenerate, np.ones(len(places), bool)])
    points = np.where(np.abs(points) < 1e-18, 0.0, points)
    DU, degenerate, rough = _slopes(run, points, degenerate)
    proven = proven and not bool(rough.any())
    gap = 1.0 - np.hypot(points[:, 0], points[:, 1])
    border = np.abs(gap) <= _blur(DU, degenerate, max(size, _field_size(run)))
    on_equator = tuple(sorted(math.atan2(s, c) % (2 * math.pi) for c, s in points[border].tolist()))
    inside = (gap > 0.0) & ~border
    points, DU, degenerate, rough = points[inside], DU[inside], degenerate[inside], rough[inside]
    order = np.lexsort((points[:, 1], np.round(points[:, 0], 9)))
    points, DU, degenerate, rough = points[order], DU[order], degenerate[order], rough[order]
    index = np.sign(DU[:, 0, 0] * DU[:, 1, 1] - DU[:, 0, 1] * DU[:, 1, 0]).astype(np.int64)
    index[degenerate] = 0
    for i in np.flatnonzero(rough):
        index[i] = _winding_number(run, points[i], INDEX_RADIUS)
    if degree is not None and degenerate.sum() == 1 and not rough.any():
        index[degenerate] = degree - index.sum()
        if abs(int(index[degenerate][0])) > 8:
            proven = False
    for array in (points, DU, degenerate, rough, index):
        array.flags.writeable = False
    found_degree = None if on_equator else degree
    return DiscZeros(points, DU, degenerate, rough, index, on_equator, curve, False, found_degree, proven)


def _slopes(run: Program, points: Array, doubtful: NDArray[np.bool_]) -> tuple[Array, NDArray[Any], NDArray[Any]]:
    """D_e U at zeros, which of those that are `doubtful` are degenerate, and which of these because U is rough there.

    Boxes stay undecided at multiple zeros, and where U has corners or unbounded second derivatives. Of a rough zero
    the sides say whether it is an ordinary one: if they all have one orientation.
    """
    DU = run.evaluate(points)[:, :, 1:]
    degenerate, rough = doubtful.copy(), np.zeros(len(points), bool)
    for i in np.flatnonzero(doubtful | ~np.isfinite(DU).all(axis=(1, 2))):
        sides = run.evaluate(points[i] + ONE_SIDED_DISTANCE * ONE_SIDED_DIRECTIONS)[:, :, 1:]
        every = np.concatenate([DU[i : i + 1], sides])
        if not np.isfinite(every).all():
            DU[i], degenerate[i], rough[i] = 0.0, True, True
            continue
        spread = np.abs(sides - DU[i]).max()
        determinants = every[:, 0, 0] * every[:, 1, 1] - every[:, 0, 1] * every[:, 1, 0]
        regular = np.abs(determinants) > REGULAR * np.square(every).sum(axis=(1, 2))
        regular &= np.abs(every).max(axis=(1, 2)) > FLAT * _field_size(run)
        degenerate[i] = not (regular.all() and np.ptp(np.sign(determinants)) == 0.0)
        # a smooth U changes its slopes by about BESIDE times its size
        rough[i] = degenerate[i] and spread > max(
            ROUGH * np.abs(every).max(), 100.0 * ONE_SIDED_DISTANCE * _field_size(run)
        )
    return DU, degenerate, rough


def _field_size(run: Program) -> float:
    """Largest |U1| + |U2| on a net: what rounding is measured by where U is small on the equator."""
    values = np.abs(run.evaluate(_SIZE_NET)[:, :, 0]).sum(axis=1)
    return float(values[np.isfinite(values)].max(initial=0.0))


def _blur(DU: Array, degenerate: NDArray[np.bool_], size: float) -> Array:
    """Return how far rounding of U moves each zero: 16 units over the smallest singular value of D_e U."""
    # the smaller singular value, to within a factor of sqrt 2
    spread = np.sqrt((DU * DU).sum(axis=(1, 2)))
    smallest = np.abs(DU[:, 0, 0] * DU[:, 1, 1] - DU[:, 0, 1] * DU[:, 1, 0]) / np.where(spread == 0.0, 1.0, spread)
    least = np.where(degenerate, 1e-6 * size, np.maximum(smallest, 1e-8 * size))
    return 16.0 * UNIT * np.maximum(1.0, size / np.where(least == 0.0, 1.0, least))


def _classify_undecided(run: Program, boxes: Array, half: float, size: float) -> tuple[list[Array], bool, bool]:
    """Undecided boxes become degenerate zeros, a curve of zeros, or stay undecided: (zeros, curve, left over)."""
    sample = boxes[:: max(1, len(boxes) // CURVE)]
    if len(boxes) >= CURVE and np.ptp(boxes, axis=0).max() > MIN_CURVE_EXTENT:
        ends, ok = _least_squares(run, sample, size, 4.0 * half)
        singular = np.linalg.svd(run.evaluate(ends[ok])[:, :, 1:], compute_uv=False)
        if ok.mean() > 0.5 and np.median(singular[:, 1]) <= 1e-6 * max(float(np.median(singular[:, 0])), 1e-6 * size):
            return [], True, False
    places: list[Array] = []
    left = False
    for cluster in _clusters(boxes, half):
        ends, ok = _least_squares(run, cluster[:: max(1, len(cluster) // CURVE)], size, 4.0 * half)
        extent = float(np.ptp(cluster, axis=0).max())
        middle = 0.5 * (cluster.min(axis=0) + cluster.max(axis=0))
        if ok.any() and extent < MIN_CURVE_EXTENT:
            places.append(np.median(ends[ok], axis=0))
        elif extent < TOGETHER and _winding_number(run, middle, 2.0 * (extent + half)):
            places.append(middle)  # U turns around it: as it is continuous it vanishes inside, with no slope to follow
        else:
            left = True
    return places, False, left


def _winding_number(run: Program, middle: Array, radius: float) -> int:
    """Count how often U turns around a small circle; 0 where it is not finite, or turns too fast to tell."""
    U = run.evaluate(middle + radius * _UNIT_CIRCLE)[:, :, 0]
    if not (np.isfinite(U).all() and U.any(axis=1).all()):
        return 0
    largest = np.abs(U).max(axis=0)  # its rows may be of very different size: that turns nothing
    if not largest.all():
        return 0
    angle = np.arctan2(U[:, 1] / largest[1], U[:, 0] / largest[0])
    step = np.remainder(np.diff(angle, append=angle[:1]) + math.pi, 2.0 * math.pi) - math.pi
    return 0 if np.abs(step).max() > 2.5 else round(float(step.sum()) / (2.0 * math.pi))


def _clusters(boxes: Array, half: float) -> list[Array]:
    """Boxes that hang together, or nearly so: that lie in neighbouring cells of a coarser net."""
    members: dict[tuple[int, int], list[int]] = {}
    for k, cell in enumerate(np.floor(boxes / (5.0 * half + TOGETHER)).astype(np.int64).tolist()):
        members.setdefault((cell[0], cell[1]), []).append(k)
    clusters = []
    while members:
        cell, cluster = members.popitem()
        border = [cell]
        while border:
            i, j = border.pop()
            for near in ((i + di, j + dj) for di in (-1, 0, 1) for dj in (-1, 0, 1)):
                if near in members:
                    cluster = cluster + members.pop(near)
                    border.append(near)
        clusters.append(boxes[sorted(cluster)])
    return clusters


def _least_squares(run: Program, start: Array, size: float, reach: float) -> tuple[Array, NDArray[np.bool_]]:
    """Gauss-Newton from each start, which also converges (linearly) to degenerate zeros; and where |U| is rounding."""
    x = start.copy()
    best, value = x.copy(), np.full(len(x), math.inf)
    for _ in range(40):
        rows = run.evaluate(x)
        U, D = rows[:, :, 0], rows[:, :, 1:]
        norm = np.hypot(U[:, 0], U[:, 1])
        norm = np.where(np.isfinite(norm) & np.isfinite(D).all(axis=(1, 2)), norm, math.inf)
        better = norm < value
        best[better], value[better] = x[better], norm[better]
        going = (value > 0.0) & np.isfinite(norm)
        if not going.any():
            break
        step = np.zeros_like(x)
        step[going] = np.einsum("kij,kj->ki", np.linalg.pinv(D[going], rcond=1e-9), U[going])
        x = np.clip(x - step, start - 1e3 * reach, start + 1e3 * reach)
    return best, value <= 64.0 * UNIT * size
