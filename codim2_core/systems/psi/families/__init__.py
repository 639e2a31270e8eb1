"""The families of Psi, each listed here: everything that offers or compares them reads this."""

from __future__ import annotations

import reprlib
from collections.abc import Mapping
from types import MappingProxyType

from .hill import HILL
from .record import Family, Parameter
from .without_parameter import CONSTANT, EXPONENTIAL, RATIONAL, TANH

__all__ = ["FAMILIES", "Family", "Parameter", "family_of_name", "register", "unregister"]

TYPED = Family(name="custom", title="your own …", formula="")  # its formula is what the user types
LISTED = (CONSTANT, RATIONAL, EXPONENTIAL, TANH, HILL, TYPED)

_families: dict[str, Family] = {family.name: family for family in LISTED}
FAMILIES: Mapping[str, Family] = MappingProxyType(_families)  # by name, in the order of menus; grows with `register`


def register(family: Family) -> Family:
    """List a family of your own with the built-in ones, for this process: before the typed one in menus.

    Parameters
    ----------
    family : Family

    Returns
    -------
    Family
        The same.

    Raises
    ------
    ValueError
        It is no record, its name is taken or is no identifier, or its formula cannot be read.
    """
    if not isinstance(family, Family):
        raise ValueError(f"family is of type {type(family).__name__}; give a psi.Family.")
    if not (isinstance(family.name, str) and family.name.isidentifier()):
        raise ValueError(f"the family's name is {family.name!r}; give letters, digits and _, such as 'lorentz'.")
    if family.name in _families:
        raise ValueError(f"there is a family {family.name!r} already; choose another name.")
    if not family.formula:
        raise ValueError(f"the family {family.name!r} has no formula; give its text in s, such as '1/(1+s)**2'.")
    family.expression()
    typed = _families.pop(next(name for name, one in _families.items() if one.typed))
    _families[family.name] = family
    _families[typed.name] = typed
    return family


def unregister(name: str) -> None:
    """Take a registered family off the list; the built-in ones stay.

    Raises
    ------
    ValueError
        There is no such family, or it is built in.
    """
    if family_of_name(name) in LISTED:
        raise ValueError(f"the family {name!r} is built in; only one that was registered can be taken off.")
    del _families[name]


def family_of_name(name: str) -> Family:
    """Return the family of a name; ValueError where there is none."""
    if not isinstance(name, str) or name not in _families:
        raise ValueError(f"there is no family {reprlib.repr(name)} of Psi; choose one of {', '.join(_families)}.")
    return _families[name]
