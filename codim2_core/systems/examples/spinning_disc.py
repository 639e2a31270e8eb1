"""A disc that slides and spins on a table: both stop at once, along one direction of (v, R omega)."""

from __future__ import annotations

import math

from ..typed import System
from .example import GRAVITY, Example, check_physics


def ratio(v2: str, w2: str, mark: str) -> dict[str, str]:
    """Return definitions of P = max(v^2, w^2), M = min(v^2, w^2)/P, B and E by v^2 and w^2; `mark` ends their names."""
    P, M = f"P{mark}", f"M{mark}"
    return {
        P: f"max({v2}, {w2})",
        M: f"min(1, min({v2}, {w2})/{P})",  # what is 1 at most, by intervals too
        f"B{mark}": f"ellipb({M})",
        f"E{mark}": f"ellipe({M})",
    }


def force(v2: str, w2: str, mark: str) -> dict[str, str]:
    """Return definitions up to that of F, the force on a disc under uniform pressure over mu m g v.

    It slides at v and spins at R omega = w; `mark` ends all names.
    """
    return {**ratio(v2, w2, mark), f"F{mark}": f"4/(3*pi)*(B{mark} + E{mark})/sqrt(P{mark})"}


def torque(v2: str, w2: str, mark: str) -> dict[str, str]:
    """Return definitions up to that of T, the torque over mu m g R w, as `force`."""
    B, E, M, d, D = (name + mark for name in "BEMdD")
    return {
        **ratio(v2, w2, mark),
        D: f"ellipb2({M})",
        d: f"({w2} - {v2})/P{mark}",
        f"T{mark}": f"2/(9*pi)*((3 + {M} - {d})*{B} + (3 - 2*{M} + 2*{d})*{E} - (1 - {d})*{D})/sqrt(P{mark})",
    }


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
    check_physics({"k": k, "g": g}, {"mu": mu})
    return System(
        U=("-mu*g*c*F", "-mu*g/k**2*s*T_s"),
        definitions=force("c**2", "(1 - c**2)", "") | torque("(1 - s**2)", "s**2", "_s"),
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
