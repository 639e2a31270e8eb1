"""The panel "Along z": sliding, crossing and unstable parts of Sigma, the slow flow, and its equilibria.

One slow variable runs; with two or more of them the plane of the first two is shown as well.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.motion.limit.predicted_delays import delays
from codim2_core.portrait.portrait_name import attracting_set
from codim2_core.portrait.sliding.along_z import slow_plane, slow_portrait
from codim2_core.portrait.sliding.slow_portrait_result import SlowPortrait
from codim2_core.results.words import written_label
from codim2_core.systems.psi.function import Psi

from ..picture.frame.frame_context import FrameContext
from ..picture.phrases import say
from ..picture.slow_layers.short import short
from ..picture.state.choices import SLOW_CONTROLS
from ..picture.state.chosen_system import System_, slow_ranges
from ..picture.state.slider_range import edited_range, slider_range
from .panel import Panel

ARROWS_PER_AXIS = 15  # arrows along each axis of the plane
NO_SLOW_VARIABLE = say("no slow variable")


def add(draft: FrameContext) -> None:
    """Add the slow portrait along the chosen slow variable, once nothing moves."""
    system, values = draft.system, draft.values
    if system is None or not system.m:
        if draft.fresh("along", NO_SLOW_VARIABLE):
            draft.header.setdefault("unable", {})["along"] = NO_SLOW_VARIABLE
        return
    z, psi = draft.scene.z, draft.scene.psi
    _add_drift(draft)
    m = system.m
    axis = min(SLOW_CONTROLS.index(values["drift"]), m - 1, len(SLOW_CONTROLS) - 1)
    spans = slow_spans(system, values)
    others = tuple(0.0 if i == axis else v for i, v in enumerate(z))
    found = draft.slow("along", (system, psi, others, axis, spans), line, system, psi, others, axis, spans)
    if found is not None:
        draft.header["along"] = found
    ahead = draft.slow("delays", (system, psi, z, spans), ahead_of, system, psi, z, spans)
    if ahead is not None:
        draft.header["delays"] = ahead
    if m > 1:
        rest = z[2:]
        plane = draft.slow("slow_plane", (system, psi, rest, spans), plane_of, system, psi, rest, spans)
        if plane is not None:
            draft.header["slow_plane"] = plane


def _add_drift(draft: FrameContext) -> None:
    """Add the slow flow that play follows: that of the attracting set which the frame before was on."""
    scene = draft.scene
    if not draft.ready:
        return  # limit cycles need the integrator
    found = attracting_set(scene["critical"], lambda: scene["cycles"], draft.now.get("drifts on"))
    draft.now["drifts on"] = None if found is None else found.e
    drift = None if found is None else {"on": found.name, "flow": [float(v) for v in found.slow_flow]}
    if draft.now.get("drift", ()) != drift:
        draft.now["drift"] = draft.header["drift"] = drift


def slow_spans(system: System_, values: Mapping[str, Any]) -> tuple[tuple[float, float], ...]:
    """Return the range of the slider of each slow variable."""
    ranges = slow_ranges(values["system"], system.m)
    return tuple(
        slider_range(*edited_range(values, name, first), values[name])[:2]
        for name, first in zip(SLOW_CONTROLS, ranges, strict=False)
    )


def line(
    system: System_, psi: Psi, others: tuple[float, ...], axis: int, spans: tuple[tuple[float, float], ...]
) -> dict[str, Any]:
    """Return what the browser draws along one slow variable."""
    found = slow_portrait(system, psi, f"z{axis + 1}", spans[axis], others)
    return {"control": SLOW_CONTROLS[axis], "m": system.m, "span": list(spans[axis]), **slow_columns(found, axis)}


def slow_columns(found: SlowPortrait, axis: int) -> dict[str, Any]:
    """Return a slow portrait as numbers and words."""
    width = found.intervals[-1].high - found.intervals[0].low
    return {
        "intervals": [{"low": i.low, "high": i.high, "kind": i.kind, "sentence": i.sentence} for i in found.intervals],
        "branches": [
            {"z": short(b.z), "flow": _drawable_flow(b.flow[:, axis], width), "kind": b.kind, "stable": b.stable}
            for b in found.branches
        ],
        "points": [
            {
                "kind": p.kind,
                "z": p.z if abs(p.z) > 1e-14 * width else 0.0,
                "stable": p.stable,
                "sentence": p.sentence,
                "flow": p.flow[axis] if p.kind != "equilibrium" else 0.0,
            }
            for p in found.points
        ],
    }


def _drawable_flow(flow: NDArray[np.float64], width: float) -> list[float]:
    """Return a slow flow as it is drawn: zero where it would take longer than any motion to be seen to move."""
    return short(np.where(np.abs(flow) < 1e-10 * width, 0.0, flow))


def ahead_of(system: System_, psi: Psi, z: tuple[float, ...], spans: tuple[tuple[float, float], ...]) -> dict[str, Any]:
    """Return the delayed losses of stability ahead of motions that come to Sigma at z, as the browser draws them."""
    found = [
        {
            "onto": written_label(one.onto),
            "z_in": short(one.z_in),
            "z_hopf": short(one.z_hopf),
            "z_out": None if one.z_out is None else short(one.z_out),
            "z": [short(column) for column in one.z.T],
            "flow": [short(column) for column in one.flow.T],
            "reason": one.reason,
        }
        for one in delays(system, psi, z, {f"z{i + 1}": span for i, span in enumerate(spans)})
    ]
    return {"found": found}


def plane_of(
    system: System_, psi: Psi, rest: tuple[float, ...], spans: tuple[tuple[float, float], ...]
) -> dict[str, Any]:
    """Return the slow flow over a net in the plane of the first two slow variables, where there is sliding."""
    found = slow_plane(system, psi, (spans[0], spans[1]), rest, ARROWS_PER_AXIS)
    arrows = [
        [float(z1), float(z2), *short(flow[:2]), int(stable)]
        for (z1, z2), flow, stable in zip(found.z, found.flow, found.stable, strict=True)
    ]
    return {"spans": [list(spans[0]), list(spans[1])], "arrows": arrows}


PANEL = Panel("along", "Along z", add, "Where Σ slides, and the slow flow along it.")
