"""The page that goes through the paper figure by figure: ours, drawn from numbers, and the link that opens each.

In its text a heading is the paper's label. A fence ``figures`` lists the parts of a figure, one a line: a preset, or
a drawing (`drawn_figures`) with what it opens, "drawing>preset" or "drawing>query of a link".
"""

from __future__ import annotations

import re
from html import escape

from codim2_core.results.paper import PRINTED
from codim2_core.systems.presets.presets import presets

_FIGURES = re.compile(r"^## (fig:\w+)$(.*?)^```figures\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def figures_page(text: str, explorer: str) -> str:
    """Return the page as Markdown, each figure with its pictures; `explorer`: its address from the site."""

    def section(match: re.Match[str]) -> str:
        label, seen, parts = match.groups()
        printed, title = PRINTED[label]
        return f"## {printed}: {title}\n{seen}{_cards(parts.split(), title, explorer)}"

    return _FIGURES.sub(section, text)


def _cards(parts: list[str], title: str, explorer: str) -> str:
    letters = [f"({chr(ord('a') + k)}) " for k in range(len(parts))] if len(parts) > 1 else [""]
    cards = "\n".join(_card(*one, title, explorer) for one in zip(parts, letters, strict=True))
    return f'```{{raw}} html\n<div class="gallery figures">\n{cards}\n</div>\n```'


def _card(part: str, letter: str, title: str, explorer: str) -> str:
    drawing, _, opened = part.partition(">")
    opened = opened or (drawing if drawing in presets else "")
    said = escape(presets[opened].title if opened in presets else title)
    if part in presets:
        shown = "".join(_image(f"portraits/{part}-{theme}", said, f"only-{theme}") for theme in ("light", "dark"))
    else:
        shown = _image(f"paper/{drawing}", said, "drawn")
    query = escape(f"preset={opened}" if opened in presets else opened)
    caption = f'{letter}<a class="live" href="{explorer}?{query}">{said}</a>' if opened else letter
    return f"<figure>{shown}<figcaption>{caption}</figcaption></figure>"


def _image(path: str, said: str, kind: str) -> str:
    return f'<img class="{kind}" src="_static/{path}.svg" alt="{said}" loading="lazy">'
