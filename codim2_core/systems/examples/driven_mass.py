"""A mass on a rough table that a turning force drives round, held by a spring."""

from __future__ import annotations

from ..typed import System
from .example import Example, check_physics


def driven_mass(F: float = 1.0, omega: float = 2.0, S: float = 0.5, k: float = 1.0) -> System:
    """Mass on a rough table that a turning force drives round, held by a spring.

    ``q'' + k q = F (cos omega t, sin omega t) - S e`` with (x, y) = q', z = (q1, q2, t). With F > S and
    ``k != omega^2`` it goes round on a circle without a stop, of radius ``R = sqrt(F^2 - S^2)/|k - omega^2|``.

    Source: the limit of isotropic friction of J. P. Den Hartog's oscillator, Trans. ASME 53 (1931) 107-115, moved to
    the plane. The motion and its multipliers are derived in `reference.oscillators`.

    Parameters
    ----------
    F : float
        Force over the mass.
    omega : float
        Its angular frequency.
    S : float
        Coulomb friction over the mass.
    k : float
        Stiffness of the spring over the mass.

    Examples
    --------
    >>> import math
    >>> import codim2_core as c2
    >>> mass, start = c2.examples.driven_mass(), c2.examples.catalogue["driven_mass"].launch
    >>> found = c2.periodic_motion(mass, None, start, math.pi)
    >>> round(math.hypot(*found.state0[2:4]), 7), bool(max(abs(found.multipliers)) < 1.0)
    (0.2886751, True)
    """
    check_physics({"omega": omega, "k": k}, {"F": F, "S": S})
    return System(
        U=("F*cos(omega*t) - k*z1 - S*c", "F*sin(omega*t) - k*z2 - S*s"),
        W=("x", "y"),
        parameters={"F": F, "omega": omega, "S": S, "k": k},
    )


EXAMPLE = Example(
    make=driven_mass,
    title="Driven mass",
    label="forced oscillator",
    source="J. P. Den Hartog, Trans. ASME 53 (1931) 107-115, moved to the plane",
    sentence="A turning force drives it on a circle against friction; Response shows its radius; z = (q₁, q₂, t).",
    ranges={"omega": (1.2, 3.0), "F": (0.6, 2.0), "S": (0.05, 0.9), "k": (0.2, 1.2)},
    z=(-0.25, -0.14, 0.0),
    slow=(("q₁", -2.0, 2.0), ("q₂", -2.0, 2.0), ("t", 0.0, 6.3)),
    launch=(0.29, -0.5, -0.25, -0.14, 0.0),
    t_end=12.6,
)
