"""The paper's three systems (sec:examples) and three more that people meet, each with its source.

All are in the units of their parameters; `catalogue` lists them with the ranges in which they are interesting.
"""

from __future__ import annotations

from .example import GRAVITY, Example
from .literature import ball_on_turntable, tilting_block, unit_vector_control
from .offered import catalogue
from .paper import attracting_repelling, ball_in_pool, nonunique_sliding

__all__ = [
    "GRAVITY",
    "Example",
    "attracting_repelling",
    "ball_in_pool",
    "ball_on_turntable",
    "catalogue",
    "nonunique_sliding",
    "tilting_block",
    "unit_vector_control",
]
