"""Branches of equilibria from the states along a parameter: linked, joined past what they do not take part in."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ...portrait.layer_problem.critical import CriticalSet
from ...results.arrays import Array
from .changes import Change
from .result import ClosedEquator, CriticalBranch, DirectionBranch, SpecialValue
from .states import State, States, on_circle

__all__ = ["branches_of_pieces"]

_JOINT_DISTANCE = 1e-3  # in the disc: from one side of a special value to the other
_END_DISTANCE = 0.05  # in the disc: from a branch to the special point at its end

BranchRows = tuple[str, Array, list[Array]]  # kind, places (k, 2), and the columns of a branch


def branches_of_pieces(
    states: States, runs: Sequence[tuple[float, float]], changes: Sequence[Change], special: Sequence[SpecialValue]
) -> tuple[tuple[DirectionBranch, ...], tuple[ClosedEquator, ...], tuple[CriticalBranch, ...]]:
    """Return the branches of limit directions, closed equators and critical sets."""
    directions: list[list[BranchRows]] = []
    sets: list[list[BranchRows]] = []
    closed: list[ClosedEquator] = []
    for low, high in runs:
        inside = [change for change in changes if low <= change.value <= high]
        stops = [low, *(v for change in inside for v in (change.before.value, change.after.value)), high]
        for start, end in zip(stops[::2], stops[1::2], strict=True):
            known = states.between(start, end)
            piece = [s for s in known if s.difference(known[0]) is None]
            directions.append(_linked_directions(piece))
            sets.append(_linked_sets(piece))
            if piece[0].exponent is not None:
                sign = piece[len(piece) // 2].exponent or 0.0
                kind = "attracting from outside" if sign < 0 else "repelling from outside" if sign > 0 else "neutral"
                columns = _read_only([s.value for s in piece], [s.exponent for s in piece])
                closed.append(ClosedEquator(*columns, kind=kind))
    ends = {v: change.value for change in changes for v in (change.before.value, change.after.value)}
    whole = [_with_ends(one, ends, special, (0,)) for one in _join_pieces(directions)]
    equator = tuple(DirectionBranch(*_read_only(*columns), kind=kind) for kind, _, columns in whole)
    found = [_with_ends(one, ends, special, (1, 2)) for one in _join_pieces(sets)]
    return equator, tuple(closed), tuple(CriticalBranch(*_read_only(*columns), kind=kind) for kind, _, columns in found)


def _linked_directions(piece: Sequence[State]) -> list[BranchRows]:
    first = piece[0].equator
    if not len(first):
        return []
    values = np.array([s.value for s in piece])
    theta = link_zeros(np.array([s.equator.theta for s in piece]))
    out = []
    for j in range(len(first)):
        places = on_circle(theta[:, j])
        own = [int((s.places @ place).argmax()) for s, place in zip(piece, places, strict=True)]
        rho = np.array([s.equator.lambda_rho[i] for s, i in zip(piece, own, strict=True)])
        slope = np.array([s.equator.lambda_theta[i] for s, i in zip(piece, own, strict=True)])
        out.append((first.kind(own[0]), places, [values, theta[:, j], rho, slope]))
    return out


def link_zeros(theta: Array) -> Array:
    """Follow each zero from row to row: between meetings they keep their cyclic order."""
    k, count = theta.shape
    if k > 1:
        turns = [np.roll(theta[1:], -r, axis=1) - theta[:-1] for r in range(count)]
        cost = np.stack([abs(np.angle(np.exp(1j * turn))).sum(axis=1) for turn in turns])
        shift = np.concatenate([[0], np.cumsum(cost.argmin(axis=0))])
        theta = np.take_along_axis(theta, (np.arange(count) + shift[:, None]) % count, axis=1)
    return np.unwrap(theta, axis=0)


def _linked_sets(piece: Sequence[State]) -> list[BranchRows]:
    values = np.array([s.value for s in piece])
    rows = [list(piece[0].critical)]
    for s in piece[1:]:
        rows.append(_match_sets(rows[-1], s.critical))
    out = []
    for column in zip(*rows, strict=True):
        e, p = np.array([C.e for C in column]), np.array([C.p for C in column])
        numbers = [np.array([C.trace for C in column]), np.array([C.determinant for C in column])]
        out.append((column[0].kind, p, [values, e, p, *numbers]))
    return out


def _match_sets(before: Sequence[CriticalSet], critical: Sequence[CriticalSet]) -> list[CriticalSet]:
    """Return critical sets in the order of those nearest to them; of one kind, where there is one."""
    left, out = list(critical), []
    for C in before:
        nearest = min(left, key=lambda D, C=C: (D.kind != C.kind, math.dist(C.p, D.p)))
        left = [D for D in left if D is not nearest]
        out.append(nearest)
    return out


def _join_pieces(pieces: Sequence[list[BranchRows]]) -> list[BranchRows]:
    """Join the branches of neighbouring pieces that go on as they are."""
    done: list[BranchRows] = []
    open_: list[BranchRows] = []
    for piece in pieces:
        going: list[BranchRows] = []
        for kind, places, columns in piece:
            before = next((one for one in open_ if one[0] == kind and _goes_on(one, places)), None)
            if before is None:
                going.append((kind, places, columns))
                continue
            open_ = [one for one in open_ if one is not before]
            if columns[1].ndim == 1:  # angles: whole turns apart
                columns[1] = columns[1] + math.tau * round(float(before[2][1][-1] - columns[1][0]) / math.tau)
            merged = [np.concatenate(pair) for pair in zip(before[2], columns, strict=True)]
            going.append((kind, np.concatenate([before[1], places]), merged))
        done += open_
        open_ = going
    return sorted([*done, *open_], key=lambda one: float(one[2][0][0]))


def _goes_on(one: BranchRows, places: Array) -> bool:
    return bool(np.hypot(*(one[1][-1] - places[0])) < _JOINT_DISTANCE)


def _with_ends(
    one: BranchRows, ends: dict[float, float], special: Sequence[SpecialValue], moved: tuple[int, ...]
) -> BranchRows:
    """Lead a branch that ends next to a special value up to its point."""
    kind, places, columns = one
    for i in (0, -1):
        value = ends.get(float(columns[0][i]))
        here = [s.place for s in special if s.value == value and math.dist(s.place, places[i]) < _END_DISTANCE]
        if value is None or not here:
            continue
        place = np.array(min(here, key=lambda p, i=i: math.dist(p, places[i])))
        last = [column[i] for column in columns]
        last[0] = value
        if moved == (0,):
            turn = math.atan2(place[1], place[0]) - float(last[1])
            last[1] = last[1] + math.remainder(turn, math.tau)
        elif math.hypot(*place) > 1.0 - 1e-12:
            last[1], last[2] = place, place
        places = np.insert(places, 0 if i == 0 else len(places), place, axis=0)
        columns = [
            np.insert(column, 0 if i == 0 else len(column), v, axis=0) for column, v in zip(columns, last, strict=True)
        ]
    return kind, places, columns


def _read_only(*rows: Any) -> tuple[Array, ...]:
    out = tuple(np.array(row, float) for row in rows)
    for array in out:
        array.flags.writeable = False
    return out
