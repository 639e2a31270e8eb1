"""The gallery: every portrait of the paper, drawn from its numbers when the site is built."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from itertools import groupby

from codim2_core.results.paper import cite
from codim2_core.systems.presets.preset import Preset
from codim2_core.systems.presets.presets import presets

from ...exports.figure import Style, figure
from ...exports.view import view_of

#: Width of a picture in mm; letters are of print's size.
SIZE = 90.0
GALLERY_HEAD = """# Gallery

Every portrait of the paper, drawn from its numbers when this page was made. {click}
`codim2 figure KEY -o FILE` draws it for print.
"""
#: What a click does.
OPENS = "A click opens it in the explorer that serves this page."
MOVES = "A click lets it move: drag C or a limit direction. Its title opens it in the explorer."
SCRIPT = '<script type="module" src="{}figures.js"></script>'


def portrait_svg(key: str, theme: str) -> str:
    """Return the picture of a portrait, theme "light" or "dark"."""
    return figure(view_of(key), Style(size=SIZE, theme=theme, legend=False))


def gallery_page(live: str = "") -> str:
    """Return the page as Markdown; `live`: where the site has an explorer without a server, "" if it has none."""
    return GALLERY_HEAD.format(click=MOVES if live else OPENS) + "".join(_groups(live))


def _groups(live: str) -> Iterator[str]:
    for group, members in groupby(presets.items(), key=lambda item: item[1].group):
        cards = "\n".join(_card(key, preset, live) for key, preset in members)
        yield f'\n## {group}\n\n```{{raw}} html\n<div class="gallery">\n{cards}\n</div>\n```\n'
    if live:
        yield f"\n```{{raw}} html\n{SCRIPT.format(live)}\n```\n"


def _card(key: str, preset: Preset, live: str) -> str:
    title = escape(preset.title)
    shown = "".join(
        f'<img class="only-{theme}" src="_static/portraits/{key}-{theme}.svg" alt="{title}" loading="lazy">'
        for theme in ("light", "dark")
    )
    label = f"<small>{escape(cite(preset.label))}, <code>{key}</code></small>"
    link = f'<a href="{live or "../"}?preset={key}" class="live">'
    if live:
        box = f'<div data-codim2="preset={key}" data-start="press">{shown}</div>'
        return f"<figure>{box}<figcaption>{link}{title}</a> {label}</figcaption></figure>"
    return f"<figure>{link}{shown}</a><figcaption>{title} {label}</figcaption></figure>"
