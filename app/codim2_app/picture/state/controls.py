"""Every value a user can set: its symbol, slider range and meaning, declared in one place.

The state holds plain values; it knows nothing of Bokeh, and it computes nothing. What may be given for them is checked
by `cleaning`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import deepcopy
from functools import lru_cache
from typing import Any

import param

from codim2_core import psi as psi_families

from ..draw.layers import LAYERS, default_layers
from .choices import CENSUSES, MAX_TRAJECTORIES, MOST_CENSUS, PANEL_NAMES, SLOW_CONTROLS, SOLIDS
from .chosen_system import NORMAL, titles
from .launches import MAX_LAUNCHES
from .portraits import portrait_keys, portrait_values
from .system_opening_values import opening_values


def _number_parameter(default: float, low: float, high: float, symbol: str, doc: str) -> Any:
    """Declare a number: the slider starts with [low, high], and a typed value may widen it."""
    return param.Number(default, softbounds=(low, high), step=0.01, label=symbol, doc=doc)


class Angle(param.Number):
    """A number in radians that has no slider."""


class ExplorerState(param.Parameterized):
    """Values of all controls. The defaults are the paper's Figure 24(c) (preset case1-cm4)."""

    a = _number_parameter(-2.0, -4, 4, "a", "First entry of A = [[a, −b], [b, d]].")
    b = _number_parameter(0.0, -4, 4, "b", "Rotation in A = [[a, −b], [b, d]].")
    d = _number_parameter(-1.0, -4, 4, "d", "Last entry of A = [[a, −b], [b, d]].")
    f1 = _number_parameter(-0.5, -3, 3, "f₁", "First component of f at z = 0.")
    f2 = _number_parameter(0.0, -3, 3, "f₂", "Second component of f at z = 0.")
    system = param.Selector(
        default=NORMAL, objects=list(titles()), check_on_set=False, label="System", doc="Which system is drawn."
    )
    texts = param.Dict({}, label="Formulas", doc="Typed formulas, by box, as far as they differ from the first ones.")
    parameters = param.Dict({}, label="Parameters", doc="Parameters of the chosen system, by name.")
    z = _number_parameter(0.0, -4, 4, "z", "Position along the discontinuity set.")
    z2 = _number_parameter(0.0, -4, 4, "z₂", "Second slow variable.")
    z3 = _number_parameter(0.0, -4, 4, "z₃", "Third slow variable.")
    z4 = _number_parameter(0.0, -4, 4, "z₄", "Fourth slow variable.")
    k1 = _number_parameter(0.5, -2, 2, "k₁", "f(z) = f + z k: how f₁ changes along z.")
    k2 = _number_parameter(0.0, -2, 2, "k₂", "f(z) = f + z k: how f₂ changes along z.")
    B1 = _number_parameter(1.0, -3, 3, "B₁", "z′ = B e + g: weight of cos θ.")
    B2 = _number_parameter(0.0, -3, 3, "B₂", "z′ = B e + g: weight of sin θ.")
    g0 = _number_parameter(0.0, -3, 3, "g", "z′ = B e + g: constant part of the slow flow.")
    psi = param.Selector(
        default="constant",
        objects=list(psi_families.FAMILIES),
        check_on_set=False,  # a family may be registered later; `clean` asks the list
        label="Ψ",
        doc="Regularisation function Ψ(s), s = (x² + y²)/ε².",
    )
    n = _number_parameter(2.0, 0.5, 6, "n", "Parameter of Ψ, such as the exponent of 3/(3 + (4s)ⁿ).")
    psi_text = param.String("1/(1+s)**2", label="Ψ(s) =", doc="Your own Ψ(s), positive, with s Ψ′(s) < Ψ(s).")
    trajectories = param.Integer(
        64, bounds=(0, MAX_TRAJECTORIES), label="Starting points", doc="Number of trajectories."
    )
    layers = param.ListSelector(
        default=default_layers(),
        objects=list(LAYERS),
        check_on_set=False,  # `clean` looks at the table, which may have grown
        instantiate=True,
        label="Layers",
        doc="What is drawn.",
    )
    preset = param.String("", label="Portrait", doc="A figure of the paper; the values start from it.")
    panel = param.Selector(
        default="atlas", objects=list(PANEL_NAMES), label="Panel", doc="What is open next to the picture."
    )
    along = param.String("f1", label="Along", doc="Parameter of the bifurcation diagram.")
    zoom = param.Integer(0, bounds=(0, 6), label="Zoom", doc="The diagram shows a 4^zoom-th of the slider's range.")
    across = param.String("f1", label="Across", doc="Horizontal axis of the atlas.")
    cycle_curves = param.Selector(
        default="hide", objects=["hide", "show"], label="Cycles", doc="Bifurcations of limit cycles in the atlas."
    )
    census = param.Selector(default="normal", objects=list(CENSUSES), label="Draw", doc="What a census draws.")
    census_size = param.Integer(
        1, bounds=(0, MOST_CENSUS), label="Systems", doc="How many a census draws: the smallest number times 10^this."
    )
    atlas_zoom = param.Integer(0, bounds=(0, 6), label="Zoom", doc="The atlas shows a 4^zoom-th of the ranges.")
    up = param.String("f2", label="Up", doc="Vertical axis of the atlas.")

    solid = param.Selector(default="sphere", objects=list(SOLIDS), label="3-D", doc="What the panel “3-D” shows.")
    drift = param.Selector(default="z", objects=list(SLOW_CONTROLS), label="Along", doc="Slow variable of “Along z”.")
    log_eps = _number_parameter(-2.0, -10, 0, "log₁₀ ε", "Size of the regularised region.")
    launch = param.String("0.6, 0.8, 0", label="Start", doc="State (x, y, z₁, …) from which a motion starts.")
    orbits = param.String("", label="Orbits", doc="Launched orbits: x,y of each, joined by semicolons.")
    orbit = param.Integer(
        1,
        bounds=(0, MAX_LAUNCHES),
        label="Orbit",
        doc="Number of the launched orbit that is shown in time; 0 is the typed start.",
    )
    pinned = param.String(
        "", label="Pinned", doc="The object whose card stays, such as 'Q2', 'C' or 'T@0.5,0.25'; or none."
    )
    orbit_eps = param.Selector(
        default="hide", objects=["hide", "show"], label="ε > 0", doc="The motion for ε > 0 next to that orbit."
    )
    lesson = param.String("", label="Lesson", doc="The lesson that is open.")
    quiz = param.String("", label="Question", doc="QUESTION.SEED or QUESTION.SEED.ANSWER of the lesson; a mark is X.Y.")
    goal = param.String("", label="Challenge", doc="A condition that is to be met, such as name == 'NCM4'; or none.")
    t_end = _number_parameter(8.0, 0, 40, "until t", "How long a motion is followed.")
    cut = Angle(0.0, label="Cut", doc="Limit directions are counted from this angle: Q₁ is the first at or after it.")
    ranges = param.Dict({}, label="Ranges", doc="Ranges of sliders, by name: [low, high].")
    beside = param.String(
        "", label="Second portrait", doc="Its own values, as the query of a link; all others are shared."
    )

    def values(self) -> dict[str, Any]:
        """Return every value by name, in the order of declaration."""
        return {name: getattr(self, name) for name in CONTROL_NAMES}

    @classmethod
    def from_values(cls, values: Mapping[str, Any], first: Mapping[str, Any] | None = None) -> ExplorerState:
        """Return the state of some clean values: those of their preset, if they name one, and theirs over them.

        Without a preset they stand over `first`, by default the first setting.
        """
        start = preset_values(values.get("preset")) or deepcopy(dict(first or {}))
        choice = values.get("system", start.get("system", NORMAL))
        if choice != start.get("system", NORMAL):
            start |= opening_values(choice)
        return cls(**{**start, **values})


@lru_cache(maxsize=256)
def _complete(key: str) -> dict[str, Any]:
    own = portrait_values(key)
    return {**first_values(), **opening_values(own["system"]), **own, "preset": key}


def preset_values(key: str | None) -> dict[str, Any]:
    """Return the values of a portrait by its key, every one: none is left over from what was open before.

    There are none if there is no such portrait.
    """
    return deepcopy(_complete(key)) if key in portrait_keys() else {}


def first_values() -> dict[str, Any]:
    """Return every value as the explorer opens with it."""
    return ExplorerState().values()


def set_options(name: str, options: Iterable[str]) -> None:
    """Let a control offer these options: what is registered on a higher floor, such as the panels."""
    ExplorerState.param[name].objects = list(options)


CONTROL_NAMES: tuple[str, ...] = tuple(
    name
    for name in ExplorerState.param
    if name != "name"  # declaration order; `name` is param's own
)
NUMBERS: tuple[str, ...] = tuple(name for name in CONTROL_NAMES if type(ExplorerState.param[name]) is param.Number)

#: Controls that keep what was typed into them, also where it cannot be used.
TYPED_IN = frozenset({*NUMBERS, "trajectories", "texts", "psi_text", "launch"})
