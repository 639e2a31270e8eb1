"""A mechanism with dry friction at several points of contact: a system of several codimension-2 sets.

With velocities v, kinetic energy v·Mv/2, applied force Q and slips x_i = J_i v - w_i,

    M v' = Q - sum mu_i N_i J_i^T e_i,    e_i = x_i/|x_i|.

Each contact has its own set x_i = 0. At one, while the others slip, their e_j are smooth functions of the state, so
that contact i sees a system of (2.7) with (x, y) = x_i, whose applied force is Q less their friction: `Contacts.at`.
At several sets at once, x_i = eps x2_i makes of e_Psi a point on a product of hemispheres, on which
(x2_i)' = J_i v' + k_i with v' linear in all e_j: a critical set solves the linear equations
``sum_j D_ij mu_j N_j e_j = J_i M^-1 Q + k_i`` of the Delassus matrix D = J M^-1 J^T, with every |e_i| < 1. It
attracts: (x2)' is minus D times the gradient of a convex function, whose gradient by x2_i is mu_i N_i e_Psi(x2_i) less
a constant.

**Which contacts stick is unique** (`Contacts.decide`): v' minimises a strictly convex function (`decision`). Where M
and J are numbers, w reads time alone, and mu N positions and time, the friction is the subdifferential of the convex
function ``sum mu_i N_i |x_i|`` of v: the inclusion is maximal monotone (Brezis 1973), one motion leaves every state
forwards, and since ``sqrt(|x|^2 + eps^2) - |x|`` is at most eps, the regularised motion for Psi = 1 comes to it within
``sqrt(2 t eps sum mu_i N_i) exp(L t)`` in the norm of the kinetic energy, L the Lipschitz constant of M^-1 Q in it.
Where J reads positions the acceleration is unique at each state, but no proof is given here that the motion is.

Not known: normal forces that read velocities or follow from constraints (Painleve). Redundant contacts, D singular as
for three feet of a rigid plate: v' is unique, the forces e that hold it are not, and the limit picks some by Psi.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ....formulas.expression import Expression
from ....formulas.names import SLOW_NAMES
from ....results.arrays import Array, read_only
from ....results.result import Result
from ....results.words import say
from ...arguments import checked_times
from ...arguments import psi as read_psi
from ...elinear import ELinear
from ...kinds import PsiLike
from ...typed import System
from .. import formula_reading
from ..formula_reading import FormulaRow, Given, GivenMatrix, GivenRow, Matrix
from ..mechanism import Mechanism
from .decision import Flags, decide_contacts
from .field import (
    ContactField,
    ContactParts,
    Law,
    contact_field,
    held_rank,
    mechanisms,
    read_contacts,
    refuse_fast_names,
)
from .result import ContactDecision, ContactMotion, ContactPhase, ContactStatus, contact_names
from .run import HELD_SLIPS, ContactRun, NonsmoothRun, RegularisedRun


@dataclass(frozen=True, eq=False)
class Contacts(Result):
    """A mechanism with dry friction at several contacts. Made by `contacts`.

    Attributes
    ----------
    M, force : formulas
    contacts : tuple
        J, mu, normal and surface of each.
    velocities : tuple of str
    rates : mapping of str to formula
        How the positions move.
    parameters : mapping of str to float
    """

    M: Matrix = field(repr=False)
    contacts: tuple[ContactParts, ...] = field(repr=False)
    force: FormulaRow = field(repr=False)
    velocities: tuple[str, ...]
    rates: Mapping[str, Expression] = field(repr=False)
    parameters: Mapping[str, float]

    def __len__(self) -> int:
        return len(self.contacts)

    @property
    def names(self) -> tuple[str, ...]:
        """Velocities, then positions: the order of a state."""
        return (*self.velocities, *self.rates)

    @cached_property
    def mechanisms(self) -> tuple[Mechanism, ...]:
        """For each contact, the mechanism in which it may be at its set while the others slip."""
        return mechanisms(self.M, self.contacts, self.force, self.velocities, self.rates, self.parameters)

    @cached_property
    def _field(self) -> ContactField:
        return contact_field(self.M, self.contacts, self.force, self.velocities, self.rates, self.parameters)

    def at(self, i: int) -> ELinear | System:
        """Return the system of (2.7) at the set of contact i, from 0, while the others slip.

        (x, y) is its slip; its slow variables are those of ``mechanisms[i].slow``.
        """
        return self.mechanisms[i].system

    def slips(self, states: ArrayLike) -> Array:
        """Return the slips (..., c, 2) of states (..., N)."""
        given = np.asarray(states, float)
        rows = given.reshape(-1, len(self.names))
        return np.array([self._field.at(row).x for row in rows]).reshape(*given.shape[:-1], len(self), 2)

    def decide(self, state: ArrayLike) -> ContactDecision:
        """Return which contacts stick at a state, and the forces that hold them.

        Parameters
        ----------
        state : (N,)
            Velocities, then positions. A contact is at its set where its slip is exactly 0.

        Raises
        ------
        ValueError
            The state has the wrong length or is not finite, or a contact has no friction there.
        """
        here = self._field.at(self._checked(state))
        if not (here.r > 0.0).all():
            raise ValueError(f"state: contact {int(np.argmin(here.r > 0.0)) + 1} has mu N = {here.r.min():.4g} there.")
        at_sets = np.hypot(*here.x.T) == 0.0
        e = np.zeros_like(here.x)
        e[~at_sets] = Law().e(here.x[~at_sets])
        Q = here.Q - np.einsum("cin,ci->n", here.J[~at_sets], here.r[~at_sets, None] * e[~at_sets])
        found = decide_contacts(here.M, Q, here.J[at_sets], here.k[at_sets], here.r[at_sets])
        e[at_sets] = found.e
        sticks = at_sets.copy()
        sticks[at_sets] = found.sticks
        unique = held_rank(here, sticks) == 2 * int(sticks.sum())
        rates = np.where(sticks[:, None], 0.0, here.J @ found.u + here.k)
        said = say("contacts decided" if unique else "contacts redundant", count=int(sticks.sum()), of=len(self))
        return ContactDecision(_kinds(sticks), read_only(e), read_only(rates), read_only(found.u), unique, said)

    def simulate_nonsmooth(
        self, state0: ArrayLike, t_span: ArrayLike, *, rtol: float = 1e-9, atol: float = 1e-11,
        times: ArrayLike | None = None, max_steps: int = 20_000, max_step: float = math.inf,
    ) -> ContactMotion:  # fmt: skip
        """Follow the motion of the limit eps -> 0, through all combinations of slip and stick.

        The regularised motion differs from it by O(eps) until a contact departs, and from then on, for Psi = 1, by
        O(eps^(4/5)): where a force passes its bound, ``x' = r (alpha t + (eps/x)^2/2)``, whose length is that.
        Each step ends at a kink or jump of a formula (abs, sign, min, max, floor, mod, comparisons), where which
        contacts stick is decided anew. Bounds of the formulas along it show that no push between its stages is missed;
        where bounds decide nothing, `reason` says so, and `max_step` makes the steps shorter.

        Parameters
        ----------
        state0 : (N,)
            Velocities, then positions.
        t_span : (t_start, t_end)
            Growing.
        rtol, atol : float
            Error allowed in a step.
        times : (k,) floats, optional
            Within the span: those of the result, as far as the motion comes; left out, the ends of the steps.
        max_steps : int
            Steps and phases before the motion is given up, with a status that says so.
        max_step : float
            The longest step.

        Raises
        ------
        ValueError
            The state, the span, a time or max_step is invalid.
        """
        return self._follow(NonsmoothRun, Law(), state0, t_span, rtol, atol, times, max_steps, max_step)

    def simulate(
        self, psi: PsiLike, state0: ArrayLike, t_span: ArrayLike, *, eps: float, rtol: float = 1e-9,
        atol: float = 1e-11, times: ArrayLike | None = None, max_steps: int = 20_000, max_step: float = math.inf,
    ) -> ContactMotion:  # fmt: skip
        """Follow the motion of the regularised system, ``e_Psi`` with the same eps at every contact.

        Parameters
        ----------
        psi : Psi
        state0, t_span, rtol, atol, times, max_steps, max_step
            As for `simulate_nonsmooth`.
        eps : float
            Positive.

        Raises
        ------
        ValueError
            The state, the span, a time, max_step or eps is invalid.
        """
        if not 1e-14 <= eps <= 1e6:
            raise ValueError(f"eps is {eps}; give a positive number, from 1e-14 to 1e6.")
        law = Law(read_psi("psi", psi), float(eps))
        return self._follow(RegularisedRun, law, state0, t_span, rtol, atol, times, max_steps, max_step)

    def _checked(self, state: ArrayLike) -> Array:
        given = np.array(state, float)
        if given.shape != (len(self.names),) or not np.isfinite(given).all():
            raise ValueError(f"the state is {given.tolist()}; give finite numbers for {', '.join(self.names)}.")
        return given

    def _follow(
        self, kind: type[ContactRun], law: Law, state0: ArrayLike, t_span: ArrayLike, rtol: float, atol: float,
        times: ArrayLike | None, max_steps: int, max_step: float,
    ) -> ContactMotion:  # fmt: skip
        t, t_end = _checked_span(t_span)
        when = checked_times(times, (t, t_end))
        if not (isinstance(max_step, int | float | np.number) and max_step > 0.0):
            raise ValueError(f"max_step is {max_step!r}; give a positive time, or leave it out.")
        run = kind(t, self._checked(state0), t_end, rtol, atol, max_steps, max_step, self._field, law)
        motion, name, detail = run.outcome()
        status, starts = ContactStatus[name], run.phases
        starts = starts or self._regularised_starts(motion.times, motion.states, law.eps)
        ends = [*(start for start, *_ in starts[1:]), float(motion.times[-1])]
        phases = tuple(
            ContactPhase(start, end, _kinds(np.array(sticks)), reason)
            for (start, sticks, reason), end in zip(starts, ends, strict=True)
        )
        reason = f"{status.value} {detail}".strip()
        return ContactMotion(motion, self.names, phases, status, reason, law.eps).sample(when)

    def _regularised_starts(self, times: Array, states: Array, eps: float) -> list[tuple[float, tuple[bool, ...], str]]:
        slips = self.slips(states)
        sticks = np.hypot(slips[..., 0], slips[..., 1]) <= HELD_SLIPS * eps
        found = [(float(times[0]), tuple(sticks[0].tolist()), say("contacts start"))]
        for t, now in zip(times[1:].tolist(), map(tuple, sticks[1:].tolist()), strict=True):
            if now != found[-1][1]:
                changed = np.array(now) != np.array(found[-1][1])
                key = "contact arrives" if np.array(now)[changed].all() else "contact departs"
                found.append((t, now, say(key, where=contact_names(changed))))
        return found


def _kinds(sticks: Flags) -> tuple[str, ...]:
    return tuple("stick" if one else "slip" for one in sticks.tolist())


def _checked_span(t_span: ArrayLike) -> tuple[float, float]:
    given = np.asarray(t_span, float)
    if given.shape != (2,) or not np.isfinite(given).all() or not given[0] < given[1]:
        raise ValueError(f"t_span is {given.tolist()}; give (t_start, t_end), finite and growing.")
    return float(given[0]), float(given[1])


def contacts(
    M: GivenMatrix, contacts: Sequence[Sequence[Any]], force: GivenRow, velocities: Sequence[str],
    rates: Mapping[str, Given] | tuple[()] = (), parameters: Mapping[str, float] | tuple[()] = (),
) -> Contacts:  # fmt: skip
    """Return the mechanism with dry friction at several points of contact.

    Parameters
    ----------
    M : (n, n)
        Mass matrix: the kinetic energy is v·Mv/2. May name positions and parameters.
    contacts : sequence of (J, mu, normal) or (J, mu, normal, surface)
        For each: the rows J (2, n) of its slip, Coulomb's coefficient, the normal force, and the velocity (2,) of the
        other body, left out if it rests. May name positions and parameters; a time is a position with the rate 1.
    force : (n,)
        All but friction and the normal forces. May name velocities too.
    velocities : (n,) names
    rates : mapping of name to text, optional
        The positions, and how each moves.
    parameters : mapping of str to float, optional

    Returns
    -------
    Contacts
        Its `at` gives the system at one contact's set, for all that is known of a hemisphere; its `simulate_nonsmooth`
        and `simulate` follow motions, its `decide` says which contacts stick.

    Raises
    ------
    ValueError
        A shape is wrong, text cannot be read, M is not positive definite, the rows of a J are dependent, or what a
        normal force reads is not known to leave one motion.

    Examples
    --------
    Two blocks of 1 kg joined by a spring. The second is pulled; the first waits until the spring is long enough:

    >>> blocks = contacts(
    ...     M=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
    ...     contacts=[(((1, 0, 0, 0), (0, 1, 0, 0)), 0.3, 10), (((0, 0, 1, 0), (0, 0, 0, 1)), 0.3, 10)],
    ...     force=("4*stretch", 0, "5 - 4*stretch", 0), velocities=("u1", "v1", "u2", "v2"),
    ...     rates={"stretch": "u2 - u1"},
    ... )
    >>> blocks.decide((0, 0, 0, 0, 0)).kinds
    ('stick', 'slip')
    >>> [phase.kinds for phase in blocks.simulate_nonsmooth((0, 0, 0, 0, 0), (0, 1.5)).phases]
    [('stick', 'slip'), ('slip', 'slip')]
    """
    words = formula_reading.velocities(velocities)
    given = formula_reading.mapping(rates, "rates")
    positions = formula_reading.words(tuple(given), "rates")
    if len(words) - 2 + len(positions) > len(SLOW_NAMES):
        most = len(SLOW_NAMES) + 2
        raise ValueError(f"velocities and rates name {len(words) + len(positions)}; give at most {most} of both.")
    known = formula_reading.parameters(parameters, (*words, *positions))
    still, n = (*positions, *known), len(words)
    rows = formula_reading.row(force, "force", n, ("c", "s", "x", "y", *words, *still))
    refuse_fast_names(rows)
    found = Contacts(
        formula_reading.matrix(M, "M", n, n, still),
        read_contacts(contacts, n, still),
        rows,
        words,
        formula_reading.rates(given, positions, (*words, *still)),
        known,
    )
    found.mechanisms  # noqa: B018 (raises where M is not positive definite, or a J not of rank 2)
    return found
