"""Equations of motion of a mechanism with several contacts, as numbers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import Any, NamedTuple

import numpy as np

from ....formulas.arrays import Program, path_program
from ....formulas.expression import Expression
from ....formulas.names import FAST_NAMES, SLOW_NAMES
from ....formulas.switches import Branch, Rows, branch_at, has_switches
from ....results.arrays import Array
from ...psi.function import Psi, direction, smoothed_direction
from ...reading import short_repr
from .. import formula_reading
from ..algebra import Algebra
from ..formula_reading import FormulaRow, Matrix
from ..mechanism import Mechanism
from .decision import RANK_TOLERANCE, Flags

MAX_CONTACTS = 8


@dataclass(frozen=True)
class ContactParts:
    """One contact: rows J of its slip, Coulomb's coefficient, normal force, velocity of the other body; as formulas."""

    J: Matrix
    mu: Expression
    normal: Expression
    surface: FormulaRow


def read_contacts(given: Any, n: int, names: Sequence[str]) -> tuple[ContactParts, ...]:
    """Read contacts ``(J, mu, normal)`` or ``(J, mu, normal, surface)``, in positions and parameters."""
    if isinstance(given, str) or not hasattr(given, "__getitem__") or not 1 <= len(given) <= MAX_CONTACTS:
        raise ValueError(
            f"contacts is {short_repr(given)}; give from 1 to {MAX_CONTACTS} of them, each (J, mu, normal) or "
            "(J, mu, normal, surface)."
        )
    found: list[ContactParts] = []
    for i, one in enumerate(given, 1):
        what = f"contacts[{i}]"
        if isinstance(one, str) or not hasattr(one, "__getitem__") or len(one) not in (3, 4):
            raise ValueError(f"{what} is {short_repr(one)}; give (J, mu, normal) or (J, mu, normal, surface).")
        J, mu, normal, surface = (*one, (0.0, 0.0))[:4]
        for part, value in (("mu", mu), ("normal", normal)):
            if not isinstance(value, str) and hasattr(value, "__len__"):
                raise ValueError(
                    f"{what}: {part} is {short_repr(value)}; give a number or text: with a matrix, "
                    "or the row of a constraint, which contacts stick is not known to be unique."
                )
        found.append(
            ContactParts(
                formula_reading.matrix(J, f"{what}: J", 2, n, names),
                formula_reading.formula(mu, f"{what}: mu", names),
                formula_reading.formula(normal, f"{what}: normal", names),
                formula_reading.row(surface, f"{what}: surface", 2, names),
            )
        )
    return tuple(found)


def mechanisms(
    M: Matrix, contacts: Sequence[ContactParts], force: FormulaRow, velocities: Sequence[str], rates: Any, known: Any
) -> tuple[Mechanism, ...]:
    """Return for each contact the mechanism in which it may be at its set while the others slip.

    The friction of the others, ``-mu N J^T e`` with ``e = (J v - w)/|J v - w|``, is part of the applied force.
    """
    found: list[Mechanism] = []
    for i, own in enumerate(contacts):
        algebra = Algebra()
        applied = [algebra.enter(row, {}) for row in force]
        for other in (*contacts[:i], *contacts[i + 1 :]):
            applied = _with_friction(algebra, applied, other, velocities)
        slow = (*_slow_velocities(own.J, velocities), *rates)
        rows = [algebra.formula(entry) for entry in applied]
        found.append(Mechanism(M, own.J, rows, own.mu, own.normal, velocities, slow, rates, own.surface, known))
    return tuple(found)


def _with_friction(algebra: Algebra, applied: list[int], other: ContactParts, velocities: Sequence[str]) -> list[int]:
    """Add the friction of a contact that slips to a force."""
    rows = [[algebra.enter(entry, {}) for entry in row] for row in other.J]
    v = [algebra.name(word) for word in velocities]
    slip = [
        algebra.minus(algebra.dot(row, v), algebra.enter(w, {})) for row, w in zip(rows, other.surface, strict=True)
    ]
    size = algebra.square_root(algebra.dot(slip, slip))
    most = algebra.times(algebra.enter(other.mu, {}), algebra.enter(other.normal, {}))
    pull = [algebra.times(most, algebra.divide(part, size)) for part in slip]
    return [algebra.minus(one, algebra.dot([row[j] for row in rows], pull)) for j, one in enumerate(applied)]


def _slow_velocities(J: Matrix, velocities: Sequence[str]) -> tuple[str, ...]:
    """Return all velocities but two that the slip determines: where it can be, by a determinant that is a number."""
    algebra = Algebra()
    rows = [[algebra.enter(entry, {}) for entry in row] for row in J]
    pairs = {
        pair: algebra.formula(algebra.determinant(tuple(tuple(row[j] for j in pair) for row in rows)))
        for pair in combinations(range(len(velocities)), 2)
    }
    able = [pair for pair, size in pairs.items() if size.constant != 0.0]
    if not able:
        raise ValueError("contacts: the rows of a J are dependent; give two directions in which its point can slip.")
    gone = min(able, key=lambda pair: pairs[pair].constant is None)
    return tuple(word for j, word in enumerate(velocities) if j not in gone)


