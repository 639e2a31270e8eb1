"""The Bokeh figure of the picture: ranges, tools and tooltips. What is seen in it the browser draws by itself.

`static/painter.js` adds two renderers of its own, which draw the packed frames; here are only the marks that have a
tooltip, unseen. So a page's document is small, and every model is ``syncable=False``: BokehJS must not send ranges,
colours or arrays back to the server.
"""

from __future__ import annotations

from bokeh.models import (
    AllIndices,
    BoxZoomTool,
    CDSView,
    ColumnDataSource,
    GlyphRenderer,
    HoverTool,
    PanTool,
    Plot,
    Range1d,
    ResetTool,
    SaveTool,
    Scatter,
    UnionRenderers,
    WheelZoomTool,
)

from .theme import NEAREST, VIEW, WIDEST

EQUATOR_TOOLTIP = """<div class="codim2-tip"><b>@label</b> @type<br>θ = @theta_text<br>
λ_ρ = @rho_text<br>λ_θ = @ang_text</div>"""
CRITICAL_TOOLTIP = """<div class="codim2-tip"><b>@label</b> @kind<br>(c, s) = @e_text<br>(x₂, y₂) = @x2_text<br>
tr J = @trace_text, det J = @det_text<br>eigenvalues @eig_text<br>z' = @slow_text</div>"""


def make_figure() -> Plot:
    """Return the empty picture: equal axes on [-VIEW, VIEW], and marks "equator" and "critical" with their tooltips."""
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
    glyph = Scatter(x="x", y="y", size=16, fill_alpha=0, line_alpha=0)
    whole, policy = AllIndices(), UnionRenderers()
    for name, tooltip in (("equator", EQUATOR_TOOLTIP), ("critical", CRITICAL_TOOLTIP)):
        source = ColumnDataSource(data={"x": [], "y": []}, selection_policy=policy)
        marks = GlyphRenderer(
            name=name, data_source=source, view=CDSView(filter=whole), glyph=glyph,
            nonselection_glyph=None, selection_glyph=None, muted_glyph=None,
        )  # fmt: skip
        plot.renderers.append(marks)
        plot.add_tools(HoverTool(renderers=[marks], tooltips=tooltip, mode="mouse", point_policy="snap_to_data"))
    for model in plot.references():
        model.syncable = False
    return plot


def _range() -> Range1d:
    return Range1d(start=-VIEW, end=VIEW, min_interval=2 * NEAREST, max_interval=2 * WIDEST)
