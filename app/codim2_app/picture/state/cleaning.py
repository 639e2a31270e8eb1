"""Clean a value for a control that a person, a link or a browser gives: the value, or its replacement."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any
from urllib.parse import parse_qsl

import param

from codim2_core import psi as psi_families

from ..draw.layers import LAYERS
from .choices import OWN_AXIS, SETTING, SLIDER_AXES
from .chosen_system import titles
from .controls import CONTROL_NAMES, NUMBERS, Angle, ExplorerState
from .launches import read_launches
from .portraits import portrait_keys

MOST_ENTRIES = 16  # of a mapping that a browser sends
LONGEST_TEXT = 2000
MAX_PORTRAIT_TEXT = 10_000  # characters of all that a second portrait has of its own
_PLACE = r"-?\d{1,2}(\.\d{1,3})?"  # of the picture
PINNED = re.compile(rf"([QLO][1-9]\d{{0,2}}|C([1-9]\d{{0,2}})?|(S[1-9]\d{{0,2}}|U[12]|R|T|H)(@{_PLACE},{_PLACE})?)?")


class InputError(ValueError):
    """A value that cannot be used, the name of the control that holds it ("" if none does), and what was given."""

    def __init__(self, control: str, message: str, given: Any = None) -> None:
        super().__init__(message)
        self.control, self.given = control, given


def clean(name: str, value: Any) -> Any:
    """Return the value of one control, converted and checked.

    Parameters
    ----------
    name : str
        One of `CONTROL_NAMES`.
    value : object
        A number, text or list; text is read as a URL writes it.

    Raises
    ------
    InputError
        With the name of the control.
    """
    if name not in CONTROL_NAMES:
        raise InputError(name, f"There is no control {name!r}; the controls are {', '.join(CONTROL_NAMES)}.")
    declared = ExplorerState.param[name]
    if name in NUMBERS:
        return _clean_number(name, declared.label, value)
    if type(declared) is param.Integer:
        return _whole_number(name, declared, value)
    if type(declared) is param.Selector:
        return _one_of(name, declared, value)
    if type(declared) is Angle:
        return _clean_number(name, declared.label, value) % (2.0 * math.pi)
    return _READ.get(name, _short_text)(name, declared.label, value)


def _whole_number(name: str, declared: Any, value: Any) -> int:
    """Return a whole number within the bounds of its declaration."""
    count = _clean_number(name, declared.label, value)
    low, high = declared.bounds  # all are declared with both
    if count != int(count) or not low <= count <= high:
        raise InputError(name, f"{declared.label}: {value} given; give a whole number from {low} to {high}.")
    return int(count)


def _one_of(name: str, declared: Any, value: Any) -> str:
    """Return one of the options that a control offers."""
    if not isinstance(value, str):
        raise InputError(name, f"{declared.label}: {str(value)[:40]} given; give its name.")
    listed = {"psi": psi_families.FAMILIES, "system": titles()}  # what has been registered is among them
    objects = listed.get(name, declared.objects)
    if value not in objects:
        allowed = ", ".join(objects)
        raise InputError(name, f"{declared.label}: {str(value)[:40]!r} given; choose one of {allowed}.")
    return str(value)


def _clean_portrait(name: str, _label: str | None, value: Any) -> str:
    """Return the key of a portrait, or ""."""
    value = value if isinstance(value, str) else str(value)[:40]
    if value != "" and value not in portrait_keys():
        some = ", ".join(list(portrait_keys())[:3])
        raise InputError(name, f"Portrait: there is no {str(value)[:40]!r}; choose one such as {some}.")
    return str(value)


def _layers(name: str, _label: str | None, value: Any) -> list[str]:
    """Return names of layers, each once, from a list or from text with commas."""
    chosen = value.split(",") if isinstance(value, str) else value
    if not isinstance(chosen, (list, tuple)) or not all(isinstance(layer, str) for layer in chosen):
        raise InputError(name, f"Layers: {str(value)[:40]} given; give names among {', '.join(LAYERS)}.")
    chosen = [layer for layer in chosen if layer]
    unknown = [layer for layer in chosen if layer not in LAYERS]
    if unknown:
        raise InputError(name, f"Layers: no layer {unknown[0][:40]!r}; they are {', '.join(LAYERS)}.")
    return list(dict.fromkeys(chosen))


def _axis(name: str, label: str | None, value: Any) -> str:
    """Return what a diagram or the atlas runs along: a control's number, or a parameter of the system."""
    value = value if isinstance(value, str) else str(value)[:40]
    if not _is_own(value) and value not in SLIDER_AXES:
        known = ", ".join([*SLIDER_AXES, f"{OWN_AXIS}mu"])
        raise InputError(name, f"{label}: {str(value)[:40]!r} given; choose one such as {known}.")
    return str(value)


