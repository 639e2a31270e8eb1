"""Vary one thing by its name: a coefficient, a parameter of the system, a slow variable, or n of a Hill Psi."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..psi import constructors
from ..psi.constructors import LARGEST_N, SMALLEST_N
from ..psi.function import Psi
from ..systems.bounds import LARGEST
from ..systems.coefficients import Coefficients
from ..systems.elinear import ELinear

__all__ = ["limits", "names", "value_of", "varied"]

_PLANE = ("a", "b", "d", "f1", "f2")


def names(system: Any, psi: Psi, z: ArrayLike = ()) -> tuple[str, ...]:
    """Names of all that can be varied.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi
    z : (m,) floats
        The slow variables, as far as they are given.

    Returns
    -------
    tuple of str
        Of an e-linear system those of a, b, d, f1, f2 that are numbers and not text; then the system's parameters, z1
        to zm, and n for a Hill Psi (unless a parameter of the system has that name).
    """
    found = [*_coefficients(system), *dict(getattr(system, "parameters", ()))]
    if hasattr(system, "evolve"):  # a system frozen at one z does not depend on z any more
        found += [f"z{i + 1}" for i in range(len(_slow(z)))]
    if psi.family == "hill" and "n" not in found:
        found.append("n")
    return tuple(found)


def varied(system: Any, psi: Psi, z: ArrayLike, name: str, value: float) -> tuple[Any, Psi, tuple[float, ...]]:
    """Return system, Psi and z with the one thing called `name` set to `value`.

    Parameters
    ----------
    system : ELinear, System, Coefficients or Frozen
    psi : Psi
    z : (m,) floats
    name : str
        One of `names`; "z" is z1.
    value : float

    Returns
    -------
    system, psi, z
        Of the given types; what does not change is passed on as it is.

    Raises
    ------
    ValueError
        Nothing variable has this name, or the value is not allowed there.
    """
    slow = _slow(z)
    if name in _coefficients(system) or name in dict(getattr(system, "parameters", ())):
        value = _finite(name, value)
        if isinstance(system, Coefficients):
            return replace(system, **{name: value}), psi, slow
        return system.evolve(**{name: value}), psi, slow
    if hasattr(system, "evolve") and (index := _slow_index(name)) in range(len(slow)):
        return system, psi, (*slow[:index], _finite(name, value), *slow[index + 1 :])
    if name == "n" and psi.family == "hill":
        return system, constructors.hill(value), slow
    raise _unknown(system, psi, z, name)


def value_of(system: Any, psi: Psi, z: ArrayLike, name: str) -> float:
    """Present value of the thing called `name`.

    Parameters
    ----------
    system, psi, z, name
        As for `varied`.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        Nothing variable has this name.
    """
    if name in _coefficients(system):
        if isinstance(system, ELinear) and name[0] == "f":
            return system.f[int(name[1]) - 1]
        return float(getattr(system, name))
    parameters = dict(getattr(system, "parameters", ()))
    if name in parameters:
        return float(parameters[name])
    slow = _slow(z)
    if hasattr(system, "evolve") and (index := _slow_index(name)) in range(len(slow)):
        return slow[index]
    if name == "n" and psi.family == "hill":
        return psi.parameter
    raise _unknown(system, psi, z, name)


def limits(system: Any, psi: Psi, name: str) -> tuple[float, float]:
    """Return the smallest and the largest value that `varied` takes for a name."""
    taken = name in _coefficients(system) or name in dict(getattr(system, "parameters", ()))
    if name == "n" and psi.family == "hill" and not taken:
        return SMALLEST_N, LARGEST_N
    return -LARGEST, LARGEST


def _coefficients(system: Any) -> tuple[str, ...]:
    if isinstance(system, Coefficients):
        return _PLANE
    if not isinstance(system, ELinear):
        return ()
    held = {"f1": system.f[0], "f2": system.f[1]}
    if system._matrix is None:  # else a, b, d belong to the rotated form
        held |= {"a": system.a, "b": system.b, "d": system.d}
    return tuple(name for name in _PLANE if isinstance(held.get(name), float))


def _slow(z: ArrayLike) -> tuple[float, ...]:
    return tuple(float(v) for v in np.atleast_1d(np.asarray(z, float)))


def _slow_index(name: str) -> int:
    """Return i - 1 of a name zi, -1 of any other name."""
    if name == "z":
        return 0
    return int(name[1:]) - 1 if name[:1] == "z" and name[1:].isdecimal() else -1


def _finite(name: str, value: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is {value!r}; give a number.") from error
    if not math.isfinite(number) or abs(number) > LARGEST:
        raise ValueError(f"{name} is {number}; give a finite number of size up to {LARGEST:g}.")
    return number


def _unknown(system: Any, psi: Psi, z: ArrayLike, name: str) -> ValueError:
    allowed = names(system, psi, z)
    return ValueError(
        f"{name!r} cannot be varied here; choose one of {', '.join(allowed)}."
        if allowed
        else f"{name!r} cannot be varied: this system is frozen and Ψ has no parameter. Give the system itself."
    )
