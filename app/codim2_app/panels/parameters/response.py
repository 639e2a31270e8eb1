"""The panel "Response": the periodic motion that the typed start settles to, followed along one parameter."""

from __future__ import annotations

from typing import Any

import numpy as np

from codim2_core.motion.initial_value.field import field
from codim2_core.motion.periodic.response import response_curve
from codim2_core.motion.periodic.result import ResponseCurve, ResponsePoint
from codim2_core.motion.periodic.search import forcing_period, settled_motion
from codim2_core.portrait.layer_problem.vary import vary
from codim2_core.systems.psi.function import Psi

from ...picture.frame.frame_context import FrameContext
from ...picture.phrases import say
from ...picture.slow_layers.short import short
from ...picture.slow_layers.typed_start import launch_of
from ...picture.state.chosen_system import System_
from ...picture.state.cleaning import InputError
from ..panel import Panel
from .axes import available, missing_axes, spans_of
from .diagram import tidy

MAX_SENT_MOTIONS = 240  # that the browser is sent


def add(draft: FrameContext) -> None:
    """Add the response curve along the chosen parameter, once nothing moves."""
    system, values, name = draft.system, draft.values, draft.values["along"]
    there = available(draft)
    try:
        if system is None or not system.m:
            raise InputError("along", say("no slow variable"))
        reason = missing_axes(draft, there, name) if there else say("no parameter")
        if not reason and there[name].core not in system.variable:
            reason = say("no parameter of the motion")
        if reason:
            raise InputError("along", reason)
        start, t_end = launch_of(values, system)
    except InputError as error:
        if draft.now.get("response") != str(error):
            draft.now["response"] = str(error)
            draft.unable("response", str(error))
        return
    axis = there[name]
    (span,) = spans_of(draft, "response", (axis,), values["zoom"])
    eps = 10.0 ** values["log_eps"] if values["orbit_eps"] == "show" else 0.0
    # without the parameter's value: moving along the curve asks for no new one
    key = vary(system, draft.scene.psi, (), axis.core, span[1])[0], draft.scene.psi, eps, start, t_end, name, span
    asked = system, draft.scene.psi, eps, start, t_end, axis.core, span
    found = draft.slow("response", key, response_columns, *asked)
    if found is not None:
        draft.header["response"] = {**found, "control": name}


def response_columns(
    system: System_, psi: Psi, eps: float, start: tuple[float, ...], t_end: float, along: str,
    span: tuple[float, float],
) -> dict[str, Any]:  # fmt: skip
    """Return the response curve as the browser draws it.

    Raises
    ------
    ValueError
        The motion from the start is not seen to repeat itself, or cannot be followed along the parameter.
    """
    settled = settled_motion(system, start, psi, eps, t_end)
    if settled is None:
        raise ValueError(say("no periodic motion to follow"))
    state, period = settled

    def period_of(value: float) -> float:
        return forcing_period(vary(system, psi, (), along, value)[0]) or period

    forced = forcing_period(system) is not None
    found = response_curve(system, psi, state, period_of if forced else period, along, span, eps=eps)
    clocks = [bool(row.constant) for row in field(system).rows[2:]]
    return {"span": list(span), "forced": forced, "eps": eps, **curve_columns(found, clocks)}


def curve_columns(found: ResponseCurve, clocks: list[bool]) -> dict[str, Any]:
    """Return a curve as numbers: of each motion the amplitude of all that is no clock, and its multipliers."""
    kept = np.unique(np.rint(np.linspace(0, len(found) - 1, min(len(found), MAX_SENT_MOTIONS))).astype(int))
    measured = [i for i, clock in enumerate(clocks) if not clock]
    which = measured[0] if measured else None
    amplitude = found.velocity_amplitude[:, 0] if which is None else found.amplitude[:, which]
    special = [
        {
            "kind": one.kind, "value": tidy(one.value), "sentence": one.sentence,
            "amplitude": float(amplitude[_nearest(found, one)]),
        }
        for one in found.special
    ]  # fmt: skip
    return {
        "of": which,
        "values": short(found.values[kept], 7), "amplitude": short(amplitude[kept]),
        "period": short(found.period[kept]),
        "stable": [bool(one) for one in found.stable[kept]],
        "multipliers": [
            [[float(f"{v.real:.4g}"), float(f"{v.imag:.4g}")] for v in row if np.isfinite(v)]
            for row in found.multipliers[kept]
        ],
        "starts": [short(row, 7) for row in found.state0[kept]],
        "special": special, "ends": list(found.ends),
    }  # fmt: skip


def _nearest(found: ResponseCurve, one: ResponsePoint) -> int:
    away = np.abs(found.values - one.value) / np.ptp(found.values) + np.abs(found.period / one.period - 1.0)
    return int(np.argmin(away))


PANEL = Panel(
    "response", "Response", add,
    "The periodic motion that the typed start settles to, along one parameter: amplitude, stability, multipliers.",
)  # fmt: skip
