"""Small pictures of results in Matplotlib, for one's own figures: the same as the notebook's, in the same colours."""

from __future__ import annotations

from typing import Any

import numpy as np

from codim2_core.scene import Scene

from ...picture.draw.layers import layers_in_paint_order
from ...picture.draw.theme import HALF_VIEW, themes
from .results import sketch
from .sketch import BASIN_COLOURS, COLOURS, Cells, Curves, LineChart, RegionChart, Sketch, region_colour

LINE_WIDTH = 1.3  # points


def plot(result: Any, ax: Any = None) -> Any:
    """Draw a result into Matplotlib axes.

    Parameters
    ----------
    result
        One that a notebook shows as a picture.
    ax : matplotlib.axes.Axes, optional
        Left out, a figure is made.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ValueError
        Matplotlib is not installed.
    """
    try:
        from matplotlib import pyplot
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path
    except ImportError:
        raise ValueError("plot draws with Matplotlib, which is missing: pip install matplotlib.") from None
    axes = pyplot.figure().add_subplot() if ax is None else ax
    colour = themes()["light"]
    if isinstance(result, Scene):
        _draw_scene(result, axes, colour)
        return axes
    shown: Sketch = sketch(result)
    if isinstance(shown, LineChart):
        kinds = dict(zip(dict.fromkeys(name for name, *_ in shown.lines), COLOURS * 9, strict=False))
        named: set[str] = set()
        for name, x, y in shown.lines:
            axes.plot(x, y, color=colour[kinds[name]], lw=LINE_WIDTH, label="_" * (name in named) + name)
            named.add(name)
        for kind in dict.fromkeys(kind for kind, *_ in shown.marks):
            places = [(x, y) for name, x, y in shown.marks if name == kind]
            axes.plot(*np.transpose(places), "o", mfc="none", label=kind)
        axes.set(xlabel=shown.across, ylabel=shown.up)
        if len(kinds) + len(shown.marks) > 1:
            axes.legend(frameon=False)
    elif isinstance(shown, RegionChart):
        named = set[str]()
        for name, polygons in shown.areas:
            path = Path.make_compound_path(*(Path(np.asarray(p), closed=False) for p in polygons))
            axes.add_patch(PathPatch(
                path, fc=colour[region_colour(name, colour)], ec=colour["soft"], lw=0.6, alpha=0.6,
                label="_" * (name in named) + name,
            ))  # fmt: skip
            named.add(name)
        axes.set(xlim=shown.spans[0], ylim=shown.spans[1], xlabel=shown.across, ylabel=shown.up)
        axes.legend(frameon=False, fontsize="small")
    else:
        _draw_picture(shown, axes, colour)
    return axes


def _draw_picture(shown: Curves | Cells, axes: Any, colour: Any) -> None:
    """Draw what lies over the hemisphere: the equator is a circle of radius 1."""
    if isinstance(shown, Curves):
        for name, points in shown.pieces:
            axes.plot(*np.asarray(points).T, color=colour[name], lw=LINE_WIDTH)
        if len(shown.places):
            axes.plot(*np.asarray(shown.places).T, "o", color=colour["orbit"], ms=3)
    else:
        from matplotlib.colors import ListedColormap

        names = [BASIN_COLOURS[i % len(BASIN_COLOURS)] for i in range(len(shown.names))]
        left, right, bottom, top = shown.box
        axes.imshow(
            np.ma.masked_less(shown.cells, -1), origin="lower", extent=(left, right, bottom, top), alpha=0.45,
            cmap=ListedColormap([colour[name] for name in ("undecided", *names)]), vmin=-1.5, vmax=len(names) - 0.5,
            interpolation="nearest",
        )  # fmt: skip
        for name, word in zip(shown.names, names, strict=True):
            axes.plot([], [], "s", color=colour[word], label=name)
        if shown.names:
            axes.legend(frameon=False, loc="upper left")
    _draw_equator(axes, colour)


def _draw_equator(axes: Any, colour: Any) -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(angle), np.sin(angle), color=colour["ink"], lw=0.8)
    axes.set_aspect("equal")


def _draw_scene(scene: Scene, axes: Any, colour: Any) -> None:
    """Draw a portrait: its curves with arrows, and limit directions and critical sets with their names."""
    for layer in layers_in_paint_order():
        if layer.hidden or (layer.optional and not len(scene.launch)):
            continue
        for part in layer.parts:
            offsets, points = part.pieces(scene[part.scene])
            lines = [line for line in np.split(points, offsets[1:-1]) if len(line) > 1]
            for i, line in enumerate(lines):
                name = layer.words if i == 0 and part is layer.parts[0] else None
                axes.plot(*line.T, color=colour[part.colour], lw=0.6 * part.width, label=name)
                if part.arrows and len(line) > 2:
                    middle = len(line) // 2
                    axes.annotate(
                        "",
                        line[middle],
                        line[middle - 1],
                        arrowprops={"arrowstyle": "->", "color": colour[part.colour]},
                    )
    _draw_equator(axes, colour)
    for row in scene.to_frame().itertuples():
        filled = row.kind.startswith(("attracts,", "stable"))
        mark = "o" if row.name.startswith("Q") else "s"
        tone = colour["attr" if mark == "o" else "crit"]
        axes.plot(row.p_1, row.p_2, mark, color=tone, mfc=tone if filled else "white", zorder=3)
        axes.annotate(row.name, (row.p_1, row.p_2), (5, 5), textcoords="offset points", color=tone)
    axes.set(xlim=(-HALF_VIEW, HALF_VIEW), ylim=(-HALF_VIEW, HALF_VIEW))
    axes.legend(frameon=False, fontsize="small", loc="upper left", bbox_to_anchor=(1.0, 1.0))
