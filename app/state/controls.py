"""Every value a user can set: its symbol, slider range and meaning, declared in one place.

The state holds plain values. It knows how to check what a person or an address gives for them, and how to hand them
to the core. It knows nothing of Bokeh, and it computes nothing.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping
from copy import deepcopy
from functools import lru_cache
from typing import Any
from urllib.parse import parse_qsl

import param

from codim2_core import psi as psi_families
from codim2_core.examples import catalogue
from codim2_core.psi.function import Psi

from ..draw.layers import LAYERS, shown
from .choices import AXES, MAX_TRAJECTORIES, OWN_AXIS, PANELS, SETTING, SLOW_CONTROLS, SOLIDS
from .chosen import NORMAL, has_atlas, starting_launch, starting_z, titles
from .launches import MOST, read_launches
from .portraits import portrait_keys, portraits

MOST_ENTRIES = 16  # of a mapping that a browser sends
LONGEST_TEXT = 2000
MOST_OWN = 10_000  # characters of all that a second portrait has of its own
PINNED = re.compile(r"(Q[1-9]\d{0,2}|C([1-9]\d{0,2})?|L[1-9]\d{0,2})?")


class InputError(ValueError):
    """A value that cannot be used, the name of the control that holds it ("" if none does), and what was given."""

    def __init__(self, control: str, message: str, given: Any = None) -> None:
        super().__init__(message)
        self.control, self.given = control, given


def _number(default: float, low: float, high: float, symbol: str, doc: str) -> Any:
    """Declare a number: the slider starts with [low, high], and a typed value may widen it."""
    return param.Number(default, softbounds=(low, high), step=0.01, label=symbol, doc=doc)


class ExplorerState(param.Parameterized):
    """What the picture shows. Defaults are the paper's fig:simCM4 (preset case1-cm4)."""

    a = _number(-2.0, -4, 4, "a", "First entry of A = [[a, −b], [b, d]].")
    b = _number(0.0, -4, 4, "b", "Rotation in A = [[a, −b], [b, d]].")
    d = _number(-1.0, -4, 4, "d", "Last entry of A = [[a, −b], [b, d]].")
    f1 = _number(-0.5, -3, 3, "f₁", "First component of f at z = 0.")
    f2 = _number(0.0, -3, 3, "f₂", "Second component of f at z = 0.")
    system = param.Selector(
        default=NORMAL, objects=list(titles()), check_on_set=False, label="System", doc="Which system is drawn."
    )
    texts = param.Dict({}, label="Formulas", doc="Typed formulas, by box, as far as they differ from the first ones.")
    parameters = param.Dict({}, label="Parameters", doc="Parameters of the chosen system, by name.")
    z = _number(0.0, -4, 4, "z", "Position along the discontinuity set.")
    z2 = _number(0.0, -4, 4, "z₂", "Second slow variable.")
    z3 = _number(0.0, -4, 4, "z₃", "Third slow variable.")
    z4 = _number(0.0, -4, 4, "z₄", "Fourth slow variable.")
    k1 = _number(0.5, -2, 2, "k₁", "f(z) = f + z k: how f₁ changes along z.")
    k2 = _number(0.0, -2, 2, "k₂", "f(z) = f + z k: how f₂ changes along z.")
    B1 = _number(1.0, -3, 3, "B₁", "z′ = B e + g: weight of cos θ.")
    B2 = _number(0.0, -3, 3, "B₂", "z′ = B e + g: weight of sin θ.")
    g0 = _number(0.0, -3, 3, "g", "z′ = B e + g: constant part of the slow flow.")
    psi = param.Selector(
        default="constant",
        objects=list(psi_families.FAMILIES),
        check_on_set=False,  # a family may be registered later; `clean` asks the list
        label="Ψ",
        doc="Regularisation function Ψ(s), s = (x² + y²)/ε².",
    )
    n = _number(2.0, 0.5, 6, "n", "Parameter of Ψ, such as the exponent of 3/(3 + (4s)ⁿ).")
    psi_text = param.String("1/(1+s)**2", label="Ψ(s) =", doc="Your own Ψ(s), positive, with s Ψ′(s) < Ψ(s).")
    trajectories = param.Integer(
        64, bounds=(0, MAX_TRAJECTORIES), label="Starting points", doc="Number of trajectories."
    )
    layers = param.ListSelector(
        default=shown(),
        objects=list(LAYERS),
        check_on_set=False,  # `clean` looks at the table, which may have grown
        instantiate=True,
        label="Layers",
        doc="What is drawn.",
    )
    preset = param.String("", label="Portrait", doc="A figure of the paper; the values start from it.")
    panel = param.Selector(default="atlas", objects=list(PANELS), label="Panel", doc="What is open beside the picture.")
    along = param.String("f1", label="Along", doc="Parameter of the bifurcation diagram.")
    zoom = param.Integer(0, bounds=(0, 6), label="Zoom", doc="The diagram shows a 4^zoom-th of the slider's range.")
    across = param.String("f1", label="Across", doc="Horizontal axis of the atlas.")
    cycle_curves = param.Selector(
        default="hide", objects=["hide", "show"], label="Cycles", doc="Bifurcations of limit cycles in the atlas."
    )
    atlas_zoom = param.Integer(0, bounds=(0, 6), label="Zoom", doc="The atlas shows a 4^zoom-th of the ranges.")
    up = param.String("f2", label="Up", doc="Vertical axis of the atlas.")

    solid = param.Selector(default="sphere", objects=list(SOLIDS), label="3-D", doc="What the panel “3-D” shows.")
    drift = param.Selector(default="z", objects=list(SLOW_CONTROLS), label="Along", doc="Slow variable of “Along z”.")
    log_eps = _number(-2.0, -10, 0, "log₁₀ ε", "Size of the regularised region.")
    launch = param.String("0.6, 0.8, 0", label="Start", doc="State (x, y, z₁, …) from which a motion starts.")
    orbits = param.String("", label="Orbits", doc="Launched orbits: x,y of each, joined by semicolons.")
    orbit = param.Integer(
        1,
        bounds=(0, MOST),
        label="Orbit",
        doc="Number of the launched orbit that is shown in time; 0 is the typed start.",
    )
    pinned = param.String("", label="Pinned", doc="The object whose card stays, such as 'Q2', 'C' or 'L1'; or none.")
    orbit_eps = param.Selector(
        default="hide", objects=["hide", "show"], label="ε > 0", doc="The motion for ε > 0 beside that orbit."
    )
    lesson = param.String("", label="Lesson", doc="The lesson that is open.")
    quiz = param.String("", label="Question", doc="QUESTION.SEED or QUESTION.SEED.ANSWER of the open lesson.")
    t_end = _number(8.0, 0, 40, "until t", "How long a motion is followed.")
    ranges = param.Dict({}, label="Ranges", doc="Ranges of sliders, by name: [low, high].")
    beside = param.String(
        "", label="Second portrait", doc="Its own values, as the query of a link; all others are shared."
    )

    def values(self) -> dict[str, Any]:
        """Return every value by name, in the order of declaration."""
        return {name: getattr(self, name) for name in NAMES}

    @classmethod
    def of(cls, values: Mapping[str, Any], first: Mapping[str, Any] | None = None) -> ExplorerState:
        """Return the state of some clean values: those of their preset, if they name one, and theirs over them.

        Without a preset they stand over `first`, by default the first setting.
        """
        start = preset_values(values.get("preset")) or deepcopy(dict(first or {}))
        choice = values.get("system", start.get("system", NORMAL))
        if choice != start.get("system", NORMAL):
            start |= opening(choice)
        return cls(**{**start, **values})


