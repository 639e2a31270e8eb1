"""A page with one picture, whose place an explorer without a server takes: what `codim2 static` wrote is next to it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from html import escape

from .describe import place_words, psi_words, system_words
from .figure import Style, figure
from .live import Slider, html_page
from .view import OWN, View

STYLE = Style(size=160.0, legend=False)


def figure_page(view: View, sliders: Sequence[str], explorer: str) -> bytes:
    """Return the page.

    Parameters
    ----------
    view : View
    sliders : sequence of ``NAME`` or ``NAME=LOW,HIGH``
        What stands below the picture.
    explorer : str
        Where the page finds the folder.

    Raises
    ------
    ValueError
        A slider is none, or the system is one from Python, which no link carries.
    """
    if not view.query:
        raise ValueError("A system from Python has no link. Type it in the explorer, and give the link of that.")
    chosen = [Slider.from_text(view, text) for text in sliders]
    given = {one.name: [one.low, one.high] for one, text in zip(chosen, sliders, strict=True) if "=" in text}
    view = replace(view, values={**view.values, "ranges": {**view.values["ranges"], **given}})
    query = f"{view.query}&controls={','.join(one.name.removeprefix(OWN) for one in chosen)}"
    setting = "; ".join(filter(None, (system_words(view), psi_words(view), place_words(view))))
    title, folder = view.title, explorer.rstrip("/")
    picture = re.sub(r"^<\?xml.*?\?>\s*", "", figure(view, STYLE))
    body = (
        f'<div data-codim2="{escape(query)}">{picture}</div>\n'
        f'<p class="note">At first: {escape(setting)}.</p>\n'
        f'<script type="module" src="{escape(folder)}/figures.js"></script>'
    )
    return html_page(title, body).encode()
