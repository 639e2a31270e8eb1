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
#: What Bokeh's names of styles are called there.
MATPLOTLIB = {"color": "color", "line_width": "linewidth", "line_color": "edgecolors", "fill_color": "color"}


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
            made[label] = _paths(pieces, label, _light(colour), parts[0].width)
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
    return _apply_style(hv.Ellipse(0, 0, 2, label="hemisphere"), color=_light("ink"), line_width=2)


def _paths(pieces: list[Any], label: str, colour: str, width: float) -> Any:
    path = hv.Path([np.asarray(piece) for piece in pieces], kdims=AXIS_LABELS, label=label)
    return _apply_style(path, color=colour, line_width=width)


def _equator_circle(scene: Scene) -> Any:
    q = glyphs.equator_columns(scene["equator"])
    colours, fills = _mark_colours(q)
    columns = (q["x"], q["y"], q["label"], q["type"], q["theta"], q["lambda_rho"], q["lambda_theta"],
               q["shape"], colours, fills)  # fmt: skip
    names = ["label", "type", "theta", "lambda_rho", "lambda_theta", "marker", "colour", "fill"]
    points = hv.Points(columns, kdims=AXIS_LABELS, vdims=names, label="equator")
    return _apply_style(points, marker=hv.dim("marker"), line_color=hv.dim("colour"), fill_color=hv.dim("fill"),
                   size=11, line_width=2, tools=["hover"])  # fmt: skip


def _critical_points(scene: Scene) -> Any:
    c = glyphs.critical_columns(scene["critical"])
    colours, fills = _mark_colours(c)
    columns = (c["x"], c["y"], c["label"], c["kind"], c["trace"], c["determinant"], c["discriminant"],
               c["shape"], colours, fills)  # fmt: skip
    names = ["label", "kind", "trace", "determinant", "discriminant", "marker", "colour", "fill"]
    points = hv.Points(columns, kdims=AXIS_LABELS, vdims=names, label="critical")
    return _apply_style(points, marker=hv.dim("marker"), line_color=hv.dim("colour"), fill_color=hv.dim("fill"),
                   size=12, line_width=2, tools=["hover"])  # fmt: skip


def _mark_colours(columns: Any) -> tuple[list[str], list[str]]:
    """Return the colours of the marks' outlines and of their insides."""
    colours = [_light(key) for key in columns["colour"]]
    return colours, [c if filled else _light("page") for c, filled in zip(colours, columns["filled"], strict=True)]


def _apply_style(element: Any, **bokeh: Any) -> Any:
    """Style an element for each backend that is loaded; Matplotlib has one marker for all points of an element."""
    if "bokeh" in hv.Store.renderers:
        element = element.opts(**bokeh, backend="bokeh")
    if "matplotlib" in hv.Store.renderers:
        given = {MATPLOTLIB[name]: value for name, value in bokeh.items() if name in MATPLOTLIB}
        element = element.opts(**given, **({"s": bokeh["size"] ** 2} if "size" in bokeh else {}), backend="matplotlib")
    return element
