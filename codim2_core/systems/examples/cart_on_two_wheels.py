"""A cart on two wheels, one behind the other: each may roll, spin or be dragged sideways."""

from __future__ import annotations

from ..mechanics.several.contacts import Contacts, contacts
from .example import GRAVITY, check_physics, examples_at_contacts


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


EXAMPLES = examples_at_contacts(
    cart_on_two_wheels,
    {"cart_at_front_wheel": "front wheel", "cart_at_rear_wheel": "rear wheel"},
    title="Cart on two wheels",
    label="one of several contacts",
    source="P. Riekert, T. E. Schunck, Ingenieur-Archiv 11 (1940) 210-224",
    sentence="The hemisphere of one wheel while the other slips; z = (ω, speed of the front rim, of the rear rim).",
    ranges={
        "D": (0.0, 100.0),
        "Y": (-100.0, 100.0),
        "mu": (0.05, 1.0),
        "m": (5.0, 50.0),
        "k": (0.1, 1.0),
        "a": (0.1, 1.0),
        "b": (0.1, 1.0),
        "j": (0.2, 5.0),
        "g": (1.0, 20.0),
    },
    z=(0.5, 4.0, 5.0),
    slow=(("ω", -4.0, 4.0), ("s₁", -10.0, 10.0), ("s₂", -10.0, 10.0)),
    launch=(0.3, 0.2, 0.5, 4.0, 5.0),
    t_end=0.2,
)
