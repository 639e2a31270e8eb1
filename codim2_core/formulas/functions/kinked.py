"""Functions with a kink or a jump."""

from __future__ import annotations

import math

import numpy as np

from .function import Function, plain


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
