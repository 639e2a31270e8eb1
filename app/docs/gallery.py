"""The gallery: every portrait of the paper, drawn from its numbers when the site is built."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from itertools import groupby
from pathlib import Path

from codim2_core.figures.preset import Preset
from codim2_core.figures.presets import presets
from codim2_core.paper import cite

from ..export.figure import Style, figure
from ..export.view import view_of

#: Width of a picture in mm; letters are of print's size.
SIZE = 90.0
GALLERY_HEAD = """# Gallery

Every portrait of the paper, drawn from its numbers when this page was made. A click opens it in the explorer that
serves this page; `codim2 figure KEY -o FILE` draws it for print.
"""


def write_gallery(folder: Path) -> None:
    """Write the page, and each portrait light and dark, into a folder of sources."""
    pictures = folder / "portraits"
    pictures.mkdir()
    for key in presets:
        view = view_of(key)
        for theme in ("light", "dark"):
            drawn = figure(view, Style(size=SIZE, theme=theme, legend=False))
            (pictures / f"{key}-{theme}.svg").write_text(drawn, encoding="utf-8")
    (folder / "gallery.md").write_text(GALLERY_HEAD + "".join(_groups()), encoding="utf-8")


def _groups() -> Iterator[str]:
    for group, members in groupby(presets.items(), key=lambda item: item[1].group):
        cards = "\n".join(_card(key, preset) for key, preset in members)
        yield f'\n## {group}\n\n```{{raw}} html\n<div class="gallery">\n{cards}\n</div>\n```\n'


def _card(key: str, preset: Preset) -> str:
    title = escape(preset.title)
    shown = "".join(
        f'<img class="only-{theme}" src="_static/portraits/{key}-{theme}.svg" alt="{title}" loading="lazy">'
        for theme in ("light", "dark")
    )
    said = f"{title} <small>{escape(cite(preset.label))}, <code>{key}</code></small>"
    return f'<figure><a href="../?preset={key}" class="live">{shown}</a><figcaption>{said}</figcaption></figure>'
