"""The compiled functions of one argument by their codes, with their slopes; and by their names, for compiled source."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from types import MappingProxyType
from typing import Any

from ...jit import kernel
from . import FUNCTIONS, code


def _jit(function: Callable[..., Any]) -> Any:
    return kernel(function)


def _otherwise(first: Any, number: int, rest: Any) -> Any:
    def value(k, a):
        return first(a) if k == number else rest(k, a)

    return _jit(value)


def _otherwise_slope(first: Any, number: int, rest: Any) -> Any:
    def slope(k, a, v):
        return first(a, v) if k == number else rest(k, a, v)

    return _jit(slope)


@_jit
def _none(k, a):  # the end of the chain
    return a


@_jit
def _no_slope(k, a, v):
    return a


_both = {one.name: one.kernels(_jit) for one in FUNCTIONS}
_reversed_kernels = [(code[name], *pair) for name, pair in reversed(_both.items())]
#: f(a) of the function with a code, and f'(a) from a and f(a).
value = reduce(lambda rest, one: _otherwise(one[1], one[0], rest), _reversed_kernels, _none)
slope = reduce(lambda rest, one: _otherwise_slope(one[2], one[0], rest), _reversed_kernels, _no_slope)

#: What compiled source calls by its name.
called: Mapping[str, Any] = MappingProxyType({one.name: _both[one.name][0] for one in FUNCTIONS if not one.source})
