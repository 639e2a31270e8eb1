"""Name a portrait, of an e-linear or a general system."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..numerics.trigonometric import INPUT_ROUNDING
from ..results.result import Result, Tabled, result_rows
from ..results.tables import paragraphs
from ..results.words import SENTENCES, count_word, power, say, subscript, written_label
from .cycles.limit_cycles import LimitCycle, surrounds
from .layer_problem.closed_equator import NEUTRAL_EQUATOR, EquatorCycle
from .layer_problem.critical import CriticalSet
from .layer_problem.equator import EquatorEquilibria, arcs_of
from .omega_limits import critical_label, radially_neutral_ones


@dataclass(frozen=True, eq=False, slots=True)
class Degeneracy(Tabled):
    """Something that a small change of the system would destroy.

    Attributes
    ----------
    name : str
    sentence : str
        What it is; says where doubles leave it undecided.
    within : float
        Relative change of the coefficients (for "tr J = 0" and "neutral equator": of the terms of that number) within
        which it cannot be distinguished from what lies on either side. 0.0: the coefficients are of this kind exactly.
    """

    _head_ = ("degenerate", "why")

    name: str
    sentence: str
    within: float = 0.0

    def _row_(self) -> tuple[str, ...]:
        return self.name, self.sentence


NEARER = SENTENCES["nearer"].says.partition(" {")[0]


def undecided_degeneracy(
    name: str, sentence: str, within: float = INPUT_ROUNDING, of: str = "each coefficient"
) -> Degeneracy:
    """Make a degeneracy whose sentence says within what it cannot be distinguished from its neighbours."""
    return Degeneracy(name, f"{sentence} {say('nearer', within=power(within), of=of)}", within)


class PortraitName(NamedTuple):
    """A portrait's name without its sentence: no limit cycle is requested. Attributes as in `Classification`."""

    case: str | None
    name: str
    degeneracies: tuple[Degeneracy, ...]

    @property
    def full_name(self) -> str:
        """The name with its case, if it has one: "I CM4"."""
        return f"{self.case} {self.name}" if self.case else self.name


@dataclass(frozen=True, eq=False, slots=True)
class Classification(Result):
    """Name of a phase portrait.

    Attributes
    ----------
    case : "I", "II", "III" or None
        Table 1; None on the borders between the cases, and for systems that are not e-linear.
    name : str
        "CM" or "NCM" (critical set or none) and the number of distinct equilibria on the equator, as in
        Figure 15: "CM0", "CM2", "CM4", "NCM2", "NCM4"; other numbers only where `degeneracies` says why. For a
        system that is not e-linear a count, such as "2 critical sets, 6 limit directions"; with "found" where that
        there are no more is not proved.
    sentence : str
        Along which directions trajectories reach the discontinuity set and leave it, the critical sets, and all that
        attracts: stable critical sets and stable limit cycles.
    degeneracies : tuple of Degeneracy
    """

    case: str | None
    name: str
    sentence: str
    degeneracies: tuple[Degeneracy, ...]

    @property
    def full_name(self) -> str:
        """The name with its case, if it has one: "I CM4"."""
        return PortraitName(self.case, self.name, self.degeneracies).full_name

    def _tables_(self) -> str:
        case = f"Case {self.case}" if self.case else ""
        name = f"<p><strong>{escape(self.name)}</strong> {case}</p>"
        return f"{name}{paragraphs([self.sentence])}{result_rows(self.degeneracies)}"


NEUTRAL_CLOSED_EQUATOR = undecided_degeneracy(
    "neutral equator",
    say("neutral closed equator"),
    NEUTRAL_EQUATOR,
    "the terms of the exponent",
)


