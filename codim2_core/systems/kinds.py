"""Systems of every kind that a function may be given."""

from __future__ import annotations

from .coefficients import Coefficients
from .elinear import ELinear
from .frozen import FrozenSystem
from .typed import System
from .typed_at_z import Frozen

AnySystem = ELinear | System | FrozenSystem
SYSTEM_KINDS = (ELinear, System, Coefficients, Frozen)  # for `isinstance`, at the door
