"""Systems of every kind that a function may be given, and what stands for one, or for a Psi, at a public function."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Concatenate, ParamSpec, Protocol, TypeVar, overload

from ..formulas.expression import parse
from .coefficients import Coefficients
from .elinear import ELinear
from .frozen import FrozenSystem
from .psi.function import Psi
from .typed import Frozen, System

AnySystem = ELinear | System | FrozenSystem
SYSTEM_KINDS = (ELinear, System, Coefficients, Frozen)  # for `isinstance`, at the door
SystemLike = AnySystem | str  # the name is a preset's or an example's
PsiLike = Psi | str  # as `psi.from_text` reads it

SomeSystem = TypeVar("SomeSystem", contravariant=True)
P = ParamSpec("P")
R = TypeVar("R", covariant=True)


class OfSystem(Protocol[SomeSystem, P, R]):
    """A public function of a system, or its name."""

    def __call__(self, system: SomeSystem | str, *args: P.args, **kwargs: P.kwargs) -> R: ...  # noqa: D102


class OfPortrait(Protocol[SomeSystem, P, R]):
    """A public function of a system and a Psi; a preset's name stands for both."""

    @overload
    def __call__(self, system: SomeSystem | str, psi: PsiLike, *args: P.args, **kwargs: P.kwargs) -> R: ...
    @overload
    def __call__(self, system: str, *args: P.args, **kwargs: P.kwargs) -> R: ...


class OfMotion(Protocol[SomeSystem, P, R]):
    """A public function of a system and a Psi that may be left out, in the limit."""

    @overload
    def __call__(self, system: SomeSystem | str, psi: PsiLike | None, *args: P.args, **kwargs: P.kwargs) -> R: ...
    @overload
    def __call__(self, system: SomeSystem | str, *args: P.args, **kwargs: P.kwargs) -> R: ...


class InPlane(Protocol[SomeSystem, P, R]):
    """A public function of a system or its a, b, d."""

    @overload
    def __call__(self, system: SomeSystem | str, *args: P.args, **kwargs: P.kwargs) -> R: ...
    @overload
    def __call__(self, a: float, b: float, d: float, *args: P.args, **kwargs: P.kwargs) -> R: ...


class InPlaneWithPsi(Protocol[SomeSystem, P, R]):
    """A public function of a system or its a, b, d, and of a Psi."""

    @overload
    def __call__(self, system: SomeSystem | str, psi: PsiLike, *args: P.args, **kwargs: P.kwargs) -> R: ...
    @overload
    def __call__(self, system: str, *args: P.args, **kwargs: P.kwargs) -> R: ...
    @overload
    def __call__(self, a: float, b: float, d: float, psi: PsiLike, *args: P.args, **kwargs: P.kwargs) -> R: ...


@overload
def takes_names(function: Callable[Concatenate[SomeSystem, Psi | None, P], R]) -> OfMotion[SomeSystem, P, R]: ...
@overload
def takes_names(function: Callable[Concatenate[SomeSystem, Psi, P], R]) -> OfPortrait[SomeSystem, P, R]: ...
@overload
def takes_names(function: Callable[Concatenate[SomeSystem, P], R]) -> OfSystem[SomeSystem, P, R]: ...
def takes_names(function: Any) -> Any:
    """Say to type checkers that a function takes names, which `arguments.with_checks` reads."""
    return function


@overload
def takes_a_b_d(function: Callable[Concatenate[SomeSystem, Psi, P], R]) -> InPlaneWithPsi[SomeSystem, P, R]: ...
@overload
def takes_a_b_d(function: Callable[Concatenate[SomeSystem, P], R]) -> InPlane[SomeSystem, P, R]: ...
def takes_a_b_d(function: Any) -> Any:
    """Say the same of a function that also takes a, b, d in the place of a system."""
    return function


def in_axes_of(system: Any, *names: str) -> Any:
    """Return a system, one made `from_matrix` in its normal form where it is that form's a, b or d that are named."""
    turned = getattr(system, "given_matrix", None) is not None and not {"a", "b", "d"}.isdisjoint(names)
    return system.rotated() if turned else system


def as_elinear(system: Any) -> ELinear | Coefficients | None:
    """Return the e-linear system with the same U, without a slow flow; None if U is not affine in (c, s) throughout."""
    typed = system.typed
    if typed is None:
        return system
    if system.frozen:
        return system.normal_form
    if not system.is_affine:
        return None
    zero = parse("0", ())
    f = tuple(u.substitute("c", zero).substitute("s", zero) for u in typed.U)
    A: Any = typed.jacobian
    return ELinear.from_matrix(A, f, g=(0.0,) * typed.m or None, parameters=dict(typed.parameters))
