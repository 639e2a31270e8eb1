"""The chosen regularisation function: one of the families, or a typed formula."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from codim2_core import psi as psi_families
from codim2_core.systems.psi.function import Psi

from .cleaning import InputError


def build_psi(values: Mapping[str, Any]) -> Psi:
    """Return the regularisation function.

    Raises
    ------
    InputError
        For a text that is no function of s, or an exponent out of range.
    """
    family = psi_families.FAMILIES[values["psi"]]
    control = "psi_text" if family.typed else "psi" if family.parameter is None else "n"
    try:
        return psi_families.make(family.name, values["n"], values["psi_text"])
    except ValueError as error:
        raise InputError(control, str(error)) from error
