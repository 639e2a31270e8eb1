"""The Bokeh figure of the picture: ranges and tools. What is seen in it the browser draws by itself.

`static/picture/painter.js` adds two renderers of its own, which draw the packed frames. So a page's document is small,
and every model is ``syncable=False``: BokehJS must not send ranges, colours or arrays back to the server.
"""

from __future__ import annotations

from bokeh.models import (
    BoxZoomTool,
    PanTool,
    Plot,
    Range1d,
    ResetTool,
    SaveTool,
    Span,
    WheelZoomTool,
)

from .theme import HALF_VIEW, MAX_HALF_VIEW, NEAREST


def make_figure() -> Plot:
    """Return the empty picture: equal axes on [-VIEW, VIEW]."""
    plot = Plot(
        name="picture",
        title=None,
        x_range=_range(),
        y_range=_range(),
        output_backend="canvas",
        sizing_mode="stretch_both",
        min_border=0,
        outline_line_color=None,
        background_fill_color=None,
        border_fill_color=None,
        toolbar_location=None,
        lod_threshold=None,
    )
    pan, wheel = PanTool(), WheelZoomTool(modifiers="ctrl")
    plot.add_tools(pan, wheel, BoxZoomTool(match_aspect=True), ResetTool(), SaveTool())
    # An empty plot is warned of in the host's log, for each visitor: Bokeh does not know what the browser adds.
    plot.add_layout(Span(location=0.0, dimension="width", visible=False))
    for model in plot.references():
        model.syncable = False
    return plot


def _range() -> Range1d:
    return Range1d(start=-HALF_VIEW, end=HALF_VIEW, min_interval=2 * NEAREST, max_interval=2 * MAX_HALF_VIEW)
