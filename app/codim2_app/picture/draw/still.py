"""The picture as a file of its own: an SVG with its colours in it."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from html import escape

from .svg import draw
from .theme import themes
from .vector.parts import VIEWBOX_SIDE

_VARIABLE = re.compile(r"var\(--([\w-]+)\)")


def still(buffer: bytes, layers: Collection[str], theme: str = "light", width: int = 560) -> str:
    """Return the picture of one packed frame as an SVG file, some 30 kB.

    Parameters
    ----------
    buffer : bytes
        A frame that holds everything.
    layers : collection of str
        Those that are shown.
    theme : {"light", "dark"}
    width : int
        In pixels, as is its height.
    """
    colours = themes()[theme]
    inner = draw(buffer, layers).replace(
        "<svg ",
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{width}" font-family="sans-serif" ',
        1,
    )
    ground = f'<rect width="{VIEWBOX_SIDE}" height="{VIEWBOX_SIDE}" fill="var(--page)"/>'
    clear = '<text paint-order="stroke" stroke="var(--page)" stroke-width="6" '  # of the lines behind it
    whole = inner.replace(">", f">{ground}", 1).replace("<text ", clear)
    return fill_colours(whole, colours)


def fill_colours(svg: str, colours: Mapping[str, str]) -> str:
    """Return an SVG with colours by name in place of the style sheet's custom properties."""
    return _VARIABLE.sub(lambda name: colours[name[1]], svg)


def page_of(svg: str, sentence: str, title: str) -> str:
    """Return a page that shows a picture and its sentence."""
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(title)}</title>\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        "<style>body{margin:2em auto;padding:0 1em;max-width:40em;font:16px/1.5 sans-serif}\n"
        "svg{max-width:100%;height:auto}</style>"
        f"</head>\n<body>{svg}<p>{escape(sentence)}</p></body></html>\n"
    )
