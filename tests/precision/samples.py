"""Random systems that reach into every corner: near the equator and the centre, with coefficients of all sizes."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator

from codim2_core import Psi, psi

FAMILIES = (
    psi.constant(),
    psi.rational(),
    psi.exponential(),
    psi.tanh(),
    psi.hill(1),
    psi.hill(2),
    psi.hill(3.7),
    psi.hill(16),
    psi.hill(0.3),
    psi.custom("1/(1+s)**2"),
    psi.custom("1/(1+s/3)"),
)
STEEP = (psi.hill(60), psi.hill(200))

Plane = tuple[float, float, float, float, float]


def with_critical_set(count: int, seed: int, families: tuple[Psi, ...] = FAMILIES) -> Iterator[tuple[Plane, Psi]]:
    """(a, b, d, f1, f2) with a critical set somewhere between the centre and 1e-12 from the equator."""
    rng = random.Random(seed)
    for k in range(count):
        a, b, d = (rng.choice((1.0, 1.0, 10.0 ** rng.uniform(-6, 6))) * rng.uniform(-2, 2) for _ in range(3))
        if k % 7 == 0:
            d = a * (1 + rng.choice((1, -1)) * 10.0 ** rng.uniform(-16, -1))
        if k % 11 == 0:
            d = -b * b / a * (1 + 10.0 ** rng.uniform(-14, -1))  # det A is nearly 0
        m = rng.random() ** 0.5
        if k % 3 == 0:
            m = 1 - 10.0 ** rng.uniform(-12, -1)
        elif k % 5 == 0:
            m = 10.0 ** rng.uniform(-12, -1)
        t = rng.uniform(0, 2 * math.pi)
        c, s = m * math.cos(t), m * math.sin(t)
        yield (a, b, d, -(a * c - b * s), -(b * c + d * s)), rng.choice(families)


def anywhere(count: int, seed: int) -> Iterator[Plane]:
    """(a, b, d, f1, f2) of ordinary and of very different sizes."""
    rng = random.Random(seed)
    for k in range(count):
        yield tuple(rng.uniform(-2, 2) * (10.0 ** rng.uniform(-8, 8) if k % 2 else 1.0) for _ in range(5))  # type: ignore[misc]
