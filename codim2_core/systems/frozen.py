"""A system frozen at one z, all that the hemisphere there depends on: of an e-linear or of a typed system."""

from .coefficients import Coefficients
from .typed import Frozen

FrozenSystem = Coefficients | Frozen
