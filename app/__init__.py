"""Web explorer of the dynamics near an isolated codimension-2 discontinuity set.

``explorer()`` is the live widget of a notebook, ``holoviews(scene)`` the same picture as HoloViews elements,
``svg(result)`` a small picture of a scene or another result, ``tables(scene)`` all that is drawn as pandas data frames.
They are imported when they are first used, so that importing this package costs nothing.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .draw.overlay import holoviews
    from .export.small.results import svg
    from .export.tables import data_frames as tables
    from .view.notebook import explorer

__all__ = ["explorer", "holoviews", "svg", "tables"]


def __getattr__(name: str) -> Any:
    if name == "explorer":
        from .view.notebook import explorer

        return explorer
    if name == "holoviews":
        from .draw.overlay import holoviews

        return holoviews
    if name == "svg":
        from .export.small.results import svg

        return svg
    if name == "tables":
        from .export.tables import data_frames

        return data_frames
    if name == "__version__":
        from codim2_core import __version__

        return __version__
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
