"""Mechanisms with dry friction at one or several points of contact, made of their parts."""

from __future__ import annotations

from ..elinear import ELinear
from ..mechanics.mechanism import contact
from ..mechanics.several.contacts import Contacts, contacts
from ..typed import System
from .example import GRAVITY, check_physics


def towed_wheel(
    V: float = 3.0,
    l: float = 0.2,  # noqa: E741 (its name in the literature)
    a: float = 0.1,
    r: float = 0.12,
    j: float = 0.2,
    k: float = 400.0,
    b: float = 0.5,
    f: float = 4.0,
) -> ELinear | System:
    """Wheel that is towed on a caster with an elastic king pin: it rolls straight, or shimmies and slips.

    (x, y) is the velocity of the wheel's lowest point along the wheel and across it, m/s; z = (q, psi, u): the king
    pin's displacement across the way, m, the angle of the caster, rad, and ``u = q'``, m/s. The wheel is rigid, thin
    and upright, and meets the ground in one point, with Coulomb friction f per mass. It rolls straight stably where
    ``(V (l - a) + b l^2)(b V + k l) > k V ((l - a)^2 + r^2)``; without damping, where ``a (l - a) > r^2``, at any V.

    Source: D. Takács, G. Stépán, S. J. Hogan, "Isolated large amplitude periodic motions of towed rigid wheels",
    Nonlinear Dynamics 52 (2008) 27-34, where it only rolls: the model. The condition is derived here.

    Parameters
    ----------
    V : float
        Speed at which it is towed, m/s.
    l : float
        Length of the caster, from the king pin to the axle, m.
    a : float
        From the king pin to the centre of mass of caster and wheel, m.
    r : float
        Radius of gyration about that, upright axis, m.
    j : float
        Moment of inertia of the wheel's spin over its radius squared and the mass.
    k, b : float
        Stiffness and damping of the king pin across the way over the mass, 1/s² and 1/s.
    f : float
        Coulomb friction over the mass, m/s².

    Examples
    --------
    >>> import codim2_core as c2
    >>> wheel = c2.examples.towed_wheel(b=10.0)
    >>> run = c2.simulate_nonsmooth(wheel, (0.0, 0.0, 0.01, 0.0, 0.0), (0.0, 4.0), c2.psi.constant())
    >>> [phase.kind for phase in run.phases], abs(float(run.states[-1, 2])) < 1e-3
    (['slide'], True)
    """
    check_physics({"l": l, "r": r, "j": j}, {"k": k, "b": b, "f": f})
    return contact(
        M=((1, "-a*cos(psi)", 0), ("-a*cos(psi)", "a**2 + r**2", 0), (0, 0, "j")),
        J=(("sin(psi)", 0, -1), ("cos(psi)", "-l", 0)),
        force=("-k*q - b*u - a*w**2*sin(psi)", 0, 0),
        mu="f",
        normal=1,
        velocities=("u", "w", "spin"),
        slow=("q", "psi", "u"),
        rates={"q": "u", "psi": "w"},
        surface=("-V*cos(psi)", "V*sin(psi)"),
        parameters={"V": V, "l": l, "a": a, "r": r, "j": j, "k": k, "b": b, "f": f},
    )


