"""A wheel that is towed on a caster with an elastic king pin: it rolls straight, or shimmies and slips."""

from __future__ import annotations

from ..elinear import ELinear
from ..mechanics.mechanism import contact
from ..typed import System
from .example import Example, check_physics


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


EXAMPLE = Example(
    make=towed_wheel,
    title="Towed wheel",
    label="shimmy of a caster",
    source="D. Takács, G. Stépán, S. J. Hogan, Nonlinear Dynamics 52 (2008) 27-34",
    sentence="It rolls straight, or its caster shimmies ever more, until the wheel slips; z = (q, ψ, q′).",
    ranges={
        "V": (0.5, 20.0),
        "l": (0.05, 0.5),
        "a": (0.02, 0.3),
        "r": (0.03, 0.3),
        "j": (0.05, 0.5),
        "k": (50.0, 1000.0),
        "b": (0.0, 20.0),
        "f": (0.5, 10.0),
    },
    z=(0.01, 0.0, 0.0),
    slow=(("q", -0.1, 0.1), ("ψ", -1.5, 1.5), ("q′", -2.0, 2.0)),
    launch=(0.5, 0.3, 0.02, 0.0, 0.0),
    t_end=4.0,
)
