"""Accuracy of special points of equilibria: residual, normal-form coefficient, and how sensitive their values are.

A special point solves a defining system F(y, v) = 0 (Kuznetsov 2004, Section 10.2), in units of the largest |U|: y is
theta of a limit direction, and F = (Theta, Theta') where two meet, F = U(theta) where a critical set comes to the
equator; or y is e of a critical set, and F = (U, g) with g the function of a row of `special_kinds`. Where the
Jacobian of F is regular, v moves by at most the sum of the last row of its inverse for a unit change of F: so a
residual bounds, to first order, how far v may be off.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...results.arrays import Array
from ...results.result import Tabled
from ...results.special_kinds import DETERMINANT, HOPF, SPECIAL_KINDS, SpecialKind
from ...results.tables import table_number
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from ..layer_problem.hemisphere import e_psi
from ..layer_problem.vary import vary

STEP = 1e-5  # of differences, of central ones of second order: |U|, and derivatives, to about 1e-10
MEETING = ("saddle-node", "exchange of limit directions", "pitchfork", "cusp")
Defining = Callable[[Array, float], Array]  # F of y and v


class SpecialPoint(Protocol):
    """A special point as far as it is requested here (`SpecialValue`)."""

    @property
    def kind(self) -> str: ...  # noqa: D102
    @property
    def value(self) -> float: ...  # noqa: D102
    @property
    def place(self) -> tuple[float, float]: ...  # noqa: D102
    @property
    def number(self) -> float: ...  # noqa: D102


@dataclass(frozen=True, eq=False, slots=True)
class PointAccuracy(Tabled):
    """Accuracy of a special point, and how it unfolds.

    Attributes
    ----------
    kind : str
    value : float
    residual : float
        The largest entry of F, in units of the largest |U|.
    coefficient : float
        Of the normal form, in these units: of "saddle-node" and "exchange of limit directions" Theta''/2, of
        "pitchfork" and "cusp" Theta'''/6, of "transcritical" and "touching the equator" Theta'; of "fold of critical
        sets" w.D^2U(v, v)/2 with v, w the null vectors of D_e U, |v| = w.v = 1; of "Hopf" the first Lyapunov
        coefficient. NaN for other kinds. Where it is not 0, nothing more degenerate happens.
    condition : float
        How far the value moves for a change of F by 1, at most and to first order; infinite where F does not fix it, as
        that of a pitchfork, which is one by a symmetry only.
    """

    _head_ = ("at", "value", "residual", "coefficient", "condition")

    kind: str
    value: float
    residual: float
    coefficient: float
    condition: float

    @property
    def error(self) -> float:
        """Estimate of how far the value may be off, to first order: ``condition * residual``."""
        return self.condition * self.residual if self.residual else 0.0

    def _row_(self) -> tuple[str, ...]:
        return self.kind, *map(table_number, (self.value, self.residual, self.coefficient, self.condition))


def point_accuracy(
    one: SpecialPoint, system: Any, psi: Psi, z: tuple[float, ...], along: str, scale: float
) -> PointAccuracy | None:
    """Return the accuracy of a special point of equilibria; None if its kind has no defining system here."""

    def frozen(value: float) -> tuple[FrozenSystem, Psi]:
        varied, its_psi, place = vary(system, psi, z, along, value)
        return varied.at(place), its_psi

    at, psi = frozen(one.value)
    size, place = at.size or 1.0, np.array(one.place)
    row = {"tr J = 0": HOPF, "fold of critical sets": DETERMINANT, **{row.kind: row for row in SPECIAL_KINDS}}.get(
        one.kind
    )
    if one.kind in (*MEETING, "transcritical", "touching the equator"):
        y = np.array([math.atan2(place[1], place[0])])
        series = lambda theta: _theta_derivatives(at, theta) / size
        F: Defining = lambda y, v: _on_equator(frozen(v)[0], float(y[0]), one.kind in MEETING) / size
        order = {"saddle-node": 2, "exchange of limit directions": 2, "pitchfork": 3, "cusp": 3}.get(one.kind, 1)
        coefficient = float(series(float(y[0]))[order]) / math.factorial(order)
    elif row is not None:
        y = e_psi(psi, place)
        F = lambda y, v: _at_set(*frozen(v), y, row, size)
        coefficient = one.number if one.kind == HOPF.kind else math.nan
        if one.kind == "fold of critical sets":
            coefficient = _fold_coefficient(at, y) / size
    else:
        return None
    residual, condition = float(abs(F(y, one.value)).max()), _condition(F, y, one.value, scale)
    return PointAccuracy(one.kind, one.value, residual, coefficient, condition)


def _condition(F: Defining, y: Array, v: float, scale: float) -> float:
    room = STEP * (1.0 - math.hypot(*y)) if len(y) == 2 else STEP  # of what is in the disc, differences stay in it
    columns = [(F(y + room * unit, v) - F(y - room * unit, v)) / (2.0 * room) for unit in np.eye(len(y))]
    step = STEP * scale
    columns.append((F(y, v + step) - F(y, v - step)) / (2.0 * step))
    J = np.stack(columns, axis=-1)
    left, weights, right = np.linalg.svd(J)
    if weights[-1] <= 1e-8 * weights[0]:
        return math.inf
    return float(abs(right.T[-1] / weights @ left.T).sum())


def _theta_derivatives(at: FrozenSystem, theta: float) -> Array:
    """Return Theta and three derivatives by theta: the last two by differences of the first, which is exact."""

    def first(t: float) -> tuple[float, float]:
        e, across = np.array([math.cos(t), math.sin(t)]), np.array([-math.sin(t), math.cos(t)])
        U, DU = at.U(e), at.DU(e)
        return float(across @ U), float(across @ DU @ across - e @ U)

    (value, slope), before, after = first(theta), first(theta - 1e-4)[1], first(theta + 1e-4)[1]
    return np.array([value, slope, (after - before) / 2e-4, (after - 2.0 * slope + before) / 1e-8])


def _on_equator(at: FrozenSystem, theta: float, meeting: bool) -> Array:
    if meeting:
        return _theta_derivatives(at, theta)[:2]
    return np.asarray(at.U(np.array([math.cos(theta), math.sin(theta)])))


def _at_set(at: FrozenSystem, psi: Psi, e: Array, row: SpecialKind, size: float) -> Array:
    """Return U, and the function of a row for q J with a positive q, in units of a size."""
    modulus = math.hypot(*e)
    beta = 1.0 + float(psi.derivative(float(psi.radius(modulus)) ** 2))
    (a, b), (c, d) = D = np.asarray(at.DU(e)) / size
    determinant = float(a * d - b * c)
    if row is not DETERMINANT:
        determinant *= 1.0 - beta * modulus**2
    return np.append(np.asarray(at.U(e)) / size, row.function(float(a + d - beta * e @ D @ e), determinant))


def _fold_coefficient(at: FrozenSystem, e: Array) -> float:
    left, _, right = np.linalg.svd(np.asarray(at.DU(e)))
    v, w = right[-1], left[:, -1]
    bend = (np.asarray(at.DU(e + STEP * v)) - np.asarray(at.DU(e - STEP * v))) @ v / (2.0 * STEP)
    return float(w @ bend / (2.0 * (w @ v))) if abs(w @ v) > 1e-8 else math.nan
