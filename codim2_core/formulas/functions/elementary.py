"""The functions of every library, with exponents and roots."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .function import Function, plain


def _exp(a):
    return math.exp(a)


def _exp_slope(a, v):
    return v


def _log_derivatives(a):
    return math.log(a)


def _log_slope(a, v):
    return 1.0 / a


def _sqrt(a):
    return math.sqrt(a)


def _sqrt_slope(a, v):
    return 0.5 / v


def _sinh(a):
    return math.sinh(a)


def _sinh_slope(a, v):
    return math.cosh(a)


def _cosh(a):
    return math.cosh(a)


def _cosh_slope(a, v):
    return math.sinh(a)


def _tanh(a):
    return math.tanh(a)


def _tanh_slope(a, v):
    return 1.0 / math.cosh(a) ** 2


def _tanh_rate(build: Any, k: int, u: int) -> int:
    # 1/cosh^2, not 1 - tanh^2: that one loses all digits where tanh is near 1
    return build.apply("/", build.number(1.0), build.apply("**", build.apply("cosh", u), build.number(2.0)))


EXP = Function(
    "exp", math.exp, np.exp, plain(_exp, _exp_slope), lambda build, k, u: k,
    sign="positive", entire=True, source="math.exp({0})",
)  # fmt: skip
LOG = Function(
    "log", math.log, np.log, plain(_log_derivatives, _log_slope), lambda build, k, u: u,
    divides=True, source="math.log({0})",
)  # fmt: skip
SQRT = Function(
    "sqrt", math.sqrt, np.sqrt, plain(_sqrt, _sqrt_slope), lambda build, k, u: build.apply("*", build.number(2.0), k),
    divides=True, steep=True, sign="not negative", source="math.sqrt({0})",
)  # fmt: skip
TANH = Function(
    "tanh", math.tanh, np.tanh, plain(_tanh, _tanh_slope), _tanh_rate, sign="kept", entire=True, source="math.tanh({0})"
)
SINH = Function(
    "sinh", math.sinh, np.sinh, plain(_sinh, _sinh_slope), lambda build, k, u: build.apply("cosh", u),
    sign="kept", entire=True, source="math.sinh({0})",
)  # fmt: skip
COSH = Function(
    "cosh", math.cosh, np.cosh, plain(_cosh, _cosh_slope), lambda build, k, u: build.apply("sinh", u),
    sign="positive", entire=True, source="math.cosh({0})",
)  # fmt: skip
