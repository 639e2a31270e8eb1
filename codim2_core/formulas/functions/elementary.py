"""The functions of every library, with exponents and roots."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .function import Function, plain


def _sin(a):
    return math.sin(a)


def _sin_slope(a, v):
    return math.cos(a)


def _cos(a):
    return math.cos(a)


def _cos_slope(a, v):
    return -math.sin(a)


def _tan(a):
    return math.tan(a)


def _tan_slope(a, v):
    return 1.0 + v * v


def _atan(a):
    return math.atan(a)


def _atan_slope(a, v):
    return 1.0 / (1.0 + a * a)


def _above_one(build: Any, i: int) -> int:
    """Entry of 1 + u^2."""
    square = build.apply("**", i, build.number(2.0))
    return build.apply("+", build.number(1.0), square)


SIN = Function(
    "sin", math.sin, np.sin, plain(_sin, _sin_slope), lambda build, k, u: build.apply("cos", u),
    entire=True, source="math.sin({0})",
)  # fmt: skip
COS = Function(
    "cos", math.cos, np.cos, plain(_cos, _cos_slope), lambda build, k, u: build.apply("neg", build.apply("sin", u)),
    entire=True, source="math.cos({0})",
)  # fmt: skip
TAN = Function(
    "tan", math.tan, np.tan, plain(_tan, _tan_slope), lambda build, k, u: _above_one(build, k),
    source="math.tan({0})",
)  # fmt: skip
ATAN = Function(
    "atan", math.atan, np.arctan, plain(_atan, _atan_slope), lambda build, k, u: _above_one(build, u),
    divides=True, sign="kept", entire=True, source="math.atan({0})",
)  # fmt: skip


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


def sign(u: float) -> float:
    """-1, 0 or 1; NaN of NaN."""
    return math.copysign(1.0, u) if u else abs(u)


def _sign(a):
    return 1.0 if a > 0.0 else -1.0 if a < 0.0 else a


def _sign_slope(a, v):
    return 0.0


def _floor(a):
    return math.floor(a) * 1.0 if abs(a) < 1e15 else a


def _abs(a):
    return abs(a)


def _abs_slope(a, v):
    return 1.0 if a > 0.0 else -1.0 if a < 0.0 else 0.0  # at its kink the mean of the two slopes


ABS = Function(
    "abs", math.fabs, np.abs, plain(_abs, _abs_slope), lambda build, k, u: build.apply("sign", u),
    sign="not negative", source="math.fabs({0})",
)  # fmt: skip
SIGN_FUNCTION = Function(
    # at the jump too: formulas that jump in e are refused (`systems.typed`)
    "sign", sign, np.sign, plain(_sign, _sign_slope), lambda build, k, u: build.number(0.0),
    source="(1.0*({0} > 0.0) - 1.0*({0} < 0.0))",
)  # fmt: skip
FLOOR_FUNCTION = Function(
    "floor", lambda u: float(math.floor(u)), np.floor, plain(_floor, _sign_slope),
    lambda build, k, u: build.number(0.0), source="(1.0*math.floor({0}))",
)  # fmt: skip
