"""Fixed points of the return map on a global section; see `global_section` for that.

The section is ``e = e_C + r u``, ``r = R/(1 + exp(-xi))`` with R where it meets the equator; xi is a parameter of
it that resolves both ends. A point is measured by ``q = ln u.(x2 - x2_C)``, which increases along the section, and
the displacement is ``q(after one turn) - q``: -inf where the orbit goes to C, +inf where it goes to the equator.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..numerics.root_between import root_through
from ..words import say
from .displacement_sampling import NEAR_FOLD, UNRESOLVED, Samples, near_fold, zeros
from .global_section import COARSE_RTOL, FINE_RTOL, INNER_RADIUS, Array, FixedPoint, Section

FOLD_NOISE = 1e-9  # noise with which a fold can be told: not so near C that all displacements are small
MIN_JUMP_WIDTH = 1e-3  # width at which a jump from -inf to +inf is left to the map backward in time
FINE_SPACING, AGREED = 0.02, 1e-10  # spacing of the samples about a fixed point; how far two interpolants may differ
NOISE = 1e-8  # displacement that COARSE cannot tell from zero
NEAR_LOOP = 1e-3
MEASURED, MIN_CYCLE_RADIUS = 2.0, 1e-8  # where the expansion at C is measured, in INNER; the smallest cycle, in r/R


def _sample_between(low: float, high: float, count: int) -> Array:
    return low + (high - low) * np.arange(1, count + 1) / (count + 1)


def _has_converged(shift: Array, inner: int, step: int) -> bool:
    """Whether the displacement has all but reached its limit where orbits stop returning, well away from zero.

    Past a saddle it converges like a power of the distance; over the last samples that distance fell fourfold.
    """
    last = 3 * step + inner
    if not 0 <= last < len(shift):
        return False
    y, before = shift[inner], shift[last]
    return bool(np.isfinite(before) and abs(y) > 8.0 * abs(y - before))


def _open_intervals(xi: Array, shift: Array) -> list[int]:
    """Intervals at whose one end orbits return and at whose other they do not, where a fixed point may hide."""
    finite = np.isfinite(shift)
    width = np.diff(xi)
    candidates = width > 1e-12 * np.maximum(1.0, np.abs(xi[:-1]))
    jumps = candidates & (width > MIN_JUMP_WIDTH) & np.isinf(shift[:-1]) & (shift[1:] == -shift[:-1])
    new = []
    for i in np.flatnonzero(candidates & (finite[1:] != finite[:-1])).tolist():
        # Before the displacement jumps to +inf; to -inf, on C, it goes continuously.
        inner, outer, step = (i, i + 1, -1) if finite[i] else (i + 1, i, 1)
        hidden = shift[outer] > 0.0 or (np.isinf(shift[outer]) and shift[inner] > 0.0)
        if hidden and not (width[i] < 0.05 and _has_converged(shift, inner, step)):
            new.append(i)
    return [*new, *np.flatnonzero(jumps).tolist()]


def _one_way(y: Array) -> bool:
    """Whether displacements are finite, and all rise or all fall from one sample to the next."""
    if not np.isfinite(y).all():
        return False
    steps = np.diff(y)
    return bool((steps > 0.0).all() or (steps < 0.0).all())


def _interpolate_fixed_point(
    section: Section, x: Array, y: Array, low: float, high: float, backward: bool
) -> float | None:
    """Find the fixed point between low and high by six samples about the zero of the cubic through those around.

    None if these do not show it: they do if their interpolant and that of the inner four agree.
    """
    guess = root_through(x, y)
    if not low < guess < high:
        return None
    x = guess + min(FINE_SPACING, 0.1 * (high - low)) * np.array([-2.5, -1.5, -0.5, 0.5, 1.5, 2.5])
    y = section.displacement(x, FINE_RTOL, backward)
    if not _one_way(y) or y[0] * y[-1] > 0.0:
        return None
    found = root_through(x, y)
    return found if abs(found - root_through(x[1:-1], y[1:-1])) < AGREED else None


def _bracket_fixed_point(section: Section, low: float, high: float, backward: bool) -> float:
    """Find the fixed point between low and high, where the displacement has opposite signs, by rounds of samples."""
    for _ in range(8):
        x = np.concatenate([[low], _sample_between(low, high, 30), [high]])
        y = section.displacement(x, COARSE_RTOL, backward)
        changes = np.flatnonzero((y[1:] < 0.0) != (y[:-1] < 0.0))
        k = int(changes[0]) if len(changes) else len(x) // 2
        low, high = float(x[k]), float(x[k + 1])
        if high - low < 1e-3 and np.isfinite(y[max(k - 2, 0) : k + 4]).all():
            break
    width = high - low
    x = low + width * np.array([-2.0, -1.0, 0.0, 1.0, 2.0, 3.0])
    y = section.displacement(x, FINE_RTOL, backward)
    if not np.isfinite(y).all() or len(np.unique(y)) < len(y):
        return 0.5 * (low + high)
    guess = root_through(x, y)
    return guess if low - width <= guess <= high + width else 0.5 * (low + high)


def _polish_fixed_point(section: Section, xi: Array, shift: Array, i: int, j: int, backward: bool) -> float:
    """Find the fixed point between samples i and j of opposite sign."""
    low, high = float(xi[i]), float(xi[j])
    near = slice(max(i - 1, 0), j + 2)
    found = (
        _interpolate_fixed_point(section, xi[near], shift[near], low, high, backward) if _one_way(shift[near]) else None
    )
    return _bracket_fixed_point(section, low, high, backward) if found is None else found


def _cycle_near_hopf(section: Section) -> FixedPoint | None:
    """Place a cycle below the innermost sample: ``displacement = 2 pi mu/omega + c r^2``, its first term exact.

    c is measured well outside the cycle, where rounding (1e-16/r) does not matter yet; what is left is of order r^2.
    None below `MIN_CYCLE_RADIUS`, where the trace of J has lost its digits.
    """
    C = section.critical
    linear = 2.0 * math.pi * C.trace / math.sqrt(-C.discriminant)
    r = INNER_RADIUS * MEASURED * np.array([1.0, 2.0, 4.0])
    parts = (section.displacement(np.log(r / (1.0 - r)), FINE_RTOL) - linear) / r**2
    square = float(parts @ (8.0, -6.0, 1.0)) / 3.0  # takes out the next two powers of r
    if not square * linear < 0.0:
        return None
    size = math.sqrt(-linear / square)
    if not MIN_CYCLE_RADIUS <= size < 2.0 * INNER_RADIUS:
        return None
    return FixedPoint(math.log(size / (1.0 - size)), square > 0.0, born=True)


def _nearly_degenerate(q: Array, shift: Array, noise: Array) -> list[str]:
    """Say where orbits nearly close along a loop, and where two fixed points nearly meet."""
    last = shift[:-1][np.isfinite(shift[:-1]) & (shift[1:] == np.inf)]
    said = [say("near a loop", gap=y) for y in last.tolist() if abs(y) < NEAR_LOOP]
    gap = near_fold(q, shift, noise)
    return [*said, say("near a fold", gap=gap)] if gap < NEAR_FOLD else said


@dataclass(frozen=True)
class ReturnMapSamples:
    """Samples of a return map that resolve it, and what they show of its fixed points.

    Attributes
    ----------
    section : Section
    xi, q, shift : ndarray (n,)
        Where the samples are, and the displacements there.
    changes : tuple of (int, int)
        Between which samples the displacement changes its sign.
    touching : tuple of int
        At which it comes to zero and turns back.
    notes : tuple of str
    """

    section: Section
    xi: Array
    q: Array
    shift: Array
    changes: tuple[tuple[int, int], ...]
    touching: tuple[int, ...]
    notes: tuple[str, ...]

    @property
    def newborn(self) -> bool:
        """Whether a cycle lies below the innermost sample."""
        C = self.section.critical
        return bool(
            self.shift.size and np.isfinite(self.shift[0]) and C.discriminant < 0.0 and self.shift[0] * C.trace < 0.0
        )

    @property
    def certain(self) -> int:
        """Return how many sign changes, from the first, are surely fixed points, with none missed before them."""
        if self.notes or self.touching or self.newborn:
            return -1
        finite = np.isfinite(self.shift).tolist()
        return next((k for k, (i, j) in enumerate(self.changes) if not (finite[i] and finite[j])), len(self.changes))


def sample_return_map(section: Section) -> ReturnMapSamples:
    """Sample the return map of a section until the samples resolve it."""
    notes: list[str] = []
    samples = Samples(section, section.grid())
    finite = np.isfinite(samples.shift)
    if finite.sum() >= 8 and np.abs(samples.shift[finite]).max() < NOISE:
        none = np.zeros(0)
        return ReturnMapSamples(section, none, none, none, (), (), (say("identity"),))
    if not samples.resolve(_open_intervals):
        notes.append(UNRESOLVED)
    known = ~np.isnan(samples.shift)
    if not known.all():
        notes.append(say("not all followed"))
    xi, q, shift, noise = (v[known] for v in (samples.xi, samples.q, samples.shift, samples.noise))
    changes, touching, band = zeros(q, shift, noise)
    if band:
        notes.append(say("band"))
    notes += _nearly_degenerate(q, shift, noise)
    meeting = tuple(i for i in touching if noise[i] < FOLD_NOISE)
    return ReturnMapSamples(section, xi, q, shift, tuple(changes), meeting, tuple(notes))


def find_fixed_points(samples: ReturnMapSamples, first: int = 0) -> list[FixedPoint]:
    """Place the fixed points at the changes of sign of the displacement, from the first or a later one.

    One that repels attracts backward in time: it is found and followed backward. It may repel so strongly that forward
    no sample beside it returns; then the way back shows whether it is there.

    Parameters
    ----------
    samples : ReturnMapSamples
    first : int
        The first change.
    """
    section, xi, shift, found = samples.section, samples.xi, samples.shift, []
    for i, j in samples.changes[first:]:
        repelling = bool(shift[i] < 0.0)
        known = bool(np.isfinite(shift[[i, j]]).all())
        if repelling and not known:
            back = section.displacement(xi[[i, j]], backward=True)
            known = bool(back[0] > 0.0 > back[1])
        if known:
            found.append(FixedPoint(_polish_fixed_point(section, xi, shift, i, j, repelling), repelling))
    return found


def search(samples: ReturnMapSamples) -> tuple[tuple[FixedPoint, ...], tuple[str, ...]]:
    """Find the fixed points that the samples show, innermost first, and notes on what is nearly degenerate.

    Parameters
    ----------
    samples : ReturnMapSamples
    """
    section, xi, notes = samples.section, samples.xi, samples.notes
    found = find_fixed_points(samples)
    found += [FixedPoint(float(xi[i]), touching=True) for i in samples.touching]
    if samples.newborn:
        newborn = _cycle_near_hopf(section)
        if newborn is not None:
            found.append(newborn)
        else:
            notes = (*notes, say("too small, about C"))
    return tuple(sorted(found, key=lambda crossing: crossing.xi)), notes
