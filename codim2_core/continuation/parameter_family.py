"""A system in which one parameter varies: its equilibria, and turns at several values side by side."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Sequence
from functools import lru_cache
from itertools import chain, islice
from typing import Any, NamedTuple, TypeVar

import numpy as np

from ..arrays import Array
from ..cycles.global_section import Section
from ..cycles.periodic_orbit import MOST_STEPS
from ..cycles.section_batch.sections import Indices, Sections, critical_points
from ..layer_problem.location import Existence
from ..layer_problem.problem import LayerProblem
from ..psi.constructors import many
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .lockstep_searches import rounds
from .turns import ReturnMapPoint, Swelling, integrate_turns

DIFFERENCE_STEP = 1e-5  # of the differences for derivatives of coefficients: they are smooth, mostly linear
CACHE_SIZE = 1024  # values whose coefficients are kept: more than those at which a span is looked at for several things

At = Callable[[float], tuple[Coefficients, Psi]]


class TurnRequest(NamedTuple):
    """Turns that are asked for, from each place at each value of a family.

    Attributes
    ----------
    family : ParameterFamily, or VariedRay
    xi, values : list of float
    backward : list of bool
        Followed backward in time, which is accurate where the cycle repels. The result is the same.
    limits : list of int, optional
        Steps after which turns may be given up; as many as a turn may take at all, if they are not given.
    """

    family: Any
    xi: list[float]
    values: list[float]
    backward: list[bool]
    limits: list[int] | None = None

    @property
    def limit(self) -> int:
        """Steps that each of them may take."""
        return MOST_STEPS if self.limits is None else max(self.limits, default=0)


class PlacedSets(NamedTuple):
    """Critical sets at those of some values, `rows` of them, at which no theorem forbids cycles, and their Psi.

    Its parameters (k,) are those of each one's Psi, of one family.
    """

    rows: list[int]
    planes: Array
    e: Array
    complement: Array
    psi: Psi
    parameters: Array

    def sections(self, ray: int | Indices) -> Sections:
        """Make their sections."""
        own = None if (self.parameters == self.parameters[0]).all() else self.parameters
        return Sections(self.planes, self.e, self.complement, self.psi, own, ray)


class PreparedTurns(NamedTuple):
    """The turns of a question that have a section, and what `turns.integrate_turns` needs for them."""

    question: TurnRequest
    placed: PlacedSets
    ray: Indices
    changes: Array
    swelling: Swelling | None


def run_batch(questions: list[TurnRequest]) -> list[list[ReturnMapPoint | None]]:
    """Follow the turns of several questions, None for those that do not return, or where there is no section.

    Those of families with one Psi are followed side by side.
    """
    found: list[list[ReturnMapPoint | None]] = [[None] * len(q.xi) for q in questions]
    ready = [(asked, out) for q, out in zip(questions, found, strict=True) if (asked := q.family.asked(q)) is not None]
    alike = [p for p in ready if p[0].swelling is None and p[0].placed.psi == ready[0][0].placed.psi]
    groups = [alike] if alike else []
    groups += [[pair] for pair in ready if pair not in alike]
    for group in groups:
        parts, outs = [asked for asked, _ in group], [out for _, out in group]
        values = [part.question.values[i] for part in parts for i in part.placed.rows]
        xi = np.array([part.question.xi[i] for part in parts for i in part.placed.rows])
        backward = np.array([part.question.backward[i] for part in parts for i in part.placed.rows])
        swelling, sections = (
            parts[0].swelling,
            _join_sections([part.placed for part in parts], [part.ray for part in parts]),
        )
        changes = np.concatenate([part.changes for part in parts], axis=1)
        limit = max(part.question.limit for part in parts)
        result = integrate_turns(sections, xi, backward, changes, swelling, limit).each(values)
        places = [(out, i) for part, out in zip(parts, outs, strict=True) for i in part.placed.rows]
        for (out, i), turn in zip(places, result, strict=True):
            out[i] = turn
    return found


def _join_sections(places: list[PlacedSets], rays: list[Indices]) -> Sections:
    """Make the sections of several families with one Psi."""
    _, planes, e, complement, psi, parameters = zip(*places, strict=True)
    planes, e, complement = np.concatenate(planes), np.concatenate(e), np.concatenate(complement)
    return PlacedSets([], planes, e, complement, psi[0], np.concatenate(parameters)).sections(np.concatenate(rays))


#: A search that asks for turns; see `lockstep_searches`.
ResultT = TypeVar("ResultT")
TurnRoutine = Generator[TurnRequest, "list[ReturnMapPoint | None]", ResultT]


def side_by_side(searches: Sequence[TurnRoutine[ResultT]]) -> TurnRoutine[list[ResultT]]:
    """Run searches in one family side by side, as one that asks for all their turns together."""
    return rounds(searches, _together_asked)


def _together_asked(questions: list[TurnRequest]) -> TurnRoutine[list[list[ReturnMapPoint | None]]]:
    family, *parts = zip(*(q._replace(limits=[q.limit] * len(q.xi)) for q in questions), strict=True)
    found = iter((yield TurnRequest(family[0], *([*chain.from_iterable(part)] for part in parts))))
    return [[*islice(found, len(question.xi))] for question in questions]


class AffineCoefficients(NamedTuple):
    """Coefficients that are affine in a parameter: those at 0, and their derivative, (5,); Psi stays."""

    origin: Array
    slope: Array
    psi: Psi


class ParameterFamily:
    """A system in which one parameter varies, and the section that goes with it.

    Parameters
    ----------
    at : callable
        value -> (Coefficients, Psi).
    scale : float
        Size of changes of the value.
    bounds : (float, float), optional
        What the parameter may be.
    straight : AffineCoefficients, optional
        The same as `at`, where it is so simple.
    """

    def __init__(
        self,
        at: At,
        scale: float,
        bounds: tuple[float, float] = (-math.inf, math.inf),
        straight: AffineCoefficients | None = None,
    ) -> None:
        self.at, self.scale, self.bounds, self.straight = lru_cache(maxsize=CACHE_SIZE)(at), scale, bounds, straight
        self.problem = lru_cache(maxsize=CACHE_SIZE)(self._problem)
        self.ray: int | None = None

    def _problem(self, value: float) -> LayerProblem:
        """Make the layer problem at one value: its equilibria are found once."""
        return LayerProblem(*self.at(value))

    def allows(self, value: float) -> bool:
        """Whether a, d differ in sign and C exists with det A > 0: else no theorem leaves room for cycles."""
        if not self.bounds[0] <= value <= self.bounds[1]:
            return False
        a, b, d = self.at(value)[0].plane[:3]
        if not (a * d < 0.0 and a * d + b * b > 0.0):
            return False
        location = self.problem(value).location
        return location is not None and location.existence is Existence.INSIDE

    def allowed(self, values: Sequence[float]) -> list[float]:
        """Return the values that `allows` is true of, within rounding."""
        placed = self.placed(values)
        return [] if placed is None else [values[i] for i in placed.rows]

    def section(self, value: float) -> Section:
        """Make the section at one value; all sections of a family are on rays of the same signs."""
        problem = self.problem(value)
        return Section(*self.at(value), problem.critical[0], self.ray, location=problem.location)

    def planes(self, values: Sequence[float]) -> Array:
        """Coefficients (a, b, d, f1, f2) (n, 5) at values within the bounds."""
        if self.straight is not None:
            return self.straight.origin + np.multiply.outer(values, self.straight.slope)
        return np.array([self.at(value)[0].plane for value in values])

    def members(self, values: Sequence[float]) -> list[Psi]:
        """Psi at values within the bounds."""
        return [self.at(value)[1] for value in values] if self.straight is None else [self.straight.psi] * len(values)

    def room(self, value: float) -> float:
        """``1 - |e_C|^2``, or a negative number: positive where `allows` is true, within rounding."""
        within = self.bounds[0] <= value <= self.bounds[1]
        return float(critical_points(self.planes([value]))[1][0]) if within else -1.0

    def placed(self, values: Sequence[float]) -> PlacedSets | None:
        """Say at which values there is a section, and where C is; None if at none of them."""
        within = [i for i, v in enumerate(values) if self.bounds[0] <= v <= self.bounds[1]]
        if not within:
            return None
        planes = self.planes([values[i] for i in within])
        e, complement = critical_points(planes)
        inside = np.flatnonzero(complement > 0.0)
        if not len(inside):
            return None
        rows = [within[i] for i in inside.tolist()]
        members = self.members([values[i] for i in rows])
        parameters = np.array([member.parameter for member in members])
        return PlacedSets(rows, planes[inside], e[inside], complement[inside], members[0], parameters)

    def asked(self, question: TurnRequest) -> PreparedTurns | None:
        """Prepare turns; None if none of them has a section."""
        values = [v if math.isfinite(xi) else math.nan for xi, v in zip(question.xi, question.values, strict=True)]
        placed = self.placed(values)
        if placed is None:
            return None
        if self.ray is None:
            self.ray = self.section(values[placed.rows[0]]).ray
        changes, swelling = self._changes([values[i] for i in placed.rows])
        return PreparedTurns(question, placed, np.full(len(placed.rows), self.ray), changes, swelling)

    def _changes(self, values: list[float]) -> tuple[Array, Swelling | None]:
        """Differentiate what depends on the parameter, by differences: (a, b, d, f1, f2) (1, n, 5), and |e_Psi|."""
        if self.straight is not None:
            return np.broadcast_to(self.straight.slope, (1, len(values), 5)), None
        h = DIFFERENCE_STEP * self.scale
        ends = [(max(v - h, self.bounds[0]), min(v + h, self.bounds[1])) for v in values]
        low, high = [self.at(before) for before, _ in ends], [self.at(after) for _, after in ends]
        width = np.array([after - before for before, after in ends])
        planes = [(np.array([q.plane for q, _ in high]) - np.array([q.plane for q, _ in low])) / width[:, None]]
        psi, before, after = low[0][1], *(np.array([p.parameter for _, p in side]) for side in (low, high))
        if (before == after).all():
            return np.array(planes), None

        def swelling(zeta: Array, whose: Indices) -> Array:
            # by 1 - |e|^2, which keeps its digits where |e| is all but 1
            change = many(psi, after[whose]).complement(zeta) - many(psi, before[whose]).complement(zeta)
            here = many(psi, 0.5 * (before + after)[whose]).modulus(zeta)
            return -0.5 * change / width[whose] / np.maximum(here, 1e-300)

        return np.array(planes), swelling


def reversible(coefficients: Coefficients) -> bool:
    """Whether a = -d and |f1| = |f2|, within 1e-9: C is then a centre, and no cycle is a limit cycle."""
    a, _, d, f1, f2 = coefficients.plane
    return abs(a + d) <= 1e-9 * abs(a - d) and abs(abs(f1) - abs(f2)) <= 1e-9 * (abs(f1) + abs(f2))
