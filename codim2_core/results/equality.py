"""Equality of results by their values, arrays among them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, cast

import numpy as np


class ByValue:
    """A frozen dataclass that is made with ``eq=False``, since its fields hold arrays.

    Two are equal if they are of one kind and their fields are: arrays by all their numbers, NaN as itself.
    """

    __slots__ = ()

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self is other or all(equal_values(value, getattr(other, name)) for name, value in compared_fields(self))

    def __hash__(self) -> int:
        texts = (value for _, value in compared_fields(self) if type(value) is str)  # equal numbers may differ in type
        return hash((type(self), *texts))


def compared_fields(result: ByValue) -> list[tuple[str, Any]]:
    """Return the fields by which a result is compared, with their values."""
    return [(one.name, getattr(result, one.name)) for one in fields(cast("Any", result)) if one.compare]


def equal_values(one: Any, other: Any) -> bool:
    """Whether two values of a field are equal: arrays by their numbers, tuples and mappings by what they hold."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        one, other = np.asarray(one), np.asarray(other)
        return one.dtype.kind == other.dtype.kind and np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")
    if isinstance(one, tuple | list) and type(one) is type(other):
        return len(one) == len(other) and all(map(equal_values, one, other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(equal_values(value, other[name]) for name, value in one.items())
    return bool(one == other) or (one != one and other != other)
