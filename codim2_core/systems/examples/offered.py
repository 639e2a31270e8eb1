"""The examples: a file and a line each, with several contacts one file for all. What offers them reads `catalogue`."""

from __future__ import annotations

import reprlib
from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType

from .example import Example

EXAMPLE_NAMES = (
    "ball_in_pool",
    "attracting_repelling",
    "nonunique_sliding",
    "tilting_block",
    "unit_vector_control",
    "ball_on_turntable",
    "spinning_disc",
    "spinning_annulus",
    "towed_wheel",
    "driven_mass",
)
MECHANISM_NAMES = ("cart_on_two_wheels", "plate_on_three_feet")  # with several contacts: an example at each
LISTED: tuple[Example, ...] = (
    *(import_module(f".{name}", __package__).EXAMPLE for name in EXAMPLE_NAMES),
    *(one for name in MECHANISM_NAMES for one in import_module(f".{name}", __package__).EXAMPLES),
)

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
