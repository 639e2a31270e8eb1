"""Discs and washers that slide and spin: the ratio of both speeds at which they come to rest.

A disc whose centre moves at v and that spins at omega turns about a point at a distance v/omega from its middle. About
that point force and torque are integrals of smooth functions of one angle. So the values were computed, and
`tests/core/motion/reference` computes them again.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

from ...portrait.layer_problem.equator import equator_equilibria
from ...systems.examples.spinning_annulus import spinning_annulus
from ...systems.examples.spinning_disc import spinning_disc
from ...systems.typed import System
from .record import ExactValue, ReferenceMotion

FARKAS = "Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, Phys. Rev. Lett. 90 (2003) 248302"
WEIDMAN = "P. D. Weidman, C. P. Malhotra, Phys. Rev. Lett. 95 (2005) 264303"


def _terminal_ratios(make: Callable[[float], System], given: Sequence[float]) -> Sequence[float]:
    """Return v/(R omega) of the limit direction along which both stop, for each argument."""
    found = []
    for one in given:
        theta = equator_equilibria(make(one)).theta
        found.append(1.0 / math.tan(theta[(theta > 0.01) & (theta < 0.5 * math.pi - 0.01)][0]))
    return found


def _known_ratio(name: str, value: float) -> ExactValue:
    return ExactValue(name, "1", value, 2e-12, "one-dimensional quadrature about the centre of rotation")


DISC = ReferenceMotion(
    "spinning-disc", "A disc stops sliding and spinning at once",
    "A uniform disc slides and spins on a table: whatever its start, v/(Rω) tends to one number as it stops.", FARKAS,
    (_known_ratio("v/(Rω)", 0.6530017892056),), partial(_terminal_ratios, spinning_disc, (math.sqrt(0.5),)),
)  # fmt: skip
GYRATION = ReferenceMotion(
    "gyration", "Discs that are not uniform",
    "Discs of other radii of gyration k R under uniform pressure: between k = 1/2 and √(2/3) both stop at once.",
    WEIDMAN, (
        _known_ratio("v/(Rω) for k = 0.6", 0.9354650672281), _known_ratio("v/(Rω) for k = 0.75", 0.5090734155928),
    ),
    partial(_terminal_ratios, spinning_disc, (0.6, 0.75)),
)  # fmt: skip
WASHER = ReferenceMotion(
    "washer", "Washers",
    "Uniform annuli of inner radius ηR: the thinner, the nearer v/(Rω) is to 1, as for a ring.", WEIDMAN, (
        _known_ratio("v/(Rω) for η = 0.3", 0.7044077196133), _known_ratio("v/(Rω) for η = 0.5", 0.7744688699130),
        _known_ratio("v/(Rω) for η = 0.8", 0.9034348892635),
    ), partial(_terminal_ratios, spinning_annulus, (0.3, 0.5, 0.8)),
)  # fmt: skip

SPINNING = (DISC, GYRATION, WASHER)
