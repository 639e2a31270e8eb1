"""Ball on a turntable: rolls on a circle at 2/7 of the turntable's rate, or slips if that is too fast."""

from __future__ import annotations

from ..elinear import ELinear
from .example import GRAVITY, Ball, Example, check_physics


def ball_on_turntable(mu: float = 0.2, Omega: float = 3.0, g: float = GRAVITY) -> ELinear:
    """Ball on a turntable: rolls on a circle at 2/7 of the turntable's rate, or slips if that is too fast.

    (x, y) is the slip velocity ``v + omega × (-R k) - Omega k × r`` at the contact, z = (v1, v2, r1, r2) velocity and
    position of the centre, m/s and m. With friction ``-mu m g e`` and the moment of inertia 2/5 m R²,
    ``(x, y)' = -(7/2) mu g e - Omega k × v`` and ``v' = -mu g e``. It rolls where ``|v| < 7 mu g/(2 |Omega|)``, with
    ``v' = (2/7) Omega k × v``.

    Source: K. Weltner, "Stable circular orbits of freely moving balls on rotating discs", Am. J. Physics 47 (1979)
    984-986.

    Parameters
    ----------
    mu : float
        Coulomb friction at the contact.
    Omega : float
        Rate of the turntable, rad/s.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    It rolls round at 2/7 of the turntable's rate:

    >>> from codim2_core import examples, sliding_flow
    >>> sliding_flow(examples.ball_on_turntable(Omega=3.5), (0.2, 0, 0, 0)).round(9).tolist()
    [0.0, 0.2, 0.2, 0.0]
    """
    check_physics({"g": g}, {"mu": mu})
    return ELinear(
        "-7/2*mu*g",
        0.0,
        "-7/2*mu*g",
        f=("Omega*z2", "-Omega*z1"),
        B=(("-mu*g", 0.0), (0.0, "-mu*g"), (0.0, 0.0), (0.0, 0.0)),
        g=(0.0, 0.0, "z1", "z2"),
        parameters={"mu": mu, "Omega": Omega, "g": g},
    )


EXAMPLE = Example(
    make=ball_on_turntable,
    title="Ball on a turntable",
    label="rolls at 2Ω/7",
    source="K. Weltner, Am. J. Physics 47 (1979) 984-986",
    sentence="It rolls on a circle, at 2/7 of the turntable's rate, or slips if too fast; z = (v₁, v₂, r₁, r₂).",
    ranges={"mu": (0.05, 1.0), "Omega": (-8.0, 8.0), "g": (1.0, 20.0)},
    z=(1.0, 0.0, 0.5, 0.0),
    slow=(("v₁", -4.0, 4.0), ("v₂", -4.0, 4.0), ("r₁", -2.0, 2.0), ("r₂", -2.0, 2.0)),
    launch=(1.0, 2.5, 1.0, 0.0, 0.5, 0.0),
    t_end=8.0,
    ball=Ball(placed=True, turning="Omega"),
)
