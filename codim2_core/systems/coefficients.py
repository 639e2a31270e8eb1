"""The e-linear system at one z: numbers, all that the hemisphere there depends on."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..formulas.arrays import Terms
from ..formulas.expression import Expression, parse
from ..results.arrays import join_columns
from ..results.result import ByValue, Listed
from .equations import affine_rows

Value = TypeVar("Value")


class Parameters(Mapping[str, Value]):
    """Names and their numbers, in the order in which they were given; read-only, so that what holds them is a value."""

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, Value]) -> None:
        self._values = dict(values)

    def __getitem__(self, name: str) -> Value:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def __hash__(self) -> int:
        return hash(frozenset(self._values.items()))

    def __repr__(self) -> str:
        return repr(self._values)


Affine = tuple[float, float, float, float, float, float]
#: What the core alone asks of a system at one z, of either kind.
INTERNAL_OF_FROZEN = frozenset(
    {
        "U_rho", "affine", "as_given", "clock", "coefficients", "frozen", "is_affine", "key", "moves_with_z",
        "normal_form", "of_critical_sets", "polynomials", "reads_position", "rows", "size", "slow_key", "speed", "turn",
        "typed", "value_of",
    }
)  # fmt: skip


def affine_terms(affine: Affine) -> tuple[Terms, Terms]:
    """Return U1 and U2 as polynomials in c and s."""
    a, b, c, d, f, g = map(Fraction, affine)
    return {(1, 0): a, (0, 1): b, (0, 0): f}, {(1, 0): c, (0, 1): d, (0, 0): g}


@lru_cache(maxsize=16)
def _speed(plane: tuple[float, ...]) -> float:
    """Return |plane|, or 1: each trajectory's kernel and each sample of a field asks for it."""
    size = max(map(abs, plane)) or 1.0
    return size * math.hypot(*[value / size for value in plane]) or 1.0


@dataclass(frozen=True, eq=False, slots=True)
class Coefficients(Listed, ByValue):
    """The e-linear system at one z: plain numbers, all that the hemisphere at that z depends on.

    Attributes
    ----------
    a, b, d, f1, f2 : float
        ``A = [[a, -b], [b, d]]`` and ``f(0, 0, z)``.
    B : ndarray (m, 2)
    g : ndarray (m,)
    rotation : float
        The angle phi, in radians, of the rotation into the normal form (Lemma B.1); 0 if none was needed.
    given : tuple of 6 floats or None
        ``(A11, A12, A21, A22, f1, f2)`` before that rotation, which rounds; None where there was none.
    """

    a: float
    b: float
    d: float
    f1: float
    f2: float
    B: NDArray[np.float64]
    g: NDArray[np.float64]
    rotation: float = 0.0
    given: Affine | None = None

    _internal_: ClassVar[frozenset[str]] = INTERNAL_OF_FROZEN | {"given", "plane", "varied", "z"}
    frozen: ClassVar[bool] = True
    clock: ClassVar[str] = ""
    moves_with_z: ClassVar[bool] = False
    coefficients: ClassVar[tuple[str, ...]] = ("a", "b", "d", "f1", "f2")
    variable: ClassVar[tuple[str, ...]] = coefficients
    typed: ClassVar[Any] = None
    is_affine: ClassVar[bool] = True
    reads_position: ClassVar[bool] = False
    z: ClassVar[tuple[float, ...]] = ()  # numbers do not know where they come from

    @property
    def m(self) -> int:
        """The number of slow variables."""
        return len(self.g)

    @property
    def plane(self) -> tuple[float, float, float, float, float]:
        """``(a, b, d, f1, f2)``: what decides the portrait."""
        return self.a, self.b, self.d, self.f1, self.f2

    @property
    def A(self) -> NDArray[np.float64]:
        """The matrix A, (4.2), (2, 2)."""
        return np.array([[self.a, -self.b], [self.b, self.d]])

    @property
    def f(self) -> NDArray[np.float64]:
        """f(0, 0, z), (2,)."""
        return np.array([self.f1, self.f2])

    def at(self, z: ArrayLike = ()) -> Coefficients:  # noqa: ARG002 (z is already chosen)
        """Return itself: a system frozen at one z, accepted wherever a system is."""
        return self

    @property
    def normal_form(self) -> Coefficients:
        """Itself."""
        return self

    @property
    def as_given(self) -> Coefficients:
        """Itself."""
        return self

    @property
    def affine(self) -> Affine:
        """``(A11, A12, A21, A22, f1, f2)`` of ``U = A e + f`` with nothing rounded, before any rotation."""
        return (self.a, -self.b, self.b, self.d, self.f1, self.f2) if self.given is None else self.given

    @property
    def polynomials(self) -> tuple[Terms, Terms]:
        """U1 and U2 as polynomials in c and s, in the axes of `affine`."""
        return affine_terms(self.affine)

    @property
    def turn(self) -> float:
        """Angle from the axes of `affine` to these."""
        return 0.0 if self.given is None else self.rotation

    @property
    def size(self) -> float:
        """The largest of |a|, |b|, |d|, |f1|, |f2|."""
        return max(map(abs, self.plane))

    @property
    def speed(self) -> float:
        """|(a, b, d, f1, f2)|, or 1 where all are zero: the unit of speed of the compiled field."""
        return _speed(self.plane)

    def varied(self, name: str, value: float) -> Coefficients:
        """Return the same system with one of `variable` changed (not checked)."""
        return replace(self, rotation=0.0, given=None, **{name: value})

    def value_of(self, name: str) -> float:
        """Present value of one of `variable`."""
        return float(getattr(self, name))

    @property
    def key(self) -> Hashable:
        """Return the key of the portrait, as `Frozen.key` of a general system."""
        return self.plane if self.given is None else (self.plane, self.given)

    @property
    def slow_key(self) -> Hashable:
        """Return the key of the slow flow on a given critical set."""
        return self.B.tobytes(), self.g.tobytes()

    def U(self, e: ArrayLike, xy: ArrayLike | None = None) -> NDArray[np.float64]:  # noqa: ARG002 (f at x = y = 0)
        """``U = A e + f`` for e of shape (..., 2)."""
        e = np.asarray(e, float)
        c, s = e[..., 0], e[..., 1]
        return join_columns(self.a * c - self.b * s + self.f1, self.b * c + self.d * s + self.f2)

    def DU(self, e: ArrayLike) -> NDArray[np.float64]:
        """``D_(c,s) U = A`` for e of shape (..., 2); shape (..., 2, 2)."""
        each = np.empty((*np.asarray(e).shape[:-1], 2, 2))
        each[...] = self.A
        return each

    def U_rho(self, e: ArrayLike) -> NDArray[np.float64]:
        """Zeros: U does not depend on the distance from Sigma."""
        return np.zeros(np.shape(e))

    def of_critical_sets(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return of rows, one for each critical set, what is shown: the only one there can be."""
        return rows[0]

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W as formulas, in which some of a, b, d, f1, f2 keep their names."""
        *abd, f1, f2 = (parse(name, (name,)) if name in kept else getattr(self, name) for name in self.variable)
        return affine_rows(abd, (f1, f2), self.B.tolist(), self.g.tolist())

    def W(self, e: ArrayLike, xy: ArrayLike | None = None) -> NDArray[np.float64]:  # noqa: ARG002
        """``W = B e + g`` for e of shape (..., 2); shape (..., m)."""
        return np.asarray(e, float) @ self.B.T + self.g
