"""Limit cycles of the layer problem, as samples of a return map show them, and why there are none where none can be.

Of an e-linear system a theorem may exclude them, see `reason_for_none`; everywhere else they are searched for by the
first turn of orbits about critical sets, see `cycle_search`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...results.arrays import Array
from ...results.result import Pictured, Several, Tabled, result_rows
from ...results.tables import paragraphs, point, table_number
from ...results.words import say
from ...systems.coefficients import Coefficients
from ...systems.kinds import AnySystem, takes_names
from ...systems.psi.function import Psi
from ..layer_problem.critical import CriticalSet, slow_flow_at
from ..layer_problem.linearisation import Existence, Location, locate, matrix_determinant
from ..layer_problem.problem import LayerProblem, found_once
from .cycle_search import search_cycles
from .periodic_orbit import Orbit
from .proof.result import Proof, covers
from .ray_section import FixedPoint

NO_FLOW = np.zeros(0)
SEMISTABLE = 1e-5  # |ln multiplier| below which a cycle counts as semistable: a fold of cycles
SEMISTABLE_NOTE = say("semistable")


@dataclass(frozen=True, eq=False)
class LimitCycle(Tabled):
    """A limit cycle of the layer problem (3.26); arrays are read-only.

    Attributes
    ----------
    points : ndarray (m, 2)
        A closed polyline in the projected disc, in order of increasing time; the last point is the first.
    period : float
        In tau, the fast time of kappa_2.
    period_T : float
        The same in T, the time of `trajectories` (dT = ebar dtau).
    multiplier : float
        Floquet multiplier, from the variational equation along the cycle.
    divergence_multiplier : float
        exp of the integral over tau of the divergence of ``U(e_Psi(x2))``: the same number by Liouville's formula.
    kind : str
        "stable", "unstable" or "semistable" (a fold of cycles, within resolution).
    direction : int
        +1 anticlockwise, -1 clockwise.
    mean_e : ndarray (2,)
        Mean of e_Psi over a period; in an e-linear system ``-A^-1 f`` by Proposition 4.2.
    slow_flow : ndarray (m,)
        Mean of z' over a period; in an e-linear system ``B mean_e + g``, that on the critical set, by Proposition 4.2.
    closure : float
        Distance on the sphere between the start and the end of one period.
    """

    _head_ = ("kind", "period", "multiplier", "mean of e", "slow flow z′")

    points: Array = field(repr=False)
    period: float
    period_T: float
    multiplier: float
    divergence_multiplier: float
    kind: str
    direction: int
    mean_e: Array
    slow_flow: Array
    closure: float

    def _row_(self) -> tuple[str, ...]:
        flow = point(self.slow_flow)
        return self.kind, table_number(self.period), table_number(self.multiplier), point(self.mean_e), flow

    @property
    def stable(self) -> bool:
        """Whether orbits on both sides approach it."""
        return self.kind == "stable"


@dataclass(frozen=True, eq=False)
class LimitCycles(Several[LimitCycle], Pictured):
    """The limit cycles found, innermost first, and what is to be said about them; iterates over the cycles.

    Attributes
    ----------
    cycles : tuple of LimitCycle
    reason : str
        Why there is none, or how those there are were found.
    notes : tuple of str
        Named near-degeneracies: near a loop through the equator, semistable, too small, undecided.
    proved : Proof or None
        None if no proof was requested. It is true in a condition exactly where the count is proved.
    """

    _held_ = "cycles"

    cycles: tuple[LimitCycle, ...]
    reason: str
    notes: tuple[str, ...] = ()
    proved: Proof | None = None

    def _tables_(self) -> str:
        reason = self.reason if self.proved is None else self.proved.reason
        return result_rows(self) + paragraphs([reason, *self.notes])


def surrounds(line: Array, place: Array) -> bool:
    """Whether a closed polyline (m, 2) winds about a point."""
    x, y = (line - place).T
    angle = np.unwrap(np.arctan2(y, x))
    return bool(abs(angle[-1] - angle[0]) > math.pi)


def reason_for_none(
    coefficients: Coefficients, critical: tuple[CriticalSet, ...], location: Location | None = None
) -> str | None:
    """Return the theorem that excludes limit cycles, or None; then a, d differ in sign and det A > 0."""
    a, _, d, f1, f2 = coefficients.plane
    if not critical:
        existence = (locate(coefficients) if location is None else location).existence
        if existence is Existence.NONE:
            return say("no set to surround")
        return f"{say('no isolated set to surround')} {existence.value}"
    if matrix_determinant(*coefficients.affine[:4])[1] < 0:
        return say("only a saddle")
    if a == d == 0.0:
        return say("preserves area")
    if a * d >= 0.0:
        sign = "negative" if a + d < 0.0 else "positive"
        return say("Bendixson", sign=sign)
    if f1 == f2 == 0.0:
        return say("linear orbits")
    if a == -d and abs(f1) == abs(f2):
        return say("reversible")
    return None


@found_once()
def excluding_theorem(problem: LayerProblem) -> str | None:
    """Return the theorem that excludes limit cycles of a layer problem (`reason_for_none`), or None."""
    form = problem.at.normal_form
    return None if form is None else reason_for_none(form, problem.critical, problem.location)


@takes_names
def limit_cycles(system: AnySystem, psi: Psi, z: ArrayLike = (), *, prove: bool = False) -> LimitCycles:
    """Find the limit cycles of the layer problem, (3.26), Section 4.3.3 (the closed equator is not one of them).

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    prove : bool
        Try to prove that there are just these: `LimitCycles.proved` says whether that was done. A theorem costs
        nothing; else by a certificate, for the systems and Psi of `prove_portrait`. As measured on e-linear ones:
        without cycles 59 of 60 random systems are proved, half of them within 0.05 s; with cycles 25 of 40, half
        within 0.35 s.

    Returns
    -------
    LimitCycles
        Empty, with a reason, wherever a theorem forbids cycles: that costs no integration. Elsewhere the `reason` says
        how they were searched for: by samples (`cycle_search`), which prove nothing of what they do not show.

    Examples
    --------
    >>> from codim2_core import ELinear, limit_cycles, psi
    >>> found = limit_cycles(ELinear(1.0, 3.0, -2.0, (0.4, 0.1)), psi.rational(), prove=True)
    >>> len(found), bool(found.proved)
    (0, True)
    >>> found.proved.save("certificate.json")  # doctest: +SKIP
    >>> found.proved.checker()  # python THIS < certificate.json  # doctest: +ELLIPSIS
    '...check.py'
    """
    problem = LayerProblem(system.at(z), psi)
    found = cycles_of(problem)
    return replace(found, proved=proof_of(problem)) if prove else found


@found_once()
def certificate_of(problem: LayerProblem) -> Proof:
    """Look for a certificate of the portrait of a layer problem."""
    from .proof.prove import prove_layer_problem  # on first use: it loads the checker, and what it needs of SciPy

    return prove_layer_problem(problem, closed_orbits(problem).cycles)


def proof_of(problem: LayerProblem) -> Proof:
    """Prove how many limit cycles a layer problem has, as far as that can be done: by a theorem, or a certificate."""
    theorem = excluding_theorem(problem)
    return certificate_of(problem) if theorem is None else Proof(True, (), theorem)


def provable(problem: LayerProblem) -> str:
    """Say how the number of limit cycles may be proved: by a "theorem", by a "certificate", or "", not at all."""
    if excluding_theorem(problem) is not None:
        return "theorem"
    if not covers(problem.psi):
        return ""
    return "" if problem.at.polynomials is None else "certificate"


@found_once("cycles")
def cycles_of(problem: LayerProblem) -> LimitCycles:
    """Find the limit cycles of a layer problem, with their slow flows."""
    found = closed_orbits(problem)
    W = partial(slow_flow_at, problem.at)
    means = [c.share @ W(c.e) for c in found.orbits]
    for mean in means:
        mean.flags.writeable = False
    cycles = tuple(replace(cycle, slow_flow=mean) for cycle, mean in zip(found.cycles, means, strict=True))
    return LimitCycles(cycles, found.reason, found.notes)


@dataclass(frozen=True)
class ClosedOrbits:
    """Limit cycles without their slow flows, which W alone decides, and the orbits of which each was made."""

    cycles: tuple[LimitCycle, ...]
    orbits: tuple[Orbit, ...]
    reason: str
    notes: tuple[str, ...] = ()


@found_once("closed_orbits")
def closed_orbits(problem: LayerProblem) -> ClosedOrbits:
    """Find the limit cycles of a layer problem as closed orbits: whatever W is."""
    theorem = excluding_theorem(problem)
    if theorem is not None:
        return ClosedOrbits((), (), theorem)
    found, reason, notes = search_cycles(problem)
    cycles = tuple(_cycle(crossing, closed, sense) for crossing, closed, sense in found)
    if any(cycle.kind == "semistable" for cycle in cycles):
        notes = (*notes, SEMISTABLE_NOTE)
    return ClosedOrbits(cycles, tuple(closed for _, closed, _ in found), reason, notes)


def _cycle(crossing: FixedPoint, found: Orbit, sense: int) -> LimitCycle:
    exponent = found.divergence
    small = abs(exponent) < SEMISTABLE and not crossing.born
    kind = "semistable" if small or crossing.touching else "stable" if exponent < 0.0 else "unstable"
    if crossing.born:
        kind = "unstable" if crossing.repelling else "stable"
    for array in (found.points, found.mean_e, NO_FLOW):
        array.flags.writeable = False
    values: dict[str, Any] = {
        "points": found.points,
        "period": found.period,
        "period_T": found.period_T,
        "multiplier": found.multiplier,
        "divergence_multiplier": math.exp(max(min(exponent, 700.0), -700.0)),
        "kind": kind,
        "direction": sense,
        "mean_e": found.mean_e,
        "slow_flow": NO_FLOW,
        "closure": found.closure,
    }
    return LimitCycle(**values)
