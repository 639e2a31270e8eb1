"""Vary one thing by its name: a coefficient, a parameter of the system, a slow variable, or the parameter of Psi."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...systems.psi.constructors import with_parameter
from ...systems.psi.function import Psi
from ...systems.reading import MAX_NUMBER


def names(system: Any, psi: Psi, z: ArrayLike = ()) -> tuple[str, ...]:
    """Names of all that can be varied: numbers of the system, its parameters, z1 to zm, and that of Psi."""
    found = [*system.variable]
    if not system.frozen:  # else z is chosen
        found += [f"z{i + 1}" for i in range(len(_slow_values(z)))]
    if psi.record.parameter is not None and psi.record.parameter.name not in found:
        found.append(psi.record.parameter.name)
    return tuple(found)


def vary(system: Any, psi: Psi, z: ArrayLike, name: str, value: float) -> tuple[Any, Psi, tuple[float, ...]]:
    """Return system, Psi and z with the thing called `name` set to a value; ValueError where that may not be."""
    slow = _slow_values(z)
    if name in system.variable:
        return system.varied(name, _finite_number(name, value)), psi, slow
    if not system.frozen and (index := _slow_index(name)) in range(len(slow)):
        return system, psi, (*slow[:index], _finite_number(name, value), *slow[index + 1 :])
    if _of_psi(psi, name):
        return system, with_parameter(psi, value), slow
    raise _unknown_name(system, psi, z, name)


def value_of(system: Any, psi: Psi, z: ArrayLike, name: str) -> float:
    """Present value of the thing called `name`; ValueError where nothing variable has this name."""
    if name in system.variable:
        return system.value_of(name)
    slow = _slow_values(z)
    if not system.frozen and (index := _slow_index(name)) in range(len(slow)):
        return slow[index]
    if _of_psi(psi, name):
        return psi.parameter
    raise _unknown_name(system, psi, z, name)


def limits(system: Any, psi: Psi, name: str) -> tuple[float, float]:
    """Return the smallest and the largest value that `vary` takes for a name."""
    shape = psi.record.parameter
    if shape is not None and name == shape.name and name not in system.variable:
        return shape.low, shape.high
    return -MAX_NUMBER, MAX_NUMBER


def check_name(system: Any, psi: Psi, z: ArrayLike, parameter: str, name: str) -> None:
    """Refuse a z that does not fit, and, under the name of a parameter, a name of nothing that can be varied."""
    system.at(z)
    allowed = names(system, psi, z)
    if name not in allowed and not (name == "z" and "z1" in allowed):
        known = f"choose one of {', '.join(allowed)}" if allowed else "nothing of this system and its Ψ can be varied"
        raise ValueError(f"{parameter} is {name!r}; {known}.")


def check_varying(
    system: Any, psi: Psi, z: ArrayLike, varying: Sequence[str], values: Sequence[ArrayLike] = ()
) -> tuple[str, ...]:
    """Return different names that can be varied, "z" as z1; refuse others, and values beyond their limits."""
    varying = tuple("z1" if name == "z" else name for name in varying)
    allowed = names(system, psi, z)
    for i, name in enumerate(varying):
        if name not in allowed:
            raise ValueError(f"{name!r} cannot be varied here; choose one of {', '.join(allowed)}.")
        if name in varying[:i]:
            raise ValueError(f"{name!r} is given twice; choose two different names.")
    for name, given in zip(varying, values, strict=False):
        low, high = limits(system, psi, name)
        given = np.asarray(given, float)
        if not (np.isfinite(given).all() and (given >= low).all() and (given <= high).all()):
            raise ValueError(f"values of {name} are beyond {low:g} to {high:g}; give values between these.")
    return varying


def usual_span(system: Any, psi: Psi, z: ArrayLike, name: str) -> tuple[float, float]:
    """Return the span over which something is looked at that was given none: about its present value."""
    value, (low, high) = value_of(system, psi, z, name), limits(system, psi, name)
    if name not in system.variable and _of_psi(psi, name):
        return max(low, value / 3.0), min(high, 3.0 * value)
    if name in system.coefficients:
        room = max(abs(system.value_of(one)) for one in system.coefficients if one in system.variable)
    else:
        room = 0.5 * abs(value) if name in system.variable else max(abs(value), 1.0)
    return max(low, value - (room or 1.0)), min(high, value + (room or 1.0))


def _of_psi(psi: Psi, name: str) -> bool:
    return psi.record.parameter is not None and name == psi.record.parameter.name


def _slow_values(z: ArrayLike) -> tuple[float, ...]:
    slow = np.atleast_1d(np.asarray(z, float))
    if slow.ndim > 1:
        raise ValueError(f"z has shape {slow.shape}; give a list of numbers.")
    return tuple(slow.tolist())


def _slow_index(name: str) -> int:
    """Return i - 1 of a name zi, -1 of any other name."""
    if name == "z":
        return 0
    return int(name[1:]) - 1 if name[:1] == "z" and name[1:].isdecimal() else -1


def _finite_number(name: str, value: float) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} is {value!r}; give a number.") from error
    if not math.isfinite(number) or abs(number) > MAX_NUMBER:
        raise ValueError(f"{name} is {number}; give a finite number of size up to {MAX_NUMBER:g}.")
    return number


def _unknown_name(system: Any, psi: Psi, z: ArrayLike, name: str) -> ValueError:
    allowed = names(system, psi, z)
    return ValueError(
        f"{name!r} cannot be varied here; choose one of {', '.join(allowed)}."
        if allowed
        else f"{name!r} cannot be varied: this system is frozen and Ψ has no parameter. Give the system itself."
    )
