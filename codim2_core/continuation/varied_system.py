"""A system in which one parameter varies: what stands still in it, and turns at several values side by side."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from functools import lru_cache
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..cycles.section import Section
from ..cycles.sections import Indices, Sections, located
from ..layer_problem.location import Existence
from ..layer_problem.problem import LayerProblem
from ..psi.constructors import many
from ..psi.function import Psi
from ..systems.coefficients import Coefficients
from .turns import Swelling, Turn, turns

Array = NDArray[np.float64]

STEP = 1e-5  # of the differences for derivatives of coefficients: they are smooth, mostly linear
KEPT = 1024  # values whose coefficients are kept: more than those at which a span is looked at for several things

At = Callable[[float], tuple[Coefficients, Psi]]


class Question(NamedTuple):
    """Turns that are asked for, from each place at each value of a family.

    Attributes
    ----------
    family : VariedSystem
    xi, values : list of float
    backward : list of bool
        Followed backward in time, which is accurate where the cycle repels. The result is the same.
    """

    family: VariedSystem
    xi: list[float]
    values: list[float]
    backward: list[bool]


class Asked(NamedTuple):
    """The turns of a question that have a section: `rows` of them, and what `turns.turns` needs."""

    question: Question
    rows: list[int]
    planes: Array
    e: Array
    complement: Array
    ray: Indices
    changes: Array
    psi: Psi
    own: Array | None
    swelling: Swelling | None


def follow(questions: list[Question]) -> list[list[Turn | None]]:
    """Follow the turns of several questions, None for those that do not return, or where there is no section.

    Those of families with one Psi are followed side by side.
    """
    found: list[list[Turn | None]] = [[None] * len(q.xi) for q in questions]
    ready = [(asked, out) for q, out in zip(questions, found, strict=True) if (asked := q.family.asked(q)) is not None]
    alike = [pair for pair in ready if pair[0].swelling is None and pair[0].psi == ready[0][0].psi]
    groups = [alike] if alike else []
    groups += [[pair] for pair in ready if pair not in alike]
    for group in groups:
        parts, outs = [asked for asked, _ in group], [out for _, out in group]
        values = [part.question.values[i] for part in parts for i in part.rows]
        xi = np.array([part.question.xi[i] for part in parts for i in part.rows])
        backward = np.array([part.question.backward[i] for part in parts for i in part.rows])
        planes, e = (np.concatenate(v) for v in zip(*((part.planes, part.e) for part in parts), strict=True))
        complement = np.concatenate([part.complement for part in parts])
        ray = np.concatenate([part.ray for part in parts])
        changes = np.concatenate([part.changes for part in parts], axis=1)
        sections = Sections(planes, e, complement, parts[0].psi, parts[0].own, ray)
        result = turns(sections, xi, backward, changes, parts[0].swelling).each(values)
        places = [(out, i) for part, out in zip(parts, outs, strict=True) for i in part.rows]
        for (out, i), turn in zip(places, result, strict=True):
            out[i] = turn
    return found


#: A search that asks for turns; see `asking`.
Found = TypeVar("Found")
Asking = Generator[Question, "list[Turn | None]", Found]


class VariedSystem:
    """A system in which one parameter varies, and the section that goes with it.

    Parameters
    ----------
    at : callable
        value -> (Coefficients, Psi).
    scale : float
        Size of changes of the value.
    bounds : (float, float), optional
        What the parameter may be.
    """

    def __init__(self, at: At, scale: float, bounds: tuple[float, float] = (-math.inf, math.inf)) -> None:
        self.at, self.scale, self.bounds = lru_cache(maxsize=KEPT)(at), scale, bounds
        self.problem = lru_cache(maxsize=KEPT)(self._problem)
        self.ray: int | None = None

    def _problem(self, value: float) -> LayerProblem:
        """Make the layer problem at one value: what stands still in it is found once."""
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

    def section(self, value: float) -> Section:
        """Make the section at one value; all sections of a family are on rays of the same signs."""
        problem = self.problem(value)
        return Section(*self.at(value), problem.critical[0], self.ray, location=problem.location)

    def asked(self, question: Question) -> Asked | None:
        """Prepare turns; None if none of them has a section."""
        allowed = [
            i
            for i, v in enumerate(question.values)
            if self.bounds[0] <= v <= self.bounds[1] and math.isfinite(question.xi[i])
        ]
        if not allowed:
            return None
        systems = [self.at(question.values[i]) for i in allowed]
        planes = np.array([q.plane for q, _ in systems])
        e, complement = located(planes)
        inside = np.flatnonzero(complement > 0.0)
        if not len(inside):
            return None
        rows = [allowed[i] for i in inside.tolist()]
        if self.ray is None:
            self.ray = self.section(question.values[rows[0]]).ray
        changes, swelling = self._changes([question.values[i] for i in rows])
        own = None if swelling is None else np.array([psi.parameter for _, psi in systems])[inside]
        return Asked(
            question, rows, planes[inside], e[inside], complement[inside], np.full(len(rows), self.ray), changes,
            systems[inside[0]][1], own, swelling,
        )  # fmt: skip

    def _changes(self, values: list[float]) -> tuple[Array, Swelling | None]:
        """Differentiate what depends on the parameter, by differences: (a, b, d, f1, f2) (1, n, 5), and |e_Psi|."""
        h = STEP * self.scale
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