def opening(choice: str) -> dict[str, Any]:
    """Return what a choice of system brings: its first place on Sigma, its own parameters, a motion worth seeing.

    And a panel that has something to show of it.
    """
    z = (*starting_z(choice), *(0.0,) * len(SLOW_CONTROLS))
    _, t_end = starting_launch(choice)
    slow = dict(zip(SLOW_CONTROLS, z, strict=False))
    across, up = axes_of(choice)
    motion = {"launch": opening_launch(choice), "t_end": t_end}
    axes = {"drift": "z", "across": across, "up": up, "along": across}
    panel = "atlas" if has_atlas(choice) else "numbers"
    return {"texts": {}, "parameters": {}, **slow, **motion, **axes, "panel": panel}


def opening_launch(choice: str) -> str:
    """Return the text of the state from which a motion of a choice starts at first."""
    launch, _ = starting_launch(choice)
    return ", ".join(f"{v:g}" for v in launch)


def axes_of(choice: str) -> tuple[str, str]:
    """Return the axes with which the atlas of a system opens: slow variables, or one and the first parameter."""
    example = catalogue.get(choice)
    if example is None:
        return ("f1", "f2") if choice == NORMAL else ("z", "n")
    if len(example.z) > 1:
        return "z", "z2"
    return "z", next((OWN_AXIS + name for name in example.ranges), "n")


