"""The Bokeh figure of the picture, made once; from then on only the contents of its sources change.

The browser fills the sources from packed frames, so every model here is ``syncable=False``: BokehJS must not
send arrays, ranges or colours back to the server.
"""

from __future__ import annotations

from typing import Any

from bokeh.core.properties import value
from bokeh.models import (
    AllIndices,
    AnnularWedge,
    BoxZoomTool,
    Circle,
    ColumnDataSource,
    GlyphRenderer,
    HoverTool,
    ImageURL,
    Line,
    PanTool,
    Plot,
    Range1d,
    ResetTool,
    SaveTool,
    Scatter,
    Text,
    UnionRenderers,
    WheelZoomTool,
)
from bokeh.models.glyph import Glyph

from .layers import TRACES, painted
from .theme import DISCS, RING, VIEW, themes

LIGHT = themes()["light"]
FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif"

EQUATOR_TOOLTIP = """<div class="codim2-tip"><b>@label</b> @type<br>θ = @theta_text<br>
λ_ρ = @rho_text<br>λ_θ = @ang_text</div>"""
CRITICAL_TOOLTIP = """<div class="codim2-tip"><b>@label</b> @kind<br>(c, s) = @e_text<br>(x₂, y₂) = @x2_text<br>
tr J = @trace_text, det J = @det_text<br>eigenvalues @eig_text<br>z' = @slow_text</div>"""


def make_figure() -> Plot:
    """Return the empty picture: equal axes on [-VIEW, VIEW], the shaded hemisphere, and a source per layer.

    Sources are found by name: those of the parts of `layers.LAYERS` ("rho_inside", ..., "continuations")
    with columns x, y (pieces separated by NaN); "outcomes" (start, end, colour, hatch);
    "arrows:<layer>" with x, y, angle; "equator", "critical" and "sense" with the columns of `codim2_app.draw.glyphs`.
    """
    plot = Plot(
        name="picture",
        x_range=Range1d(start=-VIEW, end=VIEW, syncable=False),
        y_range=Range1d(start=-VIEW, end=VIEW, syncable=False),
        output_backend="canvas",
        sizing_mode="stretch_both",
        min_border=0,
        outline_line_color=None,
        background_fill_color=None,
        border_fill_color=None,
        toolbar_location=None,
        lod_threshold=None,
        syncable=False,
    )
    _add(plot, "discs", Circle(x="x", y="y", radius="r", fill_color=LIGHT["shade"],
                               fill_alpha=float(LIGHT["shade-alpha"]), line_color=None),
         x=[0.0] * len(DISCS), y=[0.0] * len(DISCS), r=list(DISCS))  # fmt: skip
    _add(plot, "basins", ImageURL(url="url", x=-1, y=1, w=2, h=2), url=[])
    _add(plot, "outcomes", AnnularWedge(x=0, y=0, inner_radius=RING[0], outer_radius=RING[1], start_angle="start",
                                        end_angle="end", fill_color="colour", line_color=None, hatch_pattern="hatch",
                                        hatch_color=LIGHT["page"], hatch_scale=7, hatch_weight=1.4),
         start=[], end=[], colour=[], hatch=[])  # fmt: skip
    parts = [*(part for layer in painted() for part in layer.parts), *TRACES]
    for part in parts:
        _add(plot, part.name, Line(x="x", y="y", line_color=LIGHT[part.colour], line_width=part.width,
                                   line_join="round", line_dash=[*map(int, part.dash)]),
             x=[], y=[])  # fmt: skip
    for part in parts:
        if part.arrows:
            _add(plot, f"arrows:{part.name}", Scatter(x="x", y="y", angle="angle", marker="triangle", size=6.5,
                                                      fill_color=LIGHT[part.colour], line_color=None),
                 x=[], y=[], angle=[])  # fmt: skip
    _add(plot, "circle", Circle(x="x", y="y", radius="r", fill_color=None, line_color=LIGHT["ink"],
                                line_width=2.0), x=[0.0], y=[0.0], r=[1.0])  # fmt: skip
    _add(plot, "sense", Scatter(x="x", y="y", angle="angle", marker="triangle", size=10,
                                fill_color=LIGHT["ink"], line_color=None), x=[], y=[], angle=[])  # fmt: skip
    marks: dict[str, Any] = {"x": "x", "y": "y", "marker": "marker", "fill_color": "fill", "line_color": "colour"}
    equator = _add(plot, "equator", Scatter(size="size", line_width=2.4, **marks),
                   **_columns("label_x", "label_y", "size"))  # fmt: skip
    critical = _add(plot, "critical", Scatter(size=15, line_width=2.6, **marks), **_columns())
    beside: dict[str, Any] = {"text_align": "left", "x": "x", "y": "y", "x_offset": 13, "y_offset": -11}
    around: dict[str, Any] = {"text_align": "center", "x": "label_x", "y": "label_y"}
    for renderer, size, place in ((equator, "15px", around), (critical, "16px", beside)):
        text = Text(
            text="text", text_color=LIGHT["ink"], text_font=value(FONT), text_font_size=size, text_font_style="bold",
            text_baseline="middle", background_fill_color=LIGHT["page"], background_fill_alpha=0.72, **place,
        )  # fmt: skip
        text.update(padding=2, border_radius=3)
        _freeze(plot.add_glyph(renderer.data_source, text, name=f"text:{renderer.name}"))  # type: ignore[arg-type]
    pan, wheel = PanTool(), WheelZoomTool(modifiers="ctrl")
    plot.add_tools(
        pan, wheel, BoxZoomTool(match_aspect=True), ResetTool(), SaveTool(),
        HoverTool(renderers=[equator], tooltips=EQUATOR_TOOLTIP, mode="mouse", point_policy="snap_to_data"),
        HoverTool(renderers=[critical], tooltips=CRITICAL_TOOLTIP, mode="mouse", point_policy="snap_to_data"),
    )  # fmt: skip
    _add(plot, "motion_at", Scatter(x="x", y="y", size=12, line_width=2.4, fill_color=LIGHT["motion"],
                                    line_color=LIGHT["page"]), x=[], y=[])  # fmt: skip
    everything, policy = AllIndices(), UnionRenderers()
    for renderer in plot.renderers:  # one each for all: every patch walks through all models of a document
        if isinstance(renderer, GlyphRenderer):
            renderer.view.filter = everything
            renderer.data_source.update(selection_policy=policy)
    for model in plot.references():
        model.syncable = False
    return plot


def _columns(*more: str) -> dict[str, list[Any]]:
    """Return empty columns of a layer of marks."""
    return {name: [] for name in ("x", "y", "marker", "fill", "colour", "text", *more)}


def _add(plot: Plot, name: str, glyph: Glyph, **columns: Any) -> GlyphRenderer:
    """Add a renderer with a named source; a glyph neither fades when something else is selected nor when hovered."""
    return _freeze(plot.add_glyph(ColumnDataSource(data=columns, name=name, syncable=False), glyph, name=name))


def _freeze(renderer: GlyphRenderer) -> GlyphRenderer:
    renderer.nonselection_glyph = None
    renderer.selection_glyph = None
    renderer.muted_glyph = None
    return renderer
