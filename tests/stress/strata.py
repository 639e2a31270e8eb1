"""Degenerate settings as exact numbers, the ways off each of them, and the exact answer on either side.

Wherever the stratum allows it, its point has coefficients that doubles hold exactly, so that "on it" means on it. A
path moves one coefficient (relative to itself or, from 0, to the largest one) to either side of the stratum.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from codim2_core import ELinear, Psi
from codim2_core import psi as families

Plane = tuple[float, float, float, float, float]

COEFFICIENTS = ("a", "b", "d", "f1", "f2")
STEPS = tuple(10.0**-k for k in range(1, 17))
CASE3 = (172.0, 186.0, -200.0, -86.0, -93.0)


@dataclass(frozen=True)
class Stratum:
    """One degenerate setting.

    Attributes
    ----------
    name : str
    plane : (a, b, d, f1, f2)
        On the stratum.
    degeneracy : str
        The name under which `classify` reports it.
    paths : str
        Names of coefficients whose change leaves it, separated by blanks.
    clear : float
        From this relative change on, the setting is farther from the stratum than the rounding of its input.
    largest : float
        Up to this relative change no other stratum is met.
    psi : Psi or None
        If only that one has the stratum.
    """

    name: str
    plane: Plane
    degeneracy: str
    paths: str
    clear: float = 1e-14
    largest: float = 1e-1
    psi: Psi | None = None

    def moved(self, path: str, change: float) -> Plane:
        """The setting at a relative change of one coefficient."""
        k = COEFFICIENTS.index(path)
        values = list(self.plane)
        size = max(map(abs, self.plane)) or 1.0
        values[k] = values[k] * (1.0 + change) if values[k] else size * change
        return tuple(values)  # type: ignore[return-value]


def system(plane: Plane, scale: float = 1.0) -> ELinear:
    """The e-linear system with these five coefficients, and two slow variables."""
    a, b, d, f1, f2 = (v * scale for v in plane)
    return ELinear(a, b, d, (f1, f2), B=[[1.0, -2.0], [0.0, 0.5]], g=[0.25, 1.0])


ROOT2 = math.sqrt(2.0)

STRATA = (
    # a = d, b = 0, f = 0: the ball at z = 0
    Stratum("all directions", (-1.0, 0.0, -1.0, 0.0, 0.0), "all directions", "b d f1 f2"),
    Stratum("all directions, repelling", (3.0, 0.0, 3.0, 0.0, 0.0), "all directions", "a b f1"),
    # det A = 0
    Stratum("det A = 0", (1.0, 1.0, -1.0, 0.5, 0.25), "det A = 0", "a b d"),
    Stratum("det A = 0, one row", (0.0, 0.0, 2.0, 1.0, 0.0), "det A = 0", "b a"),
    Stratum("det A = 0, the line misses", (1.0, 1.0, -1.0, 5.0, 5.0), "det A = 0", "a b d"),
    Stratum("line of equilibria", (1.0, 1.0, -1.0, 0.5, 0.5), "line of equilibria", "f1 f2 a b d", 1e-14, 1e-2),
    Stratum("line through the centre", (1.0, 1.0, -1.0, 0.0, 0.0), "line of equilibria", "a b d f1"),
    Stratum("A = 0", (0.0, 0.0, 0.0, 0.5, 0.25), "det A = 0", "b"),
    Stratum("everything stands still", (0.0, 0.0, 0.0, 0.0, 0.0), "everything stands still", "a b d f1"),
    # |A^-1 f| = 1
    Stratum("transcritical, a = d", (-5.0, 0.0, -5.0, 3.0, 4.0), "transcritical", "f1 f2 a d"),
    Stratum("transcritical, case I", (-5.0, 1.0, -10.0, 3.8, 7.4), "transcritical", "f1 f2 a d b"),
    Stratum("transcritical, case II", (5.0, 0.0, -10.0, -3.0, 8.0), "transcritical", "f1 f2 a d", 1e-14, 1e-4),
    Stratum("transcritical, case III", (5.0, 10.0, -10.0, 5.0, 2.0), "transcritical", "f1 f2 a d", 1e-14, 1e-4),
    # |f| = |b| with a = d
    Stratum("|f| = |b|, a = d", (-1.0, 5.0, -1.0, 3.0, 4.0), "saddle-node", "f1 f2 b", 1e-14, 1e-2),
    Stratum("|f| = |b|, a = d > 0", (7.0, -5.0, 7.0, -4.0, 3.0), "saddle-node", "f1 f2 b"),
    Stratum("|f| = |b|, a = d = 0", (0.0, 5.0, 0.0, 3.0, 4.0), "saddle-node", "f1 f2 b"),
    # the saddle-node curve at (cos, sin) = (3/5, 4/5), a - d = 125
    Stratum("saddle-node, case I", (225.0, 50.0, 100.0, 13.0, 34.0), "saddle-node", "a b d f1 f2", 3e-14, 1e-2),
    Stratum("saddle-node, case II", (100.0, 10.0, -25.0, -19.0, 58.0), "saddle-node", "b f1 f2", 3e-14, 1e-2),
    Stratum("saddle-node, case III", (100.0, 100.0, -25.0, 53.0, 4.0), "saddle-node", "b f1", 3e-14, 1e-2),
    Stratum("two saddle-nodes, f = 0", (0.0, 0.5, 1.0, 0.0, 0.0), "saddle-node", "b d", 1e-14, 1e-2),
    # triple and fourfold roots
    Stratum("pitchfork", (-1.0, 0.0, -1.5, -0.5, 0.0), "pitchfork", "a d f1", 1e-14, 1e-2),
    Stratum("pitchfork, the other side", (1.0, 0.0, 3.0, 0.0, 2.0), "pitchfork", "d f2", 1e-14, 1e-2),
    Stratum("cusp", (225.0, -180.0, 100.0, -171.0, 172.0), "cusp", "b f1 f2", 3e-14, 1e-3),
    Stratum("fourfold", (0.0, 1.5, 1.0, ROOT2, -ROOT2), "quadruple zero", "b d", 3e-14, 1e-3),
    # tr J = 0
    Stratum("tr J = 0, a = -d", (1.0, 2.0, -1.0, 0.5, -0.5), "tr J = 0", "a d", 1e-13),
    Stratum("tr J = 0, a = d = 0", (0.0, 1.0, 0.0, 0.25, 0.5), "tr J = 0", "a d", 1e-13),
    Stratum("tr J = 0, case III", CASE3, "tr J = 0", "a d b f1", 1e-12, 1e-4, families.hill(284.0 / 129.0)),
    # |A^-1 f| = 1 just where two limit directions meet
    Stratum("transcritical saddle-node", (45.0, 50.0, -80.0, 13.0, 34.0), "transcritical", "f1 f2", 1e-13, 1e-2),
    # borders between the cases
    Stratum("a = 0", (0.0, 1.0, -1.0, 0.25, 0.125), "a = 0", "a"),
    Stratum("a = d = 0", (0.0, 1.0, 0.0, 0.25, 0.5), "a = d = 0", "a d"),
    # a = d is no degeneracy in itself: the answers go through it without a jump
    Stratum("nearly equal a and d", (-1.0, 0.25, -1.0, 0.5, 0.0), "", "a d"),
)


def existence(plane: Plane) -> str:
    """How many critical sets these doubles have exactly: "one", "none", "border", "line"."""
    a, b, d, f1, f2 = map(Fraction, plane)
    det, n1, n2 = a * d + b * b, d * f1 + b * f2, a * f2 - b * f1
    if det == 0:
        return "line" if n1 == n2 == 0 else "none"
    gap = det**2 - n1**2 - n2**2
    return "border" if gap == 0 else "one" if gap > 0 else "none"
