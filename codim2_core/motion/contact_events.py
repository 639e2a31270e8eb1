"""Events that stop a mechanism's motion where its contact opens or jams."""

from __future__ import annotations

import math
from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..results.arrays import Array
from ..results.words import say
from ..systems.arguments import psi as read_psi
from ..systems.kinds import PsiLike
from ..systems.mechanics.mechanism import Mechanism
from ..systems.psi.function import Psi
from .initial_value.events import Event
from .simulate import checked_state


@dataclass(frozen=True)
class _ForceNumber:
    """A number of the contact force along a motion, by its name; it is pickled, as a function made here is not."""

    mechanism: Mechanism
    name: str
    psi: Psi | None
    eps: float

    def __call__(self, t: float, state: Array) -> float:  # noqa: ARG002 (the mechanism has no clock)
        e = None
        if self.psi is not None:
            r = math.hypot(state[0], state[1])
            e = state[:2] * (self.psi.modulus(r / self.eps) / r if r > 0.0 else 0.0)
        return getattr(self.mechanism.contact_force(state, e), self.name)


def contact_events(
    mechanism: Mechanism, state0: ArrayLike, psi: PsiLike | None = None, eps: float = 0.0
) -> tuple[Event, ...]:
    """Return the events that stop a motion where the normal force falls to 0, or Painlevé's paradox begins.

    The system of a mechanism is that of a contact that presses: give them to `simulate` or `simulate_nonsmooth`, whose
    status says what has happened.

    Parameters
    ----------
    mechanism : Mechanism
    state0 : (2 + m,)
        Where the motion starts.
    psi : Psi, optional
    eps : float
        Those of `simulate`, where the friction is ``-N mu e_Psi``; left out, that of the limit.

    Returns
    -------
    tuple of Event
        That the contact opens; and where the normal force is that of a constraint, that friction makes it press the
        bodies together.

    Raises
    ------
    ValueError
        The contact does not press at state0, or that has the wrong length; or one of psi and eps is given alone.

    Examples
    --------
    A block that slides onto a slope which falls away, so that the normal force is 10 - 4 q after a way q:

    >>> from codim2_core import contact_events, simulate_nonsmooth
    >>> from codim2_core.systems.mechanics import Mechanism
    >>> block = Mechanism(((1, 0), (0, 1)), ((1, 0), (0, 1)), (0, 0), 0.1, "10 - 4*q", ("vx", "vy"), slow=("q",),
    ...                   rates={"q": "vx"})
    >>> start = block.state(vx=3, vy=0, q=0)
    >>> run = simulate_nonsmooth(block.system, start, (0, 9), events=contact_events(block, start))
    >>> round(float(run.states[-1, 2]), 9)
    2.5
    >>> run.reason
    'It stopped at a terminal event. The contact opens: no normal force is needed to keep the bodies apart.'
    """
    if (psi is None) != (eps == 0.0) or eps < 0.0:
        raise ValueError(f"psi is {psi}, and eps is {eps}; give both, eps positive, or neither.")
    begins = mechanism.contact_force(checked_state(state0, len(mechanism.slow)))
    if begins.kind != "presses":
        raise ValueError(f"state0 is where the contact does not press; start where it does. {begins.sentence}")
    law = None if psi is None else read_psi("psi", psi)
    opens = Event(_ForceNumber(mechanism, "approach", law, eps), -1, True, say("contact opens"))
    jams = Event(_ForceNumber(mechanism, "gain", law, eps), -1, True, say("contact jams"))
    return (opens, jams) if mechanism.has_constraint else (opens,)
