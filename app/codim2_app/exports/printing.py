"""PNG and PDF of a figure, made of its SVG by Typst.

Typst draws both with fonts that it brings along, needs no other program and no library of the system, and keeps the
lines and letters of a PDF as such. It is an extra: whoever hosts pages needs none of this.
"""

from __future__ import annotations

from functools import cache
from importlib.util import find_spec
from typing import Any

MISSING = "PNG and PDF are made by Typst, which is missing: pip install 'codim2[figures]', or ask for SVG."
#: No colour of its own: where the figure covers a part of the last pixels, a white one would be a line at a dark edge.
PAGE = b'#set page(width: auto, height: auto, margin: 0pt, fill: none)\n#image("figure.svg")\n'
#: Dots per inch of a PNG at scale 1, as a screen has them; largest scale.
DPI, MAX_SCALE = 96, 12.0


@cache
def has_typst() -> bool:
    """Whether Typst is installed, which is looked for once: each page needs it."""
    return find_spec("typst") is not None


def png(svg: str, scale: float = 3.0) -> bytes:
    """Return an SVG file as PNG.

    Parameters
    ----------
    svg : str
    scale : float
        1 is 96 dots per inch.

    Raises
    ------
    ValueError
        The scale is out of range, or Typst is missing.
    """
    if not 0 < scale <= MAX_SCALE:
        raise ValueError(f"scale is {scale:g}; give a number above 0, at most {MAX_SCALE:g}.")
    return _typst().compile(_input(svg), format="png", ppi=DPI * scale, font_paths=_fonts())


def pdf(svg: str) -> bytes:
    """Return an SVG file as PDF.

    Raises
    ------
    ValueError
        Typst is missing.
    """
    return _typst().compile(_input(svg), format="pdf", font_paths=_fonts())


def _input(svg: str) -> dict[str, bytes]:
    return {"main": PAGE, "figure.svg": svg.encode()}


def _typst() -> Any:
    try:
        import typst
    except ImportError:
        raise ValueError(MISSING) from None
    return typst


@cache
def _fonts() -> Any:
    """Return the fonts that Typst brings along: a figure looks the same on all machines."""
    return _typst().Fonts(include_system_fonts=False)
