"""The panel "Atlas": two parameters as a plane, cut into regions of one portrait each, with a small portrait of each.

The plane (f1, f2) is known in closed form: its curves go with every frame. Any other pair of axes, and a part of that
plane, by zoom or by the ranges of its sliders, is mapped once nothing moves by the core's `atlas`, the curves first,
then the regions between them, each shown as it comes. A system with one parameter only has a strip along that.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from codim2_core import bifurcations
from codim2_core.bifurcations import BifurcationCurve
from codim2_core.bifurcations.atlases.atlas import Atlas, curves_over, with_bifurcations_of_cycles, with_regions
from codim2_core.bifurcations.diagrams.class_line import ClassInterval, class_line
from codim2_core.systems.coefficients import Coefficients
from codim2_core.systems.psi.function import Psi

from ...picture.draw import plane_curves
from ...picture.draw.packing import Polylines
from ...picture.draw.thumbnails import thumbnails
from ...picture.frame.frame_context import FrameContext
from ...picture.frame.process_load import load
from ...picture.phrases import say
from ..panel import Panel
from .atlas_columns import atlas_columns, short, strip_columns
from .axes import Axis, available, missing_axes, spans_of, without_parameters

#: Controls of the plane of f: a system that lacks one of them has none.
MAP_PARAMETERS = ("a", "b", "d", "f1", "f2")
#: Of the frames of a drag each so many-th brings the curves, which are a tenth of the work of a frame; where the
#: process is busy for more than this share of its time, none before the drag rests.
EACH_FRAME, MAX_SHARE = 3, 0.6
#: Blocks of the curves in that plane, in the order of the layer "atlas_curves".
CURVES = ("saddle_node", "transcritical")
#: A region of less area than the square of this, of the map's, gets no small portrait; nor a stretch shorter than this.
THINNEST = 0.012


def add(draft: FrameContext) -> None:
    """Add the map of the chosen axes."""
    axes = draft.values["across"], draft.values["up"]
    there = available(draft)
    reason = missing_axes(draft, there, *axes)
    closed_form = axes == ("f1", "f2") and set(MAP_PARAMETERS) <= there.keys()
    plane = closed_form and draft.values["atlas_zoom"] == 0 and not {"f1", "f2"} & draft.values["ranges"].keys()
    shown = (next(iter(there)), "") if len(there) == 1 else axes
    if draft.now.get("atlas of") != (shown, plane):
        draft.now["atlas of"] = (shown, plane)
        draft.header["atlas_of"] = [*shown, plane]
    if plane:
        _plane_of_f(draft)
        return
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
    _map(draft, (there[axes[0]], there[axes[1]]))


# The plane of f ----------------------------------------------------------------------------------------------------


def _plane_of_f(draft: FrameContext) -> None:
    scene, header = draft.scene, draft.header
    matrix = scene.key("matrix")
    moved = 0 if draft.rest or draft.now.get("atlas at") == matrix else draft.now.get("atlas moved", 0) + 1
    draft.now["atlas moved"] = moved
    busy = load.share > MAX_SHARE and "atlas_size" in draft.now
    if moved % EACH_FRAME == min(moved, 1) and not (moved and busy):
        draft.now["atlas at"] = matrix
        curves = scene["atlas_curves"]
        if draft.fresh("atlas_curves", curves):
            header["atlas_size"] = draft.now["atlas_size"] = plane_curves.size_of(curves)
            for name, curve in zip(CURVES, curves, strict=True):
                draft.blocks[name] = Polylines(*plane_curves.curve_lines(curve, header["atlas_size"]))
    size = draft.now["atlas_size"]
    if draft.now.get("regions at") != matrix:
        if draft.rest:
            draft.now["regions at"] = matrix
            header["regions"] = plane_curves.region_columns(scene["regions"], size)
            draft.blocks["regions"] = Polylines(*plane_curves.region_lines(scene["regions"], size))
        else:
            draft.late("regions")
    _curves_of_psi(draft, size)
    _curves_of_cycles(draft, size)
    if draft.ready:
        _portraits_of_plane(draft)


def _curves_of_psi(draft: FrameContext, size: float) -> None:
    """Add the Hopf and node-focus curves: there are some in Case III only."""
    scene = draft.scene
    at = scene.coefficients
    assert isinstance(at, Coefficients)  # the system has a, b, d
    psi = scene.psi
    found = draft.slow("curves of psi", scene.key("matrix", "psi"), _hopf_and_node_focus, at, psi)
    if found is None:
        return
    draft.header["curves_of_psi"] = {"size": size, "points": special_points(found)}
    for name, curve in zip(("hopf", "node_focus"), found, strict=True):
        draft.blocks[name] = Polylines(*plane_curves.curve_lines(curve, size))


def _curves_of_cycles(draft: FrameContext, size: float) -> None:
    """Add the curves on which limit cycles meet, or end at the equator: in Case III, where they are requested.

    They take seconds to continue.
    """
    at, psi = draft.scene.coefficients, draft.scene.psi
    assert isinstance(at, Coefficients)  # the system has a, b, d
    a, b, d = at.plane[:3]
    possible = a * d < 0.0 < a * d + b * b
    if draft.fresh("cycles possible", possible):
        draft.header["cycles_possible"] = possible
    if not possible or draft.values["cycle_curves"] == "hide" or not draft.ready:
        return
    found = draft.slow("curves of cycles", draft.scene.key("matrix", "psi"), _cycle_curves, at, psi)
    if found is None:
        return
    draft.header["curves_of_cycles"] = {"size": size, "points": special_points(found)}
    for name, curve in zip(("cycle_folds", "heteroclinic", "closed_equator"), found, strict=True):
        draft.blocks[name] = Polylines(*plane_curves.curve_lines(curve, size))


def _hopf_and_node_focus(at: Coefficients, psi: Psi) -> tuple[BifurcationCurve, ...]:
    return bifurcations.hopf(at, psi), bifurcations.node_focus(at, psi)


def _cycle_curves(at: Coefficients, psi: Psi) -> tuple[BifurcationCurve, ...]:
    return (
        bifurcations.cycle_folds(at, psi),
        bifurcations.heteroclinic(at, psi),
        bifurcations.closed_equator(at),
    )


def special_points(curves: Sequence[BifurcationCurve]) -> list[list[Any]]:
    """Return type, place and sentence of the points of codimension two on some curves."""
    return [[point.type, *point.place, point.sentence] for curve in curves for point in curve.special]


def _portraits_of_plane(draft: FrameContext) -> None:
    scene = draft.scene
    places = [(i, region.name, region.inside) for i, region in enumerate(scene["regions"])] if draft.rest else []
    system, psi, z = scene.coefficients, scene.psi, ()
    found = draft.slow("thumbnails", scene.key("matrix", "psi"), thumbnails, system, psi, z, ("f1", "f2"), places)
    if found is not None:
        draft.header["thumbnails"] = found


# Any two parameters ------------------------------------------------------------------------------------------------


def _map(draft: FrameContext, axes: tuple[Axis, Axis]) -> None:
    system, psi, z = without_parameters(draft.scene, *axes)
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
