"""Samples of the displacement of a return map, close enough together that between them nothing is hidden.

The displacement is smooth where orbits return. On an interval between two samples it is approximated by the cubic
through the four samples about it (Newton's divided differences: spacing need not be even), and the fourth divided
difference tells how far it may be from that cubic. An interval is resolved when the cubic, wherever in that band
the displacement lies, has the zeros that the signs at its two ends ask for and no other: none, or one. So an extremum
is judged by slope and curvature, and not by the heights of samples that may lie far from it.

What is hidden in a part that four samples on either side do not show at all is not found: this is no proof.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ...results.arrays import Array
from ...results.words import say
from .ray_section import COARSE_RTOL, FINE_RTOL, TurnSection

COARSE_NOISE, FINE_NOISE = 1e-8, 1e-11  # of a displacement at COARSE and FINE
ERROR_SAFETY = 8.0  # times the estimated error of the cubic
INTERVAL_PARTS = 16  # of an interval, where its cubic is evaluated
BATCH, FEWEST = 32, 3  # samples in a round, at least in one interval: lanes step side by side
NARROWEST, NARROWEST_STEEP = 2e-6, 1e-12  # widths in xi below which an interval is left as it is: flat, and steep
UNRESOLVED = say("too steep")
PERIOD_ANNULUS_WIDTH = 0.05  # width in q of an interval of fixed points that is no fold
STEEP = 1e-3  # change of the displacement
MAX_SAMPLES, MAX_ROUNDS = 900, 24  # samples in all; rounds
MAX_UNDECIDED_SHARE = 0.25  # share of undecided samples at which looking closer is in vain
NEAR_FOLD = 1e-6  # displacement at an extremum: a pair of cycles there is not told from none with certainty
NEAR_LOOP = 1e-3  # displacement of the last orbit that returns: a loop is near
STRIDES = 1, 3, 8, 20  # of samples that are compared
RISE = 10.0  # times its noise, by which a sample differs from another
# Next to a loop errors grow along a turn. The noise there is how far two tolerances are apart, at the samples within
# reach. It is measured for displacements below the first number; beyond so many times the noise they differ from zero.
MAY_BE_NOISE, NOISE_REACH, NOISE_MULTIPLE = 1e-6, 4, 4.0
OTHER_RTOL = 4.0 * FINE_RTOL
_INSIDE = np.linspace(0.0, 1.0, INTERVAL_PARTS + 1)


def differences(q: Array, shift: Array) -> Array:
    """Fourth divided differences (n - 4,) of samples in order."""
    d = shift
    for k in range(1, 5):
        d = np.diff(d) / (q[k:] - q[:-k])
    return d


def cubics(q: Array, shift: Array) -> tuple[Array, Array]:
    """Approximate one run of samples between its samples."""
    n = len(q)
    first = np.clip(np.arange(n - 1) - 1, 0, n - 4)  # of the four samples
    x = q[:-1, None] + np.diff(q)[:, None] * _INSIDE
    values = np.zeros_like(x)
    product = np.ones_like(x)
    column = shift.copy()
    for k in range(4):
        values += column[first][:, None] * product
        product = product * (x - q[first + k][:, None])
        if k < 3:
            column = np.diff(column) / (q[k + 1 :] - q[: n - k - 1])
    fourth = np.abs(differences(q, shift))
    # the largest over five samples that hold the interval's four, or three of them
    near = np.max([fourth[np.clip(first + k, 0, n - 5)] for k in (-2, -1, 0, 1)], axis=0)
    return values, near[:, None] * np.abs(product)


def unresolved_intervals(q: Array, shift: Array, noise: Array) -> list[int]:
    """Find the intervals i, between samples i and i + 1 of n, on which zeros may be hidden."""
    out: list[int] = []
    finite = np.isfinite(shift)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], finite, [False]]).astype(np.int8)))
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        if high - low < 5:
            out += range(low, high - 1)
            continue
        part = slice(low, high)
        values, error = cubics(q[part], shift[part])
        # between its places a cubic leaves the line through them by an eighth of its second difference at most
        bend = np.abs(np.diff(values, 2)).max(axis=1, keepdims=True) / 8.0
        doubt = ERROR_SAFETY * error + bend + np.maximum(noise[part][:-1], noise[part][1:])[:, None]
        hidden = _doubtful(values, doubt)
        # where few samples show a dip, its depth is known no better than to the height it fell from
        size = np.abs(shift[part])
        dip = (size[1:-1] <= np.minimum(size[:-2], size[2:])) & (2.0 * size[1:-1] < np.maximum(size[:-2], size[2:]))
        dip &= (shift[part][:-2] < 0.0) == (shift[part][2:] < 0.0)
        hidden[:-1] |= dip
        hidden[1:] |= dip
        out += (np.flatnonzero(hidden) + low).tolist()
    return out


def _doubtful(values: Array, doubt: Array) -> NDArray[np.bool_]:
    """Whether rows of values, known within a doubt, may have other zeros than the signs of their ends ask for."""
    values = values * np.where(values[:, :1] < 0.0, -1.0, 1.0)  # from positive
    same = values[:, -1] > 0.0
    reached = values <= doubt  # may have crossed zero here
    back = values >= -doubt  # and may be on the first side here
    # after a place where it may have crossed, one where it may be back
    again = np.logical_or.accumulate(reached, axis=1)[:, :-1] & back[:, 1:]
    return np.where(same, reached.any(axis=1), again.any(axis=1))


def zeros(q: Array, shift: Array, noise: Array) -> tuple[list[tuple[int, int]], list[tuple[int, int]], bool]:
    """Return where the displacement changes sign, where it touches zero, and whether a band of it is zero."""
    decided = np.flatnonzero(np.abs(shift) > noise)
    inward = shift[decided] < 0.0
    changes, touching, band = [], [], False
    told = (inward[1:] != inward[:-1]) | (np.diff(decided) > 1)  # else there is nothing between the two
    for k in np.flatnonzero(told).tolist():
        i, j = decided[k : k + 2].tolist()
        if q[j - 1] - q[i + 1] > PERIOD_ANNULUS_WIDTH:
            band = True
        elif (shift[i] < 0.0) != (shift[j] < 0.0):
            changes.append((i, j))
        elif j > i + 1 and np.isfinite(shift[i : j + 1]).all():
            touching.append((i, j))
    return changes, touching, band


class Samples:
    """Samples of one return map, in order along the section; some of them at the fine tolerance."""

    def __init__(self, section: TurnSection, xi: Array, backward: bool = False) -> None:
        self.section, self.backward = section, backward
        self.xi, self.q = xi, section.states(xi)[1]
        self.shift = section.displacement(xi, COARSE_RTOL, backward)
        self.fine = np.zeros(len(xi), bool)

    @property
    def noise(self) -> Array:
        """Return the uncertainty of the displacement; near the critical set it is that of the distance from it."""
        return np.where(self.fine, FINE_NOISE, COARSE_NOISE) * (1.0 + np.exp(-self.q))

    def refine(self, xi: Array, also: NDArray[np.bool_], rtol: float = FINE_RTOL) -> None:
        """Add samples, by default at the fine tolerance, and repeat those marked that are not fine yet."""
        also = also & ~self.fine
        every = np.concatenate([xi, self.xi[also]])
        q = self.section.states(every)[1]
        shift = self.section.displacement(every, rtol, self.backward)
        self.shift[also] = shift[len(xi) :]
        self.fine = self.fine | also
        order = np.argsort(np.concatenate([self.xi, xi]), kind="stable")
        self.xi = np.concatenate([self.xi, xi])[order]
        self.q = np.concatenate([self.q, q[: len(xi)]])[order]
        self.shift = np.concatenate([self.shift, shift[: len(xi)]])[order]
        self.fine = np.concatenate([self.fine, np.full(len(xi), rtol == FINE_RTOL)])[order]

    def resolve(self, ends: Callable[[Array, Array], list[int]], steepest: float = NARROWEST_STEEP) -> bool:
        """Sample closer until every interval is resolved; whether that came about."""
        for _ in range(MAX_ROUNDS):
            doubtful = [
                i for i in unresolved_intervals(self.q, self.shift, self.noise) if not self._narrow(i, steepest)
            ]
            stencil = np.zeros(len(self.xi), bool)
            for i in doubtful:
                stencil[max(i - 1, 0) : i + 3] = True
            open_ = sorted({*doubtful, *ends(self.xi, self.shift)})
            if not open_:
                return True
            if len(self.xi) > MAX_SAMPLES or np.isnan(self.shift).mean() > MAX_UNDECIDED_SHARE:
                return False
            each = max(BATCH // len(open_), FEWEST)
            part = np.arange(1, each + 1) / (each + 1)
            left, right = self.xi[open_], self.xi[np.array(open_) + 1]
            # where the displacement ends, a first look is for its sign, which is plain unless a loop is near
            small = np.abs(self.shift[open_ + [i + 1 for i in open_]]) < NEAR_LOOP
            rtol = FINE_RTOL if doubtful or small.any() else COARSE_RTOL
            self.refine((left[:, None] + (right - left)[:, None] * part).ravel(), stencil, rtol)
        return False

    def rises(self, pairs: list[tuple[int, int]]) -> NDArray[np.bool_]:
        """Whether both displacements of each pair of samples are above the noise measured around them."""
        near = [np.arange(max(i - NOISE_REACH, 0), min(j + NOISE_REACH + 1, len(self.xi))) for i, j in pairs]
        least = np.array([np.abs(self.shift[[i, j]]).min() for i, j in pairs])
        small = np.flatnonzero(least < MAY_BE_NOISE)
        if not len(small):
            return np.ones(len(pairs), bool)
        at = np.unique(np.concatenate([near[k] for k in small]))
        apart = np.zeros(len(self.xi))
        again = self.section.displacement(self.xi[at], OTHER_RTOL, self.backward, noise=0.0)
        both = np.isfinite(again) & np.isfinite(self.shift[at])
        apart[at[both]] = np.abs(again[both] - self.shift[at[both]])
        noise = np.array([apart[places].max() for places in near])
        return least > NOISE_MULTIPLE * noise

    def _narrow(self, i: int, steepest: float) -> bool:
        """Whether an interval is as narrow as makes sense: steep, a jump may still differ from a slope."""
        steep = abs(self.shift[i + 1] - self.shift[i]) > STEEP
        width = self.xi[i + 1] - self.xi[i]
        return bool(width < (NARROWEST if not steep else steepest * max(1.0, abs(self.xi[i]))))


def _least_extremum(q: Array, shift: Array, noise: Array) -> float:
    """Return the smallest size of the extrema of three neighbouring samples, by their parabola; inf without any."""
    left, right = np.diff(shift)[:-1], np.diff(shift)[1:]
    at = np.flatnonzero((left * right <= 0.0) & (np.maximum(abs(left), abs(right)) > RISE * noise[1:-1]))
    u, v = q[at] - q[at + 1], q[at + 2] - q[at + 1]
    first, second = -left[at] / u, right[at] / v
    bend, slope = (second - first) / (v - u), (first * v - second * u) / (v - u)
    turned = slope * slope / (4.0 * bend)  # first and second differ, or both were zero, and so the rise
    return float(abs(shift[at + 1] - turned).min(initial=math.inf))


def near_fold(q: Array, shift: Array, noise: Array) -> float:
    """Return the smallest size of the displacement at one of its extrema, to within its noise; inf if it has none."""
    finite = np.concatenate([[False], np.isfinite(shift), [False]]).astype(np.int8)
    ends = np.flatnonzero(np.diff(finite)).tolist()
    runs = [slice(*run, k) for run in zip(ends[::2], ends[1::2], strict=True) for k in STRIDES]
    least = min((_least_extremum(q[run], shift[run], noise[run]) for run in runs), default=math.inf)
    flat = np.concatenate([[False], np.abs(shift) <= RISE * noise, [False]]).astype(np.int8)
    edges = np.flatnonzero(np.diff(flat))
    for low, high in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        neighbours = shift[[low - 1, high]] if low > 0 and high < len(shift) else np.zeros(1)
        if np.isfinite(neighbours).all() and neighbours.min() * neighbours.max() > 0.0:
            least = min(least, float(np.abs(shift[low:high]).max()))
    return least
