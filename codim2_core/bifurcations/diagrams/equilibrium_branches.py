"""One-parameter bifurcation diagrams: limit directions, critical sets and limit cycles, with their bifurcations.

Branches of equilibria are linked from the states along the parameter, and joined past what they do not take part in.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...numerics.sign_changes import roots
from ...portrait.layer_problem.critical import CriticalSet
from ...portrait.layer_problem.vary import check_name, check_varying, usual_span
from ...results.arrays import Array
from ...results.words import say
from ...systems.kinds import AnySystem, in_axes_of, takes_names
from ...systems.psi.function import Psi
from ..continuation.result import CycleBranches
from ..families.family import SystemFamily
from .changes import (
    MAX_BLUR,
    SIDE_STEP,
    Candidate,
    Change,
    candidates,
    changes_between,
    extrema_of_theta,
    least_speeds,
    look_near,
    merge,
)
from .name_changes import name_changes, single_values
from .result import Branches, ClosedEquator, CriticalBranch, DirectionBranch, SpecialValue
from .states import State, States, on_circle


@takes_names
def branches(
    system: AnySystem,
    psi: Psi,
    along: str,
    span: tuple[float, float] | None = None,
    z: ArrayLike = (),
    with_cycles: bool = True,
) -> Branches:
    """Follow limit directions, critical sets and limit cycles along one parameter, and mark where something changes.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    along : str
        What varies: one of a, b, d, f1, f2 that is a number, a parameter of the system, a slow variable z1, z2, ...
        (z is z1), or the parameter of Psi, such as n.
    span : (low, high), optional
        By default about the present value, as wide as what varies is large: `layer_problem.vary.usual_span`.
    z : (m,) floats
    with_cycles : bool
        Limit cycles take longer: without them `Branches.with_cycles` finds them later.

    Returns
    -------
    Branches
        Equilibria are found exactly at some fifty values of a grid, and Newton's method solves for the bifurcations
        between them, to the last digits: two that undo each other within a step, to which it does not come, are
        missed. Changes at a kink of U are found by bisection; what happens exactly at an end of the span is not
        reported. Places are in the axes of the system, which for an `ELinear.from_matrix` are those of its normal form
        at each value. Branches of cycles are begun at Hopf points, at ends on the equator, and at cycles seen at some
        values: one that has none of these is not seen.

    Raises
    ------
    ValueError
        Nothing variable has this name, the span is empty or beyond what the parameter may be, or z does not fit.

    Examples
    --------
    >>> import codim2_core as c2
    >>> found = c2.branches(c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3), along="n", span=(1, 4))
    >>> [(one.kind, round(one.value, 6)) for one in found.special]
    [('node-focus', 1.333333), ('Hopf', 2.20155), ('node-focus', 3.211105)]
    >>> cycle = found.cycles[0]
    >>> cycle.start.kind, cycle.end.kind, bool(cycle.stable[-1]), round(float(cycle.period[-1]), 6)
    ('Hopf', 'span', True, 0.606696)
    """
    system = in_axes_of(system, along)
    check_name(system, psi, z, "along", along)
    span = usual_span(system, psi, z, along) if span is None else span
    found = equilibrium_branches(system, psi, along, span, z)
    return found.with_cycles() if with_cycles else found


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


GRID_CELLS = 48
REACH = 1.6 / GRID_CELLS  # of the span: how far from a state a candidate may be
NEAR_REACH = 1e-4  # from the states on the sides of a change that was bisected
MAX_ROUNDS = 4  # times that candidates are looked for, from the states next to the last ones
#: Of equilibria from state to state, unless so many are not enough.
MAX_ANGLE_MOVE, MAX_PLACE_MOVE, MAX_HALVINGS = 0.15, 0.1, 6
MIN_DISTANCE = 1e-12  # of the span: between two values
SAME_VALUE = 1e-9  # of the span: of a change, and of the points that were solved for there
POLE_HALVINGS, POLE_DISTANCE = 12, 0.01  # to where U ceases to be finite; of a cell, from a pole
POLE_PLACES = np.array([[0.3, 0.1], [-0.2, 0.5], [0.6, -0.4], [-0.5, -0.7]])


def equilibrium_branches(system: Any, psi: Psi, along: str, span: Sequence[float], z: ArrayLike = ()) -> Branches:
    """Find all equilibria along one parameter; see `branches`, which takes the same.

    They are found at the values of a grid, exactly as by `classify`. Newton's method then solves for all bifurcations
    from there, and each is held against the equilibria on both of its sides; where two neighbouring states differ and
    no bifurcation was found between them, as at a kink of U, bisection finds what happens.
    """
    low, high = (float(v) for v in span)
    if not (np.isfinite([low, high]).all() and low < high):
        raise ValueError(f"the span of {along} is {low:g} to {high:g}; give two finite numbers, the smaller one first.")
    (name,) = check_varying(system, psi, z, (along,), ((low, high),))
    slow = tuple(float(v) for v in np.atleast_1d(np.asarray(z, float)))
    clocked = slow if system.frozen else tuple(system.at(z).z) or slow  # with the time of a clock
    family = SystemFamily(system, psi, clocked, (name,), ((low, high),))
    states = States(system, psi, name, (low, high), clocked)
    # off the round numbers on which special values like to lie
    u = (np.arange(GRID_CELLS + 1) + 0.3 * np.sin(2.0 + 1.7 * np.arange(GRID_CELLS + 1))) / GRID_CELLS
    u[[0, -1]] = SIDE_STEP, 1.0 - SIDE_STEP
    if not any([states(family.value(v)) for v in u.tolist()]):
        assert states.refusal is not None
        raise states.refusal
    runs = _defined_runs(family, states, u)
    found, changes = _find_changes(family, states, runs, u)
    special: list[SpecialValue] = []
    for change in changes:
        special += name_changes(family, change, _solved_near(family, found, change))
    special += single_values(family, states, found, special, u)
    special = [one for one in special if any(run[0] <= one.value <= run[1] for run in runs)]
    special.sort(key=lambda one: one.value)
    parts = branches_of_pieces(states, runs, changes, special)
    stops = [low, *(v for run in runs for v in run), high]
    wide = 2.0 * SIDE_STEP * states.width
    gaps = tuple((a, b) for a, b in zip(stops[::2], stops[1::2], strict=True) if b - a > wide)
    none = CycleBranches(along, (low, high), (), say("cycles not looked for"))
    return Branches(system, psi, slow, along, (low, high), *parts, tuple(special), gaps, none)


def _find_changes(
    family: SystemFamily, states: States, runs: Sequence[tuple[float, float]], u: Array
) -> tuple[list[Candidate], list[Change]]:
    """Find the candidates, and the changes among them and elsewhere."""
    found: list[Candidate] = []
    seen: set[float] = set()
    values: list[float] = []
    starts = extrema_of_theta(family, u), np.zeros((3, 0)) if family.affine else least_speeds(family, u)
    for turn in range(MAX_ROUNDS):
        _refine(states, runs)
        known = [state for run in runs for state in states.between(*run)]
        new = [state for state in known if state.value not in seen]
        seen |= {state.value for state in new}
        if not new:
            break
        if turn:
            starts = _starts_near(family, new)
        before = len(found)
        found = merge([*found, *candidates(family, new, starts, REACH)])
        values = _distinct(family, found)
        look_near(states, values)
        if len(found) == before:
            break
    changes = [change for run in runs for change in changes_between(states, values, *run)]
    bisected = [c for c in changes if not _solved_near(family, found, c)]
    if bisected:
        around_changes = [state for change in bisected for state in (change.before, change.after)]
        found = merge([*found, *candidates(family, around_changes, _starts_near(family, around_changes), NEAR_REACH)])
        for i, change in enumerate(changes):
            if change in bisected and (near := _solved_near(family, found, change)):
                solved = min(near, key=lambda one, change=change: abs(one.u - family.unit(change.value)))
                changes[i] = change._replace(value=family.value(solved.u))
    return found, changes


def _starts_near(family: SystemFamily, states: Sequence[State]) -> tuple[Array, Array]:
    return extrema_of_theta(family, np.array([family.unit(state.value) for state in states])), np.zeros((3, 0))


def _solved_near(family: SystemFamily, found: Sequence[Candidate], change: Change) -> list[Candidate]:
    """Return the candidates at a change."""
    return [one for one in found if abs(one.u - family.unit(change.value)) <= SAME_VALUE]


def _distinct(family: SystemFamily, found: Sequence[Candidate]) -> list[float]:
    """Return the values of candidates in order, each once: rounding parts those of one value."""
    kept: list[float] = []
    for one in sorted(found, key=lambda one: not one.regular):
        least = MIN_DISTANCE if one.regular else MAX_BLUR
        if all(abs(one.u - other) > least for other in kept):
            kept.append(one.u)
    return [family.value(u) for u in sorted(kept)]


def _refine(states: States, runs: Sequence[tuple[float, float]]) -> None:
    """Add states where equilibria move far between two that are alike."""
    for low, high in runs:
        for _ in range(MAX_HALVINGS):
            pairs = [
                pair
                for pair in pairwise(states.between(low, high))
                if _far_apart(*pair, 10.0 * SIDE_STEP * states.width)
            ]
            for left, right in pairs:
                states(0.5 * (left.value + right.value))
            if not pairs:
                break


def _far_apart(left: State, right: State, least: float) -> bool:
    if left.difference(right) is not None or right.value - left.value < least:
        return False
    for one, two, most in (
        (left.places, right.places, MAX_ANGLE_MOVE),
        (np.array([C.p for C in left.critical]), np.array([C.p for C in right.critical]), MAX_PLACE_MOVE),
    ):
        if len(one) and float(np.hypot(*np.moveaxis(one[:, None] - two, -1, 0)).min(axis=1).max()) > most:
            return True
    return False


def _defined_runs(family: SystemFamily, states: States, u: Array) -> list[tuple[float, float]]:
    """Return the parts of the span on which U is finite, from their first to their last state."""
    stops = []  # values of the grid, and None where U is not defined
    poles = _poles(family, u)
    values = [family.value(v) for v in u.tolist()]
    for value, after in zip(values, [*values[1:], values[-1]], strict=True):
        stops.append(value if states(value) else None)
        for pole in (v for v in poles if value < v < after):
            step = POLE_DISTANCE * (after - value)
            stops += [v if states(v) else None for v in (pole - step, pole + step)]
            stops.insert(-1, None)
        if (states(value) is None) != (states(after) is None):
            stops.append(_last_defined(states, value, after))
    runs: list[tuple[float, float]] = []
    start = before = None
    for value in [*stops, None]:
        if value is None and start is not None and before is not None and before > start:
            runs.append((start, before))
        start = value if start is None else None if value is None else start
        before = value
    return runs


def _last_defined(states: States, low: float, high: float) -> float:
    """Return the value nearest to where U ceases to be finite, of those at which it is."""
    first = states(low) is not None
    for _ in range(POLE_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (states(middle) is not None) == first else (low, middle)
    return low if first else high


def _poles(family: SystemFamily, u: Array) -> list[float]:
    """Return the values at which U has a pole wherever it is looked at."""
    common: list[set[int]] = []
    places: list[float] = []
    for c, s in POLE_PLACES.tolist():
        cells: set[int] = set()
        for i in range(2):
            at = lambda v, i=i, c=c, s=s: family.speed_on_net(np.full(len(v), c), np.full(len(v), s), v)[i]
            rows = at(u)
            if np.isfinite(rows).all():
                places += (found := roots(at, [u], [rows]).poles[0].tolist())
                cells |= set(np.searchsorted(u, found).tolist())
        common.append(cells)
    cells = set.intersection(*common)
    first = {int(np.searchsorted(u, v)): v for v in places}
    return [family.value(first[i]) for i in sorted(cells)]
