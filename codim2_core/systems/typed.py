"""Any system of the paper's form, (2.7): ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)``, typed as text.

The text is read by `expressions.expression.parse` against a whitelist and never evaluated as Python. The system is
immutable; `System.at` freezes it at one z, which is all that the hemisphere there depends on.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.arrays import Terms, polynomials, program
from ..formulas.expression import Expression, parse
from ..formulas.names import FAST_NAMES, MOST_SLOW_VARIABLES, SLOW_NAMES, TIME, number_names
from ..results.arrays import Array
from ..results.result import Listed
from .coefficients import INTERNAL_OF_FROZEN, Affine, Coefficients, Parameters, affine_terms
from .elinear import ELinear
from .equations import Equations, Exchange, Rows, constant, with_clock, with_left_sides, with_numbers
from .reading import (
    MAX_NUMBER,
    MIN_NUMBER,
    at_place,
    continuous,
    mapping,
    parameter,
    parse_formula,
    short_repr,
    slow_names,
    slow_values,
    texts,
)
from .reading import definitions as read_definitions

MOST_NUMBERS = 32  # parameters and slow variables that one system may read
MOST_NAMES = 64  # parameters and definitions of one system


_T = parse(TIME, (TIME,))


@dataclass(frozen=True, repr=False)
class System(Listed, Exchange):
    """A system ``(x, y)' = U(e, x, y, z)``, ``z' = W(e, x, y, z)`` with ``e = (c, s) = (x, y)/|(x, y)|``, (2.7).

    Parameters
    ----------
    U : (2,) text
        In c, s, x, y, the slow variables z1 … zm (z is z1), `parameters` and `definitions`.
    W : (m,) text, optional
        Likewise. Left out, W = 0 for as many slow variables as U names.
        Where a formula reads t, time is one more slow variable, the last, with the rate 1 (`clock` is its name): it
        needs no row, a motion that starts without it starts at the time where its span begins, and a portrait without
        it is that of t = 0. A parameter or a definition of the name t is that.
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
    >>> System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",)).at(0.5).U((1.0, 0.5)).tolist()
    [0.5, -0.5]

    A table that is shaken:

    >>> shaken = System(U=("-mu*c + F*cos(w*t)", "-mu*s"), parameters={"mu": 0.3, "F": 0.5, "w": 2.0})
    >>> shaken.m, shaken.clock, shaken.at(0.0).U((0.0, -1.0)).tolist()
    (1, 'z1', [0.5, 0.3])
    """

    U: Any
    W: Any = ()
    parameters: Any = ()
    definitions: Any = ()
    # the slow variable that is t, the last one, where formulas read t; else ""
    clock: str = field(default="", init=False)

    _internal_: ClassVar[frozenset[str]] = frozenset(
        {
            "coefficients", "frozen", "is_affine", "jacobian", "meanings", "moves_with_z", "numbers", "reads_position",
            "rows", "typed", "value_of", "varied", "without_clock",
        }
    )  # fmt: skip
    frozen: ClassVar[bool] = False
    coefficients: ClassVar[tuple[str, ...]] = ()

    def __post_init__(self) -> None:
        fix = object.__setattr__
        given, meanings = mapping(self.parameters, "parameters"), mapping(self.definitions, "definitions")
        if len(given) + len(meanings) > MOST_NAMES:
            raise ValueError(
                f"there are {len(given)} parameters and {len(meanings)} definitions; at most {MOST_NAMES} are allowed."
            )
        parameters = {name: parameter(name, value) for name, value in given.items()}
        definitions = read_definitions(meanings, tuple(parameters))
        fix(self, "parameters", Parameters(parameters))
        fix(self, "definitions", tuple((name, text) for name, text, _, _ in definitions))
        U = texts(self.U, "U")
        if len(U) != 2:
            raise ValueError(f"U is {short_repr(self.U)}; give two formulas (U1, U2).")
        formula = lambda text, what: parse_formula(text, what, tuple(parameters), definitions)
        plane = tuple(formula(text, f"U{i + 1}") for i, text in enumerate(U))
        W = texts(self.W, "W")
        if len(W) > MOST_SLOW_VARIABLES:
            raise ValueError(f"W has {len(W)} rows; at most {MOST_SLOW_VARIABLES} slow variables are allowed.")
        slow = tuple(formula(text, f"W{i + 1}") for i, text in enumerate(W))
        if TIME not in parameters and any(TIME in row.names for row in (*plane, *slow)):
            plane, slow, clock = with_clock(plane, slow)
            fix(self, "clock", clock)
        fix(self, "U", plane)
        fix(self, "W", slow)
        for what, rows in (("U", self.U), ("W", self.W)):
            for i, row in enumerate(rows):
                continuous(row, f"{what}{i + 1}")
        if len(self.numbers) > MOST_NUMBERS:
            raise ValueError(
                f"the system reads {len(self.numbers)} parameters and slow variables; at most {MOST_NUMBERS}."
            )
        self.m  # noqa: B018 (raises where W has too few rows)

    @property
    def without_clock(self) -> tuple[Rows, Rows]:
        """U and W as they were given: in t, and without the row of its clock."""
        if not self.clock:
            return self.U, self.W
        U, W = (tuple(row.substitute(self.clock, _T) for row in rows) for rows in (self.U, self.W[:-1]))
        return U, W

    @cached_property
    def m(self) -> int:
        """The number of slow variables."""
        rows = [(f"{what}{i}", row) for what, own in (("U", self.U), ("W", self.W)) for i, row in enumerate(own, 1)]
        named, first = max(
            ((SLOW_NAMES.index(name) + 1, box) for box, row in rows for name in row.names if name in SLOW_NAMES),
            default=(0, ""),
        )
        if self.W and named > len(self.W):
            raise ValueError(
                f"{first} names z{named}, but {slow_names(len(self.W), 'W')}, or give W {named} row{'s' * (named > 1)}."
            )
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

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W as formulas, in which some of the parameters keep their names."""
        rows = [*self.U, *(self.W or [constant(0.0)] * self.m)]
        return with_numbers(rows, [pair for pair in self.parameters.items() if pair[0] not in kept])

    @cached_property
    def is_affine(self) -> bool:
        """Whether U is affine in (c, s) for all parameters and slow variables, and free of x and y."""
        named = {name for row in self.jacobian for entry in row for name in entry.names}
        return not self.reads_position and named.isdisjoint(FAST_NAMES)

    @cached_property
    def moves_with_z(self) -> bool:
        """Whether U, and with it the whole portrait, may depend on z."""
        return any(name in SLOW_NAMES for u in self.U for name in u.names)

    @cached_property
    def reads_position(self) -> bool:
        """Whether U depends on x or y: then the outside differs from the hemisphere's continuation."""
        return any(name in ("x", "y") for u in self.U for name in u.names)

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
            fields = dict(zip("UW", self.without_clock, strict=True)) | fields
            return replace(self, **{"parameters": parameters, **fields})
        copy = object.__new__(System)  # only numbers change: nothing is read again
        copy.__dict__.update(self.__dict__)
        copy.__dict__["parameters"] = Parameters(parameters)
        return copy

    @property
    def equations(self) -> Equations:
        """Left and right sides of (2.7), ("x", ...), ("y", ...), ("z1", ...): what is typed in t is written in t."""
        U, W = self.without_clock
        return with_left_sides((*U, *W))

    @property
    def meanings(self) -> dict[str, Expression]:
        """The definitions as formulas, by name."""
        given = {"parameters": self.parameters, "definitions": dict(self.definitions)}
        return {name: System(U=(name, "0"), **given).without_clock[0][0] for name in given["definitions"]}

    def __repr__(self) -> str:
        U, W = ([row.text for row in rows] for rows in self.without_clock)
        given = [f"U={tuple(U)}", *([f"W={tuple(W)}"] if W else [])]
        given += [f"parameters={dict(self.parameters)}"] if self.parameters else []
        return f"System({', '.join(given)})"

    @property
    def typed(self) -> System:
        """Itself."""
        return self

    @property
    def variable(self) -> tuple[str, ...]:
        """Names of what `varied` changes: the parameters."""
        return tuple(self.parameters)

    def value_of(self, name: str) -> float:
        """Present value of one of `variable`."""
        return self.parameters[name]

    def at(self, z: ArrayLike = ()) -> Frozen:
        """Freeze at z.

        Parameters
        ----------
        z : (m,) floats
            May be left out if no formula depends on it; t, the last where there is a `clock`, also else: it is 0 then.

        Raises
        ------
        ValueError
            z has the wrong length, or U is not finite somewhere on the hemisphere.
        """
        if self.clock and np.size(np.asarray(z, object)) == self.m - 1:
            z = (*np.ravel(z).tolist(), 0.0)
        used = any(name in SLOW_NAMES for row in (*self.U, *self.W) for name in row.names)
        frozen = Frozen(self, slow_values(z, self.m, needed=used))
        frozen.size  # noqa: B018 (raises where U is not finite)
        return frozen