def directions(equator: EquatorEquilibria, cycle: EquatorCycle | None) -> str:
    """Describe the limit directions in a sentence or two."""
    if equator.all_directions:
        return say("all directions")
    count = len(equator.theta)
    if len(equator.arcs) and not count:
        return " ".join(arcs_of(equator.arcs))
    if count == 0:
        if not equator.proven:
            return say("no directions found")
        if cycle is None or cycle.exponent == 0.0:
            return say("closed equator")
        return say("closed equator, stable" if cycle.exponent < 0.0 else "closed equator, unstable")
    neutral = radially_neutral_ones(equator)
    moving = [rho for rho, still in zip(equator.lambda_rho.tolist(), neutral, strict=True) if not still]
    arriving, leaving = len([rho for rho in moving if rho < 0.0]), len([rho for rho in moving if rho > 0.0])
    if arriving == leaving == 0:
        first = say("none moves", count=count_word(count))
    elif arriving and leaving:
        others = "the other" + ("" if leaving == 1 else f" {count_word(leaving)}")
        rest = others if arriving + leaving == count else count_word(leaving)
        first = say("both", count=count_word(count), arriving=count_word(arriving), leaving=rest)
    elif count == 1:
        first = say("one arrives" if arriving else "one leaves")
    elif any(neutral):
        first = say(
            "some arrive" if arriving else "some leave", count=count_word(count), moving=count_word(arriving or leaving)
        )
    else:
        first = say(
            "all arrive" if arriving else "all leave", which="both" if count == 2 else f"all {count_word(count)}"
        )
    if not equator.proven:
        first = f"{first} {say('directions unproved')}"
    if not any(neutral):
        return first
    which = " and ".join(f"Q{subscript(i + 1)}" for i in range(count) if neutral[i])
    return f"{first} {say('neutral directions', which=f'{which} ' + ('is' if sum(neutral) == 1 else 'are'))}"


def attracting_cycles(cycles: Sequence[LimitCycle], critical: tuple[CriticalSet, ...]) -> str:
    """Describe the limit cycles that attract, and which critical sets they surround; "" if there are none."""
    around = Counter((cycle.stable, _surrounded_sets(cycle, critical)) for cycle in cycles if cycle.kind != "unstable")
    said = []
    for (stable, sets), count in around.items():
        if count == 1:
            said.append(say("stable cycle" if stable else "semistable cycle", sets=sets))
        else:
            said.append(say("stable cycles" if stable else "semistable cycles", count=count, sets=sets))
    return " ".join(said)


def _surrounded_sets(cycle: LimitCycle, critical: tuple[CriticalSet, ...]) -> str:
    """Name the critical sets about which a cycle winds."""
    labels = [
        written_label(critical_label(critical, i)) for i, C in enumerate(critical) if surrounds(cycle.points, C.p)
    ]
    return " and ".join(filter(None, [", ".join(labels[:-1]), *labels[-1:]]))


@dataclass(frozen=True)
class Attracting:
    """An attracting set, and the slow flow along it; arrays are read-only."""

    name: str  # "C", or "C1", "C2", … in the order of `critical_sets`; "cycle 1", … in that of `limit_cycles`
    e: NDArray[np.float64]  # (2,) (c, s) on it; its mean over a period of a cycle
    slow_flow: NDArray[np.float64]  # (m,) z' on it (4.17), over a cycle the mean (Proposition 4.2)


def attracting_set(
    critical: Sequence[CriticalSet], cycles: Callable[[], Iterable[LimitCycle]], last: ArrayLike | None = None
) -> Attracting | None:
    """Return the attracting set that sliding is on, or goes on with from the last e (2,); None where none is stable."""
    stable = [(i, C) for i, C in enumerate(critical) if C.kind.startswith("stable")]
    if stable:
        i, C = stable[0]
        if last is not None:
            i, C = min(stable, key=lambda one: float(np.hypot(*(one[1].e - np.asarray(last, float)))))
        return Attracting("C" if len(critical) == 1 else f"C{i + 1}", C.e, C.slow_flow)
    for k, cycle in enumerate(cycles()):
        if cycle.kind == "stable":
            return Attracting(f"cycle {k + 1}", cycle.mean_e, cycle.slow_flow)
    return None
