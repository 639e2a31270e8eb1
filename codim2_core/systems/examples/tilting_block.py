"""Block on an incline that is slowly tilted, with orthotropic Coulomb friction."""

from __future__ import annotations

import math

from ..elinear import ELinear
from .example import GRAVITY, Example, check_physics


def tilting_block(
    mu1: float = 0.3, mu2: float = 0.6, phi: float = 0.5, rate: float = 0.02, g: float = GRAVITY
) -> ELinear:
    """Block on an incline that is slowly tilted, with orthotropic Coulomb friction.

    (x, y) is the block's velocity along the principal directions of friction, m/s; z is the angle of the incline,
    rad. It sticks while gravity's pull lies in the friction ellipse,
    ``tan(z) < 1/sqrt((cos(phi)/mu1)² + (sin(phi)/mu2)²)``, then starts to slip along the eigendirection that opens.

    Source: A. Zmitrowicz, "Mathematical descriptions of anisotropic friction", Int. J. Solids Structures 25 (1989)
    837-862: friction force ``-N diag(mu1, mu2) e``.

    Parameters
    ----------
    mu1, mu2 : float
        Friction along the two principal directions.
    phi : float
        Angle between the first of them and the line of steepest descent, rad.
    rate : float
        Rate of tilting, rad/s.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    It sticks at an angle of 0.3, and slips at 0.6:

    >>> from codim2_core import critical_sets, examples, psi
    >>> [len(critical_sets(examples.tilting_block(), psi.constant(), z)) for z in (0.3, 0.6)]
    [1, 0]
    """
    check_physics({"mu1": mu1, "mu2": mu2, "g": g})
    return ELinear(
        "-mu1*g*cos(z)",
        0.0,
        "-mu2*g*cos(z)",
        f=("g*sin(z)*cos(phi)", "g*sin(z)*sin(phi)"),
        g=("rate",),
        parameters={"mu1": mu1, "mu2": mu2, "phi": phi, "rate": rate, "g": g},
    )


EXAMPLE = Example(
    make=tilting_block,
    title="Block on a tilting incline",
    label="orthotropic Coulomb friction",
    source="A. Zmitrowicz, Int. J. Solids Structures 25 (1989) 837-862",
    sentence="It sticks while gravity lies in the friction ellipse, then slips.",
    ranges={
        "mu1": (0.05, 1.0),
        "mu2": (0.05, 1.0),
        "phi": (-math.pi, math.pi),
        "rate": (0.0, 0.2),
        "g": (1.0, 20.0),
    },
    z=(0.15,),
    slow=(("incline", 0.0, 1.2),),
    launch=(1.5, 1.0, 0.15),
    t_end=40.0,
)