# Where U must be finite: rings of directions, the equator among them.
_SIZES = (0.0, 0.35, 0.7, 1.0)
_SIZE_ANGLES = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
_PROBES = np.concatenate([r * np.stack([np.cos(_SIZE_ANGLES), np.sin(_SIZE_ANGLES)], axis=-1) for r in _SIZES])


@dataclass(frozen=True)
class Frozen(Listed):
    """A general system at one z: all that the hemisphere there depends on. Made by `System.at`.

    Attributes
    ----------
    system : System
    z : tuple of float
    """

    system: System
    z: tuple[float, ...]

    _internal_: ClassVar[frozenset[str]] = INTERNAL_OF_FROZEN
    frozen: ClassVar[bool] = True
    clock: ClassVar[str] = ""
    moves_with_z: ClassVar[bool] = False
    variable: ClassVar[tuple[str, ...]] = ()
    coefficients: ClassVar[tuple[str, ...]] = ()

    @property
    def typed(self) -> Any:
        """The system that this was frozen from."""
        return self.system

    @property
    def reads_position(self) -> bool:
        """Whether U depends on x or y: then the outside differs from the hemisphere's continuation."""
        return self.system.reads_position

    @property
    def is_affine(self) -> bool:
        """Whether U is affine in (c, s), and free of x and y."""
        return self.system.is_affine

    @property
    def m(self) -> int:
        """The number of slow variables."""
        return self.system.m

    @cached_property
    def values(self) -> dict[str, float]:
        """Parameters and slow variables by name."""
        return {**dict(self.system.parameters), **dict(zip(SLOW_NAMES, self.z, strict=False))}

    def value_of(self, name: str) -> float:
        """Present value of a parameter or a slow variable."""
        return self.values[name]

    @cached_property
    def key(self) -> Hashable:
        """Return the key of the portrait: the formulas of U and the numbers that they read."""
        return self.system.U, tuple(self.values[name] for name in self.system.numbers)

    @cached_property
    def slow_key(self) -> Hashable:
        """Return the key of the slow flow on a given critical set: the formulas of W and the numbers that they read."""
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
        rows = np.asarray(program(self.key).evaluate(e.reshape(-1, 2)), np.float64)
        return rows[:, :, 1:].reshape((*e.shape[:-1], 2, 2))

    def U_rho(self, e: ArrayLike) -> Array:
        """``dU(e, rho e, z)/drho`` at rho = 0 for e of shape (..., 2)."""
        e = np.asarray(e, float)
        by_x, by_y = (self._vector([row.derivative(name) for row in self.system.U], e, None) for name in ("x", "y"))
        return by_x * e[..., :1] + by_y * e[..., 1:]

    def of_critical_sets(self, rows: Array) -> Array:
        """Return of rows, one for each critical set, what is shown: all of them."""
        return rows

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W at z as formulas, in which some of the parameters keep their names."""
        return with_numbers(self.system.rows(kept), zip(SLOW_NAMES, self.z, strict=False))

    @cached_property
    def _matrix(self) -> Array | None:
        """D_(c,s) U where it is the same everywhere: U is affine in c and s."""
        entries = [entry for row in self.system.jacobian for entry in row]
        if any(name in FAST_NAMES for entry in entries for name in entry.names):
            return None
        return self._vector(entries, (0.0, 0.0), None).reshape(2, 2)

    @cached_property
    def normal_form(self) -> Coefficients | None:
        """U in the normal form of the e-linear system, in its axes, m = 0; None if it is not affine in (c, s)."""
        if self.affine is None:
            return None
        a11, a12, a21, a22, *f = self.affine
        if a12 + a21 == 0.0:  # in the normal form already: no rotation
            return ELinear(a11, a21, a22, f).at()
        return ELinear.from_matrix([[a11, a12], [a21, a22]], f).at()

    @cached_property
    def affine(self) -> Affine | None:
        """``(A11, A12, A21, A22, f1, f2)`` of ``U = A e + f``; None if U is not affine in (c, s)."""
        if not self.is_affine or self._matrix is None:
            return None
        (a11, a12), (a21, a22) = self._matrix.tolist()
        return (a11, a12, a21, a22, *self.U((0.0, 0.0)).tolist())

    @property
    def polynomials(self) -> tuple[Terms, ...] | None:
        """U1 and U2 on Sigma as polynomials in c and s; None if they are none, or of a degree beyond `MAX_DEGREE`."""
        return polynomials(program(self.key)) if self.affine is None else affine_terms(self.affine)

    @property
    def turn(self) -> float:
        """0: `affine` has these axes."""
        return 0.0

    @property
    def as_given(self) -> Coefficients | None:
        """The normal form where U is in it already: the same axes, and nothing rounded on the way."""
        normal = self.normal_form
        return normal if normal is not None and normal.rotation == 0.0 else None

    @cached_property
    def size(self) -> float:
        """The largest |U| on a net over the disc, the unit of speed; ValueError where U is too large or small."""
        speeds = np.hypot(*np.moveaxis(self.U(_PROBES), -1, 0))
        largest = float(speeds.max())
        if not largest <= MAX_NUMBER:  # also NaN
            c, s = _PROBES[int(np.argmax(~(speeds <= MAX_NUMBER)))]
            i = int(np.argmax(~(np.abs(self.U((c, s))) <= MAX_NUMBER)))
            value, place = float(self.U((c, s))[i]), at_place(self.z, (c, s))
            if math.isnan(largest):
                raise ValueError(
                    f"U{i + 1} has no value{place}; it must be finite on the whole disc |e| <= 1: where a formula "
                    "has a limit only, give it a value, as in 'c*log(abs(c) + 1e-300)'."
                )
            raise ValueError(
                f"U{i + 1} is {value:g}{place}; it must be finite, and at most {MAX_NUMBER:g}, "
                "on the whole disc |e| <= 1."
            )
        if 0.0 < largest < MIN_NUMBER:
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
            values.update((name, float(values[name])) for name in FAST_NAMES)
        return np.stack([np.asarray(row.evaluate(values), float) for row in rows], axis=-1)