def refuse_fast_names(force: FormulaRow) -> None:
    """Refuse a force that reads the slip or e of a contact."""
    used = next((word for row in force for word in row.names if word in FAST_NAMES), None)
    if used is not None:
        raise ValueError(f"force reads {used}, which of the contacts has each of its own; write it in the velocities.")


STATE_NAMES = (*FAST_NAMES[2:], *SLOW_NAMES)
DIFFERENCE = 1e-7  # step of a finite difference, in units of max(1, |Y|)


class Local(NamedTuple):
    """The parts of the equations of motion at one state: J (c, 2, n), the slip x and k = J' v - w' (c, 2)."""

    M: Array
    Q: Array
    J: Array
    k: Array
    r: Array
    x: Array
    rates: Array


@dataclass(frozen=True)
class Law:
    """Friction by the slip of every contact: ``e_Psi``, Definition 2.4, in the limit, eps = 0, ``x/|x|``."""

    psi: Psi | None = None
    eps: float = 0.0

    def e(self, x: Array) -> Array:
        """Return e (c, 2) of slips (c, 2)."""
        return direction(self.psi, self.eps, x)

    def slope(self, x: Array, e: Array) -> Array:
        """Return de/dx (c, 2, 2): in the limit, with e as it is known, ``(1 - e n^T)/|x|``, n = x/|x|."""
        if self.psi is not None:
            return smoothed_direction(self.psi, self.eps, x)[1]
        n = self.e(x)
        with np.errstate(all="ignore"):
            return (np.eye(2) - e[:, :, None] * n[:, None, :]) / np.hypot(*x.T)[:, None, None]


class ContactField:
    """The equations of motion, by states Y: velocities, then positions; on a branch of the formulas of `whole`."""

    def __init__(
        self, n: int, count: int, rows: Rows, branch: Branch | None = None, whole: ContactField | None = None
    ) -> None:
        self.n, self.count, self.rows, self.branch, self.whole = n, count, rows, branch or Branch(), whole
        shapes = (n, n), (n,), (count, 2, n), (count, 2), (count,), (len(rows) - _fixed(n, count),), (count, 2)
        self.places, at = list[tuple[slice, tuple[int, ...]]](), 0
        for shape in shapes:
            size = math.prod(shape)
            self.places.append((slice(at, at + size), shape))
            at += size
        self.names = STATE_NAMES[: n + shapes[5][0]]
        self.moving = np.array([row.constant is None for row in rows])

    @cached_property
    def program(self) -> Program:
        """The rows, as the kernels take them."""
        return path_program(self.rows)

    @cached_property
    def moving_program(self) -> Program:
        """The rows that are no numbers."""
        return path_program(tuple(row for row in self.rows if row.constant is None))

    def on_branch(self, Y: Array, rate: Array, known: Sequence[int] = ()) -> ContactField:
        """Return the smooth branch of the formulas at a state, on a border the one ahead."""
        if not has_switches(self.rows, self.names, slip=()):
            return self
        found = branch_at(self.rows, self.names, self._named(Y), self._named(rate), known, slip=())
        return ContactField(self.n, self.count, found.rows, found, self)

    def past_switch(self, switch: int, Y: Array, rate: Array) -> ContactField:
        """Return the branch that follows this one where a guard vanishes."""
        assert self.whole is not None
        after, before = self.whole.on_branch(Y, rate), self.branch.choices
        if after.branch.choices[: switch + 1] == before[: switch + 1]:  # rounding hides that it has changed
            other = self.branch.next_choice(switch, self._named(Y))
            after = self.whole.on_branch(Y, rate, (*before[:switch], other))
        return after

    def returns_to(self, before: Branch, switch: int, Y: Array, rate: Array) -> bool:
        """Whether a state leaves this branch at once through a switch of the branch before."""
        return self.branch.returns_to(before, switch, self._named(Y), self._named(rate))

    def _named(self, numbers: Array) -> dict[str, float]:
        return dict(zip(self.names, numbers.tolist(), strict=True))

    def values(self, states: Array) -> Array:
        """Return the rows (k, rows) at states (k, N)."""
        from ....formulas import interpreter  # on first use: it loads the compiler

        out = np.empty((len(states), len(self.rows)))
        interpreter.values(*self.program.arrays, np.ascontiguousarray(states), out)
        return out

    def at_all(self, states: Array) -> list[Local]:
        """Return what the equations are made of at states (k, N)."""
        found: list[Local] = []
        for Y, row in zip(states, self.values(states), strict=True):
            M, Q, J, surface, r, rates, k = (row[place].reshape(shape) for place, shape in self.places)
            found.append(Local(M, Q, J, k, r, J @ Y[: self.n] - surface, rates))
        return found

    def at(self, Y: Array) -> Local:
        """Return what the equations are made of at a state."""
        return self.at_all(Y[None])[0]

    def rate(self, local: Local, e: Array, sticks: Flags) -> Array:
        """Return Y' where these contacts stick, and friction is -r J^T e at the others."""
        Q = local.Q - np.einsum("cin,ci->n", local.J[~sticks], local.r[~sticks, None] * e[~sticks])
        return np.concatenate([held_rates(local, sticks, Q)[0], local.rates])

    def smooth_slopes(self, Y: Array, e: Array, sticks: Flags) -> tuple[Array, Array]:
        """Return the derivatives of Y' with e as it is, and of the slips, by Y."""
        places = np.vstack([Y, Y + np.diag(DIFFERENCE * np.maximum(1.0, np.abs(Y)))])
        here, *others = self.at_all(places)
        steps, first = places.diagonal(-1) - Y, self.rate(here, e, sticks)
        rate = np.array([self.rate(other, e, sticks) - first for other in others]).T / steps
        return rate, np.moveaxis(np.array([other.x - here.x for other in others]), 0, -1) / steps

    def friction_slope(self, local: Local, gain: Array, sticks: Flags, slip: Array) -> Array:
        """Return the derivative of Y' by Y through e, whose derivatives by the slips are `gain`."""
        found = np.zeros((len(self.names), len(self.names)))
        out = ~sticks
        pull = np.einsum("cin,cij,cjy->ny", local.J[out], local.r[out, None, None] * gain[out], slip[out])
        solved = np.linalg.solve(local.M, pull)
        if sticks.any():
            held = local.J[sticks].reshape(-1, self.n)
            back = np.linalg.solve(local.M, held.T)
            solved = solved - back @ np.linalg.lstsq(held @ back, held @ solved, RANK_TOLERANCE)[0]
        found[: self.n] = -solved
        return found


