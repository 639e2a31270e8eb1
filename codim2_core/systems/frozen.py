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
    """A system frozen at one z, `Coefficients` or `Frozen`, whose docstrings describe what is declared here."""

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
