"""Coefficients of an e-linear system, and its Psi, for many values of one or several parameters at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arrays import Array
from ..expressions.expression import Expression
from ..layer_problem.vary import check_varying
from ..psi.function import Psi
from ..systems.affine import as_elinear
from ..systems.bounds import MAX_NUMBER
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear

_GRID_CELLS = 512
_GRID_OFFSETS = 0.3 * np.sin(2.0 + np.arange(_GRID_CELLS + 1) * 1.7)
_GRID_OFFSETS[[0, -1]] = 0.0
MAX_REACH, MAX_TURN = 0.9 * np.pi, 0.1  # of the axes of the normal form along a line, and from value to value


@dataclass(frozen=True, eq=False)
class Plane:
    """Coefficients and Psi at k parameter values.

    Attributes
    ----------
    a, b, d, f1, f2 : ndarray (k,)
        Zero where `defined` is not.
    psi : Psi
    n : ndarray (k,) or None
        The parameter of Psi, where it varies; of `psi` only the family then counts.
    defined : ndarray of bool (k,)
        Every coefficient is finite there.
    given : tuple of 6 ndarrays (k,), or None
        ``(A11, A12, A21, A22, f1, f2)`` before the rotation into the normal form, which rounds; None without one.
    turn : ndarray (k,) or None
        The angle of that rotation.
    told : ndarray (k,) or None
        The angle from the axes before it to those in which places are told.
    """

    a: Array
    b: Array
    d: Array
    f1: Array
    f2: Array
    psi: Psi
    n: Array | None
    defined: NDArray[np.bool_]
    given: tuple[Array, ...] | None = None
    turn: Array | None = None
    told: Array | None = None

    def __len__(self) -> int:
        return len(self.a)

    @property
    def arrays(self) -> tuple[Array, Array, Array, Array, Array]:
        """``(a, b, d, f1, f2)``."""
        return self.a, self.b, self.d, self.f1, self.f2

    @property
    def affine(self) -> tuple[Array, ...]:
        """``(A11, A12, A21, A22, f1, f2)`` with nothing rounded: what signs are decided by."""
        return (self.a, -self.b, self.b, self.d, self.f1, self.f2) if self.given is None else self.given

    @property
    def rigid(self) -> bool:
        """Whether a, b, d, f1, f2 are the same everywhere."""
        return bool(self.defined.all()) and all(bool((v == v[:1]).all()) for v in self.arrays)

    @property
    def back(self) -> Array:
        """Angle (k,) from the axes of a, b, d, f1, f2 to those in which places are told."""
        return np.zeros(len(self)) if self.turn is None or self.told is None else self.told - self.turn

    def matrix(self, i: int) -> Array:
        """Return A (2, 2) at value i, in the axes in which places are told."""
        angle = 0.0 if self.told is None else float(self.told[i])
        c, s = np.cos(angle), np.sin(angle)
        R = np.array([[c, -s], [s, c]])
        return R @ np.array([float(v[i]) for v in self.affine[:4]]).reshape(2, 2) @ R.T

    def coefficients(self, i: int) -> Coefficients:
        """Return the system at value i, without its slow part."""
        a, b, d, f1, f2 = (float(v[i]) for v in self.arrays)
        empty = np.zeros((0, 2)), np.zeros(0)
        if self.given is None or self.turn is None:
            return Coefficients(a, b, d, f1, f2, *empty)
        g11, g12, g21, g22, g1, g2 = (float(v[i]) for v in self.given)
        return Coefficients(a, b, d, f1, f2, *empty, float(self.turn[i]), (g11, g12, g21, g22, g1, g2))


_COEFFICIENTS = ("a", "b", "d", "f1", "f2")


@dataclass(frozen=True, eq=False)
class FamilySweep:
    """A system in which some names vary, prepared for many evaluations. Made by `family`.

    Attributes
    ----------
    names : tuple of str
    system : ELinear or Coefficients
    psi : Psi
    z : (m,) floats
    fixed : tuple of float or None
        a, b, d, f1, f2, where they vary by name only and in no formula.
    shape : str
        The one of the names that is the parameter of Psi, or "".
    axes : float
        Of the rotations into the normal form, by angles half a turn apart, the one by the angle nearest to this is
        taken: they change smoothly along a line as long as they keep within a quarter of a turn of it.
    own_axes : bool
        Places are told in the axes in which a matrix was given, else in those of the normal form, by `rotation`.
    """

    names: tuple[str, ...]
    system: ELinear | Coefficients
    psi: Psi
    z: ArrayLike
    fixed: tuple[float, ...] | None
    shape: str
    axes: float = 0.0
    own_axes: bool = False

    def __call__(self, **values: Array) -> Plane:
        """Coefficients at k values of every name, each of (k,), within `layer_problem.vary.limits` (not checked)."""
        k = len(values[self.names[0]])
        n = values[self.shape] if self.shape else None
        if self.fixed is not None:
            a, b, d, f1, f2 = (
                values[name] if name in values else np.full(k, v)
                for name, v in zip(_COEFFICIENTS, self.fixed, strict=True)
            )
            plane = Plane(a, b, d, f1, f2, self.psi, n, np.ones(k, bool))
            at: Any = self.system
            if not at.frozen or at.given is None or any(name in _COEFFICIENTS for name in self.names):
                return plane
            turn, given = np.full(k, at.rotation), tuple(np.full(k, v) for v in at.given)
            return replace(plane, given=given, turn=turn, told=0.0 * turn if self.own_axes else turn)
        assert isinstance(self.system, ELinear)
        rows = _coefficient_rows(self.system, self.z, values)
        full = [v if isinstance(v, np.ndarray) and v.shape == (k,) else np.full(k, v) for v in rows]
        defined = np.ones(k, bool)
        with np.errstate(invalid="ignore"):
            for v in full:
                defined &= abs(v) <= MAX_NUMBER
        if not defined.all():
            full = [np.where(defined, v, 0.0) for v in full]
        if self.system.given_matrix is None:
            a, b, d, f1, f2 = full
            return Plane(a, b, d, f1, f2, self.psi, n, defined)
        a, b, d, f1, f2, turn = _rotate_to_normal_form(*full)
        half_turns = np.rint((self.axes - turn) / np.pi)
        sign = 1.0 - 2.0 * (half_turns % 2.0)
        told = 0.0 * turn if self.own_axes else turn
        turn = turn + np.pi * half_turns
        return Plane(a, b, d, sign * f1, sign * f2, self.psi, n, defined, tuple(full), turn, told)


def family(system: Any, psi: Psi, z: ArrayLike, *varying: str, spans: Sequence[ArrayLike] = ()) -> FamilySweep:
    """Prepare an e-linear system in which some names vary (see `layer_problem.vary.names`).

    Parameters
    ----------
    system : ELinear or Coefficients
    psi : Psi
    z : (m,) floats
    *varying : str
        Different names.
    spans : sequence of arrays
        For each name, values to be checked against its limits.

    Returns
    -------
    FamilySweep

    Raises
    ------
    ValueError
        A name cannot be varied, a value is beyond what it may be, z does not fit, or the system is not e-linear.
    """
    if not isinstance(system, (ELinear, Coefficients)):
        raise ValueError(f"the system is of type {type(system).__name__}; give an e-linear one (ELinear).")
    varying = check_varying(system, psi, z, varying, spans)
    own = dict(getattr(system, "parameters", ()))
    fixed = None if isinstance(system, ELinear) and _needs(system, varying) else system.at(z).plane
    shape = "" if psi.record.parameter is None else psi.record.parameter.name
    return FamilySweep(varying, system, psi, z, fixed, shape if shape in varying and shape not in own else "")


@dataclass(frozen=True, eq=False)
class SystemPath:
    """A family with one name: a path of systems."""

    family: FamilySweep

    @property
    def names(self) -> tuple[str, ...]:
        """The one name."""
        return self.family.names

    @property
    def affine(self) -> bool:
        """Whether a, b, d, f1, f2 are constant, but for one that is the parameter itself."""
        return self.family.fixed is not None

    def __call__(self, values: Array) -> Plane:
        """Coefficients at k values, (k,)."""
        return self.family(**{self.family.names[0]: values})


def values_over(span: tuple[float, float]) -> Array:
    """Return the grid over a span: off the round numbers on which special values like to lie."""
    low, high = span
    values = low + (high - low) * (np.arange(_GRID_CELLS + 1) + _GRID_OFFSETS) / _GRID_CELLS
    values[-1] = high
    return values


def linear_path(system: Any, psi: Psi, z: ArrayLike, along: str, values: Array) -> SystemPath | None:
    """Prepare a system whose U is affine in (c, s) all along a line, as the e-linear system that it is.

    Parameters
    ----------
    system : ELinear, System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    along : str
    values : ndarray (k,)
        In order: the whole line is theirs.

    Returns
    -------
    SystemPath or None
        Places are told in the axes of the system, which for an `ELinear.from_matrix` are those of its normal form at
        each value. None if U is not affine, or where the axes of the normal form turn by nearly half a turn or jump,
        as they do beside a symmetric part that is a multiple of the unit matrix.
    """
    linear: Any = as_elinear(system)
    if linear is None:
        return None
    own = system.typed is not None
    z = z if system.frozen else system.at(z).z or z  # with the time of a clock
    path = SystemPath(family(linear, psi, z, along, spans=(values,)))
    plane = path(values)
    if plane.turn is None or plane.given is None or not plane.defined.any():
        return path
    if own and not linear.frozen and not (plane.given[1] + plane.given[2]).any():  # without a rotation
        (a, _), (b, d) = linear.given_matrix
        return SystemPath(replace(path.family, system=replace(linear, a=a, b=b, d=d, given_matrix=None)))
    turns = np.unwrap(plane.turn[plane.defined], period=np.pi)
    if np.ptp(turns) > MAX_REACH or (abs(np.diff(turns)) > MAX_TURN).any():
        return None if own else path
    return SystemPath(replace(path.family, axes=0.5 * float(turns.min() + turns.max()), own_axes=own))


def _needs(system: ELinear, varying: tuple[str, ...]) -> bool:
    """Whether a, b, d, f1, f2 are more than the numbers given and the values themselves."""
    if system.given_matrix is not None:
        return True
    used = {name for what, e in system.expressions if what in _COEFFICIENTS for name in e.names}
    return bool(used & {*varying, "z" if "z1" in varying else ""})


def _coefficient_rows(system: ELinear, z: ArrayLike, values: Mapping[str, Array]) -> list[Any]:
    """Return a, b, d, f1, f2, or the matrix as given (rows first), f1, f2."""
    held: dict[str, Any] = dict(system.parameters)
    for i, value in enumerate(np.atleast_1d(np.asarray(z, float))):
        held[f"z{i + 1}"] = float(value)
    held |= {name: v for name, v in values.items() if name in held}
    if "z1" in held:
        held["z"] = held["z1"]

    def number(name: str, value: Any) -> Any:
        return (
            value.evaluate({n: held[n] for n in value.names})
            if isinstance(value, Expression)
            else values.get(name, value)
        )

    f1, f2 = number("f1", system.f[0]), number("f2", system.f[1])
    if system.given_matrix is None:
        return [number(name, getattr(system, name)) for name in "abd"] + [f1, f2]
    return [number("", v) for row in system.given_matrix for v in row] + [f1, f2]


def _rotate_to_normal_form(a11: Array, a12: Array, a21: Array, a22: Array, f1: Array, f2: Array) -> tuple[Array, ...]:
    """Return a, b, d, f1, f2 in the normal form (lem:normalform), as `ELinear.from_matrix` makes it, and the angle."""
    shear, stretch = a12 + a21 + 0.0, a22 - a11 + 0.0
    phi = 0.5 * np.arctan2(shear, stretch)
    mean, half = 0.5 * a11 + 0.5 * a22, 0.5 * np.hypot(shear, stretch)
    c, s = np.cos(phi), np.sin(phi)
    return mean - half, 0.5 * a21 - 0.5 * a12, mean + half, c * f1 - s * f2, s * f1 + c * f2, phi
