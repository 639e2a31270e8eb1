"""Critical sets along one parameter, and where they change: |A^-1 f| = 1, det A = 0, Hopf, node-focus."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..layer_problem.lyapunov import first_lyapunov
from ..numerics.sign_changes import roots
from ..psi.constructors import with_parameter
from ..special_kinds import HOPF, NODE_FOCUS
from ..words import say
from .result import CriticalBranch, SpecialValue
from .test_functions import KINDS, Linearisation, Plane, SystemPath, border_functions, linearise

__all__ = ["ExistenceBorders", "critical_part", "existence_borders"]


_SAMPLES = 49
# Crowded towards both ends: there the curves have vertical tangents
CHEBYSHEV_SAMPLES = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, _SAMPLES + 1) / (_SAMPLES + 1)))

# Next to the equator a critical set is a node, but for a part of 1e-8 of a piece or less it may have been a focus
_END_OFFSETS = np.geomspace(1e-11, 1e-4, 8)
CROWDED_SAMPLES = np.concatenate([_END_OFFSETS, CHEBYSHEV_SAMPLES, 1.0 - _END_OFFSETS[::-1]])

_MAX_MOVE, MAX_HALVINGS = 0.1, 10  # p moves by at most this between samples, unless so many halvings are not enough
OFF_CENTRE = 0.4567  # in the middle of a piece symmetry likes to put something special


class ExistenceBorders:
    """Values at which the critical set begins, ends, or is not isolated.

    Attributes
    ----------
    equator, touching : ndarray
        Values with |A^-1 f| = 1: where |A^-1 f| - 1 changes its sign, and where it does not.
    singular : ndarray
        Values with det A = 0.
    line : ndarray of bool
        For each of `singular`: f is in the range of A.
    """

    def __init__(self, equator: Array, touching: Array, singular: Array, line: NDArray[np.bool_]) -> None:
        self.equator, self.touching, self.singular, self.line = equator, touching, singular, line

    @property
    def all(self) -> Array:
        """All these values, increasing."""
        return np.sort(np.concatenate([self.equator, self.touching, self.singular]))


def existence_borders(path: SystemPath, grid: Array, exponent: int) -> ExistenceBorders:
    """Find where |A^-1 f| = 1 and where det A = 0."""
    plane = path(grid)
    if plane.rigid:
        return ExistenceBorders(np.zeros(0), np.zeros(0), np.zeros(0), np.zeros(0, bool))
    gap, det = border_functions(plane, exponent)
    singular = roots(lambda v: border_functions(path(v), exponent)[1], [grid], [det]).zeros[0]
    plane = path(singular)
    size = sum((abs(np.ldexp(v, exponent)) for v in plane.arrays), np.full(len(singular), 1e-300))
    line = -border_functions(plane, exponent)[0] <= (1e-9 * size**2) ** 2  # it is -|adj(A) f|^2 there
    found = roots(lambda v: border_functions(path(v), exponent)[0], [grid], [gap])
    equator, touching = found.zeros[0], found.touches[0]
    width = grid[-1] - grid[0]
    for value in singular[line]:
        equator = equator[abs(equator - value) > 1e-6 * width]
        touching = touching[abs(touching - value) > 1e-6 * width]
    return ExistenceBorders(equator, touching, singular, line)


def _focus(found: Linearisation) -> Array:
    """Discriminant of J as a share of its terms: the same size however near the equator is."""
    size = found.trace**2 + 4.0 * abs(found.determinant)
    return found.discriminant / np.where(size > 0.0, size, 1.0)


def _critical_angle(plane: Plane, i: int) -> float:
    """Angle of -A^-1 f at value i."""
    m11, m12, m21, m22, f1, f2 = (float(v[i]) for v in plane.affine)
    sign = -math.copysign(1.0, m11 * m22 - m12 * m21)
    turn = 0.0 if plane.told is None else float(plane.told[i])
    return math.atan2(sign * (m11 * f2 - m21 * f1), sign * (m22 * f1 - m12 * f2)) + turn


def critical_part(
    path: SystemPath, grid: Array, exponent: int, cuts: ExistenceBorders, extra: Array
) -> tuple[list[CriticalBranch], list[SpecialValue]]:
    """Branches of the critical set and its special values between the ends of the grid; `extra`: where else to look."""
    special = _border_points(path, exponent, cuts)
    width = float(grid[-1] - grid[0])
    ends = [float(grid[0]), *cuts.all.tolist(), float(grid[-1])]
    pieces = [(low, high) for low, high in pairwise(ends) if high - low > 1e-13 * width]
    samples = [np.union1d(u + (v - u) * CROWDED_SAMPLES, extra[(extra > u) & (extra < v)]) for u, v in pieces]
    found = linearise(path(np.concatenate(samples)), exponent)
    at = np.cumsum([len(x) for x in samples])[:-1]
    share, focus = np.split(found.share, at), np.split(_focus(found), at)
    stands = np.split(found.exists, at)
    standing = [k for k in range(len(pieces)) if stands[k].mean() > 0.5]
    grids = [samples[k][stands[k]] for k in standing]
    neutral = roots(lambda v: linearise(path(v), exponent).share, grids, [share[k][stands[k]] for k in standing])
    turning = roots(lambda v: _focus(linearise(path(v), exponent)), grids, [focus[k][stands[k]] for k in standing])
    branches: list[CriticalBranch] = []
    for k, inner, trace, touch, shape in zip(
        standing, grids, neutral.zeros, neutral.touches, turning.zeros, strict=True
    ):
        # where all of A vanishes as well, rounding leaves a sign to det A
        hopf = trace[border_functions(path(trace), exponent)[1] > 1e-12]
        u, v = pieces[k]
        inner = inner[(inner - u > _END_OFFSETS[-1] * (v - u)) & (v - inner > _END_OFFSETS[-1] * (v - u))]
        parts, kinds = _cut_at_changes(path, inner, pieces[k], np.sort(np.concatenate([hopf, shape])))
        branches += [_critical_branch(path, part, kind) for part, kind in zip(parts, kinds, strict=True)]
        special += [_hopf_point(path, v) for v in hopf.tolist()]
        special += [_focus_point(path, v) for v in shape.tolist()]
        special += [_neutral_point(path, v) for v in touch.tolist()]
    return branches, special


def _cut_at_changes(
    path: SystemPath, x: Array, ends: tuple[float, float], changes: Array
) -> tuple[list[Array], list[str]]:
    """Values of each part between changes of kind, and the kinds; parts of one kind are joined."""
    stops = [ends[0], *changes.tolist(), ends[1]]
    middles = np.array([u + OFF_CENTRE * (v - u) for u, v in pairwise(stops)])
    kinds = linearise(path(middles)).kind.tolist()
    parts: list[Array] = []
    names: list[str] = []
    for i, kind in enumerate(kinds):
        u, v = stops[i], stops[i + 1]
        values = np.array([u, *x[(x > u) & (x < v)], v])
        if names and names[-1] == KINDS[kind]:
            parts[-1] = np.concatenate([parts[-1], values[1:]])
        else:
            parts.append(values)
            names.append(KINDS[kind])
    return parts, names


def _critical_branch(path: SystemPath, values: Array, kind: str) -> CriticalBranch:
    for _ in range(MAX_HALVINGS):
        found, e, p = _sets_at(path, values)
        far = np.flatnonzero(np.hypot(*np.diff(p, axis=0).T) > _MAX_MOVE)
        if not len(far):
            break
        values = np.sort(np.concatenate([values, 0.5 * (values[far] + values[far + 1])]))
    found, e, p = _sets_at(path, values)
    arrays = values, e, p, found.trace, found.determinant
    for array in arrays:
        array.flags.writeable = False
    return CriticalBranch(*arrays, kind)


def _sets_at(path: SystemPath, values: Array) -> tuple[Linearisation, Array, Array]:
    """Critical sets, e and p at the values of a branch, whose ends may lie on the equator or where det A = 0."""
    plane = path(values)
    found = linearise(plane)
    e, p = found.e.copy(), found.p.copy()
    for i in (0, -1):
        if found.exists[i] and 1.0 - np.hypot(*e[i]) >= 1e-12:
            continue
        m11, m12, m21, m22 = (float(v[i]) for v in plane.affine[:4])
        if abs(m11 * m22 - m12 * m21) <= 1e-12 * (abs(m11 * m22) + abs(m12 * m21)):
            # a whole line of equilibria: where the branch arrives shows a little before
            inner = values[i] + 1e-6 * (values[i + 1 if i == 0 else i - 1] - values[i])
            there = linearise(path(np.array([inner])))
            e[i], p[i] = there.e[0], there.p[0]
        else:
            t = _critical_angle(plane, i)
            e[i] = p[i] = math.cos(t), math.sin(t)
    return found, e, p


def _border_points(path: SystemPath, exponent: int, cuts: ExistenceBorders) -> list[SpecialValue]:
    special = []
    for values, kind, what in (
        (cuts.equator, "transcritical", "border, turns"),
        (cuts.touching, "touching the equator", "border, turns back"),
    ):
        plane = path(values)
        for i, value in enumerate(values.tolist()):
            t = _critical_angle(plane, i)
            special.append(SpecialValue(kind, value, (math.cos(t), math.sin(t)), say(what, theta=t % math.tau)))
    for value, line in zip(cuts.singular.tolist(), cuts.line.tolist(), strict=True):
        if line:
            at = linearise(path(np.array([value + 1e-7 * max(1.0, abs(value))])), exponent)
            place = (float(at.p[0, 0]), float(at.p[0, 1]))
            special.append(SpecialValue("line of equilibria", value, place, say("line at one value")))
        else:
            special.append(SpecialValue("det A = 0", value, (0.0, 0.0), say("through infinity")))
    return special


def _point(path: SystemPath, value: float) -> tuple[Plane, Linearisation, tuple[float, float]]:
    plane = path(np.array([value]))
    found = linearise(plane)
    return plane, found, (float(found.p[0, 0]), float(found.p[0, 1]))


def _hopf_point(path: SystemPath, value: float) -> SpecialValue:
    plane, found, place = _point(path, value)
    psi = plane.psi if plane.n is None else with_parameter(plane.psi, float(plane.n[0]))
    # in the centre the formulas for the derivatives of Psi divide by s = 0
    x2 = found.x2 if np.hypot(*found.x2[0]) > 1e-9 else np.full((1, 2), 1e-9)
    with np.errstate(all="ignore"):
        number = float(first_lyapunov(plane.matrix(0), psi, x2)[0])
    if not math.isfinite(number):
        number = 0.0
    born = "supercritical" if number < 0.0 else "subcritical" if number > 0.0 else "degenerate"
    return SpecialValue(HOPF.kind, value, place, say(f"Hopf, {born}", number=number), number)


def _neutral_point(path: SystemPath, value: float) -> SpecialValue:
    place = _point(path, value)[2]
    return SpecialValue("tr J = 0", value, place, say("trace touches zero"))


def _focus_point(path: SystemPath, value: float) -> SpecialValue:
    place = _point(path, value)[2]
    return SpecialValue(NODE_FOCUS.kind, value, place, NODE_FOCUS.says)
