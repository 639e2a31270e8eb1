"""Equations of motion of a mechanism with several contacts, as numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from ...arrays import Array
from ...expressions.expression import Expression
from ...psi.function import Psi
from ..formula_reading import FormulaRow, Matrix
from .contact_parts import ContactParts
from .decision import RANK_TOLERANCE, Flags

SMALLEST_ZETA = 1e-9  # in the chart kappa_2: nearer, e_Psi is as linear as it is there
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


class Law(Protocol):
    """Friction by the slip: e and its derivative."""

    def e(self, x: Array) -> Array:
        """Return e (c, 2) of slips (c, 2)."""
        ...

    def slope(self, x: Array) -> Array:
        """Return de/dx (c, 2, 2)."""
        ...


class Coulomb:
    """``e = x/|x|``."""

    def e(self, x: Array) -> Array:
        """Return the unit vectors; nan at 0."""
        with np.errstate(invalid="ignore"):
            return x / np.hypot(*x.T)[:, None]

    def slope(self, x: Array) -> Array:
        """Return ``(1 - e e^T)/|x|``."""
        with np.errstate(all="ignore"):
            e, size = self.e(x), np.hypot(*x.T)
            return (np.eye(2) - e[:, :, None] * e[:, None, :]) / size[:, None, None]


class Regularised:
    """``e_Psi``, def:MPsi, of every contact."""

    def __init__(self, psi: Psi, eps: float) -> None:
        self._psi, self._eps = psi, eps

    def _polar(self, x: Array) -> tuple[Array, Array]:
        zeta = np.hypot(*x.T) / self._eps
        direction = x / (self._eps * np.where(zeta > 0.0, zeta, 1.0))[:, None]
        return np.maximum(zeta, SMALLEST_ZETA), direction

    def e(self, x: Array) -> Array:
        """Return ``e_Psi``."""
        zeta, direction = self._polar(x)
        return self._psi.modulus(zeta)[:, None] * direction

    def slope(self, x: Array) -> Array:
        """Return its derivative: along e ``(Psi - zeta^2 Psi')/(zeta^2 + Psi)^(3/2)``, across ``|e_Psi|/zeta``."""
        zeta, direction = self._polar(x)
        value = self._psi(zeta**2)
        size = np.sqrt(zeta**2 + value)
        out = (value - zeta**2 * self._psi.derivative(zeta**2)) / size**3
        along = direction[:, :, None] * direction[:, None, :]
        return (out[:, None, None] * along + (np.eye(2) - along) / size[:, None, None]) / self._eps


class ContactField:
    """The equations of motion, by states Y: velocities, then positions."""

    def __init__(
        self,
        M: Matrix,
        contacts: Sequence[ContactParts],
        force: FormulaRow,
        velocities: Sequence[str],
        rates: Mapping[str, Expression],
        parameters: Mapping[str, float],
    ) -> None:
        self.n, self.words = len(velocities), (*velocities, *rates)
        self._parameters = dict(parameters)
        self._M = self._rows(M)
        self._J = [self._rows(one.J) for one in contacts]
        self._surface = [self._rows([one.surface]) for one in contacts]
        self._bounds = [self._rows([(one.mu, one.normal)]) for one in contacts]
        self._force, self._rates = self._rows([force]), self._rows([tuple(rates.values())])
        slopes = lambda rows, word: [tuple(entry.derivative(word) for entry in row) for row in rows]
        self._moving = [
            (j, i, self._rows(slopes(one.J, word)), self._rows(slopes([one.surface], word)))
            for j, word in enumerate(rates)
            for i, one in enumerate(contacts)
            if any(word in entry.names for row in (*one.J, one.surface) for entry in row)
        ]

    def _rows(self, rows: Iterable[FormulaRow]) -> tuple[tuple[FormulaRow, ...], Array | None]:
        """Return formulas, with their numbers where nothing in them moves."""
        given = tuple(map(tuple, rows))
        moves = any(word in self.words for row in given for entry in row for word in entry.names)
        return given, None if moves else self._numbers(given, self._parameters)

    @staticmethod
    def _numbers(rows: tuple[FormulaRow, ...], known: Mapping[str, float]) -> Array:
        return np.array([[float(entry.evaluate(known)) for entry in row] for row in rows])

    def at(self, Y: Array) -> Local:
        """Return what the equations are made of at a state."""
        known = {**self._parameters, **dict(zip(self.words, Y.tolist(), strict=True))}
        value = lambda rows: self._numbers(rows[0], known) if rows[1] is None else rows[1]
        v, J = Y[: self.n], np.array(list(map(value, self._J)))
        surface = np.array([value(rows)[0] for rows in self._surface])
        rates, k = value(self._rates)[0], np.zeros_like(surface)
        for j, i, rows, own in self._moving:
            k[i] += rates[j] * (value(rows) @ v - value(own)[0])
        r = np.array([value(rows).prod() for rows in self._bounds])
        return Local(value(self._M), value(self._force)[0], J, k, r, J @ v - surface, rates)

    def rate(self, local: Local, e: Array, sticks: Flags) -> Array:
        """Return Y' where these contacts stick, and friction is -r J^T e at the others."""
        Q = local.Q - np.einsum("cin,ci->n", local.J[~sticks], local.r[~sticks, None] * e[~sticks])
        return np.concatenate([held_rates(local, sticks, Q)[0], local.rates])

    def smooth_slopes(self, Y: Array, e: Array, sticks: Flags) -> tuple[Array, Array]:
        """Return the derivatives of Y' with e as it is, and of the slips, by Y."""
        here = self.at(Y)
        first = self.rate(here, e, sticks)
        rate, slip = np.zeros((len(Y), len(Y))), np.zeros((len(here.r), 2, len(Y)))
        for j in range(len(Y)):
            beside = Y.copy()
            beside[j] += DIFFERENCE * max(1.0, abs(Y[j]))
            other = self.at(beside)
            rate[:, j] = (self.rate(other, e, sticks) - first) / (beside[j] - Y[j])
            slip[:, :, j] = (other.x - here.x) / (beside[j] - Y[j])
        return rate, slip

    def friction_slope(self, local: Local, gain: Array, sticks: Flags, slip: Array) -> Array:
        """Return the derivative of Y' by Y through e, whose derivatives by the slips are `gain`."""
        found = np.zeros((len(self.words), len(self.words)))
        out = ~sticks
        pull = np.einsum("cin,cij,cjy->ny", local.J[out], local.r[out, None, None] * gain[out], slip[out])
        solved = np.linalg.solve(local.M, pull)
        if sticks.any():
            held = local.J[sticks].reshape(-1, self.n)
            back = np.linalg.solve(local.M, held.T)
            solved = solved - back @ np.linalg.lstsq(held @ back, held @ solved, RANK_TOLERANCE)[0]
        found[: self.n] = -solved
        return found


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
