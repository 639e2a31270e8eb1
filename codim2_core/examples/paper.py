"""The paper's three systems, sec:examples."""

from __future__ import annotations

from ..systems.elinear import ELinear
from ..systems.typed import System
from .example import GRAVITY


def ball_in_pool(mu: float = 0.2, m: float = 1.0, K: float = 1.0, g: float = GRAVITY) -> ELinear:
    """Ball at the bottom of a pool, sec:ballpool: slips, sticks and rolls.

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
    """
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
    """Attracting and repelling directions, sec:mateslidecross, eq:ex4p5: some approaches cross, others slide."""
    return System(U=("2*c**2 - c - 1/2", "-s"), W=("-z",))


def nonunique_sliding() -> System:
    """Sliding that depends on the direction of approach, sec:nonunique, eq:exmult: two stable critical sets."""
    return System(
        U=("-c*(c - chi(z)/2)*(c + chi(z)/2)", "-s/2"),
        W=("-2*c + 1/4",),
        definitions={"chi(z)": "(1 + 2*z**2)/(1 + z**2)"},
    )