def within_disc(e: Array) -> Array:
    """Return e (c, 2), brought back onto the circle where it is outside."""
    return e / np.maximum(1.0, np.hypot(*e.T))[:, None]


def _fixed(n: int, count: int) -> int:
    """Return how many rows do not depend on how many positions there are."""
    return n * n + n + 2 * count * n + 5 * count


def contact_field(
    M: Matrix,
    contacts: Sequence[ContactParts],
    force: FormulaRow,
    velocities: Sequence[str],
    rates: Mapping[str, Expression],
    parameters: Mapping[str, float],
) -> ContactField:
    """Return the equations of motion of a mechanism."""
    algebra, words = Algebra(), (*velocities, *rates)
    meanings = {word: algebra.number(value) for word, value in parameters.items()}
    meanings |= {word: algebra.name(name) for word, name in zip(words, STATE_NAMES, strict=False)}
    enter = lambda rows: [algebra.enter(entry, meanings) for row in rows for entry in row]
    v, moves = [meanings[word] for word in velocities], enter([rates.values()])
    k = []
    for one in contacts:
        for row, w in zip(one.J, one.surface, strict=True):
            total = algebra.zero
            for word, move in zip(rates, moves, strict=True):
                slope = algebra.dot(enter([[entry.derivative(word) for entry in row]]), v)
                slope = algebra.minus(slope, *enter([[w.derivative(word)]]))
                total = algebra.plus(total, algebra.times(move, slope))
            k.append(total)
    J, surface = enter(row for one in contacts for row in one.J), enter(one.surface for one in contacts)
    r = [algebra.times(*enter([(one.mu, one.normal)])) for one in contacts]
    entries = (*enter(M), *enter([force]), *J, *surface, *r, *moves, *k)
    return ContactField(len(velocities), len(contacts), tuple(map(algebra.formula, entries)))


def held_rank(local: Local, sticks: Flags) -> int:
    """Return how many directions of the velocities contacts that stick hold."""
    held = local.J[sticks].reshape(-1, local.J.shape[2])
    return int(np.linalg.matrix_rank(held, RANK_TOLERANCE)) if len(held) else 0


def held_rates(local: Local, sticks: Flags, Q: Array) -> tuple[Array, Array]:
    """Return v' where contacts stick, and the forces (c, 2) that hold them: of redundant ones the smallest."""
    free = np.asarray(np.linalg.solve(local.M, Q), np.float64)
    if not sticks.any():
        return free, np.zeros((0, 2))
    held = local.J[sticks].reshape(-1, len(Q))
    back = np.linalg.solve(local.M, held.T)
    force = np.linalg.lstsq(held @ back, held @ free + local.k[sticks].ravel(), RANK_TOLERANCE)[0]
    return free - back @ force, np.asarray(force, np.float64).reshape(-1, 2)


def project_velocities(local: Local, v: Array, at_sets: Flags) -> Array:
    """Return the velocities nearest in kinetic energy at which these contacts do not slip."""
    if not at_sets.any():
        return v
    held = local.J[at_sets].reshape(-1, len(v))
    back = np.linalg.solve(local.M, held.T)
    return v - back @ np.linalg.lstsq(held @ back, local.x[at_sets].ravel(), RANK_TOLERANCE)[0]
