"""U on Sigma over one or two parameters, with its derivatives: what bifurcation points and curves are solved from.

Each parameter runs from 0 to 1 over its range.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ...formulas.arrays import program
from ...formulas.expression import Expression, parse
from ...formulas.names import SLOW_NAMES
from ...motion.initial_value.field import function_of
from ...portrait.layer_problem.vary import vary
from ...results.arrays import Array
from ...systems.psi.constructors import many, with_parameter
from ...systems.psi.function import Psi

Ranges = tuple[tuple[float, float], ...]

DIFFERENCE_STEP = 1e-5  # of ln s and of the parameter of Psi, for derivatives by them
KINK_OFFSET = 1e-10  # in e, where derivatives are taken for those of a point that has none
MIN_RADIUS_SQUARED = 1e-16  # |e|^2 below which it counts as this
MAX_RADIUS_SQUARED = 1.0 - 1e-6  # |e|^2 up to which curves that ask for Psi are followed: they end on the equator
AXES: tuple[str, str] = ("x", "y")  # names of the parameters in units of their ranges: free, as x = y = 0 on Sigma
_TAPE_ROWS = ("row_c", "row_s", "row_f")


class EigenvalueRatio(NamedTuple):
    """sigma, the ratio of the radial to the tangential eigenvalue of D e_Psi, written ``1 - bend |e|^2``."""

    bend: float
    by_square: float  # derivative of `bend` by |e|^2
    by_parameters: tuple[float, float]  # derivatives of `bend` by both parameters: not zero where one is that of Psi


@dataclass(frozen=True, eq=False)
class SystemFamily:
    """A system and Psi over one or two parameters."""

    system: Any  # as given
    psi: Psi
    z: tuple[float, ...]
    names: tuple[str, ...]
    ranges: Ranges
    # (2,) Parameters ``origin + matrix u`` at a place u of the unit square, where this is no rectangle of the
    # ranges
    slant: tuple[Array, Array] | None = None

    @cached_property
    def rows(self) -> tuple[Expression, Expression]:
        """U1 and U2 on Sigma, in c, s and the names of the parameters."""
        first, second = (self._on_sigma(row) for row in _formula_rows(self.system, self.names))
        return first, second

    def _on_sigma(self, row: Expression) -> Expression:
        values = {"x": 0.0, "y": 0.0, **dict(zip(SLOW_NAMES, self.z, strict=False))}
        for name, value in values.items():
            if name in row.names and name not in self.names:
                row = row.substitute(name, parse(repr(value), ()))
        return row

    @cached_property
    def affine(self) -> bool:
        """Whether U is affine in e: then critical sets do not meet."""
        return all(
            not {"c", "s"} & set(row.derivative(one).derivative(other).names) and
            row.derivative(one).derivative(other).constant == 0.0
            for row in self.rows for one in "cs" for other in "cs"
        )  # fmt: skip

    @property
    def read(self) -> tuple[bool, ...]:
        """Return which of the parameters U reads."""
        return tuple(any(name in row.names for row in self.rows) for name in self.names)

    @cached_property
    def of_psi(self) -> tuple[bool, ...]:
        """Return which of the parameters is that of Psi."""
        own = self.psi.record.parameter
        return tuple(own is not None and name == own.name and name not in self.system.variable for name in self.names)

    @cached_property
    def unit_rows(self) -> tuple[Expression, Expression]:
        """U1 and U2 over `size`, in c, s and `AXES`, the places in the unit square."""
        if self.slant is None:
            places = [f"{low!r} + {high - low!r}*{unit}" for (low, high), unit in zip(self.ranges, AXES, strict=False)]
        else:
            places = [
                f"{low!r} + {first!r}*x + {second!r}*y"
                for low, (first, second) in zip(*(part.tolist() for part in self.slant), strict=True)
            ]
        found = []
        for row in self.rows:
            for name, place in zip(self.names, places, strict=True):
                row = row.substitute(name, parse(place, AXES))
            found.append(parse(f"value/{self.size!r}", ("value",)).substitute("value", row))
        return found[0], found[1]

    def jet(self, c: float, s: float, u: float, v: float) -> tuple[float, ...]:
        """Return U1, then U2: the value, and derivatives by c, s, u, v, cc, cs, cu, cv, ss, su, sv.

        Where one is undefined, as that of abs(c) at 0, all are taken a rounding away.
        """
        found = self._jet(c, s, u, v)
        return found if math.isfinite(sum(found)) else self._jet(c + KINK_OFFSET, s + KINK_OFFSET, u, v)

    @cached_property
    def _jet(self) -> Callable[..., tuple[float, ...]]:
        names = ("c", "s", *AXES)
        rows = []
        for row in self.unit_rows:
            once = [row.derivative(name) for name in names]
            twice = [once[i].derivative(names[j]) for i in range(2) for j in range(i, 4)]
            rows += [row, *once, *twice]
        return function_of(rows, names)

    @property
    def symmetric(self) -> bool:
        """Whether a half turn of the square about its middle turns the portrait, and changes nothing else."""
        return self.slant is not None

    @cached_property
    def widths(self) -> Array:
        """Widths of the ranges, (n,)."""
        return np.array([high - low for low, high in self.ranges])

    @cached_property
    def _low(self) -> Array:
        return np.array([low for low, _ in self.ranges])

    def values(self, u: Array) -> Array:
        """Return the parameters at places (..., n) of the unit square."""
        if self.slant is not None:
            return np.asarray(self.slant[0] + u @ self.slant[1].T)
        return self._low + self.widths * u

    def units(self, values: Array) -> Array:
        """Return places of the unit square from values (..., n) of the parameters."""
        if self.slant is not None:
            return np.asarray(np.linalg.solve(self.slant[1], (values - self.slant[0])[..., None])[..., 0], float)
        return np.asarray((values - self._low) / self.widths)

    def value(self, u: float) -> float:
        """Return the parameter of a family of one at a place of its span."""
        return float(self._low[0] + self.widths[0] * u)

    def unit(self, value: float) -> float:
        """Return the place in its span of a value of the parameter of a family of one."""
        return float((value - self._low[0]) / self.widths[0])

    @cached_property
    def size(self) -> float:
        """The largest |U| on a coarse net over the disc and the square, or 1: the unit of speed."""
        sides = *2 * [np.linspace(-1.0, 1.0, 9)], *len(self.names) * [np.linspace(0.0, 1.0, 5)]
        c, s, *u = (side.ravel() for side in np.meshgrid(*sides))
        inside = c * c + s * s <= 1.0
        where = self.values(np.stack(u, axis=-1)[inside])
        values = {"c": c[inside], "s": s[inside], **dict(zip(self.names, where.T, strict=True))}
        speeds = np.hypot(*(row.evaluate(values) for row in self.rows))
        return float(speeds[np.isfinite(speeds)].max(initial=0.0)) or 1.0

    def on_net(self, c: Array, s: Array, *u: Array) -> tuple[Array, Array]:
        """Return U (2, ...) over `size` and its derivatives by e (2, 2, ...) at many places at once."""
        places = np.broadcast_arrays(c, s, *u)
        if self.affine:  # a few numbers, which need no compiler
            shape, D = places[0].shape, [[row.derivative(name) for name in "cs"] for row in self.unit_rows]
            values = [_evaluate_row(row, places, shape) for row in (*self.unit_rows, *D[0], *D[1])]
            return np.stack(values[:2]), np.stack(values[2:]).reshape(2, 2, *shape)
        rows = program((self.unit_rows, ())).evaluate(np.stack([v.ravel() for v in places], axis=-1))
        found = np.moveaxis(rows, 0, -1).reshape(2, 3, *places[0].shape)
        return found[:, 0], found[:, 1:]

    def speed_on_net(self, c: Array, s: Array, *u: Array, by: str = "") -> Array:
        """Return U (2, ...) over `size`, or its derivative by a name, at many places at once."""
        rows = [row.derivative(by) if by else row for row in self.unit_rows]
        shape = np.broadcast_shapes(*(np.shape(v) for v in (c, s, *u)))
        return np.stack([_evaluate_row(row, (c, s, *u), shape) for row in rows])

    def jacobian_factors(self, square: Array, u: Array) -> tuple[Array, Array]:
        """Return both eigenvalues of D e_Psi, along e and across it, at |e|^2 (k,) and places (k, n)."""
        modulus = np.sqrt(np.clip(square, MIN_RADIUS_SQUARED, 1.0 - 1e-15))
        psi = many(self.psi, self.values(u)[:, self.of_psi.index(True)]) if any(self.of_psi) else self.psi
        return psi.jacobian_factors(psi.radius(modulus, (1.0 - modulus) * (1.0 + modulus)))

    def psi_at(self, u: Array) -> Psi:
        """Return Psi at a place of the unit square."""
        if not any(self.of_psi):
            return self.psi
        return with_parameter(self.psi, float(self.values(np.clip(u, 0.0, 1.0))[self.of_psi.index(True)]))

    def ratio(self, square: float, u: Array) -> EigenvalueRatio:
        """Return sigma at |e|^2 = `square`; beyond `MAX_RADIUS_SQUARED` it goes on along its tangent."""
        held = min(max(square, MIN_RADIUS_SQUARED), MAX_RADIUS_SQUARED)
        first, second = (self._ratio_by(k, held, u) if own else 0.0 for k, own in enumerate(self.of_psi))
        bend, by_square = _bend(self.psi_at(u), held)
        return EigenvalueRatio(bend + by_square * max(square - MAX_RADIUS_SQUARED, 0.0), by_square, (first, second))

    def _ratio_by(self, k: int, square: float, u: Array) -> float:
        step, held = DIFFERENCE_STEP * np.eye(2)[k], np.clip(u, 0.0, 1.0)
        low, high = np.clip(held - step, 0.0, 1.0), np.clip(held + step, 0.0, 1.0)
        rise = _bend(self.psi_at(high), square)[0] - _bend(self.psi_at(low), square)[0]
        return rise / float(high[k] - low[k])

    @cached_property
    def turns(self) -> bool:
        """Whether the portrait's axes are turned from those of `rows`, by Lemma B.1."""
        return getattr(self.system, "given_matrix", None) is not None

    def frozen(self, u: Array) -> Any:
        """Return the system at a place of the unit square, with all numbers."""
        system, _, z = self.at(u)
        return system.at(z)

    def at(self, u: Array) -> tuple[Any, Psi, tuple[float, ...]]:
        """Return system, Psi and z at a place of the unit square."""
        of = self.system, self.psi, self.z
        for name, value in zip(self.names, self.values(u).tolist(), strict=True):
            of = vary(*of, name, value)
        return of


