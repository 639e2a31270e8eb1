"""Sine, cosine, tangent, and the angle of a tangent."""

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
