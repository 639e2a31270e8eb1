"""The e-linear system in its normal form, (4.1) with (4.2).

``(x, y)' = A e + f`` and ``z' = B e + g`` with ``e = (x, y)/|(x, y)|`` and ``A = [[a, -b], [b, d]]``.
Every coefficient is a number, or text in the slow variables ``z1 … zm`` and in named parameters.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, fields, replace
from fractions import Fraction
from functools import cached_property
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..formulas.expression import Expression, parse
from ..formulas.names import MOST_SLOW_VARIABLES
from ..results.result import Listed
from .coefficients import Affine, Coefficients, Parameters
from .equations import Equations, Exchange, affine_rows, constant, linear_rows, negative, with_left_sides, with_numbers
from .reading import MAX_NUMBER, MIN_NUMBER, at_place, slow_names, slow_values


def in_normal_form(
    a11: float, a12: float, a21: float, a22: float
) -> tuple[float, float, float, float, tuple[float, float]]:
    """Return (a, b, d, phi, (cos phi, sin phi)) of R(phi) A R(phi)^T = [[a, -b], [b, d]], Lemma B.1.

    Rotation leaves the antisymmetric part b = (A21 - A12)/2 and the trace alone and diagonalises the symmetric
    part, whose eigenvalues are mean -+ half the length of (A12 + A21, A22 - A11). Where these nearly cancel, the
    smaller one is the determinant of the symmetric part, exact, over the larger: its sign is that of the matrix.
    """
    shear, stretch = a12 + a21 + 0.0, a22 - a11 + 0.0  # no -0: atan2 would turn by a right angle
    phi = 0.5 * math.atan2(shear, stretch)
    mean, half = 0.5 * a11 + 0.5 * a22, 0.5 * math.hypot(shear, stretch)
    a, d = mean - half, mean + half
    if 0.5 * half < abs(mean) < 2.0 * half:
        F11, F12, F21, F22 = map(Fraction, (a11, a12, a21, a22))
        determinant = F11 * F22 - (F12 + F21) ** 2 / 4
        if mean > 0.0:
            a = float(determinant / Fraction(d))
        else:
            d = float(determinant / Fraction(a))
    if shear == 0.0:  # by no angle, or by a right angle: exactly
        return a, 0.5 * a21 - 0.5 * a12, d, phi, ((1.0, 0.0) if stretch >= 0.0 else (0.0, 1.0))
    return a, 0.5 * a21 - 0.5 * a12, d, phi, (math.cos(phi), math.sin(phi))


def rotate_f(given: Affine, c: float, s: float) -> tuple[float, float]:
    """Rotate f; a component that is zero, as f is an eigenvector of the symmetric part of A, is zero exactly."""
    f1, f2 = given[4:]
    u, v = c * f1 - s * f2, s * f1 + c * f2
    if min(abs(u), abs(v)) <= 1e-12 * max(abs(u), abs(v)):
        a11, a12, a21, a22, g1, g2 = map(Fraction, given)
        shear = (a12 + a21) / 2
        if g1 * (shear * g1 + a22 * g2) == g2 * (a11 * g1 + shear * g2):
            return (0.0, v) if abs(u) < abs(v) else (u, 0.0)
    return u, v


Coefficient = float | Expression
#: Names that text may use of slow variables.
SLOW_NAMES = (*(f"z{i}" for i in range(1, MOST_SLOW_VARIABLES + 1)), "z")


def _coefficient(value: object, what: str, names: tuple[str, ...]) -> Coefficient:
    if isinstance(value, Expression):
        return value
    if isinstance(value, str):
        try:
            return parse(value, names)
        except ValueError as error:
            raise ValueError(f"{what}: {error}") from error
    try:
        number = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{what} is {reprlib.repr(value)}; give a number, or text in {', '.join(names)}.") from error
    return _require_finite(number, what)


def _require_finite(number: float, what: str) -> float:
    if abs(number) <= MAX_NUMBER:
        return number
    if not math.isfinite(number):
        raise ValueError(f"{what} is {number}; give a finite number.")
    raise ValueError(
        f"{what} is {number:.3g}; at most {MAX_NUMBER:g} in size is allowed. "
        "Divide all coefficients by one common factor: that only rescales time."
    )


def _parameter_value(value: object, name: str) -> float:
    return _require_finite(_real_number(value, f"parameter {name}"), f"parameter {name}")


_ONE = (str, float, int, Expression)  # what is one coefficient, and no row of them


def _pairs(values: Any, what: str, shape: str) -> list[tuple[Any, Any]]:
    """Nested sequences, checked to be (m, 2)."""
    rows = []
    given: Any = [values] if isinstance(values, _ONE) else values
    for row in given:
        if isinstance(row, str) or not hasattr(row, "__len__") or len(row) != 2:
            raise ValueError(f"{what} has a row {row!r}; give {what} of shape {shape}.")
        rows.append(tuple(row))
    return rows


@dataclass(frozen=True)
class ELinear(Listed, Exchange):
    """The normal form of the e-linear system, (4.1) with (4.2).

    Parameters
    ----------
    a, b, d : float or str
        ``A = [[a, -b], [b, d]]``. Text may use ``z1 … zm`` (``z`` is ``z1``) and the names in `parameters`.
    f : (2,) floats or str
    B : (m, 2) floats or str, optional
    g : (m,) floats or str, optional
        Default 0. The number m of slow variables is the number of rows of B or g, or the largest z that is named.
    parameters : mapping of str to float, optional
        Values of further names used in the text; `evolve` changes them without parsing anything again.

    Raises
    ------
    ValueError
        A coefficient is not finite or too large, text cannot be read, or a shape is wrong.
    """

    a: Any
    b: Any
    d: Any
    f: Any = (0.0, 0.0)
    B: Any = None
    g: Any = None
    parameters: Any = ()
    given_matrix: Any = None  # the raw entries ((a11, a12), (a21, a22)) when made by `from_matrix`

    _internal_: ClassVar[frozenset[str]] = frozenset(
        {
            "clock", "coefficients", "expressions", "frozen", "is_affine", "meanings", "moves_with_z", "rows", "typed",
            "value_of", "varied",
        }
    )  # fmt: skip
    frozen: ClassVar[bool] = False
    clock: ClassVar[str] = ""
    is_affine: ClassVar[bool] = True
    coefficients: ClassVar[tuple[str, ...]] = Coefficients.variable
    typed: ClassVar[None] = None
    meanings: ClassVar[Mapping[str, Expression]] = MappingProxyType({})

    def __post_init__(self) -> None:
        parameters = {name: _parameter_value(value, name) for name, value in dict(self.parameters).items()}
        names = (*SLOW_NAMES, *parameters)
        entry = lambda value, what: _coefficient(value, what, names)

        def matrix(values: Any, what: str, shape: str) -> Any:
            return None if values is None else tuple(
                tuple(entry(value, f"{what}[{i},{j}]") for j, value in enumerate(row, 1))
                for i, row in enumerate(_pairs(values, what, shape), 1)
            )  # fmt: skip

        if isinstance(self.f, str) or not hasattr(self.f, "__len__") or len(self.f) != 2:
            raise ValueError(f"f is {self.f!r}; give two coefficients (f1, f2).")
        f = tuple(entry(value, f"f{i}") for i, value in enumerate(self.f, 1))
        B, given = matrix(self.B, "B", "(m, 2)"), (self.g,) if isinstance(self.g, _ONE) else self.g
        g = None if given is None else tuple(entry(value, f"g{i}") for i, value in enumerate(given, 1))
        if B is not None and g is not None and len(B) != len(g):
            raise ValueError(f"B has {len(B)} row(s) and g has {len(g)}; both need m, one for each slow variable.")
        made = {name: entry(getattr(self, name), name) for name in "abd"}
        A = matrix(self.given_matrix, "A", "(2, 2)")
        if A is not None and all(isinstance(value, float) for row in A for value in row):
            made["a"], made["b"], made["d"], *_ = in_normal_form(*A[0], *A[1])
        made |= {"f": f, "B": B, "g": g, "parameters": Parameters(parameters), "given_matrix": A}
        for name, value in made.items():
            object.__setattr__(self, name, value)

    @classmethod
    def from_matrix(
        cls,
        A: ArrayLike | Sequence[Sequence[float | str]],
        f: Sequence[float | str] = (0.0, 0.0),
        B: Any = None,
        g: Any = None,
        parameters: Mapping[str, float] | None = None,
    ) -> ELinear:
        """Bring any A into the normal form by the rotation of Lemma B.1.

        With ``2 phi = atan2(A12 + A21, A22 - A11)`` (two arguments, see the errata), ``R(phi) A R(phi)^T``
        has the form [[a, -b], [b, d]], f becomes ``R f`` and B becomes ``B R^T``. The angle is
        ``system.at(z).rotation``; a direction theta of the original system is ``theta + rotation`` of this one.

        Parameters
        ----------
        A : (2, 2) floats or str
        f, B, g, parameters
            As for `ELinear`, in the original axes.
        """
        rows = A.tolist() if isinstance(A, np.ndarray) else A
        if isinstance(rows, str) or not hasattr(rows, "__len__") or len(rows) != 2:  # type: ignore[arg-type]
            raise ValueError(f"A is {A!r}; give a matrix of shape (2, 2).")
        return cls(0.0, 0.0, 0.0, f, B, g, parameters or {}, given_matrix=rows)

    @cached_property
    def expressions(self) -> tuple[tuple[str, Expression], ...]:
        """The coefficients that are text, by name: ("f1", ...), ("A[1,2]", ...), ("B[1,1]", ...), ("g1", ...)."""
        found = [
            (name, v) for name, v in zip("abd", (self.a, self.b, self.d), strict=True) if isinstance(v, Expression)
        ]
        for name, entries in (("f", self.f), ("A", self.given_matrix), ("B", self.B), ("g", self.g)):
            for i, entry in enumerate(entries or (), 1):
                if isinstance(entry, Expression):
                    found.append((f"{name}{i}", entry))
                elif isinstance(entry, tuple):
                    found += [(f"{name}[{i},{j}]", v) for j, v in enumerate(entry, 1) if isinstance(v, Expression)]
        return tuple(found)

    @cached_property
    def equations(self) -> Equations:
        """Left and right sides of (2.7), ("x", ...), ("y", ...), ("z1", ...): in the axes in which it was given."""
        matrix = self.given_matrix or ((self.a, negative(self.b)), (self.b, self.d))
        B, g = self.B or ((0.0, 0.0),) * self.m, self.g or (0.0,) * self.m
        rows = [(*row, constant) for row, constant in zip((*matrix, *B), (*self.f, *g), strict=True)]
        return with_left_sides(linear_rows(rows, tuple(self.parameters), self.m))

    def __repr__(self) -> str:
        defaults = {"f": (0.0, 0.0), "B": None, "g": None, "parameters": {}, "given_matrix": None}
        shown = {one.name: getattr(self, one.name) for one in fields(self)}
        set_values = {name: value for name, value in shown.items() if name not in defaults or value != defaults[name]}
        given = (f"{name}={_coefficient_text(value)}" for name, value in set_values.items())
        return f"ELinear({', '.join(given)})"

    @cached_property
    def _slow_names(self) -> frozenset[str]:
        return frozenset(name for _, name in self._slow_reads)

    @cached_property
    def _slow_reads(self) -> tuple[tuple[str, str], ...]:
        """Coefficients that read a slow variable, each with its name."""
        own = dict(self.parameters)
        return tuple((box, name) for box, text in self.expressions for name in sorted(text.names) if name not in own)

    @cached_property
    def m(self) -> int:
        """The number of slow variables."""
        reads = ((1 if name == "z" else int(name[1:]), box) for box, name in self._slow_reads)
        named, first = max(reads, default=(0, ""))
        given = "B" if self.B is not None else "g"
        rows = len(self.B) if self.B is not None else len(self.g) if self.g is not None else named
        if named > rows:
            raise ValueError(
                f"{first} names z{named}, but {slow_names(rows, given)}, or give B and g {named} "
                f"row{'s' * (named > 1)}."
            )
        return rows

    def evolve(self, **changes: Any) -> ELinear:
        """Return the same system with some coefficients or parameters changed.

        Parameters
        ----------
        **changes
            Any of a, b, d, f, f1, f2, B, g, or a name in `parameters`. Where a, b or d of a system made `from_matrix`
            are changed, all of them are of its normal form.
        """
        if self.given_matrix is not None and {"a", "b", "d"} & changes.keys():
            return self.rotated().evolve(**changes)
        parameters = dict(self.parameters)
        if changes.keys() <= parameters.keys():  # no text is read again, and what is known of it stays
            changed = copy(self)
            parameters |= {name: _parameter_value(value, name) for name, value in changes.items()}
            object.__setattr__(changed, "parameters", Parameters(parameters))
            return changed
        changed_fields: dict[str, Any] = {}
        f = list(self.f)
        for name, value in changes.items():
            if name in parameters:
                parameters[name] = value
            elif name in ("f1", "f2"):
                f[int(name[1]) - 1] = value
            elif name in ("a", "b", "d", "f", "B", "g"):
                changed_fields[name] = value
            else:
                allowed = ", ".join(["a", "b", "d", "f", "f1", "f2", "B", "g", *parameters])
                raise ValueError(f"{name!r} is no coefficient of this system; it has {allowed}.")
        return replace(self, **{"f": tuple(f), "parameters": parameters, **changed_fields})

    def rotated(self) -> ELinear:
        """Return a system made `from_matrix` as the a, b, d, f, B that it is in its normal form (Lemma B.1).

        Raises
        ------
        ValueError
            A, f or B holds text.
        """
        if self.given_matrix is None:
            return self
        if any(what[0] in "fAB" for what, _ in self.expressions):
            raise ValueError(
                "A, f or B holds text, so a, b, d are no numbers here; vary its parameters, or give a, b, d."
            )
        at = self._at((0.0,) * self.m)
        return ELinear(at.a, at.b, at.d, (at.f1, at.f2), at.B.tolist() if self.B else None, self.g, self.parameters)

    @cached_property
    def moves_with_z(self) -> bool:
        """Whether A or f, and with them the whole portrait, may depend on z."""
        known = dict(self.parameters)
        plane = (e for what, e in self.expressions if what[0] not in "Bg")
        return any(name not in known for expression in plane for name in expression.names)

    @property
    def variable(self) -> tuple[str, ...]:
        """Names of what `varied` changes: those of a, b, d, f1, f2 that are numbers, and the parameters."""
        held = {"f1": self.f[0], "f2": self.f[1]}
        if self.given_matrix is None:  # else a, b, d belong to the rotated form
            held |= {"a": self.a, "b": self.b, "d": self.d}
        numbers = [name for name in Coefficients.variable if isinstance(held.get(name), float)]
        return (*numbers, *self.parameters)

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W as formulas, in which some of `variable` keep their names; ValueError if the axes turn with these."""
        values = [pair for pair in self.parameters.items() if pair[0] not in kept]

        def as_expression(value: Any, name: str = "") -> Expression:
            if name in kept:
                return parse(name, (name,))
            expression = value if isinstance(value, Expression) else constant(value)
            expression = with_numbers([expression], values)[0]
            return expression.substitute("z", parse("z1", SLOW_NAMES)) if "z" in expression.names else expression

        f = [as_expression(value, name) for name, value in zip(("f1", "f2"), self.f, strict=True)]
        B = [[as_expression(value) for value in row] for row in self.B or [(0.0, 0.0)] * self.m]
        g = [as_expression(value) for value in self.g or [0.0] * self.m]
        abd: list[Any] = [
            as_expression(value, name) for name, value in zip("abd", (self.a, self.b, self.d), strict=True)
        ]
        axes = (1.0, 0.0)
        if self.given_matrix is not None:
            entries = [[as_expression(value).constant for value in row] for row in self.given_matrix]
            if any(entry is None for row in entries for entry in row):
                if any(
                    name in kept for row in self.given_matrix for value in row for name in as_expression(value).names
                ):
                    raise ValueError(
                        "A is made of the parameters named, and its rotation into the normal form turns with them: "
                        "give the system as System(U=..., W=...) in fixed axes."
                    )
                raise ValueError(
                    "A depends on z, and its rotation into the normal form would turn the axes of (x, y) with it: "
                    "nothing to simulate in. Give the system as System(U=..., W=...) in fixed axes."
                )
            still = self.from_matrix(np.array(entries, float)).at()
            abd, axes = [still.a, still.b, still.d], (math.cos(still.rotation), math.sin(still.rotation))
        return affine_rows(abd, f, B, g, axes)

    def value_of(self, name: str) -> float:
        """Present value of one of `variable`."""
        parameters = dict(self.parameters)
        if name in parameters:
            return parameters[name]
        return self.f[int(name[1]) - 1] if name[0] == "f" else getattr(self, name)

    def at(self, z: ArrayLike = ()) -> Coefficients:
        """All coefficients at z, as numbers.

        Parameters
        ----------
        z : (m,) floats
            May be left out if no coefficient depends on it.

        Raises
        ------
        ValueError
            z has the wrong length, or a coefficient is not finite there.
        """
        z = slow_values(z, self.m, needed=bool(self._slow_names))
        return self._at(z)

    def _at(self, z: tuple[float, ...]) -> Coefficients:
        names: dict[str, float] = dict(self.parameters)
        names.update((f"z{i + 1}", value) for i, value in enumerate(z))
        if z:
            names["z"] = z[0]

        def number(value: Coefficient, what: str) -> float:
            if not isinstance(value, Expression):
                return value
            try:
                result = float(value.evaluate(names))
            except (ArithmeticError, ValueError) as error:
                raise ValueError(f"{what} cannot be computed{at_place(z)}: {error}.") from error
            if abs(result) <= MAX_NUMBER:
                return result
            if not math.isfinite(result):
                raise ValueError(f"{what} is {result}{at_place(z)}; every coefficient must be finite there.")
            return _require_finite(result, f"{what}{at_place(z)}")

        f1, f2 = number(self.f[0], "f1"), number(self.f[1], "f2")
        B = np.zeros((self.m, 2))
        g = np.zeros(self.m)
        for i, row in enumerate(self.B or ()):
            B[i] = number(row[0], f"B[{i + 1},1]"), number(row[1], f"B[{i + 1},2]")
        for i, value in enumerate(self.g or ()):
            g[i] = number(value, f"g{i + 1}")
        if self.given_matrix is None:
            a, b, d, phi, given = number(self.a, "a"), number(self.b, "b"), number(self.d, "d"), 0.0, None
        else:
            (a11, a12), (a21, a22) = (
                tuple(number(v, f"A[{i + 1},{j + 1}]") for j, v in enumerate(row))
                for i, row in enumerate(self.given_matrix)
            )
            given = (a11, a12, a21, a22, f1, f2)
            a, b, d, phi, (c, s) = in_normal_form(a11, a12, a21, a22)
            f1, f2 = rotate_f(given, c, s)
            B = B @ np.array([[c, s], [-s, c]])
        size = max(abs(a), abs(b), abs(d), abs(f1), abs(f2))
        if 0.0 < size < MIN_NUMBER:
            raise ValueError(
                f"the largest of a, b, d, f1, f2 is {size:.3g}; at least {MIN_NUMBER:g} (or all zero) is allowed. "
                "Multiply all coefficients by one common factor: that only rescales time."
            )
        B.flags.writeable = g.flags.writeable = False
        return Coefficients(a, b, d, f1, f2, B, g, phi, given)


def _coefficient_text(value: Any) -> str:
    """Return a coefficient as it was given, however deep in tuples."""
    if isinstance(value, tuple):
        return f"({', '.join(map(_coefficient_text, value))}{',' * (len(value) == 1)})"
    if isinstance(value, Expression):
        return repr(value.text)
    return repr(value).removesuffix(".0") if isinstance(value, float) else repr(value)


def _real_number(value: object, what: str) -> float:
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError) as error:
        raise ValueError(f"{what} is {reprlib.repr(value)}; give a number.") from error