def _evaluate_row(row: Expression, places: Sequence[Array], shape: tuple[int, ...]) -> Array:
    known = dict(zip(("c", "s", *AXES), places, strict=False))
    return np.broadcast_to(np.asarray(row.evaluate({name: known[name] for name in row.names}), float), shape)


def _bend(psi: Psi, square: float) -> tuple[float, float]:
    """Return ``(1 - sigma)/q`` and its derivative by q = |e|^2: sigma = (1 - q)(1 + k), k = -s Psi'(s)/Psi(s)."""
    modulus = math.sqrt(square)
    zeta = float(psi.radius(modulus, (1.0 - modulus) * (1.0 + modulus)))
    k = psi.steepness(zeta)
    higher, lower = (psi.steepness(zeta * math.exp(0.5 * sign * DIFFERENCE_STEP)) for sign in (1.0, -1.0))
    rise = (higher - lower) / (2.0 * DIFFERENCE_STEP)  # d k/d ln s
    return 1.0 + k - k / square, (k - rise / (1.0 + k)) / (square * square)


def _formula_rows(system: Any, names: Sequence[str]) -> list[Expression]:
    """U1 and U2 as formulas in which two names stay; of a matrix that was given in its own axes."""
    kept = [name for name in names if name in system.variable]
    given = getattr(system, "given_matrix", None)  # of e-linear systems only
    if given is None:
        return system.rows(kept)[:2]
    own = [(name, value) for name, value in system.parameters.items() if name not in kept]

    def as_expression(value: Any, name: str = "") -> Expression:
        if name in kept:
            return parse(name, (name,))
        row = value if isinstance(value, Expression) else parse(repr(value), ())
        row = row.substitute("z", parse("z1", SLOW_NAMES)) if "z" in row.names else row
        for parameter, number in own:
            row = row.substitute(parameter, parse(repr(number), ()))
        return row

    found = []
    for i, entries in enumerate(given):
        row = parse("row_c*c + row_s*s + row_f", ("c", "s", *_TAPE_ROWS))
        for name, value in zip(_TAPE_ROWS, (*entries, system.f[i]), strict=True):
            row = row.substitute(name, as_expression(value, f"f{i + 1}" if name == "row_f" else ""))
        found.append(row)
    return found
