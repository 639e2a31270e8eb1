"""Lyapunov exponents of a motion, and its Poincare section at every period of a forcing.

Benettin, Galgani, Giorgilli and Strelcyn (1980): the derivative of the motion over each period acts on an orthonormal
basis, and a QR decomposition gives by how much it stretched each direction. In the limit eps -> 0 derivatives go
through arrival at Sigma, sliding and crossing, so that directions that a slide forgets have the exponent -inf.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array, read_only
from ...results.result import Result
from ...results.tables import html_table, paragraphs, table_number
from ...results.words import say
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..initial_value.field import field as formulas_of
from ..simulate import MAX_STEPS, checked_eps, checked_state, checked_tolerances, with_time
from .result import PeriodicStatus
from .search import shooting
from .shooting import LostError

BATCHES = 16  # parts of equal length whose spread gives the errors


@dataclass(frozen=True, eq=False)
class LyapunovExponents(Result):
    """Lyapunov exponents of one motion; arrays are read-only.

    Attributes
    ----------
    values : ndarray (q,)
        Largest first, per unit of time; of a forced motion of all but its clocks, whose exponents are 0. -inf of
        directions that are forgotten.
    errors : ndarray (q,)
        Standard errors: of the mean over 16 parts of the motion, as if these were independent.
    section : ndarray (k, 2 + m)
        Poincare section: states at the ends of the periods that were counted.
    period : float
    reason : str
        How long it was followed, and why no longer if it was to be.
    """

    values: Array
    errors: Array
    section: Array = field(repr=False)
    period: float
    reason: str

    def _tables_(self) -> str:
        rows = zip(map(table_number, self.values.tolist()), (f"{error:.1e}" for error in self.errors), strict=True)
        return html_table(("exponent", "error"), list(rows)) + paragraphs([self.reason])


@takes_names
def lyapunov_exponents(
    system: AnySystem,
    psi: Psi | None,
    state0: ArrayLike,
    period: float,
    *,
    eps: float | None = None,
    count: int = 400,
    transient: int = 50,
    rtol: float = 1e-8,
    atol: float = 1e-10,
    stiction: float = 1.0,
    max_steps: int = MAX_STEPS,
    max_step: float = np.inf,
) -> LyapunovExponents:
    """Lyapunov exponents of the motion from a state, followed over many periods, and its states at each of them.

    Parameters
    ----------
    system : ELinear, System, or one of them frozen at a z
    psi : Psi or None
        As in `periodic_motion`.
    state0 : (2 + m,)
        (x, y, z1, ..., zm).
    period : float
        Of the forcing, or of a system without one any time after which derivatives are made orthogonal again.
    eps, rtol, atol, stiction, max_steps, max_step
        As in `periodic_motion`.
    count : int
        Periods that are counted, at least 16.
    transient : int
        Periods before, which are not.

    Returns
    -------
    LyapunovExponents

    Raises
    ------
    ValueError
        An argument is invalid, or the motion or its derivative ends before 16 periods were counted; the message says
        why.

    Examples
    --------
    A pendulum that is driven into chaos (published: 0.160, over a long time):

    >>> import math
    >>> from codim2_core import System, lyapunov_exponents, psi
    >>> pendulum = System(U=("-0.1*x - sin(z1) + 2.5*sin(z2)", "-y"), W=("x", "1"))
    >>> found = lyapunov_exponents(pendulum, psi.constant(), (0.5, 0.0, 1.0, 0.0), 2*math.pi, eps=1e-3, count=64)
    >>> bool(found.values[0] > 0.1), round(float(found.values.sum()), 6)
    (True, -1.1)
    """
    checked_tolerances(rtol, atol, max_steps, max_step)
    if count < BATCHES:
        raise ValueError(f"count is {count}; give at least {BATCHES} periods.")
    start = checked_state(with_time(state0, system, 0.0), formulas_of(system).m)
    asked = shooting(
        system, psi, checked_eps(eps, psi, stiction), start, period, None, atol / rtol, max_steps, stiction, max_step
    )
    free = np.ix_(asked.free, asked.free)
    basis = np.eye(int(asked.free.sum()))
    growth, section, state, why = [], [], start, ""
    for i in range(transient + count):
        try:
            shot = asked.shot(state, period, rtol)
        except LostError as lost:
            ended = lost.status is PeriodicStatus.MOTION_ENDS
            why = lost.run.reason if ended else lost.run.variation().reason
            break
        state = shot.run.states[-1]
        basis, stretched = np.linalg.qr(shot.variation.last[free] @ basis)
        if i >= transient:
            with np.errstate(divide="ignore"):
                growth.append(np.log(np.abs(np.diag(stretched))))
            section.append(state)
    if len(growth) < BATCHES:
        raise ValueError(f"{len(growth)} periods could be counted, of {BATCHES} that are needed at least. {why}")
    return _average(np.array(growth) / period, np.array(section), period, why)


def _average(rates: Array, section: Array, period: float, why: str) -> LyapunovExponents:
    """Average the rates (k, q) of all periods."""
    parts = np.array([part.mean(axis=0) for part in np.array_split(rates, BATCHES)])
    values = rates.mean(axis=0)
    forgotten = np.isneginf(parts).any(axis=0)
    with np.errstate(invalid="ignore"):
        errors = np.where(forgotten, 0.0, parts.std(axis=0, ddof=1) / np.sqrt(BATCHES))
    order = np.argsort(-values, kind="stable")
    reason = say("exponents", count=len(rates), time=len(rates) * period)
    sentence = f"{reason} {why}".strip()
    return LyapunovExponents(read_only(values[order]), read_only(errors[order]), read_only(section), period, sentence)
