"""The panel "Atlas": two parameters as a plane, cut into regions of one portrait each, with a small portrait of each.

The core's `atlas` maps any pair of axes once nothing moves: the curves first, then the regions between them, each
shown as it comes. The plane (f1, f2) is that of f(z), and as wide as its curves. A system with one parameter only has
a strip along that.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from codim2_core.bifurcations.atlases.atlas import curves_over, with_bifurcations_of_cycles, with_regions
from codim2_core.bifurcations.atlases.result import Atlas
from codim2_core.bifurcations.diagrams.classes import ClassInterval, class_line
from codim2_core.bifurcations.plane.curve import border_reach, coefficients_of
from codim2_core.bifurcations.plane.plane_curves import may_turn
from codim2_core.systems.coefficients import Coefficients

from ...picture.draw.thumbnails import thumbnails
from ...picture.frame.frame_context import FrameContext
from ...picture.phrases import say
from ...picture.state.slider_range import round_up, slider_range
from ..panel import Panel
from .atlas_columns import atlas_columns, short, strip_columns
from .axes import Axis, available, missing_axes, spans_of, without_parameters

#: Controls of the plane of f(z).
MATRIX, FORCE = ("a", "b", "d"), ("f1", "f2")
#: A region of less area than the square of this, of the map's, gets no small portrait; nor a stretch shorter than this.
THINNEST = 0.012


def add(draft: FrameContext) -> None:
    """Add the map of the chosen axes."""
    axes = draft.values["across"], draft.values["up"]
    there = available(draft)
    reason = missing_axes(draft, there, *axes)
    of_f = axes == FORCE and {*MATRIX, *FORCE} <= there.keys()
    shown = (next(iter(there)), "") if len(there) == 1 else axes
    if draft.now.get("atlas of") != (shown, of_f):
        draft.now["atlas of"] = (shown, of_f)
        draft.header["atlas_of"] = [*shown, of_f]
    if len(there) == 1:
        _strip(draft, *there.values())
        return
    if not there:
        reason = say("no parameter to map")
    elif axes[0] == axes[1]:
        reason = say("one axis twice")
    if reason:
        if draft.now.get("map") != reason:
            draft.now["map"] = reason
            draft.unable("map", reason)
        return
    chosen = there[axes[0]], there[axes[1]]
    if of_f:
        _plane_of_f(draft, chosen)
    else:
        _offer_cycles(draft, True)
        _map(draft, chosen, without_parameters(draft.scene, *chosen))


def _offer_cycles(draft: FrameContext, possible: bool) -> None:
    """Say whether the map may have bifurcations of limit cycles, which are offered then."""
    if draft.now.get("cycles possible") != possible:
        draft.now["cycles possible"] = possible
        draft.header["cycles_possible"] = possible


def _plane_of_f(draft: FrameContext, axes: tuple[Axis, Axis]) -> None:
    """Map the plane of f(z) of the matrix: moving z, or what f depends on, asks for no other map."""
    at = draft.scene.coefficients
    assert isinstance(at, Coefficients)  # the system has a, b, d
    matrix, f = at.plane[:3], at.plane[3:]
    _offer_cycles(draft, may_turn(*matrix))
    reach = round_up(border_reach(matrix))
    wide = []
    for axis, value in zip(axes, f, strict=True):
        low, high = (axis.low, axis.high) if axis.name in draft.values["ranges"] else (-reach, reach)
        low, high, _ = slider_range(low, high, axis.value)  # f itself is in sight too
        wide.append(replace(axis, low=low, high=high, value=value))
    _map(draft, (wide[0], wide[1]), (coefficients_of(matrix), draft.scene.psi, ()))


def _map(draft: FrameContext, axes: tuple[Axis, Axis], of: tuple[Any, ...]) -> None:
    """Add the map over two axes of a system, Psi and z, and its small portraits."""
    system, psi, z = of
    spans = spans_of(draft, "map", axes, draft.values["atlas_zoom"])
    names = axes[0].core, axes[1].core
    key = (system, psi, z, names, spans)
    _add_atlas(draft, key, axes)
    _portraits(draft, key)


def _add_atlas(draft: FrameContext, key: tuple[Any, ...], axes: tuple[Axis, Axis]) -> None:
    """Add the curves and, once they are there, the regions between them.

    Then, where they are requested, the folds of its limit cycles and the connections of its saddles.
    """
    system, psi, z, names, spans = key
    curves: Atlas | None = draft.slow("map", key, curves_over, system, psi, *names, spans, z)
    if curves is not None:
        draft.now["curves"] = key, curves
        draft.now.pop("curves of cycles", None)  # the browser has this map anew, without them
    kept, known = draft.now.get("curves", (None, None))
    if kept != key or draft.now.get("map") != key:
        return
    whole: Atlas | None = draft.slow("map regions", key, with_regions, system, psi, known, z)
    if whole is not None:
        draft.now["whole"] = key, whole
    kept, known = draft.now.get("whole", (None, None))
    cycles: Atlas | None = None
    if kept == key and draft.values["cycle_curves"] == "show":
        cycles = draft.slow("curves of cycles", key, with_bifurcations_of_cycles, system, psi, known, z)
    found = cycles or whole or curves
    if found is not None:
        draft.header["map"], lines = atlas_columns(found, (axes[0].symbol, axes[1].symbol))
        draft.blocks.update(lines)
    if whole is not None:
        least = THINNEST**2 * sum(region.area for region in whole.regions)
        wide = [(i, short(r.name), r.sample) for i, r in enumerate(whole.regions) if r.area >= least]
        draft.now["places"] = (key, wide)


def _portraits(draft: FrameContext, key: tuple[Any, ...]) -> None:
    """Add a small portrait of each region of the map that the browser has."""
    of, places = draft.now.get("places", (None, ()))
    if draft.ready and of == key:
        system, psi, z, names, _ = key
        tiles = draft.slow("thumbnails", key, thumbnails, system, psi, z, names, places)
        if tiles is not None:
            draft.header["thumbnails"] = tiles


def _strip(draft: FrameContext, axis: Axis) -> None:
    """Add the stretches of one class along the only parameter, as a plane of which the other axis means nothing."""
    system, psi, z = without_parameters(draft.scene, axis)
    (span,) = spans_of(draft, "map", (axis,), draft.values["atlas_zoom"])
    key = (system, psi, z, (axis.core,), span)
    found: tuple[ClassInterval, ...] | None = draft.slow("map", key, class_line, system, psi, axis.core, span, z)
    if found is not None:
        draft.header["map"], lines = strip_columns(found, span, say("one parameter", name=axis.symbol))
        draft.blocks.update(lines)
        wide = [(i, short(s.name), (0.5 * (s.low + s.high),)) for i, s in enumerate(found)
                if s.high - s.low >= THINNEST * (span[1] - span[0])]  # fmt: skip
        draft.now["places"] = (key, wide)
    _portraits(draft, key)


PANEL = Panel("atlas", "Atlas", add, "Two parameters as a plane, cut into regions of one portrait each.")
