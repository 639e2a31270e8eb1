"""The panel "Diagram": limit directions, critical sets and cycles along one parameter, special points marked.

Above it is a film strip: a small portrait at each special value, and one between each two.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.bifurcations.continuation.result import CycleBranches
from codim2_core.bifurcations.diagrams.equilibrium_branches import Branches, branches

from ...picture.draw.thumbnails import MAX_KEPT as MAX_FRAMES
from ...picture.draw.thumbnails import thumbnails
from ...picture.frame.frame_context import FrameContext
from ...picture.phrases import say
from ...picture.state.animation_pacing import MIN_PACE, SLOW_DISTANCE
from ..panel import Panel
from .atlas_columns import short
from .axes import available, missing_axes, spans_of, without_parameters

#: Most points that the browser is sent of a branch: it is drawn some 320 px wide.
MAX_BRANCH_POINTS = 160
#: Of the span: special values that are nearer have no portrait between them.
MIN_FRAME_GAP = 1e-3
#: Special points of branches of cycles that the diagram has already, or that are none of the system's.
KNOWN_ENDS = ("Hopf", "span", "closed")


def add(draft: FrameContext) -> None:
    """Add the diagram along the chosen parameter, over a span around its value, once nothing moves; then the cycles."""
    name = draft.values["along"]
    there = available(draft)
    reason = missing_axes(draft, there, name) if there else say("no parameter")
    if reason:
        if draft.now.get("diagram") != reason:
            draft.now["diagram"] = reason
            draft.unable("diagram", reason)
        return
    axis = there[name]
    (span,) = spans_of(draft, "diagram", (axis,), draft.values["zoom"])
    system, psi, z = without_parameters(draft.scene, axis)
    key = (system, psi, z, name, span)
    found = draft.slow("diagram", key, _diagram_columns, system, psi, axis.core, span, z)
    if found is not None:
        shown, stands = found
        draft.header["diagram"] = {**shown, "control": name}
        draft.now["stands along"] = key, stands
    of, stands = draft.now.get("stands along", (None, None))
    if draft.ready and of == key:
        cycles = draft.slow("cycles along", key, _cycles, stands)
        if cycles is not None:
            draft.header["cycles_along"] = cycles
            draft.now["cycles are"] = key, cycles
        if draft.now.get("cycles along") == key:  # they are there, or cannot be
            of, cycles = draft.now.get("cycles are", (None, None))
            events = [tidy(s.value) for s in stands.standing] + [
                s["value"] for s in (cycles if of == key else {}).get("special", ())
            ]
            film = draft.slow("film", key, thumbnails, system, psi, z, (axis.core,), frames_of(span, events))
            if film is not None:
                draft.header["film"] = [[place[0], short(portrait), drawn] for _, portrait, place, drawn in film]


def _diagram_columns(*of: Any) -> tuple[dict[str, Any], Branches]:
    found = branches(*of, with_cycles=False)
    return branch_columns(found), found


def _cycles(standing: Branches) -> dict[str, Any]:
    return cycle_columns(standing.with_cycles().cycles)


def frames_of(span: tuple[float, float], events: Iterable[float]) -> list[tuple[int, str, tuple[float, ...]]]:
    """Return where a film strip has its portraits: at each special value, and before and after it."""
    at = sorted(set(events))
    ends = [span[0], *at, span[1]]
    apart = MIN_FRAME_GAP * (span[1] - span[0])
    between = [0.5 * (low + high) for low, high in pairwise(ends) if high - low > apart]
    values = sorted([*at, *between] if len(at) + len(between) <= MAX_FRAMES else at)
    return [(i, "", (value,)) for i, value in enumerate(values)]


def tidy(value: float) -> float:
    """Return the decimal of twelve digits that a value is up to rounding, or else the value: addresses carry it."""
    near = float(f"{value:.12g}")
    return near if abs(near - value) <= 2.0 * math.ulp(value) else value


def branch_columns(found: Branches) -> dict[str, Any]:
    """Return what the browser draws: branches as x, y and kind, and the special values."""
    return {
        "span": list(found.span),
        "equator": [
            {**_branch_line(b.value, b.theta), "attracting": bool(np.median(b.lambda_rho) < 0.0),
             "turning": bool(np.median(b.lambda_theta) < 0.0)}
            for b in found.limit_directions
        ],
        "critical": [{**_branch_line(b.value, b.radius), "kind": b.kind} for b in found.critical],
        "closed": [[float(b.value[0]), float(b.value[-1])] for b in found.closed],
        "special": [
            {"kind": s.kind, "value": tidy(s.value), "place": [float(v) for v in s.place], "sentence": s.sentence}
            for s in found.standing
        ],
    }  # fmt: skip


def cycle_columns(found: CycleBranches) -> dict[str, Any]:
    """Return the branches of limit cycles, in pieces of one stability, their special points, and what is to say."""
    pieces = []
    for branch in found:
        finite = np.isfinite(branch.period)
        value, amplitude, period = branch.value[finite], branch.amplitude[finite], branch.period[finite]
        # at a fold or a Hopf point the exponent is zero: the stability belongs to the steps between points
        step = branch.exponent[finite]
        stable = (step[1:] + step[:-1]) < 0.0
        cuts = [0, *(np.flatnonzero(np.diff(stable)) + 1), len(stable)]
        for start, end in pairwise(cuts):
            if end > start:
                part = slice(start, end + 1)
                line = _branch_line(value[part], amplitude[part])
                pieces.append(
                    {**line, "period": _branch_line(value[part], period[part])["y"], "stable": bool(stable[start])}
                )
    special = [
        {"kind": p.kind, "value": tidy(p.value), "amplitude": float(p.amplitude), "sentence": p.sentence}
        for branch in found
        for p in branch.special
        if p.kind not in KNOWN_ENDS and np.isfinite(p.amplitude)
    ]
    return {"pieces": pieces, "special": special, "sentence": " ".join([found.reason, *found.notes])}


def _branch_line(x: NDArray[np.float64], y: NDArray[np.float64]) -> dict[str, list[float]]:
    if len(x) > MAX_BRANCH_POINTS:
        kept = np.unique(np.rint(np.linspace(0, len(x) - 1, MAX_BRANCH_POINTS)).astype(int))
        x, y = x[kept], y[kept]
    return {"x": [float(f"{v:.7g}") for v in x], "y": [float(f"{v:.4g}") for v in y]}


PANEL = Panel(
    "diagram", "Diagram", add, "Equilibria along one parameter, and where they change.",
    {"slow": MIN_PACE, "near": SLOW_DISTANCE},
)  # fmt: skip
