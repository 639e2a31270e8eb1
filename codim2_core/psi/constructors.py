"""The families of Psi by name, and what makes each of them."""

from __future__ import annotations

from ..expressions.expression import parse
from . import families
from .function import Psi
from .typed import custom_kernel

FAMILIES = ("constant", "rational", "exponential", "tanh", "hill", "custom")
SMALLEST_N, LARGEST_N = 1e-2, 1000.0


def constant() -> Psi:
    """``Psi = 1``: ``e_Psi`` is the point of the projected hemisphere itself."""
    return Psi("constant", 0.0, "1", None, families.Constant())


def rational() -> Psi:
    """``Psi = 1/(1 + s)``."""
    return Psi("rational", 0.0, "1/(1+s)", None, families.Rational())


def exponential() -> Psi:
    """``Psi = exp(-s)``."""
    return Psi("exponential", 0.0, "exp(-s)", None, families.Exponential())


def tanh() -> Psi:
    """``Psi = s/sinh(sqrt s)^2``, for which ``|e_Psi| = tanh zeta``, fig:component."""
    return Psi("tanh", 0.0, "s/sinh(sqrt(s))**2", None, families.Tanh())


def hill(n: float) -> Psi:
    """``Psi = 3/(3 + (4s)^n)``, the family of case III, fig:bads.

    Parameters
    ----------
    n : float
        0.01 <= n <= 1000. Psi is smooth at s = 0 and s = inf (R1, R5) for whole n only; others work all the same.

    Raises
    ------
    ValueError
        n is no number or out of range.
    """
    try:
        n = float(n)
    except (TypeError, ValueError) as error:
        raise ValueError(f"n is {n!r}; give a number from {SMALLEST_N:g} to {LARGEST_N:g}.") from error
    if not SMALLEST_N <= n <= LARGEST_N:
        raise ValueError(f"n is {n!r}; allowed is {SMALLEST_N:g} <= n <= {LARGEST_N:g} (the paper uses 1 to 4).")
    return Psi("hill", n, f"3/(3+(4*s)**{n!r})".replace(".0)", ")"), None, families.Hill(n=n))


def custom(text: str) -> Psi:
    """Psi from text in s, such as ``"1/(1+s)**2"``; see `parse` for what can be written.

    Conditions of def:Psi that it breaks while it stays usable are reported by `Psi.check`.

    Parameters
    ----------
    text : str

    Raises
    ------
    ValueError
        The text cannot be read, or Psi is unusable: not positive and finite for all s >= 0, or ``|e_Psi|`` does not
        rise from 0 to 1 (then no inverse exists, lem:ePsi(c)).
    """
    expression = parse(text, ("s",))
    return Psi("custom", 0.0, expression.text, expression, custom_kernel(expression))


def make(family: str, parameter: float = 1.0, text: str = "") -> Psi:
    """Psi by the name of its family, for menus and links.

    Parameters
    ----------
    family : str
        One of `FAMILIES`.
    parameter : float
        n, read for "hill" only.
    text : str
        The formula, read for "custom" only.

    Raises
    ------
    ValueError
        No such family, or its constructor refuses.
    """
    match family:
        case "constant":
            return constant()
        case "rational":
            return rational()
        case "exponential":
            return exponential()
        case "tanh":
            return tanh()
        case "hill":
            return hill(parameter)
        case "custom":
            return custom(text)
    raise ValueError(f"there is no family {family!r} of Psi; choose one of {', '.join(FAMILIES)}.")
