"""Any system of the paper's form, eq:vf: ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)``, typed as text.

The text is read by `expressions.expression.parse` against a whitelist and never evaluated as Python. The system is
immutable; `System.at` freezes it at one z, which is all that the hemisphere there depends on.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..expressions.arrays import program
from ..expressions.expression import Expression
from ..expressions.names import MOST_SLOW_VARIABLES, PLANE, SLOW, number_names
from .bounds import LARGEST, SMALLEST, slow_values
from .coefficients import Affine, Coefficients
from .elinear import ELinear
from .formulas import continuous, mapping, parameter, read, shortened, texts
from .formulas import definitions as read_definitions

Array = NDArray[np.float64]

MOST_NUMBERS = 32  # parameters and slow variables that one system may read
MOST_NAMES = 64  # parameters and definitions of one system

# Where U must be finite: rings of directions, the equator among them.
_SIZES = (0.0, 0.35, 0.7, 1.0)
_ANGLES = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
_PROBES = np.concatenate([r * np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=-1) for r in _SIZES])


@dataclass(frozen=True)
class System:
    """A system ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)`` with ``e = (c, s) = (x, y)/|(x, y)|``, eq:vf.

    Parameters
    ----------
    U : (2,) text
        In c, s, x, y, the slow variables z1 … zm (z is z1), `parameters` and `definitions`.
    W : (m,) text, optional
        Likewise. Left out, W = 0 for as many slow variables as U names.
    parameters : mapping of str to float, optional
        `evolve` changes their values without reading or compiling anything again.
    definitions : mapping of str to text, optional
        Named sub-expressions, such as ``{"chi": "(1 + 2*z**2)/(1 + z**2)"}`` (the key may be ``"chi(z)"``); each may
        use the ones before it. In U, W both ``chi`` and ``chi(z)`` can be written.

    Notes
    -----
    Formulas may have kinks in e (abs, min, max, ``sqrt(c**2 + s**2)``): everything is found for them too, but for
    proofs that need smoothness, and where something lies on a kink, its derivatives are the mean of the two sides. A
    formula must not jump in e, x or y: sign of these is refused, since a jump is a discontinuity set of codimension 1,
    with a sliding flow of its own. sign of slow variables and parameters is a number like any other.

    Raises
    ------
    ValueError
        Text cannot be read (`ExpressionError`: with the column), or a shape or a value is wrong.

    Examples
    --------
    >>> System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",)).at(0.5).U((1.0, 0.0)).tolist()
    [0.5, 0.0]
    """

    U: Any
    W: Any = ()
    parameters: Any = ()
    definitions: Any = ()

    frozen: ClassVar[bool] = False

    def __post_init__(self) -> None:
        fix = object.__setattr__
        given, meanings = mapping(self.parameters, "parameters"), mapping(self.definitions, "definitions")
        if len(given) + len(meanings) > MOST_NAMES:
            raise ValueError(
                f"there are {len(given)} parameters and {len(meanings)} definitions; at most {MOST_NAMES} are allowed."
            )
        parameters = {name: parameter(name, value) for name, value in given.items()}
        definitions = read_definitions(meanings, tuple(parameters))
        fix(self, "parameters", tuple(parameters.items()))
        fix(self, "definitions", tuple((name, text) for name, text, _, _ in definitions))
        U = texts(self.U, "U")
        if len(U) != 2:
            raise ValueError(f"U is {shortened(self.U)}; give two formulas (U1, U2).")
        formula = lambda text, what: read(text, what, tuple(parameters), definitions)  # noqa: E731
        fix(self, "U", tuple(formula(text, f"U{i + 1}") for i, text in enumerate(U)))
        W = texts(self.W, "W")
        if len(W) > MOST_SLOW_VARIABLES:
            raise ValueError(f"W has {len(W)} rows; at most {MOST_SLOW_VARIABLES} slow variables are allowed.")
        fix(self, "W", tuple(formula(text, f"W{i + 1}") for i, text in enumerate(W)))
        for what, rows in (("U", self.U), ("W", self.W)):
            for i, row in enumerate(rows):
                continuous(row, f"{what}{i + 1}")
        if len(self.numbers) > MOST_NUMBERS:
            raise ValueError(
                f"the system reads {len(self.numbers)} parameters and slow variables; at most {MOST_NUMBERS}."
            )
        self.m  # noqa: B018 (raises where W has too few rows)

    @cached_property
    def m(self) -> int:
        """The number of slow variables."""
        used = {name for row in (*self.U, *self.W) for name in row.names}
        named = max((i + 1 for i, name in enumerate(SLOW) if name in used), default=0)
        if self.W and named > len(self.W):
            raise ValueError(f"a formula names z{named}, but W has only {len(self.W)} row(s); give m rows.")
        return len(self.W) or named

    @cached_property
    def numbers(self) -> tuple[str, ...]:
        """Names of the slow variables and parameters that U reads: the arguments of its compiled field, in order."""
        return number_names(self.U)

    @cached_property
    def jacobian(self) -> tuple[tuple[Expression, Expression], tuple[Expression, Expression]]:
        """``D_(c,s) U`` as formulas, rows first; exact derivatives, not differences."""
        first, second = ((u.derivative("c"), u.derivative("s")) for u in self.U)
        return first, second

    def evolve(self, **changes: Any) -> System:
        """Return the same system with some parameters (by name), or U, W, parameters, definitions, changed."""
        parameters = dict(self.parameters)
        fields: dict[str, Any] = {}
        for name, value in changes.items():
            if name in parameters:
                parameters[name] = parameter(name, value)
            elif name in ("U", "W", "parameters", "definitions"):
                fields[name] = value
            else:
                allowed = ", ".join([*parameters, "U", "W", "parameters", "definitions"])
                raise ValueError(f"{name!r} is no parameter of this system; it has {allowed}.")
        if fields:
            return replace(self, **{"parameters": tuple(parameters.items()), **fields})
        copy = object.__new__(System)  # only numbers change: nothing is read again
        copy.__dict__.update(self.__dict__)
        copy.__dict__["parameters"] = tuple(parameters.items())
        return copy

    @property
    def typed(self) -> System:
        """Itself."""
        return self

    @property
    def variable(self) -> tuple[str, ...]:
        """Names of what `varied` changes: the parameters."""
        return tuple(dict(self.parameters))

    def varied(self, name: str, value: float) -> System:
        """Return the same system with one of `variable` changed."""
        return self.evolve(**{name: value})

    def value_of(self, name: str) -> float:
        """Present value of one of `variable`."""
        return dict(self.parameters)[name]

    def at(self, z: ArrayLike = ()) -> Frozen:
        """Freeze at z.

        Parameters
        ----------
        z : (m,) floats
            May be left out if no formula depends on it.

        Raises
        ------
        ValueError
            z has the wrong length, or U is not finite somewhere on the hemisphere.
        """
        used = any(name in SLOW for row in (*self.U, *self.W) for name in row.names)
        frozen = Frozen(self, slow_values(z, self.m, needed=used))
        frozen.size  # noqa: B018 (raises where U is not finite)
        return frozen

    @cached_property
    def moves_with_z(self) -> bool:
        """Whether U, and with it the whole portrait, may depend on z."""
        return any(name in SLOW for u in self.U for name in u.names)

    @cached_property
    def reads_position(self) -> bool:
        """Whether U depends on x or y: then the outside differs from the hemisphere's continuation."""
        return any(name in ("x", "y") for u in self.U for name in u.names)


