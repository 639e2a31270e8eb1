"""All that stands still along one parameter, with the points that are special."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..arrays import Array
from ..continuation.result import CycleBranches
from ..numerics.sign_changes import roots
from ..psi.function import Psi
from ..words import say
from .critical import critical_part, existence_borders
from .equator import equator_part
from .family import linear_path, values_over
from .further_kinds import further_kinds
from .recheck_intervals import samples_beside
from .result import Branches, ClosedEquator, CriticalBranch, DirectionBranch, SpecialValue
from .test_functions import Plane, SystemPath, scale
from .typed.general_diagram import general_parts

_MAX_AUDITS = 5  # times that special values are looked for


def equilibrium_branches(system: Any, psi: Psi, along: str, span: Sequence[float], z: ArrayLike = ()) -> Branches:
    """Find everything that stands still along one parameter; see `bifurcation_diagram`, which takes the same.

    Special values are found on a grid of 512 steps and then to the last digits. Two of one kind between neighbouring
    grid points are found too, if the function behind them is smooth on that scale and exceeds 1e-13 of its largest
    size between the two. Then the portrait's class is compared along every interval between special values, and where
    it changes they are looked for again (`recheck_intervals`).
    """
    low, high = (float(v) for v in span)
    if not (np.isfinite([low, high]).all() and low < high):
        raise ValueError(f"the span of {along} is {low:g} to {high:g}; give two finite numbers, the smaller one first.")
    directions, orbits, sets, special, gaps = _find_parts(system, psi, along, (low, high), z)
    special += further_kinds(system, psi, along, z, [*directions, *sets])
    special.sort(key=lambda s: s.value)
    none = CycleBranches(along, (low, high), (), say("cycles not looked for"))
    slow = tuple(float(v) for v in np.atleast_1d(np.asarray(z, float)))
    parts = tuple(directions), tuple(orbits), tuple(sets), tuple(special), tuple(gaps), none
    return Branches(system, psi, slow, along, (low, high), *parts)


EquilibriumParts = tuple[list[DirectionBranch], list[ClosedEquator], list[CriticalBranch], list[SpecialValue]]
Gaps = list[tuple[float, float]]


def _find_parts(
    system: Any, psi: Psi, along: str, span: tuple[float, float], z: ArrayLike
) -> tuple[list[DirectionBranch], list[ClosedEquator], list[CriticalBranch], list[SpecialValue], Gaps]:
    """Find branches, special values and gaps, in any order."""
    grid = values_over(span)
    path = linear_path(system, psi, z, along, grid)
    if path is None:
        directions, orbits, sets, found = general_parts(system, psi, along, span, z)
        return directions, orbits, sets, found, []
    whole = path(grid)
    exponent = scale(whole)
    runs, gaps = _runs(path, grid, whole)
    equator: list[DirectionBranch] = []
    closed: list[ClosedEquator] = []
    critical: list[CriticalBranch] = []
    special: list[SpecialValue] = []
    for run in runs:
        directions, orbits, sets, found = _mark_run(path, run, exponent)
        equator += directions
        closed += orbits
        critical += sets
        special += found
    return equator, closed, critical, special, gaps


def _mark_run(path: SystemPath, run: Array, exponent: int) -> EquilibriumParts:
    """Branches and special values of a run, looked for again where something changes between them."""
    extra = np.zeros(0)
    parts: EquilibriumParts = [], [], [], []
    for _ in range(_MAX_AUDITS):
        cuts = existence_borders(path, run, exponent)
        critical, special = critical_part(path, run, exponent, cuts, extra)
        equator, closed, more = equator_part(path, run, exponent, cuts)
        special += more
        parts = equator, closed, critical, special
        if path(run).rigid:
            break
        beside = samples_beside(path, run, np.unique([s.value for s in special]))
        if not len(beside):
            break
        extra = np.union1d(extra, beside)
        run = np.union1d(run, beside)
    return parts


def _runs(path: SystemPath, grid: Array, whole: Plane) -> tuple[list[Array], list[tuple[float, float]]]:
    """Parts of the grid on which all coefficients are finite, and what lies between."""
    defined = whole.defined
    poles: list[float] = []
    if not path.affine:
        for i in range(6):
            found = roots(lambda v, i=i: path(v).affine[i], [grid], [whole.affine[i]]).poles[0]
            poles += found.tolist()
    if defined.all() and not poles:
        return [grid], []
    cut = np.isin(np.arange(len(grid) - 1), np.searchsorted(grid, poles) - 1)
    runs, start = [], None
    for i in range(len(grid)):
        if start is None and defined[i]:
            start = i
        if start is not None and (i + 1 == len(grid) or cut[i] or not defined[i + 1]):
            if i - start > 2:
                runs.append(grid[start : i + 1])
            start = None
    stops = [float(grid[0]), *(float(v) for run in runs for v in (run[0], run[-1])), float(grid[-1])]
    return runs, [(u, v) for u, v in zip(stops[::2], stops[1::2], strict=True) if v > u]
