"""Approach outcomes: what becomes of trajectories that reach the discontinuity set, for every angle of approach.

Outside, a system that does not depend on x, y is the same at every distance, so the angle alone decides which limit
direction a trajectory tends to; otherwise it does so near Sigma, and that is what is said here. Where lambda_rho < 0
there it reaches Sigma, goes up the hemisphere from Q (Theorem 3.1(b), Figure 7), and what attracts it there
is the outcome: a critical set or a limit cycle means sliding (Theorem 3.3, Proposition 4.2), another limit direction
means crossing.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..results.arrays import Array
from ..results.result import Several, Tabled, result_rows
from ..results.tables import point, table_number
from ..results.words import say, written_label
from ..systems.arguments import regularisations
from ..systems.frozen import FrozenSystem
from ..systems.kinds import AnySystem, PsiLike, takes_names
from ..systems.psi.constructors import comparison_families
from ..systems.psi.function import Psi
from .layer_problem.critical import CriticalSet
from .layer_problem.equator import EquatorEquilibria, arcs_of
from .layer_problem.problem import LayerProblem, found_once
from .omega_limits import angular_sign, radially_neutral
from .outcome_verdicts import (
    ARRIVAL_ANGLES,
    OUTER_ANGLES,
    OutcomeVerdict,
    add_slow_flow,
    judge_arrivals,
    judge_equator_spirals,
)

AT_ZERO = 1e-9  # angle to a limit direction that counts as that direction


@dataclass(frozen=True, eq=False)
class Outcome(Tabled):
    """The outcome for trajectories that arrive along one limit direction (or spiral onto the closed equator).

    Attributes
    ----------
    theta : float or None
        The limit direction, radians; None for the closed equator and where every direction is one.
    label : str
        "Q1", ...; "equator"; "every direction".
    arrives : str
        "open set" (angularly attracting), "one side", "single direction" (angularly repelling), or "nothing".
    verdict : str
        "slide", "cycle" (sliding around a limit cycle), "cross", "undecided", or "misses" (never reaches Sigma).
    onto : str or None
        What it slides on ("C", or "C1", "C2", ... where there are several; "cycle 1") or leaves along ("Q2",
        "equator").
    leaving : float or None
        Direction in which it leaves Sigma, for "cross".
    slow_flow : ndarray (m,) or None
        z' while sliding; on a cycle its mean, in the e-linear system the same by Proposition 4.2.
    reason : str
    depends_on_psi : bool or None
        Whether other regularisations give another outcome; None where they were not asked.
    families : tuple of (Psi as a menu writes it, verdict, onto)
        What they give; empty where a theorem makes asking needless.
    slides_alike : bool
        It depends on Psi what it slides on, C or a cycle around it, but not how: the slow flow is the same.
    why : str
        Of "undecided": "several" (the orbits have more than one ending, or run into a saddle), "neutral" (to first
        order nothing arrives or leaves), or "unfollowed" (the computation gave up); "" else.
    """

    _head_ = ("limit direction", "θ", "arrives", "verdict", "onto", "leaves at θ", "slow flow z′", "why")

    theta: float | None
    label: str
    arrives: str
    verdict: str
    onto: str | None
    leaving: float | None
    slow_flow: Array | None
    reason: str
    depends_on_psi: bool | None = False
    families: tuple[tuple[str, str, str | None], ...] = ()
    slides_alike: bool = False
    why: str = ""

    def _row_(self) -> tuple[str, ...]:
        theta, leaving = ("–" if angle is None else table_number(angle) for angle in (self.theta, self.leaving))
        flow = "–" if self.slow_flow is None else point(self.slow_flow)
        return self.label, theta, self.arrives, self.verdict, self.onto or "–", leaving, flow, self.reason

    @property
    def slides(self) -> bool | None:
        """Whether it ends up sliding; crossing includes turning away from Sigma, as in Section 5.2.

        None where it is undecided.
        """
        return None if self.verdict == "undecided" else self.verdict in ("slide", "cycle")


@dataclass(frozen=True, eq=False)
class Outcomes(Several[Outcome]):
    """Outcomes of all limit directions that trajectories arrive along, open sets first; iterates over them.

    Attributes
    ----------
    outcomes : tuple of Outcome
    directions : tuple of Outcome
        The same for each of Q1, Q2, ... in order, also those that nothing arrives along ("misses").
    equator : EquatorEquilibria
    whole : Outcome or None
        That of all angles, where no Q decides (closed equator, or every direction is a limit direction).
        None where there are limit directions Q.
    """

    _held_ = "outcomes"

    outcomes: tuple[Outcome, ...]
    directions: tuple[Outcome, ...] = field(repr=False)
    equator: EquatorEquilibria = field(repr=False)
    whole: Outcome | None
    _at: FrozenSystem = field(repr=False)

    def _tables_(self) -> str:
        return result_rows(self) or result_rows(self.directions)

    def destination(self, theta: float) -> int | None:
        """Index (from 0) of the limit direction that a trajectory outside, now at angle theta, tends to.

        None where no Q decides: where there is none, or theta leads to a whole arc of limit directions. Raises
        ValueError: theta is not finite.
        """
        if not math.isfinite(theta):
            raise ValueError(f"theta is {theta}; give a finite angle in radians.")
        if self.whole is not None:
            return None
        angle = theta % math.tau
        for i, zero in enumerate(self.equator.theta.tolist()):
            if abs(math.remainder(angle - zero, math.tau)) <= AT_ZERO:
                return i
        if any((angle - first) % math.tau <= (last - first) % math.tau for first, last in self.equator.arcs.tolist()):
            return None
        cuts = self._cuts
        after = bisect.bisect([cut for cut, _ in cuts], angle) % len(cuts)
        (begin, before), (end, beyond) = cuts[after - 1], cuts[after]
        # Theta has one sign between its zeros; near a multiple one rounding would decide
        middle = 0.5 * (begin + end + (0.0 if end > begin else math.tau))
        c, s = math.cos(middle), math.sin(middle)
        u, v = self._at.U(np.array([c, s])).tolist()
        return beyond if c * v > s * u else before

    @property
    def _cuts(self) -> list[tuple[float, int | None]]:
        """Limit directions (angle, index) and the ends of whole arcs of them (angle, None), in order."""
        ends = [(end, None) for end in self.equator.arcs.ravel().tolist()]
        cuts = [*((zero, i) for i, zero in enumerate(self.equator.theta.tolist())), *ends]
        return sorted(cuts, key=lambda cut: cut[0])

    def outcome(self, theta: float) -> Outcome:
        """Outcome for a trajectory that starts outside at angle theta (radians).

        At any distance, or near Sigma if U depends on x or y.
        """
        if self.whole is not None:
            return self.whole
        i = self.destination(theta)
        return on_arcs(self.equator) if i is None else self.directions[i]

    @property
    def arcs(self) -> tuple[tuple[float, float, Outcome], ...]:
        """The circle of approach angles, cut at the limit directions: (from, to, outcome), to > from."""
        if self.whole is not None:
            return ((0.0, math.tau, self.whole),)
        angles = [angle for angle, _ in self._cuts]
        ends = [*angles[1:], angles[0] + math.tau]
        return tuple((t, e, self.outcome(0.5 * (t + e))) for t, e in zip(angles, ends, strict=True))


def on_arcs(equator: EquatorEquilibria) -> Outcome:
    """Say of angles that they lead to a whole arc of limit directions, as a Theta with kinks may have."""
    reason = " ".join(arcs_of(equator.arcs)) or say("no directions found")
    return Outcome(None, "equator", "nothing", "undecided", None, None, None, reason, why="unfollowed")


MAX_COMPARED_SETS = 8  # critical sets: with more, other regularisations are asked only on request


def _sensitive(at: FrozenSystem, equator: EquatorEquilibria, critical: tuple[CriticalSet, ...]) -> bool:
    """Whether no theorem fixes the outcome for every Psi: Case III, crossing with several ways out, any general U."""
    form = at.normal_form
    if form is None:
        return True
    if critical:
        return form.a * form.d < 0.0 and critical[0].kind != "saddle"
    return int(((equator.lambda_rho > 0.0) & (equator.lambda_theta < 0.0)).sum()) > 1


def _radial(at: FrozenSystem) -> Array:
    """lambda_rho in many directions, where Theta vanishes identically."""
    angle = 2.0 * np.pi * np.arange(64) / 64.0
    e = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return (e * at.U(e)).sum(axis=-1)


def _arrival(equator: EquatorEquilibria, i: int) -> str:
    if equator.multiplicity[i] % 2 == 0:
        return "one side"
    return "open set" if angular_sign(equator, i) < 0 else "single direction"


@takes_names
def approach_outcomes(
    system: AnySystem,
    psi: Psi,
    z: ArrayLike = (),
    *,
    compare: Sequence[PsiLike] | None = None,
) -> Outcomes:
    """Say of every limit direction whether what arrives there slides, and on what, or crosses, and where to.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
    psi : Psi
    z : (m,) floats
    compare : sequence of Psi, optional
        Regularisations that `Outcome.depends_on_psi` compares where no theorem answers; default the built-in families
        with n = 1 to 4 of the Hill family (none if there are more than 8 critical sets). An empty sequence asks none.

    Returns
    -------
    Outcomes

    Examples
    --------
    >>> from codim2_core import approach_outcomes
    >>> [(one.label, one.verdict) for one in approach_outcomes("case1-cm4")]
    [('Q2', 'slide'), ('Q4', 'slide'), ('Q1', 'slide'), ('Q3', 'slide')]
    """
    others = None if compare is None else regularisations("compare", compare)
    return compared_outcomes(LayerProblem(system.at(z), psi), others)


@found_once("outcomes")
def outcomes_of(problem: LayerProblem) -> Outcomes:
    """Say of every limit direction of a layer problem what becomes of what arrives there."""
    return compared_outcomes(problem, None)


def compared_outcomes(own: LayerProblem, compare: Sequence[Psi] | None) -> Outcomes:
    """Say the same, with the regularisations that are asked as in `approach_outcomes`."""
    equator, asked = own.equator, _comparison(own, compare)
    if not len(equator):
        whole = _outcome_of_equator(asked)
        found = () if whole.verdict == "misses" else (whole,)
        return Outcomes(found, (), equator, whole, own.at)
    directions = _direction_outcomes(asked, range(len(equator)))
    order = ("open set", "one side", "single direction")
    found = sorted((o for o in directions if o.arrives in order), key=lambda o: order.index(o.arrives))
    return Outcomes(tuple(found), directions, equator, None, own.at)


def outcome_towards(own: LayerProblem, theta: float, compare: Sequence[Psi] | None = None) -> Outcome:
    """Say what `outcomes_of` says of one angle of approach, at the cost of that one."""
    equator, asked = own.equator, _comparison(own, compare)
    if not len(equator):
        return _outcome_of_equator(asked)
    i = Outcomes((), (), equator, None, own.at).destination(theta)
    return on_arcs(equator) if i is None else _direction_outcomes(asked, (i,))[0]


class _OutcomeQuestion(NamedTuple):
    """A layer problem, the same under other regularisations that are asked, and whether these may say otherwise."""

    own: LayerProblem
    others: list[LayerProblem]
    sensitive: bool


def _comparison(own: LayerProblem, compare: Sequence[Psi] | None) -> _OutcomeQuestion:
    if not _sensitive(own.at, own.equator, own.critical):
        return _OutcomeQuestion(own, [], False)
    if compare is None:
        compare = () if len(own.critical) > MAX_COMPARED_SETS else comparison_families()
    return _OutcomeQuestion(own, [own.with_psi(other) for other in compare], True)


def _direction_outcomes(asked: _OutcomeQuestion, indices: Sequence[int]) -> tuple[Outcome, ...]:
    """Say of some limit directions (from 0) what becomes of what arrives there."""
    own, others, sensitive = asked
    equator = own.equator
    which = [i for i in indices if not radially_neutral(equator, i) and equator.lambda_rho[i] < 0.0]
    problems = {problem.psi: problem for problem in (*others, own)}  # the own Psi may be one of the others
    arrivals = {
        psi: judge_arrivals(problem, which, ARRIVAL_ANGLES if problem is own else OUTER_ANGLES)
        for psi, problem in problems.items()
    }
    judged = {i: [arrivals[problem.psi][k] for problem in (own, *others)] for k, i in enumerate(which)}
    texts = [other.psi.words for other in others]
    return tuple(_direction_outcome(own, judged.get(i, ()), texts, sensitive, i) for i in indices)


def _compare_families(
    outcome: Outcome, verdicts: list[tuple[str, str, str | None]], sensitive: bool, elinear: bool
) -> Outcome:
    if not sensitive:
        return outcome
    if not verdicts:
        return replace(outcome, depends_on_psi=None)
    depends = any((verdict, onto) != (outcome.verdict, outcome.onto) for _, verdict, onto in verdicts)
    # an e-linear system has its C for every Ψ, and Proposition 4.2 gives its slow flow to every cycle around it
    alike = depends and elinear and {outcome.verdict, *(verdict for _, verdict, _ in verdicts)} <= {"slide", "cycle"}
    reason = f"{outcome.reason} {say('alike')}" if alike else outcome.reason
    return replace(outcome, depends_on_psi=depends, families=tuple(verdicts), slides_alike=alike, reason=reason)


def _direction_outcome(
    own: LayerProblem, judged: Sequence[OutcomeVerdict], texts: list[str], sensitive: bool, i: int
) -> Outcome:
    """Say what becomes of what arrives at Q_{i+1}, judged under its own Psi and then under those with these texts."""
    equator, label = own.equator, f"Q{i + 1}"
    theta = float(equator.theta[i])
    if radially_neutral(equator, i):
        reason = say("neutral approach", Q=written_label(label))
        return Outcome(theta, label, "nothing", "undecided", None, None, None, reason, why="neutral")
    if equator.lambda_rho[i] > 0.0:
        reason = say("repels" if angular_sign(equator, i) > 0 else "leads away", Q=written_label(label))
        neighbours = equator.lambda_rho[[i - 1, (i + 1) % len(equator)]]
        if angular_sign(equator, i) < 0 and (neighbours < 0.0).any():
            reason = f"{reason} {say('turns away')}"
        return Outcome(theta, label, "nothing", "misses", None, None, None, reason)
    arrives = _arrival(equator, i)
    verdict, onto, leaving, slow, reason, why = add_slow_flow(own, judged[0])
    # a single direction is an even zero of Theta
    reason = f"{say('one side, all angles' if len(equator) == 1 else arrives, Q=written_label(label))} {reason}"
    outcome = Outcome(theta, label, arrives, verdict, onto, leaving, slow, reason, why=why)
    verdicts = [(text, *other[:2]) for text, other in zip(texts, judged[1:], strict=True)]
    return _compare_families(outcome, verdicts, sensitive, own.at.normal_form is not None)


def _outcome_of_equator(asked: _OutcomeQuestion) -> Outcome:
    own, others, sensitive = asked
    elinear, cycle = own.at.normal_form is not None, own.equator_cycle
    if own.equator.all_directions:
        label, radial = "every direction", _radial(own.at)
        if radial.max() < 0.0:
            verdict, onto, leaving, slow, reason, why = add_slow_flow(
                own, judge_equator_spirals(own, "Orbits leave the equator at all angles")
            )
            reason = f"{say('all directions')} {reason}"
            outcome = Outcome(None, label, "open set", verdict, onto, leaving, slow, reason, why=why)
            return _compare_families(
                outcome, [(other.psi.words, *judge_equator_spirals(other)[:2]) for other in others], sensitive, elinear
            )
        if radial.min() > 0.0:
            return Outcome(None, label, "nothing", "misses", None, None, None, say("all lead away"))
        rest = not radial.any()
        reason, why = (say("at rest"), "neutral") if rest else (say("some lead"), "several")
        return Outcome(None, label, "nothing", "undecided", None, None, None, reason, why=why)
    if not own.equator.proven:
        return on_arcs(own.equator)
    if cycle is None or cycle.neutral:
        reason = say("neutral equator")
        return Outcome(None, "equator", "nothing", "undecided", None, None, None, reason, why="neutral")
    if not cycle.stable_outside:
        reason = say("equator repels")
        return Outcome(None, "equator", "nothing", "misses", None, None, None, reason)
    verdict, onto, leaving, slow, reason, why = add_slow_flow(own, judge_equator_spirals(own))
    outcome = Outcome(None, "equator", "open set", verdict, onto, leaving, slow, f"{say('spiral')} {reason}", why=why)
    return _compare_families(
        outcome, [(other.psi.words, *judge_equator_spirals(other)[:2]) for other in others], sensitive, elinear
    )
