"""Construct a Psi: of a family by its name, or of a typed formula."""

from __future__ import annotations

import reprlib
from difflib import get_close_matches
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...formulas.expression import parse
from .families import FAMILIES, TYPED, Family, family_of_name
from .families.record import Each
from .function import Psi
from .typed import custom_kernel


def constant() -> Psi:
    """``Psi = 1``: ``e_Psi`` is the point of the projected hemisphere itself.

    Examples
    --------
    >>> from codim2_core import psi
    >>> round(float(psi.constant().modulus(1.0))**2, 12)
    0.5
    """
    return _constant()


@cache
def _constant() -> Psi:
    """Return the one that is requested in every frame."""
    return make("constant")


def rational() -> Psi:
    """``Psi = 1/(1 + s)``.

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.rational()(1.0)
    0.5
    """
    return make("rational")


def exponential() -> Psi:
    """``Psi = exp(-s)``.

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.exponential().derivative(0.0)
    -1.0
    """
    return make("exponential")


def tanh() -> Psi:
    """``Psi = s/sinh(sqrt s)^2``, for which ``|e_Psi| = tanh zeta``, Figure 5.

    Examples
    --------
    The modulus of e_Psi is a hyperbolic tangent:

    >>> import math
    >>> from codim2_core import psi
    >>> bool(abs(psi.tanh().modulus(0.7) - math.tanh(0.7)) < 1e-15)
    True
    """
    return make("tanh")


def hill(n: float) -> Psi:
    """``Psi = 3/(3 + (4s)^n)``, the family of case III, Figure 17.

    Parameters
    ----------
    n : float
        0.01 <= n <= 1000. Psi is smooth at s = 0 and s = inf (R1, R5) for whole n only; others work all the same.

    Raises
    ------
    ValueError
        n is no number or out of range.

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.hill(2)(0.25)
    0.75
    """
    return _member(family_of_name("hill"), n)


def custom(text: str) -> Psi:
    """Psi from text in s, such as ``"1/(1+s)**2"``; see `parse` for what can be written.

    Conditions of Definition 2.3 that it breaks while it stays usable are reported by `Psi.check`.

    Parameters
    ----------
    text : str

    Raises
    ------
    ValueError
        The text cannot be read, or Psi is unusable: not positive and finite for all s >= 0, or ``|e_Psi|`` does not
        rise from 0 to 1 (then no inverse exists, Lemma 2.6(c)).

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.custom("1/(1 + s)**2")(1.0)
    0.25
    """
    expression = parse(text, ("s",))
    return Psi(TYPED.name, 0.0, expression.text, expression, custom_kernel(expression), TYPED)


def from_text(text: str) -> Psi:
    """Psi as the command line names it: a family, ``"hill:3"`` with its parameter, or a formula in s.

    Parameters
    ----------
    text : str

    Raises
    ------
    ValueError
        It is none of these.

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.from_text("hill:3") == psi.hill(3)
    True
    """
    if not isinstance(text, str):
        raise ValueError(f"text is {reprlib.repr(text)}; give text such as 'hill:3' or '1/(1 + s)'.")
    text = text.strip()
    name, _, number = text.partition(":")
    record = FAMILIES.get(name)
    if record is None or record.typed:
        near = get_close_matches(name, [key for key, one in FAMILIES.items() if not one.typed], n=1, cutoff=0.7)
        if near and "(" not in text:
            raise ValueError(f"{text[:40]!r} is no family of Psi and no formula in s; the nearest name is {near[0]}.")
        identity = next(one for one in FAMILIES.values() if one.identity)
        return make(identity.name) if text == identity.formula else custom(text)
    if number and record.parameter is None:
        raise ValueError(f"{name} has no parameter, and {number!r} is given; leave it out.")
    return make(name, number or None)


def make(family: str, parameter: float | str | None = None, text: str = "") -> Psi:
    """Psi by the name of its family, for menus and links.

    Parameters
    ----------
    family : str
        One of `FAMILIES`.
    parameter : float, optional
        That of the family, if it has one; default its own default.
    text : str
        The formula, read for the typed family only.

    Raises
    ------
    ValueError
        No such family, or the parameter or the text is refused.

    Examples
    --------
    >>> from codim2_core import psi
    >>> psi.make("hill", 3.0) == psi.hill(3)
    True
    """
    record = family_of_name(family)
    if record.typed:
        return custom(text)
    return _member(record, record.parameter.default if parameter is None and record.parameter else parameter)


def _member(record: Family, parameter: Any) -> Psi:
    value = 0.0 if record.parameter is None else record.parameter.check_value(parameter)
    text = record.text(value)
    if record.kernel is None:
        expression = parse(text, ("s",))
        return Psi(record.name, value, text, expression, custom_kernel(expression), record)
    kernel = record.kernel() if record.parameter is None else record.kernel(value)
    return Psi(record.name, value, text, None, kernel, record)


def with_parameter(psi: Psi, value: Any) -> Psi:
    """Return the member of the same family with another parameter."""
    if psi.record.parameter is None:
        raise ValueError(f"Psi = {psi.text} has no parameter; choose a family that has one, such as psi.hill(2).")
    return _member(psi.record, value)


def many(psi: Psi, values: NDArray[np.float64]) -> Psi:
    """Members of the family of psi, one for each of the values (k,): a Psi that works on arrays of that length only."""
    record = psi.record
    if record.batched and record.kernel is not None:
        kernel = record.kernel(values)
    else:
        kernel = Each(tuple(with_parameter(psi, value).kernel for value in values.tolist()))
    return Psi(record.name, float("nan"), record.formula, None, kernel, record)


def comparison_families(most: int | None = None) -> tuple[Psi, ...]:
    """Those members of all families, at most so many of each, with which "whatever Psi" is asked."""
    return tuple(_member(record, value) for record in FAMILIES.values() for value in record.compared[:most])
