"""A view in words: its system as formulas, its regularisation, its place, and the sentence of its portrait."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from codim2_core import __version__
from codim2_core.results.words import written_number
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

from ..picture.draw.mathml import plain_symbol
from ..picture.state.chosen_system import NORMAL
from .view import View


def plain(value: float) -> str:
    """Return a number with a minus sign, to six digits."""
    return written_number(float(value), 6)


def system_words(view: View) -> str:
    """Return the formulas of the system at all z, and the values of its parameters."""
    system = view.scene().system
    if view.system is None and view.values["system"] == NORMAL:
        return _normal_form(view.values)
    if isinstance(system, ELinear):
        f = ", ".join(map(_text, system.f))
        said = f"(x, y)′ = A e + f with a = {_text(system.a)}, b = {_text(system.b)}, d = {_text(system.d)}, f = ({f})"
        if system.B is not None or system.g is not None:
            rows = "; ".join(", ".join(map(_text, row)) for row in system.B or ())
            said += f"; z′ = B e + g with B = ({rows}), g = ({', '.join(map(_text, system.g or ()))})"
    elif isinstance(system, System):
        slow = f", z′ = ({', '.join(map(_text, system.W))})" if system.W else ""
        said = f"x′ = {_text(system.U[0])}, y′ = {_text(system.U[1])}{slow}"
    else:
        return "the layer problem at one z"
    named = ", ".join(f"{plain_symbol(name)} = {plain(value)}" for name, value in system.parameters.items())
    return said + (f"; {named}" if named else "")


def _normal_form(values: Mapping[str, Any]) -> str:
    """Return the e-linear normal form with the numbers of the sliders."""
    f = ", ".join(_affine_text(values[f"f{i}"], values[f"k{i}"], "z") for i in (1, 2))
    a, b, d, B1, B2, g = (plain(values[name]) for name in ("a", "b", "d", "B1", "B2", "g0"))
    return f"(x, y)′ = A e + f with a = {a}, b = {b}, d = {d}, f = ({f}); z′ = B e + g with B = ({B1}, {B2}), g = {g}"


def _affine_text(constant: float, slope: float, name: str) -> str:
    if not slope:
        return plain(constant)
    return f"{plain(constant)} {'+' if slope > 0 else '−'} {plain(abs(slope))} {name}"


def _text(value: Any) -> str:
    """Return a formula as it is read: no stars, Greek letters."""
    if isinstance(value, (int, float)):
        return plain(value)
    text = str(getattr(value, "text", value)).replace("**", "^").replace("*", " ").replace("-", "−")
    return re.sub(r"[A-Za-z]\w*", lambda name: plain_symbol(name[0]), text)


def psi_words(view: View) -> str:
    """Return Psi as a formula in s."""
    return f"Ψ(s) = {view.scene().psi.words}"


def place_words(view: View) -> str:
    """Return the place along Sigma; empty if there is none."""
    z = view.scene().z
    return f"z = ({', '.join(map(plain, z))})" if len(z) > 1 else f"z = {plain(z[0])}" if z else ""


def caption_of(view: View, header: Mapping[str, Any]) -> str:
    """Return the caption of a figure: the portrait's sentence, and what it is a portrait of."""
    said = "; ".join(filter(None, (system_words(view), psi_words(view), place_words(view))))
    return f"{header['portrait']['sentence']} {said}."


def facts(view: View) -> dict[str, str]:
    """Return what goes with all exported data: system, Psi, z, version, link."""
    address = f"?{view.query}" if view.query else "none: the system was given from Python"
    return {
        "system": system_words(view),
        "psi": psi_words(view),
        "z": place_words(view) or "none",
        "version": f"codim2 {__version__}",
        "link": address,
    }
