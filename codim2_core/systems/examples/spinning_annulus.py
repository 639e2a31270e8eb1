"""An annulus, as a washer or a ring, that slides and spins on a table."""

from __future__ import annotations

from numbers import Real

from ..reading import MAX_NUMBER
from ..typed import System
from .example import GRAVITY, Example, check_physics
from .spinning_disc import force, torque


def spinning_annulus(eta: float = 0.5, mu: float = 0.2, g: float = GRAVITY) -> System:
    """Return a uniform annulus that slides and spins on a table: as `spinning_disc`, without the disc in its middle.

    Force and torque are those of a disc less those of the disc that is cut out, each under the same pressure; its
    radius of gyration is ``R sqrt((1 + eta^2)/2)``. The thinner it is, the nearer v/(R omega) is to 1, as for a ring.

    Source: Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, Phys. Rev. Lett. 90 (2003) 248302, and for annuli P. D.
    Weidman, C. P. Malhotra, "Regimes of terminal motion of sliding spinning disks", Phys. Rev. Lett. 95 (2005) 264303.

    Parameters
    ----------
    eta : float
        Inner radius over R, between 0 and 1.
    mu : float
        Coulomb friction.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    >>> import math
    >>> from codim2_core import equator_equilibria, examples
    >>> theta = equator_equilibria(examples.spinning_annulus(eta=0.5)).theta
    >>> round(1.0/math.tan(theta[1]), 6)
    0.774469
    """
    check_physics({"g": g}, {"eta": eta, "mu": mu})
    if isinstance(eta, Real) and 1.0 <= eta <= MAX_NUMBER:
        raise ValueError(f"eta is {eta:g}; give a number below 1.")
    outer = force("c**2", "(1 - c**2)", "") | torque("(1 - s**2)", "s**2", "_s")
    inner = force("c**2", "eta**2*(1 - c**2)", "_i") | torque("(1 - s**2)", "eta**2*s**2", "_si")
    return System(
        U=(
            "-mu*g*c*(F - eta**2*F_i)/(1 - eta**2)",
            "-2*mu*g*s*(T_s - eta**4*T_si)/(1 - eta**4)",  # k^2 = (1 + eta^2)/2
        ),
        definitions=outer | inner,
        parameters={"eta": eta, "mu": mu, "g": g},
    )


EXAMPLE = Example(
    make=spinning_annulus,
    title="Sliding, spinning annulus",
    label="friction of an annulus",
    source="Z. Farkas et al., Phys. Rev. Lett. 90 (2003) 248302",
    sentence="A washer stops sliding and spinning at once, the nearer to v = Rω the thinner it is.",
    ranges={"eta": (0.05, 0.95), "mu": (0.05, 1.0), "g": (1.0, 20.0)},
    z=(),
    slow=(),
    launch=(1.0, 0.4),
    t_end=1.0,
)
