"""The paper's three systems, Section 5."""

from __future__ import annotations

from ..elinear import ELinear
from ..typed import System
from .example import GRAVITY, check_physics


def ball_in_pool(mu: float = 0.2, m: float = 1.0, K: float = 1.0, g: float = GRAVITY) -> ELinear:
    """Ball at the bottom of a pool, Section 5.1: slips, sticks and rolls.

    (x, y) is the velocity at the point of contact, z the velocity of the centre of mass, m/s. It sticks where
    ``|z| < z_crit = 7 mu m g/(2 K)`` and then slows down as exp(-5 K t/(7 m)).

    Parameters
    ----------
    mu : float
        Coulomb friction at the contact.
    m : float
        Mass, kg.
    K : float
        Viscous friction through the centre of mass, kg/s; 0 is the textbook ball, which ends up rolling at 5/7 of
        the speed with which it was pushed.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    Without drag it slips for 2 v0/(7 mu g), and then rolls:

    >>> from codim2_core import examples, simulate_nonsmooth
    >>> run = simulate_nonsmooth(examples.ball_in_pool(K=0, mu=0.25, g=8), (1, 0, 1, 0), (0, 1))
    >>> [(phase.kind, round(phase.t_end, 6)) for phase in run.phases]
    [('slip', 0.142857), ('slide', 1.0)]
    """
    check_physics({"m": m, "g": g}, {"mu": mu, "K": K})
    drag = ("-K/m*z1", "-K/m*z2")
    return ELinear(
        "-7/2*mu*g",
        0.0,
        "-7/2*mu*g",
        f=drag,
        B=(("-mu*g", 0.0), (0.0, "-mu*g")),
        g=drag,
        parameters={"mu": mu, "m": m, "K": K, "g": g},
    )


def attracting_repelling() -> System:
    """Attracting and repelling directions, Section 5.2, (5.12): some approaches cross, others slide.

    Examples
    --------
    >>> from codim2_core import classify, examples, psi
    >>> classify(examples.attracting_repelling(), psi.constant(), 0.0).name
    '2 critical sets, 6 limit directions'
    """
    return System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",))


def nonunique_sliding() -> System:
    """Sliding that depends on the direction of approach, Section 5.3, (5.16): two stable critical sets.

    Examples
    --------
    At z = 0 two critical sets attract:

    >>> from codim2_core import critical_sets, examples, psi
    >>> critical_sets(examples.nonunique_sliding(), psi.constant(), 0.0).kinds
    ('stable node', 'saddle', 'stable node')
    """
    return System(
        U=("-c*(c - chi(z)/2)*(c + chi(z)/2)", "-s/2"),
        W=("-2*c + 1/4",),
        definitions={"chi(z)": "(1 + 2*z**2)/(1 + z**2)"},
    )
