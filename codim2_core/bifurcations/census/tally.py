"""The tally of one chunk of a census: counts by name, and its typical and marginal systems.

A new distribution from which a census draws its systems is a function here, and a line in `DRAWS`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...portrait.approach_outcomes import compared_outcomes
from ...portrait.classify import portrait_name
from ...portrait.layer_problem.critical import CriticalSet
from ...portrait.layer_problem.equator import EquatorEquilibria
from ...portrait.layer_problem.problem import LayerProblem
from ...systems.elinear import ELinear
from ...systems.kinds import AnySystem
from ...systems.psi.function import Psi
from ...systems.typed import System
from .names import IMPOSSIBLE, PORTRAIT_NAMES, names

#: Draws systems: (random generator, how many) to coefficients (n, 5), or to a sequence of systems.
Draw = Callable[[np.random.Generator, int], "NDArray[np.float64] | Sequence[AnySystem]"]

_MONOMIALS = ("1", "c", "s", "c^2", "c*s", "s^2")
_COEFFICIENT_NAMES = tuple(f"{row}{i}" for row in "uv" for i in range(len(_MONOMIALS)))
_U = tuple(" + ".join(f"{row}{i}*{term}" for i, term in enumerate(_MONOMIALS)) for row in "uv")


def normal(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Draw a, b, d, f1, f2 independently from the standard normal distribution; (count, 5)."""
    return rng.standard_normal((count, 5))


def quadratic(rng: np.random.Generator, count: int) -> list[AnySystem]:
    """Draw systems quadratic in e, whose twelve coefficients (of 1, c, s, c^2, c s, s^2) are standard normal."""
    empty = System(U=_U, parameters=dict.fromkeys(_COEFFICIENT_NAMES, 0.0))
    drawn = rng.standard_normal((count, len(_COEFFICIENT_NAMES)))
    return [empty.evolve(parameters=dict(zip(_COEFFICIENT_NAMES, row, strict=True))) for row in drawn.tolist()]


DRAWS: dict[str, Draw] = {"normal": normal, "quadratic": quadratic}


Drawn = NDArray[np.float64] | Sequence[AnySystem]
SampleLocation = tuple[int, int]  # which chunk, which of its systems

#: What becomes of arriving orbits, by `Outcome.verdict`, in the order of the table.
ENDINGS = {
    "slide": "slides",
    "cycle": "slides around a cycle",
    "cross": "crosses",
    "undecided": "undecided",
    "misses": "almost none arrives",
}


class NameCount(NamedTuple):
    """The systems of one name: how many, and margin and place of the most typical and of the most marginal."""

    systems: int
    wide: float
    typical: SampleLocation
    narrow: float
    marginal: SampleLocation


@dataclass(frozen=True)
class Tally:
    """Portraits of some chunks by name, and how many systems contradict index theory."""

    found: dict[str, NameCount]
    contradictions: int = 0

    @property
    def systems(self) -> int:
        """Return the number of systems of all names."""
        return sum(entry.systems for entry in self.found.values())

    def merge(self, other: Tally) -> Tally:
        """Return both together; of equal margins this one's example is kept."""
        found = dict(self.found)
        for name, new in other.found.items():
            old = found.get(name)
            if old is None:
                found[name] = new
                continue
            typical = new[1:3] if new.wide > old.wide else old[1:3]
            marginal = new[3:] if new.narrow < old.narrow else old[3:]
            found[name] = NameCount(old.systems + new.systems, *typical, *marginal)
        return Tally(found, self.contradictions + other.contradictions)


@dataclass(frozen=True)
class CensusPlan:
    """A plan of a census: distribution, Psi, seed, and whether names tell the outcomes too."""

    draw: Draw
    psi: Psi
    seed: int
    outcomes: bool

    def drawn(self, chunk: int, size: int) -> Drawn:
        """Draw the systems of one chunk."""
        return self.draw(np.random.default_rng((self.seed, chunk)), size)


def tally(plan: CensusPlan, chunk: int, size: int) -> Tally:
    """Name the systems of one chunk."""
    drawn = plan.drawn(chunk, size)
    if len(drawn) != size:
        raise ValueError(f"draw returned {len(drawn)} systems; {size} are expected.")
    if isinstance(drawn, np.ndarray):
        return _with_outcomes(drawn, plan.psi, chunk) if plan.outcomes else _of_coefficients(drawn, chunk)
    whole = Tally({})
    for i, system in enumerate(drawn):
        problem = LayerProblem(system.at((0.0,) * getattr(system, "m", 0)), plan.psi)
        whole = whole.merge(_tally_one(problem, _margin(problem), plan.outcomes, (chunk, i)))
    return whole


def _of_coefficients(plane: NDArray[np.float64], chunk: int) -> Tally:
    codes, margins, others = names(plane)
    found: dict[str, NameCount] = {}
    for code in np.unique(codes[codes > 0]):
        where = np.flatnonzero(codes == code)
        most, least = int(where[np.argmax(margins[where])]), int(where[np.argmin(margins[where])])
        name = " ".join(PORTRAIT_NAMES[code - 1])
        found[name] = NameCount(len(where), float(margins[most]), (chunk, most), float(margins[least]), (chunk, least))
    whole = Tally(found, int(np.isin(codes, IMPOSSIBLE).sum()))
    for i, (case, name) in others.items():
        full = f"{case} {name}" if case else name
        whole = whole.merge(Tally({full: NameCount(1, 0.0, (chunk, i), 0.0, (chunk, i))}))
    return whole


def _with_outcomes(plane: NDArray[np.float64], psi: Psi, chunk: int) -> Tally:
    _, margins, _ = names(plane)
    whole = Tally({})
    for i, (a, b, d, f1, f2) in enumerate(plane.tolist()):
        problem = LayerProblem(ELinear(a, b, d, (f1, f2)).at(()), psi)
        whole = whole.merge(_tally_one(problem, float(margins[i]), True, (chunk, i)))
    return whole


def _tally_one(problem: LayerProblem, margin: float, outcomes: bool, place: SampleLocation) -> Tally:
    named = portrait_name(problem)
    name = named.full_name
    if outcomes:
        arriving = [each for each in compared_outcomes(problem, ()) if each.arrives in ("open set", "one side")]
        said = {outcome.verdict for outcome in arriving} or {"misses"}
        name = f"{name}, {' or '.join(words for verdict, words in ENDINGS.items() if verdict in said)}"
    if named.degeneracies:
        return Tally({name: NameCount(1, 0.0, place, 0.0, place)})
    turns = problem.equator.turns
    contradicts = turns is not None and turns != sum(C.index for C in problem.critical)
    return Tally({name: NameCount(1, margin, place, margin, place)}, int(contradicts))


def _margin(problem: LayerProblem) -> float:
    return margin_of(problem.equator, problem.critical)


def margin_of(equator: EquatorEquilibria, critical: Sequence[CriticalSet]) -> float:
    """Estimate how far a system lies from its nearest border, 0 to 1.

    The least of: the relative change to a multiple zero of Theta, lambda_rho against lambda_theta at each limit
    direction, det J against the square of J's entries and 1 - |e| at each critical set.
    """
    near = [1.0, equator.distance]
    rho, turning = np.abs(equator.lambda_rho), np.abs(equator.lambda_theta)
    if len(rho):
        near.append(float(np.min(rho / np.maximum(rho + turning, np.finfo(float).tiny))))
    for C in critical:
        size = float((np.asarray(C.jacobian) ** 2).sum())
        near += [1.0 - float(np.hypot(*C.e)), 2.0 * abs(C.determinant) / size if size else 0.0]
    return max(0.0, min(near))