def cart_on_two_wheels(
    D: float = 30.0,
    Y: float = 0.0,
    mu: float = 0.5,
    m: float = 20.0,
    k: float = 0.4,
    a: float = 0.4,
    b: float = 0.4,
    j: float = 2.0,
    g: float = GRAVITY,
) -> Contacts:
    """Cart on two wheels, one behind the other: each may roll, spin or be dragged sideways.

    Its velocities are those of the centre of mass along the cart and across it, u and v, m/s, its rate of turning w,
    rad/s, and the speeds of the two rims, s1 and s2, m/s. It stays upright; the load of a wheel is ``m g`` times the
    distance of the other from the centre of mass over ``a + b``. At rest both wheels roll while each force is in its
    friction circle, with ``q = D/(m + 2 j)``:

        front ``(j q)^2 + (Y b/(a + b))^2 < (mu m g b/(a + b))^2``,
        rear ``((m + j) q)^2 + (Y a/(a + b))^2 < (mu m g a/(a + b))^2``.

    Source: the model is the single-track one, with Coulomb friction in the place of cornering stiffness: P. Riekert,
    T. E. Schunck, "Zur Fahrmechanik des gummibereiften Kraftfahrzeugs", Ingenieur-Archiv 11 (1940) 210-224. The
    conditions are derived here.

    Parameters
    ----------
    D : float
        Drive of the rear wheel: its torque over the radius, N.
    Y : float
        Force across the cart at its centre of mass, as on a banked road, N.
    mu : float
        Coulomb friction of both contacts.
    m, k : float
        Mass, kg, and radius of gyration about the upright axis, m.
    a, b : float
        Distances of the front and the rear contact from the centre of mass, m.
    j : float
        Moment of inertia of a wheel's spin over its radius squared, kg.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    >>> import codim2_core as c2
    >>> [c2.examples.cart_on_two_wheels(D=drive).decide((0.0,) * 5).kinds for drive in (50.0, 60.0)]
    [('stick', 'stick'), ('stick', 'slip')]
    """
    check_physics({"m": m, "k": k, "a": a, "b": b, "j": j, "g": g, "mu": mu})
    return contacts(
        M=(("m", 0, 0, 0, 0), (0, "m", 0, 0, 0), (0, 0, "m*k**2", 0, 0), (0, 0, 0, "j", 0), (0, 0, 0, 0, "j")),
        contacts=(
            (((1, 0, 0, -1, 0), (0, 1, "a", 0, 0)), "mu", "m*g*b/(a + b)"),
            (((1, 0, 0, 0, -1), (0, 1, "-b", 0, 0)), "mu", "m*g*a/(a + b)"),
        ),
        force=("m*w*v", "Y - m*w*u", 0, 0, "D"),
        velocities=("u", "v", "w", "s1", "s2"),
        parameters={"D": D, "Y": Y, "mu": mu, "m": m, "k": k, "a": a, "b": b, "j": j, "g": g},
    )


def plate_on_three_feet(
    F: float = 0.5,
    T: float = 0.0,
    mu: float = 0.3,
    m: float = 2.0,
    k: float = 0.5,
    r: float = 0.7,
    g: float = GRAVITY,
) -> Contacts:
    """Plate on three feet that is pushed: it sticks, turns about a foot, or slides on all.

    Its velocities, in axes that turn with it, are those of the centre of mass, u and v, m/s, and its rate of turning w,
    rad/s. The feet are at the distance r from the centre of mass, the first on the axis of u, and bear a third of the
    weight each. At rest all stick while ``|F| < mu m g`` if T is 0, and while ``|T| < mu m g r`` if F is 0.

    With no push, a plate that turns about one foot goes on turning about it while, with
    ``q = (r^2 - k^2)/(r^2 + k^2)``,

        ``w^2 < (mu g/(3 r)) sqrt(1 - 3 q^2)``:

    the friction of the other two is ``sqrt(3)`` times the most that this foot can hold, and turns the plate too.

    Source: derived here.

    Parameters
    ----------
    F : float
        Push at the centre of mass along the axis of u, N.
    T : float
        Torque, N m.
    mu : float
        Coulomb friction of all feet.
    m, k : float
        Mass, kg, and radius of gyration, m.
    r : float
        Distance of the feet from the centre of mass, m.
    g : float
        Acceleration of gravity, m/s².

    Examples
    --------
    >>> import codim2_core as c2
    >>> c2.examples.plate_on_three_feet(F=5.0).decide((0.0, 0.0, 0.0)).kinds
    ('stick', 'stick', 'stick')
    >>> [len(c2.critical_sets(c2.examples.plate_at_foot_1(F=0.0), c2.psi.constant(), w)) for w in (1.07, 1.08)]
    [1, 0]
    """
    check_physics({"m": m, "k": k, "r": r, "g": g, "mu": mu})
    feet = (("0", "r"), ("sqrt(3)/2*r", "-r/2"), ("-sqrt(3)/2*r", "-r/2"))  # y and x
    return contacts(
        M=(("m", 0, 0), (0, "m", 0), (0, 0, "m*k**2")),
        contacts=[(((1, 0, f"-({y})"), (0, 1, x)), "mu", "m*g/3") for y, x in feet],
        force=("F + m*w*v", "-m*w*u", "T"),
        velocities=("u", "v", "w"),
        parameters={"F": F, "T": T, "mu": mu, "m": m, "k": k, "r": r, "g": g},
    )
