"""Three more systems that people meet, each with its source."""

from __future__ import annotations

from ..systems.elinear import ELinear
from ..systems.typed import System
from .example import GRAVITY


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
    """
    return ELinear(
        "-mu1*g*cos(z)",
        0.0,
        "-mu2*g*cos(z)",
        f=("g*sin(z)*cos(phi)", "g*sin(z)*sin(phi)"),
        g=("rate",),
        parameters={"mu1": mu1, "mu2": mu2, "phi": phi, "rate": rate, "g": g},
    )


def unit_vector_control(K: float = 2.0, k: float = 1.0, w1: float = 0.6, w2: float = 0.0, h: float = 0.4) -> System:
    """Unit-vector sliding-mode control of a point in the plane under a disturbance.

    The point q'' = u + w has the switching variable (x, y) = q' + k q and the control ``u = -k q' - K e``, so that
    ``(x, y)' = w - K e`` and, with z = q, ``z' = (x, y) - k z``. The disturbance is ``w = (w1, w2) + h z``. It slides
    where |w| < K, and then q falls as exp(-k t) whatever w does: that is what the control is for. With w = 0 it
    gets there from (x, y) in the time |(x, y)|/K.

    Source: S. Gutman, "Uncertain dynamical systems: a Lyapunov min-max approach", IEEE Trans. Automatic Control 24
    (1979) 437-443; C. Edwards, S. K. Spurgeon, "Sliding Mode Control", Taylor & Francis (1998), ch. 3.

    Parameters
    ----------
    K : float
        Gain of the control.
    k : float
        Rate at which q falls in the sliding mode.
    w1, w2 : float
        Constant part of the disturbance.
    h : float
        How it grows with q.
    """
    return System(
        U=("w1 + h*z1 - K*c", "w2 + h*z2 - K*s"),
        W=("x - k*z1", "y - k*z2"),
        parameters={"K": K, "k": k, "w1": w1, "w2": w2, "h": h},
    )


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
    """
    return ELinear(
        "-7/2*mu*g",
        0.0,
        "-7/2*mu*g",
        f=("Omega*z2", "-Omega*z1"),
        B=(("-mu*g", 0.0), (0.0, "-mu*g"), (0.0, 0.0), (0.0, 0.0)),
        g=(0.0, 0.0, "z1", "z2"),
        parameters={"mu": mu, "Omega": Omega, "g": g},
    )
