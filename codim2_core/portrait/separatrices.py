"""Separatrices: the skeleton of a portrait, as a graph from saddles to where their branches end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ..numerics.arclength import distance
from ..results.arrays import Array
from ..results.words import say
from ..systems.kinds import AnySystem, takes_names
from ..systems.psi.function import Psi
from .cycles.limit_cycles import LimitCycles, cycles_of
from .layer_problem.equator import EquatorEquilibria
from .layer_problem.problem import LayerProblem
from .omega_limits import drawn_time, radially_neutral
from .orbits.seeds import PIXEL
from .separatrix_branches import Separatrices, Separatrix, bent_branch, branches_inside, outside_half_saddle, ray


def _gap(one: Array, other: Array) -> float:
    """Distance of the middle of `other`, by arc length, from the polyline `one`."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(other, axis=0).T))])
    at = np.array([np.interp(0.5 * length[-1], length, other[:, k]) for k in range(2)])
    return float(distance(at, one))


def gaps_between(branches: list[Separatrix]) -> dict[tuple[int, int], float]:
    """Distances between each unstable branch and each stable one of another saddle, by their places in the list."""
    gaps = {}
    for i, leaving in enumerate(branches):
        for j, entering in enumerate(branches):
            if leaving.direction != "unstable" or entering.direction != "stable" or leaving.origin == entering.origin:
                continue
            gaps[i, j] = min(_gap(leaving.points, entering.points), _gap(entering.points, leaving.points))
    return gaps


def name_connections(
    branches: list[Separatrix], gaps: dict[tuple[int, int], float], tolerance: float
) -> list[Separatrix]:
    """Name saddle connections: an unstable branch that coincides with a stable one of another saddle."""
    out = list(branches)
    for (i, j), gap in gaps.items():
        if gap <= tolerance:
            leaving, entering = branches[i].origin, branches[j].origin
            sentence = say("saddle connection", leaving=leaving, entering=entering, gap=gap)
            out[i] = replace(out[i], end=entering, connection=True, gap=gap, status=sentence)
            out[j] = replace(out[j], end=leaving, connection=True, gap=gap, status=sentence)
            continue
        for k in (i, j):
            known = out[k].gap
            if known is None or gap < known:
                out[k] = replace(out[k], gap=gap)
    return out


@takes_names
def separatrices(
    system: AnySystem,
    psi: Psi,
    z: ArrayLike = (),
    *,
    t_max: float | None = None,
    rtol: float = 1e-9,
    view: float = 2.0,
    pixel: float = PIXEL,
    tolerance: float = 1e-6,
    cycles: LimitCycles | None = None,
) -> Separatrices:
    """Separatrices of the critical sets that are saddles, and of the half-saddles on the equator, Theorem 3.1(b).

    Branches of C start on a polynomial of order `saddle_manifold.ORDER` (5) of the invariant manifold, those of Q
    on an expansion of order 2 in ebar (`orbits.departures`), each at a distance where its error is below rtol.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    t_max : float, optional
        Longest time T drawn of a branch; default 600 over the unit of speed, |(a, b, d, f1, f2)| or max |U|. Where it
        ends is decided beyond that.
    rtol : float
    view, pixel : float
        As in `trajectories`.
    tolerance : float
        Distance in the disc within which the branches of two saddles count as a connection.
    cycles : LimitCycles, optional
        Of the same system, where they are known already.

    Returns
    -------
    Separatrices

    Examples
    --------
    >>> from codim2_core import ELinear, psi, separatrices
    >>> found = separatrices(ELinear(1.0, 0.3, -1.2, (0.2, 0.45)), psi.constant())
    >>> [(one.direction, one.end) for one in found if one.origin == "C"]
    [('unstable', 'Q3'), ('unstable', 'Q1'), ('stable', 'Q4'), ('stable', 'Q2')]
    """
    problem = LayerProblem(system.at(z), psi).give(cycles_of, cycles)
    return separatrices_of(problem, t_max=t_max, rtol=rtol, view=view, pixel=pixel, tolerance=tolerance)


def separatrices_of(
    problem: LayerProblem,
    *,
    t_max: float | None = None,
    rtol: float = 1e-9,
    view: float = 2.0,
    pixel: float = PIXEL,
    tolerance: float = 1e-6,
) -> Separatrices:
    """Separatrices of a layer problem, with the parameters of `separatrices`."""
    equator = problem.equator
    longest = drawn_time(problem.at, equator) if t_max is None else t_max

    def inside(pixel: float) -> list[Separatrix]:
        leaving, entering = (branches_inside(problem, longest, rtol, pixel, back) for back in (False, True))
        return leaving + entering

    branches = inside(pixel)
    gaps = gaps_between(branches)
    if gaps and min(gaps.values()) < 2.0 * pixel:
        # Drawn lines are too coarse to tell a connection from a near miss.
        gaps = gaps_between(inside(min(pixel, tolerance)))
    branches = name_connections(branches, gaps, tolerance)
    rays = [i for i in range(len(equator)) if outside_half_saddle(equator, i)]
    if problem.at.reads_position:
        branches += [bent_branch(problem, i, longest, rtol, view, pixel) for i in rays]
    else:
        branches += [ray(equator, i, view) for i in rays]
    for branch in branches:
        branch.points.flags.writeable = False
    return Separatrices(tuple(branches), _notes(equator, branches))


def _notes(equator: EquatorEquilibria, branches: list[Separatrix]) -> tuple[str, ...]:
    notes = [b.status for b in branches if b.connection and b.direction == "unstable"]
    notes += [say("branches not followed", Q=f"Q{i + 1}") for i in range(len(equator)) if radially_neutral(equator, i)]
    notes += [say("branch undecided", origin=b.origin, status=b.status) for b in branches if b.end == "undecided"]
    if equator.all_directions:
        notes.append(say("no separatrices"))
    return tuple(dict.fromkeys(notes))