def _is_own(name: str) -> bool:
    """Whether this names a parameter of the system."""
    return name.startswith(OWN_AXIS) and name.removeprefix(OWN_AXIS).isidentifier()


def _pinned_name(name: str, _label: str | None, value: Any) -> str:
    """Return the name of an object of the picture, or ""."""
    if not isinstance(value, str) or not PINNED.fullmatch(value):
        raise InputError(name, f"Pinned: {str(value)[:40]!r} given; give an object such as Q2, C or L1.")
    return str(value)


def _clean_orbits(name: str, label: str | None, value: Any) -> str:
    """Return launched orbits as they came, if they can be read."""
    if not isinstance(value, str) or len(value) > LONGEST_TEXT:
        raise InputError(name, f"{label}: give text of at most {LONGEST_TEXT} characters.")
    try:
        read_launches(value)
    except ValueError as error:
        raise InputError(name, f"{label}: {error}") from error
    return str(value)


def _short_text(name: str, label: str | None, value: Any) -> str:
    if not isinstance(value, str) or len(value) > 200:
        raise InputError(name, f"{label}: give text of at most 200 characters.")
    return value


def _ranges(name: str, label: str | None, value: Any) -> dict[str, list[float]]:
    """Return ranges of sliders by name, from a mapping or from JSON."""
    if isinstance(value, str):
        try:
            value = json.loads(value) if len(value) <= LONGEST_TEXT else None
        except ValueError:
            value = None
    sliders = isinstance(value, Mapping) and all(isinstance(key, str) and _has_slider(key) for key in value)
    if not sliders or len(value) > 2 * MOST_ENTRIES:
        raise InputError(name, f"{label}: give at most {2 * MOST_ENTRIES} ranges by the names of sliders.")
    found: dict[str, list[float]] = {}
    for key, ends in value.items():
        if not isinstance(ends, (list, tuple)) or len(ends) != 2:
            raise InputError(name, f"{label}: {key}: give two numbers, [low, high].")
        low, high = (_clean_number(name, f"{label}: {key}", end) for end in ends)
        if not low < high or math.isinf(high - low):
            raise InputError(name, f"{label}: {key}: {low:g} to {high:g} given; give [low, high] with low < high.")
        found[key] = [low, high]
    return found


def _has_slider(name: str) -> bool:
    return name in NUMBERS or _is_own(name)


def _own_values(name: str, label: str | None, value: Any) -> str:
    """Return the own values of a second portrait as they came, if each can be used."""
    if not isinstance(value, str) or len(value) > MAX_PORTRAIT_TEXT:
        raise InputError(name, f"{label}: give its own values as text of at most {MAX_PORTRAIT_TEXT} characters.")
    for own, text in parse_qsl(value, keep_blank_values=True):
        if own not in SETTING:
            raise InputError(name, f"{label}: {own[:20]!r} cannot be its own; it may have {', '.join(SETTING)}.")
        clean(own, text)
    return value


def _mapping(name: str, label: str | None, value: Any) -> dict[str, Any]:
    """Return texts or numbers by name, from a mapping or from JSON."""
    if isinstance(value, str):
        try:
            value = json.loads(value) if len(value) <= 10 * LONGEST_TEXT else None
        except ValueError:
            value = None
    if not isinstance(value, Mapping) or len(value) > MOST_ENTRIES or not all(isinstance(key, str) for key in value):
        raise InputError(name, f"{label}: give at most {MOST_ENTRIES} values by name.")
    if name == "parameters":
        return {key: _clean_number(name, key, entry) for key, entry in value.items()}
    if not all(isinstance(entry, str) and len(entry) <= LONGEST_TEXT for entry in value.values()):
        raise InputError(name, f"{label}: give texts of at most {LONGEST_TEXT} characters.")
    return dict(value)


def _clean_number(name: str, label: str | None, value: Any) -> float:
    """Return a finite float, or say what to type."""
    try:
        number = float(value)
    except OverflowError:
        raise InputError(name, f"{label}: the number is too large; give one below 1e308.") from None
    except (TypeError, ValueError):
        raise InputError(name, f"{label}: {str(value)[:40]!r} is not a number; type one such as −0.5.") from None
    if math.isnan(number):
        raise InputError(name, f"{label}: this is no number; give a finite number.")
    if not math.isfinite(number):
        raise InputError(name, f"{label}: {number} given; give a finite number.")
    return number


#: How a control is read that is neither a number nor a choice among options; all others are short texts.
_READ: Mapping[str, Callable[[str, str | None, Any], Any]] = MappingProxyType(
    {
        "preset": _clean_portrait,
        "layers": _layers,
        "along": _axis,
        "across": _axis,
        "up": _axis,
        "pinned": _pinned_name,
        "ranges": _ranges,
        "texts": _mapping,
        "parameters": _mapping,
        "orbits": _clean_orbits,
        "beside": _own_values,
    }
)
