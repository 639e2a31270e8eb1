"""A plate on three feet that is pushed: it sticks, turns about a foot, or slides on all."""

from __future__ import annotations

from ..mechanics.several.contacts import Contacts, contacts
from .example import GRAVITY, check_physics, examples_at_contacts


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


EXAMPLES = examples_at_contacts(
    plate_on_three_feet,
    {"plate_at_foot_1": "foot 1", "plate_at_foot_2": "foot 2", "plate_at_foot_3": "foot 3"},
    title="Plate on three feet",
    label="one of several contacts",
    source="derived here",
    sentence="The hemisphere of one foot while the plate turns about it, and the other two slip; z is its rate ω.",
    ranges={
        "F": (-8.0, 8.0),
        "T": (-5.0, 5.0),
        "mu": (0.05, 1.0),
        "m": (0.5, 5.0),
        "k": (0.1, 2.0),
        "r": (0.1, 2.0),
        "g": (1.0, 20.0),
    },
    z=(0.6,),
    slow=(("ω", 0.05, 3.0),),
    launch=(0.1, 0.05, 0.6),
    t_end=0.3,
)
