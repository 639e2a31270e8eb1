"""The picture as HoloViews elements, to add to, restyle and lay out in a notebook."""

from __future__ import annotations

from typing import Any

import holoviews as hv
import numpy as np

from codim2_core.scene import Scene

from . import glyphs
from .layers import layers_in_paint_order
from .theme import HALF_VIEW, themes

AXIS_LABELS = ["x̄", "ȳ"]
#: Points of print to a px of the screen; Bokeh's marks as Matplotlib names them.
POINT = 0.75
MARKERS = {"circle": "o", "square": "s", "diamond": "D", "triangle": "^", "x": "x", "circle_dot": "o", "hex": "h"}


def elements(scene: Scene) -> dict[str, Any]:
    """Return one HoloViews element for each layer of the picture, from bottom to top.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    dict of str to Element
        "hemisphere", the layers of curves that are shown at first (paths; a layer of two colours is two elements, by
        the names of its parts), "equator" and "critical" (points with the inspector's numbers as further dimensions).
    """
    made: dict[str, Any] = {"hemisphere": _circle()}
    for layer in layers_in_paint_order():
        colours = dict.fromkeys(part.colour for part in layer.parts)
        asked = not layer.hidden and not (layer.optional and not any(len(scene[part.scene]) for part in layer.parts))
        for colour in colours if asked else ():
            parts = [part for part in layer.parts if part.colour == colour]
            label = layer.name if len(colours) == 1 else parts[0].name
            pieces = [piece for part in parts for piece in _split_pieces(*part.pieces(scene[part.scene]))]
            made[label] = _paths(pieces, label, colour, parts[0].width)
    made["equator"] = _equator_circle(scene)
    made["critical"] = _critical_points(scene)
    return made


def holoviews(scene: Scene) -> Any:
    """Return the picture of a scene as an overlay.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    hv.Overlay
        Of the elements that `elements` lists; axes are equal. Bokeh is loaded if no backend is.

    Examples
    --------
    >>> import codim2_core as c2
    >>> picture = holoviews(c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0))))
    >>> len(picture)
    11
    """
    if not hv.Store.renderers:
        hv.extension("bokeh")
    overlay: Any = hv.Overlay(list(elements(scene).values()))
    x, y = (str(hv.Dimension(axis).label) for axis in AXIS_LABELS)
    common = {
        "xlim": (-HALF_VIEW, HALF_VIEW),
        "ylim": (-HALF_VIEW, HALF_VIEW),
        "show_legend": False,
        "xlabel": x,
        "ylabel": y,
    }
    sized = {"bokeh": {"data_aspect": 1, "frame_width": 500}, "matplotlib": {"aspect": "equal", "fig_inches": 6}}
    for backend in sized.keys() & hv.Store.renderers.keys():
        overlay = overlay.opts(**common, **sized[backend], backend=backend)
    return overlay


def _split_pieces(offsets: Any, points: Any) -> list[Any]:
    return np.split(points, offsets[1:-1]) if len(points) else []


def _light(name: str) -> str:
    return themes()["light"][name]


def _circle() -> Any:
    return _style_curves(hv.Ellipse(0, 0, 2, label="hemisphere"), "ink", 2)


def _paths(pieces: list[Any], label: str, colour: str, width: float) -> Any:
    path = hv.Path([np.asarray(piece) for piece in pieces], kdims=AXIS_LABELS, label=label)
    return _style_curves(path, colour, width)


def _equator_circle(scene: Scene) -> Any:
    q = glyphs.equator_columns(scene["equator"])
    return _marks(q, ("type", "theta", "lambda_rho", "lambda_theta"), "equator", 11)


def _critical_points(scene: Scene) -> Any:
    c = glyphs.critical_columns(scene["critical"])
    return _marks(c, ("kind", "trace", "determinant", "discriminant"), "critical", 12)


def _marks(columns: Any, shown: tuple[str, ...], label: str, size: int) -> Any:
    """Return marks of their own shape, colour and fill, with their tooltips, for each backend that is loaded."""
    colours, fills = _mark_colours(columns)
    names = ("label", *shown)
    values = (columns["x"], columns["y"], *(columns[name] for name in names), columns["shape"], colours, fills)
    points: Any = hv.Points(values, kdims=AXIS_LABELS, vdims=[*names, "marker", "colour", "fill"], label=label)
    if "bokeh" in hv.Store.renderers:
        points = points.opts(marker=hv.dim("marker"), line_color=hv.dim("colour"), fill_color=hv.dim("fill"), size=size,
                             line_width=2, tools=["hover"], backend="bokeh")  # fmt: skip
    if "matplotlib" in hv.Store.renderers:

        def draw_each(plot: Any, _element: Any) -> None:
            """Give each point its own mark: Matplotlib's scatter has one for all."""
            artist = plot.handles["artist"]
            samples = [artist.axes.scatter([], [], marker=MARKERS[name]) for name in columns["shape"]]
            artist.set_paths([sample.get_paths()[0] for sample in samples])
            for sample in samples:
                sample.remove()
            artist.set(edgecolors=colours, facecolors=fills, linewidths=2 * POINT)

        points = points.opts(s=(size * POINT) ** 2, hooks=[draw_each], backend="matplotlib")
    return points


def _mark_colours(columns: Any) -> tuple[list[str], list[str]]:
    """Return the colours of the marks' outlines and of their insides."""
    colours = [_light(key) for key in columns["colour"]]
    return colours, [c if filled else _light("page") for c, filled in zip(colours, columns["filled"], strict=True)]


def _style_curves(element: Any, colour: str, width: float) -> Any:
    """Style curves for each backend that is loaded: widths are px of a screen, or points of print."""
    if "bokeh" in hv.Store.renderers:
        element = element.opts(color=_light(colour), line_width=width, backend="bokeh")
    if "matplotlib" in hv.Store.renderers:
        element = element.opts(color=_light(colour), linewidth=POINT * width, backend="matplotlib")
    return element
