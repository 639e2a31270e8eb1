"""Columns that the panel "Atlas" sends: regions, curves and points of a map, with their labels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.bifurcations.atlases.connections.connection_curves import KINDS
from codim2_core.bifurcations.atlases.result import Atlas
from codim2_core.bifurcations.diagrams.classes import ClassInterval

from ...picture.draw.glyphs import join
from ...picture.draw.packing import Polylines
from ...picture.draw.thinning import thin
from ...picture.phrases import say

Spans = tuple[tuple[float, float], tuple[float, float]]


def short(name: str) -> str:
    """Return a class without what its limit directions do: a region has little room."""
    return name.partition(";")[0]


def strip_columns(
    found: Sequence[ClassInterval], span: tuple[float, float], note: str
) -> tuple[dict[str, Any], dict[str, Polylines]]:
    """Return stretches as the regions of a plane that is as high as it is wide, and their ends as its curves."""
    middle, half = 0.5 * (span[0] + span[1]), 0.5 * (span[1] - span[0])
    ends = [[(v - middle) / half for v in (s.low, s.high)] for s in found]
    loops = [np.array([(u, -1.0), (v, -1.0), (v, 1.0), (u, 1.0)]) for u, v in ends]
    between = [np.array([(v, -1.0), (v, 1.0)]) for _, v in ends[:-1]]
    header = {
        "spans": [list(span), [0.0, 1.0]],
        "name": [s.name for s in found],
        "inside": [[0.5 * (s.low + s.high), 0.5] for s in found],
        "loops": [1] * len(found),
        "curve": [s.happening[0] for s in found[:-1]],
        "pieces": [1] * len(between),
        "note": note,
    }
    return header, {"map": Polylines(*join(loops)), "map_curves": Polylines(*join(between))}


def atlas_columns(found: Atlas, symbols: tuple[str, str]) -> tuple[dict[str, Any], dict[str, Polylines]]:
    """Return curves, points and, if they are there yet, regions of an atlas, its names shown by some symbols."""
    header = {
        "spans": [list(span) for span in found.ranges],
        "name": [region.name for region in found.regions],
        "inside": [list(region.sample) for region in found.regions],
        "loops": [len(region.boundary) for region in found.regions],
        "curve": [curve.kind for curve in found.curves],
        "pieces": [1] * len(found.curves),
        "points": [[point.kind, *point.place, point.sentence] for point in found.points],
        "note": _note(found, dict(zip(found.names, symbols, strict=True))),
    }
    loops = [loop for region in found.regions for loop in region.boundary]
    return header, _curve_columns(found.ranges, loops, [curve.points for curve in found.curves])


def _note(found: Atlas, symbols: dict[str, str]) -> str:
    """Tell what an atlas has missed, or may have."""
    looked = found.looked
    sentences = [say("degenerate line", name=symbols[name], value=value) for name, value in found.degenerate]
    given_up = [kind for kind in found.unfinished if kind not in KINDS]
    seen = [kind for kind in found.unfinished if kind in KINDS]
    sentences += [say("curves given up", kinds=", ".join(given_up))] if given_up else []
    sentences += [say("connections not followed", kinds=", ".join(seen))] if seen else []
    sentences += [say("region unlike", few=len(looked.unlike), all=looked.places)] if looked.unlike else []
    sentences += [say("regions unproved", few=looked.unproved, all=looked.places)] if looked.unproved else []
    return " ".join([*sentences, say("map by curves") if looked.places else say("regions to come")])


def _curve_columns(
    spans: Spans, loops: Sequence[NDArray[np.float64]], curves: Sequence[NDArray[np.float64]]
) -> dict[str, Polylines]:
    """Return borders of regions and curves where both spans are -1 to 1."""
    low, high = np.array(spans).T
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    return {
        name: Polylines(*thin([(line - middle) / half for line in lines]))
        for name, lines in (("map", loops), ("map_curves", curves))
    }
