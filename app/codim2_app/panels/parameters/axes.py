"""Parameters along which a diagram runs or a map spreads: which there are, and over which span."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from codim2_core.portrait.layer_problem.vary import names, vary
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import catalogue
from codim2_core.systems.psi.function import Psi

from ...picture.draw.mathml import plain_symbol
from ...picture.frame.frame_context import FrameContext
from ...picture.phrases import say
from ...picture.state.choices import COEFFICIENTS, OWN_AXIS, SLIDER_AXES, SLOW_CONTROLS
from ...picture.state.chosen_system import NORMAL, OWN_SYSTEM, PARAMETER_RANGE, parameter_ranges, slow_ranges
from ...picture.state.controls import ExplorerState
from ...picture.state.slider_range import edited_range, slider_range
from ...picture.state.system_opening_values import axes_of

#: Coefficients of the slow flow: nothing in a diagram or a map depends on them.
SLOW_FLOW_PARAMETERS = ("B1", "B2", "g0")


@dataclass(frozen=True, slots=True)
class Axis:
    """A parameter that can be varied: its name here and in the core, its symbol, its slider's range, its value."""

    name: str
    core: str
    symbol: str
    low: float
    high: float
    value: float

    def span(self, zoom: int = 0) -> tuple[float, float]:
        """Return the range of the slider, or a part of it: a 4^zoom-th, around the value.

        The part moves in steps of a quarter of its width, so that it stays where it is while the value moves a little.
        """
        low, high, _ = slider_range(self.low, self.high, self.value)
        if not zoom:
            return low, high
        width = (high - low) / 4.0**zoom
        start = min(max(low + width * (round(4.0 * (self.value - low) / width) / 4.0 - 0.5), low), high - width)
        return start, start + width


def available(draft: FrameContext) -> dict[str, Axis]:
    """Return, by name, the axes that belong to the present system and Psi; the browser hears when they change."""
    found = axes_there(draft.scene, draft.values, draft.locked)
    names = tuple((axis.name, axis.symbol) for axis in found.values())
    if draft.now.get("axes") != names:
        draft.now["axes"] = names
        draft.header["axes"] = [list(row) for row in names]
    return found


@cache
def _declared(name: str) -> tuple[str, tuple[float, float]]:
    """Return the label and the range of a slider, which cost much of `param`."""
    declared = ExplorerState.param[name]
    return str(declared.label), declared.softbounds


def axes_there(scene: Scene, values: Mapping[str, Any], locked: Collection[str] = ()) -> dict[str, Axis]:
    """Return, by name, the axes that belong to the system and Psi of a scene.

    They are those of `SLIDER_AXES`, and "own:" with the name of any other parameter of the system.
    """
    known = names(scene.system, scene.psi, scene.z)
    normal, example = values["system"] == NORMAL, catalogue.get(values["system"])
    own = dict(getattr(scene.system, "parameters", ()))
    found = {}
    # a parameter of a typed system may be called a, but then it is not the control a
    ranges = slow_ranges(values["system"], getattr(scene.system, "m", 0))
    for name in SLIDER_AXES if normal else (*SLOW_CONTROLS, "n"):
        slow = SLOW_CONTROLS.index(name) if name in SLOW_CONTROLS else None
        core = name if slow is None else f"z{slow + 1}"
        if core not in known or name in locked or (name == "n" and "n" in own):
            continue
        label, softbounds = _declared(name)
        low, high = edited_range(values, name, softbounds if normal or slow is None else ranges[slow])
        symbol = example.slow[slow][0] if example and slow is not None else label
        found[name] = Axis(name, core, symbol, float(low), float(high), float(values[name]))
    typed = parameter_ranges(values["system"], values["texts"])
    for parameter, value in own.items():
        if normal and parameter in COEFFICIENTS and parameter not in locked:
            continue
        name = OWN_AXIS + parameter
        low, high = edited_range(values, name, typed.get(parameter, PARAMETER_RANGE))
        found[name] = Axis(name, parameter, plain_symbol(parameter), float(low), float(high), float(value))
    return found


def opening_axes(scene: Scene, values: Mapping[str, Any], locked: Collection[str] = ()) -> dict[str, str]:
    """Return other axes for those with which a choice of system opens, where the system at hand lacks them.

    What a choice opens with is the same whatever is typed, and whichever Psi is chosen; typed equations may
    have it and not read it in U. An axis that was chosen stays, and a sentence says that it is not there; but a
    parameter that has left the typed equations makes way.
    """
    choice = values["system"]
    across, up = axes_of(OWN_SYSTEM if choice == NORMAL and not isinstance(scene.system, ELinear) else choice)
    there = axes_there(scene, values, locked)
    numbers = getattr(scene.system, "numbers", [axis.core for axis in there.values()])
    read = {name for name, axis in there.items() if name == "n" or axis.core in numbers}
    read = read or there.keys()
    # along Sigma, then over what the system's author named
    order = sorted(there, key=lambda name: (name not in read, name not in SLOW_CONTROLS, not name.startswith(OWN_AXIS)))
    found: dict[str, str] = {}
    for control, first in (("across", across), ("up", up), ("along", across)):
        gone = values[control].startswith(OWN_AXIS) and values[control] not in there
        if gone or (values[control] == first and first not in read):
            other = {"across": values["up"], "up": found.get("across", values["across"]), "along": None}[control]
            free = [name for name in order if name != other]
            if free:
                found[control] = free[0]
    return found


def missing_axes(draft: FrameContext, there: dict[str, Axis], *wanted: str) -> str:
    """Say which of the wanted axes does not belong to the present system or Psi, or return nothing."""
    for name in wanted:
        if name in there:
            continue
        if name == "n":
            return say("n of another Ψ")
        own = name.startswith(OWN_AXIS)
        symbol = plain_symbol(name.removeprefix(OWN_AXIS)) if own else ExplorerState.param[name].label
        return say("axis given" if name in draft.locked else "no such axis", symbol=symbol)
    return ""


def spans_of(draft: FrameContext, name: str, axes: tuple[Axis, ...], zoom: int) -> tuple[tuple[float, float], ...]:
    """Return the spans of some axes: those that the browser has, as long as the present values are well inside."""
    kind = tuple(axis.name for axis in axes), zoom
    of, spans = draft.now.get(f"{name} spans", (None, ()))
    if of == kind and zoom and all(map(_well_inside, spans, axes)):
        return spans
    # n has a short range; next to another parameter it stays whole
    spans = tuple(axis.span(0 if axis.name == "n" and len(axes) > 1 else zoom) for axis in axes)
    draft.now[f"{name} spans"] = kind, spans
    return spans


def _well_inside(span: tuple[float, float], axis: Axis) -> bool:
    low, high = span
    return 0.08 <= (axis.value - low) / (high - low) <= 0.92


def without_parameters(scene: Scene, *along: Axis) -> tuple[Any, Psi, tuple[float, ...]]:
    """Return system, Psi and z of a scene at a fixed value of some parameters, and without a slow flow.

    They say all that a diagram along these depends on: moving their sliders, or those of B and g, asks for no new one.
    """
    system, psi, z = scene.system, scene.psi, scene.z
    if isinstance(system, ELinear):
        given = dict(system.parameters)
        system = system.evolve(**{name: 0.0 for name in SLOW_FLOW_PARAMETERS if name in given})
    for axis in along:
        system, psi, z = vary(system, psi, z, axis.core, axis.high)
    return system, psi, tuple(z)
