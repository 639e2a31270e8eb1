"""Pictures of results: the core computes, and the app, which is installed with it, draws.

`Scene.plot` and the ``_repr_svg_`` of results ask here. The app is imported then and not before; without it, as where
the core alone has been copied, a notebook shows the tables.
"""

from __future__ import annotations

from base64 import b64encode
from importlib import import_module
from pathlib import Path
from typing import Any

#: The package that draws: ``holoviews(scene)`` is an overlay, ``svg(result)`` a small picture,
#: ``plot(result, ax)`` the same in Matplotlib.
DRAWER = "codim2_app"


def _drawer() -> Any:
    try:
        return import_module(DRAWER)
    except ImportError:
        raise ValueError(f"Pictures are drawn by {DRAWER}, which is missing: pip install codim2.") from None


def overlay(scene: Any) -> Any:
    """Return the picture of a scene as a HoloViews overlay; raises ValueError without the app."""
    return _drawer().holoviews(scene)


def plot(result: Any, ax: Any) -> Any:
    """Draw a small picture of a result into Matplotlib axes, and return them; raises ValueError without them."""
    return _drawer().plot(result, ax)


def save(result: Any, path: str | Path) -> None:
    """Write the picture of a result as SVG, PNG or PDF; raises ValueError for other names, or without the app."""
    kind = Path(path).suffix.lower()
    if kind not in (".svg", ".png", ".pdf"):
        raise ValueError(f"path is {str(path)!r}; give a name that ends with .svg, .png or .pdf.")
    try:
        picture = _drawer().svg(result)
    except TypeError:
        what = type(result).__name__
        raise ValueError(f"A {what} has no picture; draw its Scene, or write its table with to_csv.") from None
    printing = import_module(f"{DRAWER}.exports.printing")
    Path(path).write_bytes(picture.encode() if kind == ".svg" else getattr(printing, kind[1:])(picture))


def image(result: Any) -> str:
    """Return the picture of a result as an HTML image, which notebooks that are not trusted show too; "" without."""
    picture = result._repr_svg_()
    if not picture:
        return ""
    return (
        f'<img alt="{type(result).__name__}" src="data:image/svg+xml;base64,{b64encode(picture.encode()).decode()}"/>'
    )


def svg(result: Any) -> str | None:
    """Return a small picture of a result as SVG; None without the app."""
    try:
        drawer = import_module(DRAWER)
    except ImportError:
        return None
    return drawer.svg(result)
