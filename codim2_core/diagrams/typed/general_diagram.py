"""The one-parameter diagram of a general system, by the exact functions at single values and bisection."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...arrays import Array
from ...psi.function import Psi
from ..equator import link_zeros
from ..result import ClosedEquator, CriticalBranch, DirectionBranch, SpecialValue
from .cancellation_zones import RoughError, States
from .changes import SIDE_STEP, match_sets, pieces_between
from .name_changes import name_changes
from .state import State

__all__ = ["general_parts"]

GeneralParts = tuple[list[DirectionBranch], list[ClosedEquator], list[CriticalBranch], list[SpecialValue]]

_GRID_CELLS = 48


def general_parts(system: Any, psi: Psi, name: str, span: tuple[float, float], z: ArrayLike) -> GeneralParts:
    """Branches and special values of any system; see `bifurcation_diagram`."""
    state = States(system, psi, name, span, z)
    low, high = span
    width = high - low
    # off the round numbers on which special values like to lie
    u = (np.arange(_GRID_CELLS + 1) + 0.3 * np.sin(2.0 + 1.7 * np.arange(_GRID_CELLS + 1))) / _GRID_CELLS
    u[[0, -1]] = 0.0, 1.0
    values = (low + width * np.clip(u, SIDE_STEP, 1.0 - SIDE_STEP)).tolist()
    while True:
        try:
            pieces, changes = pieces_between(state, [state(v) for v in values], width)
            break
        except RoughError as found:
            state.leave_out(found.zone)
    special = [one for change in changes for one in name_changes(*change)]
    equator: list[DirectionBranch] = []
    closed: list[ClosedEquator] = []
    critical: list[CriticalBranch] = []
    for piece in pieces:
        states = [s for s in piece if s.difference(piece[0]) is None]
        values = np.array([s.value for s in states])
        equator += _direction_branches(values, states)
        critical += _sets(values, states)
        if states[0].exponent is not None:
            sign = states[len(states) // 2].exponent or 0.0
            kind = "attracting from outside" if sign < 0 else "repelling from outside" if sign > 0 else "neutral"
            x, y = _read_only(values, [s.exponent for s in states])
            closed.append(ClosedEquator(x, y, kind))
    return equator, closed, critical, special


def _direction_branches(values: Array, states: list[State]) -> list[DirectionBranch]:
    first = states[0].equator
    if not len(first):
        return []
    theta = link_zeros(np.array([s.equator.theta for s in states]))
    out = []
    for j in range(len(first)):
        own = [
            int(abs(np.exp(1j * s.equator.theta) - np.exp(1j * t[j])).argmin())
            for s, t in zip(states, theta, strict=True)
        ]
        rho = [s.equator.lambda_rho[i] for s, i in zip(states, own, strict=True)]
        slope = [s.equator.lambda_theta[i] for s, i in zip(states, own, strict=True)]
        x, t, rho_, slope_ = _read_only(values, theta[:, j], rho, slope)
        out.append(DirectionBranch(x, t, rho_, slope_, first.kind(own[0])))
    return out


def _sets(values: Array, states: list[State]) -> list[CriticalBranch]:
    rows = [list(states[0].critical)]
    for s in states[1:]:
        rows.append(match_sets([C.p for C in rows[-1]], s.critical))
    out = []
    for column in zip(*rows, strict=True):
        x, e, p = _read_only(values, [C.e for C in column], [C.p for C in column])
        trace, determinant = _read_only([C.trace for C in column], [C.determinant for C in column])
        out.append(CriticalBranch(x, e, p, trace, determinant, column[0].kind))
    return out


def _read_only(*rows: Any) -> tuple[Array, ...]:
    out = tuple(np.array(row, float) for row in rows)
    for array in out:
        array.flags.writeable = False
    return out
