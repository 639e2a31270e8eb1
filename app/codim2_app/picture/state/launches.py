"""Orbits that a user launched: points of the picture, as one short text in the link: ``0.3,0.2;1.5,-0.1,-:slow one``.

Each is x,y in the picture (|p| < 1 on the hemisphere, 1 + rho outside), then ``,-`` if it is hidden and ``:name`` if it
has a name. The same grammar is read by `static/interaction/launches.js`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

MAX_LAUNCHES = 12
MAX_LAUNCH_RADIUS = 4.0  # from the centre: the edge of what can be seen when zoomed out
LONGEST_NAME = 24
TYPED = -1  # in place of a launched orbit's place: the typed start


@dataclass(frozen=True)
class Launch:
    """One launched orbit."""

    x: float
    y: float
    hidden: bool = False
    name: str = ""


def read_launches(text: str) -> tuple[Launch, ...]:
    """Read launched orbits.

    Raises
    ------
    ValueError
        The text is none; the sentence says what is allowed.
    """
    entries = [entry for entry in text.split(";") if entry.strip()]
    if len(entries) > MAX_LAUNCHES:
        raise ValueError(f"{len(entries)} orbits given; at most {MAX_LAUNCHES} can be launched.")
    return tuple(_read(entry) for entry in entries)


def _read(entry: str) -> Launch:
    place, _, name = entry.partition(":")
    parts = place.split(",")
    hidden = len(parts) == 3 and parts[2].strip() == "-"
    try:
        x, y = (float(part) for part in parts[: 2 if hidden else None])
    except ValueError:
        raise ValueError(f"{entry[:40]!r} is no orbit; give x,y such as 0.3,0.2.") from None
    if not (math.isfinite(x) and math.isfinite(y) and max(abs(x), abs(y)) <= MAX_LAUNCH_RADIUS):
        raise ValueError(
            f"{entry[:40]!r} lies outside the picture; give x and y "
            f"from {-MAX_LAUNCH_RADIUS:g} to {MAX_LAUNCH_RADIUS:g}."
        )
    if len(name) > LONGEST_NAME:
        raise ValueError(f"the name {name[:40]!r} is too long; give at most {LONGEST_NAME} characters.")
    return Launch(x, y, hidden, name.strip())


def selected_place(launches: tuple[Launch, ...], number: int) -> int | None:
    """Return the place, among those that are shown, of the orbit of this number, counted from 1; the last if fewer.

    `TYPED` for 0, and where nothing was launched; None where it is hidden.
    """
    if number == 0 or not launches:
        return TYPED
    k = min(number, len(launches)) - 1
    return None if launches[k].hidden else sum(not launch.hidden for launch in launches[:k])