@lru_cache(maxsize=256)
def _complete(key: str) -> dict[str, Any]:
    own = next(portrait["values"] for portrait in portraits() if portrait["key"] == key)
    return {**first_values(), **opening(own["system"]), **own, "preset": key}


def preset_values(key: str | None) -> dict[str, Any]:
    """Return the values of a portrait by its key, every one: none is left over from what was open before.

    There are none if there is no such portrait.
    """
    return deepcopy(_complete(key)) if key in portrait_keys() else {}


def first_values() -> dict[str, Any]:
    """Return every value as the explorer opens with it."""
    return ExplorerState().values()


def offer(name: str, options: Iterable[str]) -> None:
    """Let a control offer these options: what is registered on a higher floor, such as the panels."""
    ExplorerState.param[name].objects = list(options)


NAMES: tuple[str, ...] = tuple(
    name
    for name in ExplorerState.param
    if name != "name"  # declaration order; `name` is param's own
)
NUMBERS: tuple[str, ...] = tuple(name for name in NAMES if type(ExplorerState.param[name]) is param.Number)

#: Controls that keep what was typed into them, also where it cannot be used.
TYPED_IN = frozenset({*NUMBERS, "trajectories", "texts", "psi_text", "launch"})


def clean(name: str, value: Any) -> Any:
    """Return the value of one control, converted and checked.

    Parameters
    ----------
    name : str
        One of `NAMES`.
    value : object
        A number, text or list; text is read as a URL writes it.

    Raises
    ------
    InputError
        With the name of the control.
    """
    if name not in NAMES:
        raise InputError(name, f"There is no control {name!r}; the controls are {', '.join(NAMES)}.")
    declared = ExplorerState.param[name]
    if name in NUMBERS:
        return _finite(name, declared.label, value)
    if type(declared) is param.Integer:
        count = _finite(name, declared.label, value)
        bounds: tuple[int, int] = declared.bounds  # type: ignore[assignment]  # all are declared with both
        low, high = bounds
        if count != int(count) or not low <= count <= high:
            raise InputError(name, f"{declared.label}: {value} given; give a whole number from {low} to {high}.")
        return int(count)
    if type(declared) is param.Selector and not isinstance(value, str):
        raise InputError(name, f"{declared.label}: {str(value)[:40]} given; give its name.")
    if type(declared) is param.Selector:
        listed = {"psi": psi_families.FAMILIES, "system": titles()}  # what has been registered is among them
        objects = listed.get(name, declared.objects)
        if value not in objects:
            allowed = ", ".join(objects)
            raise InputError(name, f"{declared.label}: {str(value)[:40]!r} given; choose one of {allowed}.")
        return str(value)
    if name == "preset":
        value = value if isinstance(value, str) else str(value)[:40]
        if value != "" and value not in portrait_keys():
            some = ", ".join(list(portrait_keys())[:3])
            raise InputError(name, f"Portrait: there is no {str(value)[:40]!r}; choose one such as {some}.")
        return str(value)
    if name == "layers":
        chosen = value.split(",") if isinstance(value, str) else value
        if not isinstance(chosen, (list, tuple)) or not all(isinstance(layer, str) for layer in chosen):
            raise InputError(name, f"Layers: {str(value)[:40]} given; give names among {', '.join(LAYERS)}.")
        chosen = [layer for layer in chosen if layer]
        unknown = [layer for layer in chosen if layer not in LAYERS]
        if unknown:
            raise InputError(name, f"Layers: no layer {unknown[0][:40]!r}; they are {', '.join(LAYERS)}.")
        return list(dict.fromkeys(chosen))
    if name in ("along", "across", "up"):
        value = value if isinstance(value, str) else str(value)[:40]
        own = value.startswith(OWN_AXIS) and value.removeprefix(OWN_AXIS).isidentifier()
        if not own and value not in AXES:
            known = ", ".join([*AXES, f"{OWN_AXIS}mu"])
            raise InputError(name, f"{declared.label}: {str(value)[:40]!r} given; choose one such as {known}.")
        return str(value)
    if name == "pinned":
        if not isinstance(value, str) or not PINNED.fullmatch(value):
            raise InputError(name, f"Pinned: {str(value)[:40]!r} given; give an object such as Q2, C or L1.")
        return str(value)
    if name == "ranges":
        return _ranges(declared.label, value)
    if name in ("texts", "parameters"):
        return _mapping(name, declared.label, value)
    if name == "orbits":
        if not isinstance(value, str) or len(value) > LONGEST_TEXT:
            raise InputError(name, f"{declared.label}: give text of at most {LONGEST_TEXT} characters.")
        try:
            read_launches(value)
        except ValueError as error:
            raise InputError(name, f"{declared.label}: {error}") from error
        return str(value)
    if name == "beside":
        return _own_values(declared.label, value)
    if not isinstance(value, str) or len(value) > 200:
        raise InputError(name, f"{declared.label}: give text of at most 200 characters.")
    return value


