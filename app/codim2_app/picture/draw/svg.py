"""Pictures as inline SVG: the first one, shown before any script has loaded, and small portraits for the atlas.

Colours are the style sheet's custom properties, so that light and dark need no second drawing.
"""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from codim2_core.scene import Scene

from . import glyphs
from .layers import LAYERS, layers_in_paint_order
from .packing import unpack
from .vector import parts as vector
from .vector.parts import VIEWBOX_SIDE, Placement

#: The whole picture; lines and marks have the size that they have in a picture of 700 px.
DEFAULT_PLACEMENT = Placement()


def draw(buffer: bytes, layers: Collection[str]) -> str:
    """Return the picture of one packed frame as an ``<svg>`` element, about 30 kB.

    Coordinates are whole thousandths of the picture's side.

    Parameters
    ----------
    buffer : bytes
        A frame that holds everything.
    layers : collection of str
        Those that are shown.
    """
    whole = (
        f'<svg viewBox="0 0 {VIEWBOX_SIDE} {VIEWBOX_SIDE}" fill="none" stroke-linejoin="round" stroke-linecap="round">'
    )
    return whole + content(buffer, layers, DEFAULT_PLACEMENT) + "</svg>"


def content(buffer: bytes, layers: Collection[str], place: Placement, labelled: bool = True) -> str:
    """Return what is drawn of one packed frame, from bottom to top, as elements of an SVG.

    Parameters
    ----------
    buffer : bytes
        A frame that holds everything.
    layers : collection of str
        Those that are shown.
    place : Placement
        What of the picture, and where in the drawing.
    labelled : bool
        Whether marks have labels.
    """
    header, blocks = unpack(buffer)
    parts = [vector.sphere(place)]
    drawn = [part for layer in layers_in_paint_order() if layer.name in layers for part in layer.parts]
    if "basins" in layers:
        parts += vector.basins(header.get("basins"), blocks, place)
    if "outcomes" in layers:
        parts += vector.arcs(header.get("outcomes"), place)
    parts += [vector.curves(part, blocks, place) for part in drawn]
    # heads lie over all curves, or else those of the lower layers would be crossed out
    parts += [vector.heads(part, blocks, place) for part in drawn]
    parts += vector.equator(header, place)
    if "launched" in layers:
        parts += vector.launch_marks(header.get("launched"), LAYERS["launched"].parts, place)
    taken: list[vector.LabelBox] = []
    marked = [header[name] for name in ("equator", "critical") if name in layers and header.get(name)]
    for columns in marked:
        parts += vector.marks(columns, place, taken)
    for columns in marked if labelled else ():
        parts += vector.labels(columns, place, taken, bool("outcomes" in layers and header.get("outcomes")))
    return "".join(parts)


#: Layers of a small portrait, from bottom to top, and their widths in px where it is 80 px wide.
SMALL_WIDTHS = {"outside": 0.5, "inside": 0.6, "continuations": 1.0, "cycles": 1.6}
SMALL_SIDE = 240


def small(scene: Scene, view: float) -> str:
    """Return a small portrait without words: trajectories, limit cycles, equator equilibria and critical sets.

    Parameters
    ----------
    scene : Scene
    view : float
        Half its width in picture units.

    Returns
    -------
    str
        An ``<svg>`` element of some 5 kB, in the style sheet's colours.
    """
    place = Placement((-view, view, -view, view), SMALL_SIDE, SMALL_SIDE / 80)
    parts = [f'<svg viewBox="0 0 {SMALL_SIDE} {SMALL_SIDE}" fill="none" stroke-linejoin="round" aria-hidden="true">']
    for name, width in SMALL_WIDTHS.items():
        for part in LAYERS[name].parts:
            offsets, points = part.pieces(scene[part.scene])
            path = place.path(np.split(place.points(points), offsets[1:-1]))
            parts.append(f'<path d="{path}" {vector.stroke(part.colour, width, (), place)}/>')
    parts.append(f'<circle cx="120" cy="120" r="{place.scale:.0f}" stroke="var(--ink)" stroke-width="4"/>')
    for columns in (glyphs.equator_columns(scene["equator"]), glyphs.critical_columns(scene["critical"])):
        for i, (u, v) in enumerate(place.points(np.column_stack([columns["x"], columns["y"]])).tolist()):
            parts.append(vector.mark(columns, i, u, v, 18 / columns["size"][i], 4))
    return "".join(parts) + "</svg>"
