"""The report as one HTML page that needs no network: texts, tables, and Bokeh plots whose curves can be hidden."""

from __future__ import annotations

import re
from html import escape

from bokeh.embed import components
from bokeh.layouts import gridplot
from bokeh.models import Legend
from bokeh.plotting import figure
from bokeh.resources import Resources

from .pictures import Plot, style

STYLE = """body { font: 15px/1.5 system-ui, sans-serif; max-width: 1180px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px } td, th { border: 1px solid #ddd; padding: 2px 8px }
td:not(:first-child) { text-align: right }"""


def bokeh_figure(drawn: Plot):
    """One log-log plot; a click on the legend hides a curve."""
    styles = style(drawn.lines)
    result = figure(
        title=drawn.title, x_axis_type="log", y_axis_type="log", x_axis_label=drawn.x, y_axis_label=drawn.y,
        width=560, height=400, tools="pan,wheel_zoom,box_zoom,reset,save,hover",
        tooltips=[("", "$name"), (drawn.x, "$x"), (drawn.y, "$y")],
    )  # fmt: skip
    items = []
    for line in drawn.lines:
        colour, dash = styles[line.name]
        x, y = zip(*line.points, strict=True)
        options = {"color": colour, "name": line.name}
        drawn_line = result.line(x, y, line_width=3 if line.bold else 1.3, line_dash=dash or "solid", **options)
        items.append((line.name, [drawn_line, result.scatter(x, y, size=6 if line.bold else 4, **options)]))
    result.add_layout(Legend(items=items, click_policy="hide", label_text_font_size="9px", spacing=-4), "right")
    return result


def _inline(text: str) -> str:
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text, quote=False))


def html_of(markdown: str) -> str:
    """Paragraphs, headings and tables of the little Markdown that reports are written in, as HTML."""
    out = []
    for block in re.split(r"\n\s*\n", markdown.strip()):
        lines = block.splitlines()
        rows = [line for line in lines if line.startswith("|")]
        if rows:
            cells = [[_inline(cell.strip()) for cell in row.strip("|").split("|")] for row in rows]
            out.append("<table><tr>" + "".join(f"<th>{cell}</th>" for cell in cells[0]) + "</tr>")
            out += ["<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in cells[2:]]
            out.append("</table>")
            lines = [line for line in lines if not line.startswith("|")]
        if lines and lines[0].startswith("#"):
            level = len(lines[0]) - len(lines[0].lstrip("#"))
            out.append(f"<h{level}>{_inline(lines.pop(0).lstrip('# '))}</h{level}>")
        if lines:
            out.append(f"<p>{_inline(' '.join(lines))}</p>")
    return "\n".join(out)


def page(title: str, sections: list[tuple[str, list[Plot]]]) -> str:
    """Return the page: sections of Markdown, each followed by its plots."""
    body, scripts = [], []
    for text, plots in sections:
        body.append(html_of(text))
        if plots:
            figures = [bokeh_figure(drawn) for drawn in plots]
            script, place = components(gridplot(figures, ncols=2, toolbar_location=None))
            scripts.append(script)
            body.append(place)
    resources = Resources(mode="inline", components=["bokeh"])
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>{resources.render()}'
    return f'<!doctype html><html lang="en"><head>{head}</head><body>{"".join(body)}{"".join(scripts)}</body></html>\n'
