"""A function of one argument in all forms in which a formula needs it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

Jit = Callable[[Callable[..., Any]], Any]
Kernels = tuple[Callable[[float], float], Callable[[float, float], float]]


@dataclass(frozen=True, eq=False)
class Function:
    """A function f(u) that typed text may call.

    Attributes
    ----------
    name : str
        What is typed.
    scalar, vector : callable
        Of a float, which may raise where IEEE arithmetic has inf or nan; of an array.
    kernels : callable
        Given the compiler, the compiled f(u), and f'(u) from u and f(u).
    rate : callable
        From a tape's builder, the entry of f(u) and that of u, the entry of f'(u), or of 1/f'(u) if `divides`.
    divides : bool
        Whether `rate` is 1/f'(u).
    steep : bool
        Whether f is 0 with an infinite slope where u is 0.
    sign : str
        "positive", "kept" (that of u), "not negative", or "any".
    entire : bool
        Smooth wherever u is finite.
    source : str
        Python of it, `{0}` the argument; empty for a call by its name.
    blur : float
        How many units of 2^-51 f and f', as the kernels compute them, may be off at most; 0 where `numerics.intervals`
        bounds it by rules of its own. Else f and f' are monotone, up to `until`, beyond which they are undefined.
    until : float
        The end of where it is defined.
    """

    name: str
    scalar: Callable[[float], float]
    vector: Callable[[Any], Any]
    kernels: Callable[[Jit], Kernels]
    rate: Callable[[Any, int, int], int]
    divides: bool = False
    steep: bool = False
    sign: Literal["positive", "kept", "not negative", "any"] = "any"
    entire: bool = False
    source: str = ""
    blur: float = 0.0
    until: float = float("inf")

    def python_source(self, argument: str) -> str:
        """Return Python source of f(argument)."""
        return self.source.format(argument) if self.source else f"{self.name}({argument})"


def plain(value: Callable[[float], float], slope: Callable[[float, float], float]) -> Callable[[Jit], Kernels]:
    """Return `Function.kernels` of functions that call nothing but `math`."""
    return lambda jit: (jit(value), jit(slope))
