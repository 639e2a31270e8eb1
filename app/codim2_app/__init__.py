"""Web explorer of the dynamics near an isolated codimension-2 discontinuity set.

``explorer()`` is the live widget of a notebook, ``holoviews(scene)`` the same picture as HoloViews elements,
``svg(result)`` a small picture of a scene or another result, ``plot(result, ax)`` the same in Matplotlib,
``tables(scene)`` all that is drawn as pandas data frames.
They are imported when they are first used, so that importing this package costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .exports.small.axes import plot
    from .exports.small.results import svg
    from .exports.tables import data_frames as tables
    from .picture.draw.overlay import holoviews
    from .view.notebook import explorer

__all__ = ["explorer", "holoviews", "plot", "svg", "tables"]

_HOMES = {
    "explorer": ("view.notebook", "explorer"),
    "holoviews": ("picture.draw.overlay", "holoviews"),
    "plot": ("exports.small.axes", "plot"),
    "svg": ("exports.small.results", "svg"),
    "tables": ("exports.tables", "data_frames"),
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    if name == "__version__":
        return import_module("codim2_core").__version__
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, own = _HOMES[name]
    return getattr(import_module(f".{module}", __name__), own)


def __dir__() -> list[str]:
    """Return the public names, for the Tab key."""
    return list(__all__)
