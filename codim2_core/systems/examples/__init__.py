"""The paper's three systems (Section 5) and others that people meet, each with its source.

All are in the units of their parameters; `catalogue` lists them with the ranges in which they are interesting.
"""

from __future__ import annotations

import reprlib
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from ..elinear import ELinear
from ..typed import System
from .bodies import (
    ball_on_turntable,
    driven_mass,
    spinning_annulus,
    spinning_disc,
    tilting_block,
    unit_vector_control,
)
from .example import GRAVITY, Ball, Example, read_examples
from .mechanisms import cart_on_two_wheels, plate_on_three_feet, towed_wheel
from .paper import attracting_repelling, ball_in_pool, nonunique_sliding

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


LISTED = read_examples(Path(__file__).with_name("examples.toml"), globals())

_examples: dict[str, Example] = {example.key: example for example in LISTED}
catalogue: Mapping[str, Example] = MappingProxyType(_examples)  # by key, in the order of menus; grows with `register`


def keys_at_contacts(key: str) -> tuple[str, ...]:
    """Return the keys of the examples at all contacts of the mechanism of one; () where it has one contact."""
    found = catalogue.get(key)
    if found is None or found.mechanism is None:
        return ()
    return tuple(other.key for other in catalogue.values() if other.mechanism is found.mechanism)


def register(example: Example) -> Example:
    """List an example of your own next to those that come with the package, for this process.

    Parameters
    ----------
    example : Example

    Returns
    -------
    Example
        The same.

    Raises
    ------
    ValueError
        It is no Example, its key is taken, it does not make a system, or z, slow variables and launch do not fit it.
    """
    if not isinstance(example, Example):
        raise ValueError(f"example is of type {type(example).__name__}; give an examples.Example.")
    if example.key in _examples:
        raise ValueError(f"there is an example {example.key!r} already; name the function otherwise.")
    example.check()
    _examples[example.key] = example
    return example


def unregister(key: str) -> None:
    """Take a registered example off the list; those of the package stay.

    Raises
    ------
    ValueError
        There is no such example, or it is the package's.
    """
    if not isinstance(key, str) or key not in _examples or _examples[key] in LISTED:
        raise ValueError(f"the key {reprlib.repr(key)} is of no example that was registered.")
    del _examples[key]
