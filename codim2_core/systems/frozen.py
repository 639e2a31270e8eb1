"""The interface of a system frozen at one z: all that the hemisphere there depends on."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from numpy.typing import ArrayLike

from ..formulas.arrays import Terms
from ..formulas.expression import Expression
from ..results.arrays import Array

if TYPE_CHECKING:
    from .coefficients import Affine, Coefficients


class FrozenSystem(Protocol):
    """A system frozen at one z: numbers (`Coefficients`), or typed formulas with numbers (`Frozen`).

    Nothing outside this package asks for the kind of a system. A quantity that has a closed form where U is affine asks
    for `as_given` or `affine`; where that is None it is searched for.

    Attributes
    ----------
    frozen : bool
        True: z is chosen already.
    moves_with_z : bool
        False: it depends on z no more.
    variable : tuple of str
        Names of the numbers that may be changed; `value_of` tells them.
    z : tuple of float
        Where it is frozen, as far as that is known: () for numbers alone.
    m : int
        The number of slow variables.
    typed : System or None
        The typed system that this was frozen from, for what shows it as it was given.
    key : hashable
        What decides the portrait.
    slow_key : hashable
        What decides the slow flow on a given critical set.
    normal_form : Coefficients or None
        U in the normal form of the e-linear system (Lemma B.1), in axes of its own; None if U is not e-linear.
    as_given : Coefficients or None
        The normal form where it has the same axes.
    is_affine : bool
        Whether U is affine in (c, s), and free of x and y.
    affine : tuple of 6 floats or None
        ``(A11, A12, A21, A22, f1, f2)`` of ``U = A e + f`` with nothing rounded: what signs are decided by. None if U
        is not e-linear.
    polynomials : tuple of two mappings, or None
        U1 and U2 on Sigma as polynomials in c and s, in the axes of `affine`; None if they are none.
    turn : float
        Angle from the axes of `affine` to those of this system, by which a matrix was brought into the normal form.
    size : float
        The largest of |a|, |b|, |d|, |f1|, |f2|, or the largest |U|: what residuals are compared with; 0 if U = 0.
    speed : float
        The speed that compiled fields count in; 1 if U = 0.
    reads_position : bool
        Whether U depends on x or y: then the outside differs from the hemisphere's continuation.
    """

    frozen: ClassVar[bool]
    clock: ClassVar[str]
    moves_with_z: ClassVar[bool]
    variable: ClassVar[tuple[str, ...]]

    @property
    def is_affine(self) -> bool: ...  # noqa: D102

    def value_of(self, name: str) -> float: ...  # noqa: D102
    @property
    def z(self) -> tuple[float, ...]: ...  # noqa: D102
    @property
    def m(self) -> int: ...  # noqa: D102
    @property
    def typed(self) -> Any: ...  # noqa: D102
    @property
    def key(self) -> Hashable: ...  # noqa: D102
    @property
    def slow_key(self) -> Hashable: ...  # noqa: D102
    @property
    def normal_form(self) -> Coefficients | None: ...  # noqa: D102
    @property
    def as_given(self) -> Coefficients | None: ...  # noqa: D102
    @property
    def affine(self) -> Affine | None: ...  # noqa: D102
    @property
    def polynomials(self) -> tuple[Terms, ...] | None: ...  # noqa: D102
    @property
    def turn(self) -> float: ...  # noqa: D102
    @property
    def size(self) -> float: ...  # noqa: D102
    @property
    def speed(self) -> float: ...  # noqa: D102
    @property
    def reads_position(self) -> bool: ...  # noqa: D102

    def at(self, z: ArrayLike = ()) -> FrozenSystem:
        """Return itself: a frozen system is accepted wherever a system is."""
        ...

    def U(self, e: ArrayLike, xy: ArrayLike | None = None) -> Array:
        """``U(e, x, y, z)`` for e of shape (..., 2) and xy of that shape (default x = y = 0, on Sigma)."""
        ...

    def W(self, e: ArrayLike, xy: ArrayLike | None = None) -> Array:
        """``W(e, x, y, z)`` likewise, of shape (..., m)."""
        ...

    def DU(self, e: ArrayLike) -> Array:
        """``D_(c,s) U`` on Sigma for e of shape (..., 2); shape (..., 2, 2)."""
        ...

    def U_rho(self, e: ArrayLike) -> Array:
        """``dU(e, rho e, z)/drho`` at rho = 0 for e of shape (..., 2): zero unless U reads x or y."""
        ...

    def of_critical_sets(self, rows: Array) -> Array:
        """Return of rows, one for each critical set, what is shown: the row itself where there cannot be two."""
        ...

    def rows(self, kept: Sequence[str] = ()) -> list[Expression]:
        """U and W as formulas, in which some of the system's numbers keep their names."""
        ...
