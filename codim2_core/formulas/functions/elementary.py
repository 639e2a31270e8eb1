"""The functions of every library, with exponents and roots."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...results.rebind import rebind
from .function import Function, plain

# What the two functions below read: a function of `math`, put in by `rebind`.
named: Any = None


def _call(a):
    return named(a)


def _call_for_slope(a, v):
    return named(a)


def _same_slope(of: Callable[[float], float]) -> Callable[[float, float], float]:
    return rebind(_call_for_slope, of.__name__, named=of)


def _cos_slope(a, v):
    return -math.sin(a)


def _tan_slope(a, v):
    return 1.0 + v * v


def _atan_slope(a, v):
    return 1.0 / (1.0 + a * a)


def _exp_slope(a, v):
    return v


def _log_slope(a, v):
    return 1.0 / a


def _sqrt_slope(a, v):
    return 0.5 / v


def _tanh_slope(a, v):
    return 1.0 / math.cosh(a) ** 2


def sign(u: float) -> float:
    """-1, 0 or 1; NaN of NaN."""
    return math.copysign(1.0, u) if u else abs(u)


def _sign(a):
    return 1.0 if a > 0.0 else -1.0 if a < 0.0 else a


def _flat(a, v):
    return 0.0


def _floor(a):
    return math.floor(a) * 1.0 if abs(a) < 1e15 else a


def _abs(a):
    return abs(a)


def _abs_slope(a, v):
    return 1.0 if a > 0.0 else -1.0 if a < 0.0 else 0.0  # at its kink the mean of the two slopes


def _above_one(build: Any, i: int) -> int:
    """Entry of 1 + u^2."""
    square = build.apply("**", i, build.number(2.0))
    return build.apply("+", build.number(1.0), square)


def _tanh_rate(build: Any, k: int, u: int) -> int:
    # 1/cosh^2, not 1 - tanh^2: that one loses all digits where tanh is near 1
    return build.apply("/", build.number(1.0), build.apply("**", build.apply("cosh", u), build.number(2.0)))


def _of_math(scalar: Any, vector: Any, slope: Any, rate: Callable[[Any, int, int], int], **options: Any) -> Function:
    """Return a function of `math`, with that of NumPy, its slope as a kernel and its rate on a tape."""
    name = scalar.__name__
    value = rebind(_call, name, named=scalar)
    return Function(name, scalar, vector, plain(value, slope), rate, source=f"math.{name}({{0}})", **options)


ELEMENTARY = (
    _of_math(math.sin, np.sin, _same_slope(math.cos), lambda build, k, u: build.apply("cos", u), entire=True),
    _of_math(math.cos, np.cos, _cos_slope, lambda build, k, u: build.apply("neg", build.apply("sin", u)), entire=True),
    _of_math(math.tan, np.tan, _tan_slope, lambda build, k, u: _above_one(build, k)),
    _of_math(math.exp, np.exp, _exp_slope, lambda build, k, u: k, sign="positive", entire=True),
    _of_math(math.log, np.log, _log_slope, lambda build, k, u: u, divides=True),
    _of_math(
        math.sqrt, np.sqrt, _sqrt_slope, lambda build, k, u: build.apply("*", build.number(2.0), k),
        divides=True, steep=True, sign="not negative",
    ),
    _of_math(math.tanh, np.tanh, _tanh_slope, _tanh_rate, sign="kept", entire=True),
    _of_math(
        math.sinh, np.sinh, _same_slope(math.cosh), lambda build, k, u: build.apply("cosh", u),
        sign="kept", entire=True,
    ),
    _of_math(
        math.cosh, np.cosh, _same_slope(math.sinh), lambda build, k, u: build.apply("sinh", u),
        sign="positive", entire=True,
    ),
    _of_math(
        math.atan, np.arctan, _atan_slope, lambda build, k, u: _above_one(build, u),
        divides=True, sign="kept", entire=True,
    ),
    Function(
        "abs", math.fabs, np.abs, plain(_abs, _abs_slope), lambda build, k, u: build.apply("sign", u),
        sign="not negative", source="math.fabs({0})",
    ),
    Function(  # at its jump too: formulas that jump in e are refused (`systems.typed`)
        "sign", sign, np.sign, plain(_sign, _flat), lambda build, k, u: build.number(0.0),
        source="(1.0*({0} > 0.0) - 1.0*({0} < 0.0))",
    ),
    Function(
        "floor", lambda u: float(math.floor(u)), np.floor, plain(_floor, _flat),
        lambda build, k, u: build.number(0.0), source="(1.0*math.floor({0}))",
    ),
)  # fmt: skip
