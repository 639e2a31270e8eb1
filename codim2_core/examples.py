"""The paper's three systems (sec:examples) and three more that people meet, each with its source.

All are in the units of their parameters; `catalogue` lists them with the ranges in which they are interesting.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from .general import System
from .systems import ELinear

GRAVITY = 9.81  # m/s²


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


@dataclass(frozen=True, slots=True)
class Example:
    """One example as the explorer offers it.

    Attributes
    ----------
    key, title, label : str
        The function's name, what people call it, and the paper's label or the literature.
    sentence : str
        What there is to see.
    make : callable
        The function; its keyword arguments are the parameters.
    ranges : mapping of str to (low, high)
        In which each parameter is interesting.
    z : tuple of float
        Where to start.
    slow : tuple of (symbol, low, high)
        Each slow variable and its range.
    launch : tuple of float
        A state (x, y, z1, …, zm) from which a motion is worth following.
    t_end : float
        For how long.
    """

    key: str
    title: str
    label: str
    sentence: str
    make: Callable[..., ELinear | System]
    ranges: Mapping[str, tuple[float, float]]
    z: tuple[float, ...]
    slow: tuple[tuple[str, float, float], ...]
    launch: tuple[float, ...]
    t_end: float


def _example(
    title: str,
    label: str,
    sentence: str,
    make: Callable[..., ELinear | System],
    ranges: dict[str, tuple[float, float]],
    z: tuple[float, ...],
    slow: tuple[tuple[str, float, float], ...],
    launch: tuple[float, ...],
    t_end: float,
) -> Example:
    return Example(make.__name__, title, label, sentence, make, MappingProxyType(ranges), z, slow, launch, t_end)


catalogue: Mapping[str, Example] = MappingProxyType(
    {
        example.key: example
        for example in (
            _example(
                "Ball at the bottom of a pool",
                "sec:ballpool",
                "It sticks and rolls where |z| < 7μmg/(2K); faster, it slips.",
                ball_in_pool,
                {"mu": (0.05, 1.0), "m": (0.2, 3.0), "K": (0.0, 4.0), "g": (1.0, 20.0)},
                (4.0, 0.0),
                (("v₁", -12.0, 12.0), ("v₂", -12.0, 12.0)),
                (9.0, 3.0, 9.0, 0.0),
                5.0,
            ),
            _example(
                "Attracting and repelling directions",
                "sec:mateslidecross",
                "Trajectories that arrive within π/3 of θ = 0 cross, all others slide.",
                attracting_repelling,
                {},
                (0.5,),
                (("z", -2.0, 2.0),),
                (-1.0, 1.2, 1.0),
                3.0,
            ),
            _example(
                "Non-unique sliding",
                "sec:nonunique",
                "Two stable critical sets with different slow flows: sliding depends on the side of approach.",
                nonunique_sliding,
                {},
                (0.0,),
                (("z", -1.5, 1.5),),
                (-0.25, 0.3, -0.4),
                5.0,
            ),
            _example(
                "Block on a tilting incline",
                "orthotropic Coulomb friction",
                "It sticks while gravity lies in the friction ellipse, then slips.",
                tilting_block,
                {
                    "mu1": (0.05, 1.0),
                    "mu2": (0.05, 1.0),
                    "phi": (-math.pi, math.pi),
                    "rate": (0.0, 0.2),
                    "g": (1.0, 20.0),
                },
                (0.15,),
                (("incline", 0.0, 1.2),),
                (1.5, 1.0, 0.15),
                40.0,
            ),
            _example(
                "Unit-vector sliding-mode control",
                "a point in the plane",
                "It slides where the disturbance is smaller than the gain.",
                unit_vector_control,
                {"K": (0.2, 5.0), "k": (0.1, 3.0), "w1": (-3.0, 3.0), "w2": (-3.0, 3.0), "h": (-1.0, 1.0)},
                (1.0, 0.5),
                (("q₁", -5.0, 5.0), ("q₂", -5.0, 5.0)),
                (2.5, -1.0, 1.0, 0.5),
                6.0,
            ),
            _example(
                "Ball on a turntable",
                "rolls at 2Ω/7",
                "It rolls on a circle, at 2/7 of the turntable's rate, or slips if that is too fast.",
                ball_on_turntable,
                {"mu": (0.05, 1.0), "Omega": (-8.0, 8.0), "g": (1.0, 20.0)},
                (1.0, 0.0, 0.5, 0.0),
                (("v₁", -4.0, 4.0), ("v₂", -4.0, 4.0), ("r₁", -2.0, 2.0), ("r₂", -2.0, 2.0)),
                (1.0, 2.5, 1.0, 0.0, 0.5, 0.0),
                8.0,
            ),
        )
    }
)
