"""The constructors of Psi under one short name: ``from codim2_core import psi; psi.hill(3)``."""

from .constructors import FAMILIES, constant, custom, exponential, hill, make, rational, tanh
from .function import Psi

__all__ = ["FAMILIES", "Psi", "constant", "custom", "exponential", "hill", "make", "rational", "tanh"]