@dataclass(frozen=True)
class Frozen:
    """A general system at one z: all that the hemisphere there depends on. Made by `System.at`.

    Attributes
    ----------
    system : System
    z : tuple of float
    """

    system: System
    z: tuple[float, ...]

    frozen: ClassVar[bool] = True
    moves_with_z: ClassVar[bool] = False
    variable: ClassVar[tuple[str, ...]] = ()

    @property
    def typed(self) -> System:
        """The system that this was frozen from."""
        return self.system

    @property
    def reads_position(self) -> bool:
        """Whether U depends on x or y: then the outside differs from the hemisphere's continuation."""
        return self.system.reads_position

    @property
    def m(self) -> int:
        """The number of slow variables."""
        return self.system.m

    @cached_property
    def values(self) -> dict[str, float]:
        """Parameters and slow variables by name."""
        return {**dict(self.system.parameters), **dict(zip(SLOW, self.z, strict=False))}

    @property
    def numbers(self) -> tuple[float, ...]:
        """Values of ``system.numbers``: the arguments of the compiled field."""
        return tuple(self.values[name] for name in self.system.numbers)

    @cached_property
    def key(self) -> Hashable:
        """What decides the portrait: the formulas of U and the numbers that they read."""
        return self.system.U, self.numbers

    @cached_property
    def slow_key(self) -> Hashable:
        """What decides the slow flow on a given critical set: the formulas of W and the numbers that they read."""
        return self.system.W, tuple(self.values[name] for name in number_names(self.system.W))

    def at(self, z: ArrayLike = ()) -> Frozen:  # noqa: ARG002 (z is already chosen)
        """Return itself: a system frozen at one z, accepted wherever a system is."""
        return self

    def U(self, e: ArrayLike, xy: ArrayLike | None = None) -> Array:
        """``U(e, x, y, z)`` for e of shape (..., 2) and xy of that shape (default x = y = 0, on Sigma)."""
        return self._vector(self.system.U, e, xy)

    def W(self, e: ArrayLike, xy: ArrayLike | None = None) -> Array:
        """``W(e, x, y, z)`` likewise, of shape (..., m)."""
        if not self.system.W:
            return np.zeros((*np.shape(e)[:-1], self.m))
        return self._vector(self.system.W, e, xy)

    def DU(self, e: ArrayLike) -> Array:
        """``D_(c,s) U`` on Sigma for e of shape (..., 2); shape (..., 2, 2), exact; on a kink the mean of its sides."""
        e = np.asarray(e, float)
        if self._matrix is not None:
            return np.broadcast_to(self._matrix, (*e.shape[:-1], 2, 2))
        rows = np.asarray(program(self.key).at(e.reshape(-1, 2)), np.float64)
        return rows[:, :, 1:].reshape((*e.shape[:-1], 2, 2))

    @property
    def normal_form(self) -> Coefficients | None:
        """U in the normal form of the e-linear system (lem:normalform), or None if it is not affine in (c, s).

        U must not read x or y, and its derivatives by c and s must be free of them. Only the portrait's plane is
        brought over, in the rotated axes: the result has m = 0.
        """
        return self._normal_form

    @cached_property
    def _matrix(self) -> Array | None:
        """D_(c,s) U where it is the same everywhere: U is affine in c and s."""
        entries = [entry for row in self.system.jacobian for entry in row]
        if any(name in PLANE for entry in entries for name in entry.names):
            return None
        return self._vector(entries, (0.0, 0.0), None).reshape(2, 2)

    @cached_property
    def _normal_form(self) -> Coefficients | None:
        if self.affine is None:
            return None
        a11, a12, a21, a22, *f = self.affine
        if a12 + a21 == 0.0:  # in the normal form already: no rotation
            return ELinear(a11, a21, a22, f).at()
        return ELinear.from_matrix([[a11, a12], [a21, a22]], f).at()

    @property
    def affine(self) -> Affine | None:
        """``(A11, A12, A21, A22, f1, f2)`` of ``U = A e + f``; None if U is not affine in (c, s)."""
        return self._affine

    @cached_property
    def _affine(self) -> Affine | None:
        if self.reads_position or self._matrix is None:
            return None
        (a11, a12), (a21, a22) = self._matrix.tolist()
        return (a11, a12, a21, a22, *self.U((0.0, 0.0)).tolist())

    @property
    def turn(self) -> float:
        """0: `affine` has these axes."""
        return 0.0

    @property
    def as_given(self) -> Coefficients | None:
        """The normal form where U is in it already: the same axes, and nothing rounded on the way."""
        normal = self.normal_form
        return normal if normal is not None and normal.rotation == 0.0 else None

    @property
    def size(self) -> float:
        """The largest |U| on a coarse net over the closed disc: the unit of speed.

        Raises
        ------
        ValueError
            U is not finite there, or beyond 1e150, or not zero and below 1e-150.
        """
        return self._size

    @cached_property
    def _size(self) -> float:
        speeds = np.hypot(*np.moveaxis(self.U(_PROBES), -1, 0))
        largest = float(speeds.max())
        if not largest <= LARGEST:  # also NaN
            c, s = _PROBES[int(np.argmax(~(speeds <= LARGEST)))]
            raise ValueError(
                f"U is {self.U((c, s)).tolist()} at e = ({c:.3g}, {s:.3g}), z = {self.z}; it must be finite, and at "
                f"most {LARGEST:g}, on the whole disc |e| <= 1."
            )
        if 0.0 < largest < SMALLEST:
            raise ValueError(f"U is at most {largest:.3g}; multiply it by a factor: that only rescales time.")
        return largest

    @property
    def speed(self) -> float:
        """The largest |U|, or 1 where U = 0: the unit of speed of the compiled field."""
        return self.size or 1.0

    def _vector(self, rows: Sequence[Expression], e: ArrayLike, xy: ArrayLike | None) -> Array:
        e = np.asarray(e, float)
        values: dict[str, Any] = {**self.values, "c": e[..., 0], "s": e[..., 1], "x": 0.0, "y": 0.0}
        if xy is not None:
            xy = np.asarray(xy, float)
            values["x"], values["y"] = xy[..., 0], xy[..., 1]
        if e.ndim == 1 and (xy is None or xy.ndim == 1):
            values.update((name, float(values[name])) for name in PLANE)
        return np.stack([np.asarray(row.evaluate(values), float) for row in rows], axis=-1)
