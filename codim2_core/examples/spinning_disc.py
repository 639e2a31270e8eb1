"""A disc that slides and spins on a table: both stop at once, along one direction of (v, R omega)."""

from __future__ import annotations

import math

from ..systems.typed import System
from .example import GRAVITY, Example

#: Force, and torque over R, of a disc under uniform pressure, over mu m g, for (v, R omega) = (v, w): with
#: P = max(v^2, w^2), M = min(v^2, w^2)/P, d = (w^2 - v^2)/P, these times v and w.
FORCE = "4/(3*pi)*(ellipb({M}) + ellipe({M}))/sqrt({P})"
TORQUE = "2/(9*pi)*((3 + {M} - {d})*ellipb({M}) + (3 - 2*{M} + 2*{d})*ellipe({M}) - (1 - {d})*ellipb2({M}))/sqrt({P})"


def resistance(v2: str, w2: str, mark: str) -> tuple[dict[str, str], str, str]:
    """Return definitions, and by them force over v and torque over w, given v^2 and w^2; `mark` ends their names."""
    P, M, d = f"P{mark}", f"M{mark}", f"d{mark}"
    defined = {
        P: f"max({v2}, {w2})",
        M: f"min(1, min({v2}, {w2})/{P})",  # what is 1 at most, by intervals too
        d: f"({w2} - {v2})/{P}",
    }
    return defined, FORCE.format(M=M, P=P), TORQUE.format(M=M, P=P, d=d)


def spinning_disc(k: float = math.sqrt(0.5), mu: float = 0.2, g: float = GRAVITY) -> System:
    """Return a disc that slides and spins on a table: both stop at once, along one direction of (v, R omega).

    (x, y) = (v, R omega), m/s: the velocity of its centre, and the rate at which it spins times its radius R. Each
    point of its base has Coulomb friction, under uniform pressure, so that force and torque depend on the direction of
    (v, R omega) alone, by complete elliptic integrals of ``min(v, R omega)^2/max(v, R omega)^2``:
    ``v' = -mu g F``, ``(R omega)' = -mu g T/k^2``, F = 1 where it only slides, T = 2/3 where it only spins. Limit
    directions are its ways of stopping. With 1/2 < k < sqrt(2/3) all motions that do both stop along one of them,
    v/(R omega) = 0.653002 for a uniform disc; with a smaller k spinning dies out first, with a larger one sliding.

    On the hemisphere F is continued by c alone and T by s alone: what is within the disc depends on that, limit
    directions and motions outside do not.

    Source: Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, "Frictional coupling between sliding and spinning motion",
    Phys. Rev. Lett. 90 (2003) 248302; S. Goyal, A. Ruina, J. Papadopoulos, Wear 143 (1991) 307-330.

    Parameters
    ----------
    k : float
        Radius of gyration over R; sqrt(1/2) for a uniform disc.
    mu : float
        Coulomb friction.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    >>> import codim2_core as c2
    >>> directions = c2.equator_equilibria(c2.examples.spinning_disc()).theta
    >>> round(1.0 / math.tan(directions[1]), 6)
    0.653002
    """
    slides, force, _ = resistance("c**2", "(1 - c**2)", "")
    spins, _, torque = resistance("(1 - s**2)", "s**2", "_s")
    return System(
        U=(f"-mu*g*c*{force}", f"-mu*g/k**2*s*{torque}"),
        definitions=slides | spins,
        parameters={"k": k, "mu": mu, "g": g},
    )


EXAMPLE = Example(
    make=spinning_disc,
    title="Sliding, spinning disc",
    label="friction of a disc",
    source="Z. Farkas et al., Phys. Rev. Lett. 90 (2003) 248302",
    sentence="It slides and spins, and both stop at once: all its motions meet in v = 0.653 Rω.",
    ranges={"k": (0.3, 1.0), "mu": (0.05, 1.0), "g": (1.0, 20.0)},
    z=(),
    slow=(),
    launch=(1.0, 0.4),
    t_end=1.0,
)
