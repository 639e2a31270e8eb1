"""A function of one argument in all forms in which a formula needs it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

Jit = Callable[[Callable[..., Any]], Any]
Kernels = tuple[Callable[[float], float], Callable[[float, float], float]]


@dataclass(frozen=True, eq=False)
class Function:
    """A function f(u) that typed text may call."""

    name: str  # what is typed
    scalar: Callable[[float], float]  # of a float, which may raise where IEEE arithmetic has inf or nan; of an array
    vector: Callable[[Any], Any]
    kernels: Callable[[Jit], Kernels]  # given the compiler, the compiled f(u), and f'(u) from u and f(u)
    # from a tape's builder, the entry of f(u) and that of u, the entry of f'(u), or of 1/f'(u) if `divides`
    rate: Callable[[Any, int, int], int]
    divides: bool = False  # whether `rate` is 1/f'(u)
    steep: bool = False  # whether f is 0 with an infinite slope where u is 0
    # "positive", "kept" (that of u), "not negative", or "any"
    sign: Literal["positive", "kept", "not negative", "any"] = "any"
    entire: bool = False  # smooth wherever u is finite
    source: str = ""  # python of it, `{0}` the argument; empty for a call by its name
    # how many units of 2^-51 f and f', as the kernels compute them, may be off at most; 0 where
    # `numerics.enclosure` bounds it by rules of its own. Else f and f' are monotone, up to `until`, beyond which
    # they are undefined
    blur: float = 0.0
    until: float = float("inf")  # the end of where it is defined

    def python_source(self, argument: str) -> str:
        """Return Python source of f(argument)."""
        return self.source.format(argument) if self.source else f"{self.name}({argument})"


def plain(value: Callable[[float], float], slope: Callable[[float, float], float]) -> Callable[[Jit], Kernels]:
    """Return `Function.kernels` of functions that call nothing but `math`."""
    return lambda jit: (jit(value), jit(slope))