def _ranges(label: str | None, value: Any) -> dict[str, list[float]]:
    """Return ranges of sliders by name, from a mapping or from JSON."""
    if isinstance(value, str):
        try:
            value = json.loads(value) if len(value) <= LONGEST_TEXT else None
        except ValueError:
            value = None
    sliders = isinstance(value, Mapping) and all(isinstance(key, str) and _has_slider(key) for key in value)
    if not sliders or len(value) > 2 * MOST_ENTRIES:
        raise InputError("ranges", f"{label}: give at most {2 * MOST_ENTRIES} ranges by the names of sliders.")
    found: dict[str, list[float]] = {}
    for key, ends in value.items():
        if not isinstance(ends, (list, tuple)) or len(ends) != 2:
            raise InputError("ranges", f"{label}: {key}: give two numbers, [low, high].")
        low, high = (_finite("ranges", f"{label}: {key}", end) for end in ends)
        if not low < high or math.isinf(high - low):
            raise InputError("ranges", f"{label}: {key}: {low:g} to {high:g} given; give [low, high] with low < high.")
        found[key] = [low, high]
    return found


def _has_slider(name: str) -> bool:
    return name in NUMBERS or (name.startswith(OWN_AXIS) and name.removeprefix(OWN_AXIS).isidentifier())


def _own_values(label: str | None, value: Any) -> str:
    """Return the own values of a second portrait as they came, if each can be used."""
    if not isinstance(value, str) or len(value) > MOST_OWN:
        raise InputError("beside", f"{label}: give its own values as text of at most {MOST_OWN} characters.")
    for name, text in parse_qsl(value, keep_blank_values=True):
        if name not in SETTING:
            raise InputError("beside", f"{label}: {name[:20]!r} cannot be its own; it may have {', '.join(SETTING)}.")
        clean(name, text)
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
        return {key: _finite(name, key, entry) for key, entry in value.items()}
    if not all(isinstance(entry, str) and len(entry) <= LONGEST_TEXT for entry in value.values()):
        raise InputError(name, f"{label}: give texts of at most {LONGEST_TEXT} characters.")
    return dict(value)


def _finite(name: str, label: str | None, value: Any) -> float:
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


def slider_range(low: float, high: float, value: float) -> tuple[float, float, float]:
    """Return (low, high, step) of a slider, widened to hold the value; the same rule as in controls.js."""
    size = abs(value)
    if value < low or value > high:
        reach = _round_up(size)
        low, high = (-reach, reach) if low < 0 else (low, reach)
    return low, high, 10.0 ** (len(str(int(high - low))) - 4)


def _round_up(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten, at least 1.2 times the size."""
    target, power = 1.2 * size, 1.0
    while power * 10 <= target:
        power *= 10
    return next(power * k for k in (1, 2, 5, 10) if power * k >= target)


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
