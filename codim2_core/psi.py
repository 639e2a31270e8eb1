"""The constructors of Psi under one short name: ``from codim2_core import psi; psi.hill(3)``."""

from .regularisation import FAMILIES, Psi, constant, custom, exponential, hill, make, rational, tanh

__all__ = ["FAMILIES", "Psi", "constant", "custom", "exponential", "hill", "make", "rational", "tanh"]
