"""The paper's three systems (Section 5) and others that people meet, each with its source.

All are in the units of their parameters; `catalogue` lists them with the ranges in which they are interesting.
"""

from __future__ import annotations

from collections.abc import Callable

from ..elinear import ELinear
from ..typed import System
from .attracting_repelling import attracting_repelling
from .ball_in_pool import ball_in_pool
from .ball_on_turntable import ball_on_turntable
from .cart_on_two_wheels import cart_on_two_wheels
from .driven_mass import driven_mass
from .example import GRAVITY, Ball, Example
from .nonunique_sliding import nonunique_sliding
from .offered import catalogue, register, unregister
from .plate_on_three_feet import plate_on_three_feet
from .spinning_annulus import spinning_annulus
from .spinning_disc import spinning_disc
from .tilting_block import tilting_block
from .towed_wheel import towed_wheel
from .unit_vector_control import unit_vector_control

__all__ = [
    "GRAVITY", "Ball", "Example", "attracting_repelling", "ball_in_pool", "ball_on_turntable", "cart_on_two_wheels",
    "catalogue", "driven_mass", "nonunique_sliding", "plate_on_three_feet", "register", "spinning_annulus",
    "spinning_disc", "tilting_block", "towed_wheel", "unit_vector_control", "unregister",
]  # fmt: skip


def __getattr__(name: str) -> Callable[..., ELinear | System]:
    """Make ``examples.NAME`` of a registered example its function."""
    if name in catalogue:
        return catalogue[name].make
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
