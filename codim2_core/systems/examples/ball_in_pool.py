"""Ball at the bottom of a pool, Section 5.1: slips, sticks and rolls."""

from __future__ import annotations

from ..elinear import ELinear
from .example import GRAVITY, Ball, Example, check_physics


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


EXAMPLE = Example(
    make=ball_in_pool,
    title="Ball at the bottom of a pool",
    label="sec:ballpool",
    source="N. Cheesman, K. Uldall Kristiansen and S. J. Hogan, Section 5.1",
    sentence="It sticks and rolls where |z| < 7μmg/(2K); faster, it slips.",
    ranges={"mu": (0.05, 1.0), "m": (0.2, 3.0), "K": (0.0, 4.0), "g": (1.0, 20.0)},
    z=(4.0, 0.0),
    slow=(("z₁", -12.0, 12.0), ("z₂", -12.0, 12.0)),
    launch=(9.0, 3.0, 9.0, 0.0),
    t_end=5.0,
    ball=Ball(),
)
