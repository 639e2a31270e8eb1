"""Place labels next to their marks, over no other label and no mark."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

#: Widths of letters over the size of the font: a little more than those of Times, in which or in something like it a
#: reader sees them.
NARROW_LETTER, WIDE_LETTER, CAPITAL, OTHER = 0.34, 0.84, 0.76, 0.54
COMBINING = "\u0304\u0305"  # bars over the letter before

#: Steps tried from where a label would stand, in sizes of the font, the shortest first: across, up.
LABEL_OFFSETS = tuple(
    (0.7 * ring * math.cos(k * math.pi / 6), 0.7 * ring * math.sin(k * math.pi / 6))
    for ring in range(8)
    for k in range(12 if ring else 1)
)


@dataclass(frozen=True)
class LabelBox:
    """A rectangle of the drawing: its corner, y downward, and its size."""

    x: float
    y: float
    width: float
    height: float

    def meets(self, other: LabelBox) -> bool:
        """Whether both have points in common."""
        return (
            self.x < other.x + other.width
            and other.x < self.x + self.width
            and self.y < other.y + other.height
            and other.y < self.y + self.height
        )

    def fits(self, width: float, height: float) -> bool:
        """Whether it is in a drawing of this size."""
        return self.x >= 0 and self.y >= 0 and self.x + self.width <= width and self.y + self.height <= height


def width_of(text: str, size: float) -> float:
    """Return how wide a text is at most."""
    return size * sum(map(_width, text))


def _width(letter: str) -> float:
    if letter in COMBINING:
        return 0.0
    if letter in "ijlftr .,:;'′|()[]₁₂₃₄₅₆₇₈₉":
        return NARROW_LETTER
    if letter in "mwMW⊙⊗":
        return WIDE_LETTER
    return CAPITAL if letter.isupper() else OTHER


def clear_of(
    taken: Sequence[LabelBox], text: str, x: float, y: float, anchor: str, size: float, width: float, height: float
) -> LabelBox:
    """Return the box of a label whose middle height is at y, as near to (x, y) as there is room.

    Parameters
    ----------
    taken : sequence of LabelBox
        What it must not stand over.
    anchor : {"start", "middle"}
        What of it is at x.
    size : float
        Of the font.
    width, height : float
        Of the drawing, in which it stays.
    """
    wide, high = width_of(text, size), 1.1 * size
    # a label next to its mark may also stand on the mark's other side
    lefts = (x - wide / 2,) if anchor == "middle" else (x, x - wide - 2 * size)
    boxes = [
        LabelBox(left + across * size, y - high / 2 + up * size, wide, high)
        for across, up in LABEL_OFFSETS
        for left in lefts
    ]
    free = (box for box in boxes if box.fits(width, height) and not any(box.meets(other) for other in taken))
    return next(free, boxes[0])
