"""Systems of every kind that a function may be given."""

from __future__ import annotations

from .coefficients import Coefficients
from .elinear import ELinear
from .typed import Frozen, System

AnySystem = ELinear | System | Coefficients | Frozen
