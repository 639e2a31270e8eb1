"""The compiled functions of one argument by their codes, with their slopes."""

from __future__ import annotations

from typing import Any

from ...results.rebind import rebind
from ..jit import kernel
from . import FUNCTIONS, code

# What the links of the chains below read: one function, its code, and the rest of the chain.
first: Any = None
link_code: int = 0
rest: Any = None


def _value_link(k, a):
    return first(a) if k == link_code else rest(k, a)


def _slope_link(k, a, v):
    return first(a, v) if k == link_code else rest(k, a, v)


@kernel
def _none(k, a):  # the end of the chain
    return a


@kernel
def _no_slope(k, a, v):
    return a


_both = {one.name: one.kernels(kernel) for one in FUNCTIONS}


def _chain(link: Any, which: int, end: Any) -> Any:
    for name, pair in reversed(_both.items()):
        end = kernel(rebind(link, name, first=pair[which], link_code=code[name], rest=end))
    return end


#: f(a) of the function with a code, and f'(a) from a and f(a).
value, slope = _chain(_value_link, 0, _none), _chain(_slope_link, 1, _no_slope)
