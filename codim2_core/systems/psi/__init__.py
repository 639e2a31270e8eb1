"""The constructors of Psi under one short name: ``from codim2_core import psi; psi.hill(3)``."""

from collections.abc import Callable
from functools import partial

from .constructors import constant, custom, exponential, from_text, hill, make, rational, tanh
from .engines import ENGINES, Engine, engine, engine_eps
from .families import FAMILIES, Family, Parameter, register, unregister
from .function import Psi

__all__ = [
    "ENGINES", "FAMILIES", "Engine", "Family", "Parameter", "Psi", "constant", "custom", "engine", "engine_eps",
    "exponential", "from_text", "hill", "make", "rational", "register", "tanh", "unregister",
]  # fmt: skip


def __getattr__(name: str) -> Callable[..., Psi]:
    """Make ``psi.NAME`` of a registered family its constructor."""
    if name in FAMILIES:
        return partial(make, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
