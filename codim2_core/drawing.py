"""Pictures of results: the core computes, and the app, which is installed with it, draws what it is asked for.

`Scene.plot` and the ``_repr_svg_`` of results ask here. The app is imported then and not before; without it, as where
the core alone has been copied, a notebook shows the tables.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

#: The package that draws: ``holoviews(scene)`` is an overlay, ``svg(result)`` a small picture,
#: ``plot(result, ax)`` the same in Matplotlib.
DRAWER = "codim2_app"


def overlay(scene: Any) -> Any:
    """Return the picture of a scene as a HoloViews overlay.

    Raises
    ------
    ValueError
        The app is not there.
    """
    try:
        drawer = import_module(DRAWER)
    except ImportError:
        raise ValueError(f"Scene.plot is drawn by {DRAWER}, which is missing: pip install codim2.") from None
    return drawer.holoviews(scene)


def plot(result: Any, ax: Any) -> Any:
    """Draw a small picture of a result into Matplotlib axes, and return them.

    Raises
    ------
    ValueError
        Matplotlib or the app is not there.
    """
    try:
        drawer = import_module(DRAWER)
    except ImportError:
        raise ValueError(f"plot is drawn by {DRAWER}, which is missing: pip install codim2.") from None
    return drawer.plot(result, ax)


def svg(result: Any) -> str | None:
    """Return a small picture of a result as SVG; None without the app."""
    try:
        drawer = import_module(DRAWER)
    except ImportError:
        return None
    return drawer.svg(result)
