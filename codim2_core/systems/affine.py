"""A typed system whose U is affine in (c, s) for all parameters, as the e-linear system that it is (Lemma B.1)."""

from __future__ import annotations

from typing import Any

from ..formulas.expression import parse
from .coefficients import Coefficients
from .elinear import ELinear

__all__ = ["as_elinear", "in_axes_of"]


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
