"""Physical quantities of a ball that slips and rolls, from the states of an example."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Ball:
    """A ball on a plane: z begins with the velocity of its centre, (x, y) is the slip at its contact, m/s.

    Attributes
    ----------
    placed : bool
        The next two slow variables are the place of the centre, m; else it starts at (0, 0).
    turning : str or None
        The parameter that is the rate of the plane about (0, 0), rad/s; None where the plane is at rest.
    """

    placed: bool = False
    turning: str | None = None
