"""The picture as HoloViews elements, to add to, restyle and lay out in a notebook."""

from __future__ import annotations

from typing import Any

import holoviews as hv
import numpy as np

from codim2_core.scene import Scene

from . import glyphs
from .theme import LIGHT, VIEW

AXES = ["x̄", "ȳ"]
MARKERS = {"circle": "circle", "diamond": "diamond", "triangle": "triangle"}


def elements(scene: Scene) -> dict[str, Any]:
    """Return one HoloViews element for each layer of the picture, from bottom to top.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    dict of str to Element
        "hemisphere", "rho", "theta", "lines_inside", "lines_outside", "outside", "inside", "continuations", "cycles"
        (paths), "equator" and "critical" (points with the inspector's numbers as further dimensions).
    """
    branches = [*scene["nullclines_inside"], *scene["nullclines_outside"]]
    made: dict[str, Any] = {"hemisphere": _circle()}
    for name in ("rho", "theta"):
        made[name] = _paths([b.points for b in branches if b.kind == name], name, LIGHT[name], 1.8)
    for name, inside in (("lines_inside", True), ("lines_outside", False)):
        pieces = [b.points for b in branches if b.kind in ("U1", "U2") and b.inside is inside]
        made[name] = _paths(pieces, name, LIGHT[name], 1.5)
    for name, colour in (("outside", "outside"), ("inside", "orbit"), ("continuations", "continuation")):
        made[name] = _paths(scene[name].points, name, LIGHT[colour], 0.9)
    made["cycles"] = _paths([cycle.points for cycle in scene["cycles"]], "cycles", LIGHT["cycle"], 2.8)
    made["equator"] = _equator(scene)
    made["critical"] = _critical(scene)
    return made


def holoviews(scene: Scene) -> Any:
    """Return the picture of a scene as an overlay.

    Parameters
    ----------
    scene : Scene

    Returns
    -------
    hv.Overlay
        Of the elements that `elements` lists; axes are equal. Load a backend first: ``hv.extension("bokeh")``.

    Examples
    --------
    >>> import codim2_core as c2
    >>> picture = holoviews(c2.Scene(c2.ELinear(-2, 0, -1, (-0.5, 0))))
    >>> len(picture)
    10
    """
    overlay = hv.Overlay(list(elements(scene).values()))
    if "bokeh" not in hv.Store.renderers:
        return overlay
    return overlay.opts(
        xlim=(-VIEW, VIEW), ylim=(-VIEW, VIEW), data_aspect=1, frame_width=500, show_legend=False, backend="bokeh"
    )


def _circle() -> Any:
    return _styled(hv.Ellipse(0, 0, 2, label="hemisphere"), color=LIGHT["equator"], line_width=2)


def _paths(pieces: list[Any], label: str, colour: str, width: float) -> Any:
    path = hv.Path([np.asarray(piece) for piece in pieces], kdims=AXES, label=label)
    return _styled(path, color=colour, line_width=width)


def _equator(scene: Scene) -> Any:
    q = glyphs.equator_columns(scene["equator"])
    colours = [LIGHT["attracting"] if filled else LIGHT["repelling"] for filled in q["filled"]]
    fills = [colour if filled else LIGHT["hollow"] for colour, filled in zip(colours, q["filled"], strict=True)]
    columns = (q["x"], q["y"], q["label"], q["type"], q["theta"], q["lambda_rho"], q["lambda_theta"],
               [MARKERS[shape] for shape in q["shape"]], colours, fills)  # fmt: skip
    names = ["label", "type", "theta", "lambda_rho", "lambda_theta", "marker", "colour", "fill"]
    points = hv.Points(columns, kdims=AXES, vdims=names, label="equator")
    return _styled(points, marker=hv.dim("marker"), line_color=hv.dim("colour"), fill_color=hv.dim("fill"),
                   size=11, line_width=2, tools=["hover"])  # fmt: skip


def _critical(scene: Scene) -> Any:
    c = glyphs.critical_columns(scene["critical"])
    fills = [LIGHT["critical"] if kind.startswith("stable") else LIGHT["hollow"] for kind in c["kind"]]
    columns = (c["x"], c["y"], c["label"], c["kind"], c["trace"], c["determinant"], c["discriminant"], fills)
    names = ["label", "kind", "trace", "determinant", "discriminant", "fill"]
    points = hv.Points(columns, kdims=AXES, vdims=names, label="critical")
    return _styled(points, marker="square", line_color=LIGHT["critical"], fill_color=hv.dim("fill"),
                   size=12, line_width=2, tools=["hover"])  # fmt: skip


def _styled(element: Any, **bokeh: Any) -> Any:
    """Style for the Bokeh backend, if it has been loaded."""
    if "bokeh" not in hv.Store.renderers:
        return element
    return element.opts(**bokeh, backend="bokeh")
