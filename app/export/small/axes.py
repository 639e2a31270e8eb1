"""Small pictures of results in Matplotlib, to put beside one's own: the same as the notebook's, in the same colours."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...draw.theme import themes
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
        import matplotlib as mpl
        from matplotlib import pyplot
    except ImportError:
        raise ValueError("plot draws with Matplotlib, which is missing: pip install matplotlib.") from None
    shown: Sketch = sketch(result)
    axes = pyplot.figure().add_subplot() if ax is None else ax
    colour = themes()["light"]
    if isinstance(shown, LineChart):
        kinds = dict(zip(dict.fromkeys(name for name, *_ in shown.lines), COLOURS * 9, strict=False))
        told: set[str] = set()
        for name, x, y in shown.lines:
            axes.plot(x, y, color=colour[kinds[name]], lw=LINE_WIDTH, label="_" * (name in told) + name)
            told.add(name)
        axes.set(xlabel=shown.across, ylabel=shown.up)
        if len(kinds) > 1:
            axes.legend(frameon=False)
    elif isinstance(shown, RegionChart):
        for name, polygons in shown.areas:
            path = mpl.path.Path.make_compound_path(*(mpl.path.Path(np.asarray(p), closed=False) for p in polygons))
            axes.add_patch(mpl.patches.PathPatch(
                path, fc=colour[region_colour(name, colour)], ec=colour["soft"], lw=0.6, alpha=0.6, label=name
            ))  # fmt: skip
        axes.set(xlim=shown.spans[0], ylim=shown.spans[1], xlabel=shown.across, ylabel=shown.up)
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
    angle = np.linspace(0.0, 2.0 * np.pi, 361)
    axes.plot(np.cos(angle), np.sin(angle), color=colour["ink"], lw=0.8)
    axes.set_aspect("equal")
