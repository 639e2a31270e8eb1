"""Points and bodies with friction, or under a control, whose equations are known."""

from __future__ import annotations

import math
from numbers import Real

from ..elinear import ELinear
from ..reading import MAX_NUMBER
from ..typed import System
from .example import GRAVITY, check_physics


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

    Examples
    --------
    >>> from codim2_core import examples
    >>> print(examples.unit_vector_control().at(examples.catalogue["unit_vector_control"].z).m)
    2
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
