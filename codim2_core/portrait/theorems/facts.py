"""A certificate, and the facts about one system that all certificates read."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from ...results.arrays import Array
from ...results.paper import cite
from ...results.result import Tabled
from ...results.tables import table_number
from ...systems.coefficients import Coefficients
from ...systems.frozen import FrozenSystem
from ...systems.psi.function import Psi
from ..classify import portrait_name
from ..layer_problem.closed_equator import EquatorCycle
from ..layer_problem.critical import CriticalSet
from ..layer_problem.equator import EquatorEquilibria
from ..layer_problem.linearisation import Existence, Location
from ..layer_problem.problem import LayerProblem
from ..portrait_name import PortraitName

RELATIVE_TOLERANCE = 1e-9  # of the size of what is compared
RAY_ANGLES = np.linspace(0.0, 2.0 * math.pi, 48, endpoint=False)


UNCERTAIN = frozenset(
    {
        "limit directions uncertain",
        "critical sets uncertain",
        "index mismatch",
        "curve of equilibria",
        "everything stands still",
        "degenerate critical set",
    }
)


class Verdict(Enum):
    """The verdict of a certificate; the value is shown."""

    HOLDS = "holds"
    DOES_NOT_APPLY = "does not apply"
    FAILS = "fails"


@dataclass(frozen=True, slots=True)
class Certificate(Tabled):
    """One claim of the paper, evaluated.

    Attributes
    ----------
    theorem : str
        The paper's label, with the part: "Theorem 4.3(a)".
    statement : str
        What it says, in short.
    verdict : Verdict
    numbers : tuple of (name, value)
        What shows it.
    sentence : str
        What it comes to here, or why it does not apply.
    """

    _head_ = ("claim", "what it says", "verdict", "numbers", "here")

    theorem: str
    statement: str
    verdict: Verdict
    numbers: tuple[tuple[str, float], ...]
    sentence: str

    def _row_(self) -> tuple[str, ...]:
        numbers = ", ".join(f"{name} = {table_number(value)}" for name, value in self.numbers)
        return cite(self.theorem), self.statement, self.verdict.value, numbers, self.sentence


@dataclass(frozen=True)
class Facts:
    """Everything the theorems speak of, of one layer problem."""

    problem: LayerProblem
    system: Any = None  # the system that was frozen, where it is known: Theorem 3.3(d) looks along z
    z: tuple[float, ...] = ()

    @property
    def frozen_system(self) -> FrozenSystem:
        """The frozen system."""
        return self.problem.at

    @property
    def form(self) -> Coefficients | None:
        """The normal form, None where U is not e-linear."""
        return self.problem.at.normal_form

    @property
    def own_coefficients(self) -> tuple[Array, Array]:
        """A (2, 2) and f (2,) of an e-linear system, in its own axes."""
        form, affine = self.problem.at.as_given, self.problem.at.affine
        assert affine is not None
        if form is not None:
            return form.A, form.f
        return np.array(affine[:4]).reshape(2, 2), np.array(affine[4:])

    @property
    def slow_size(self) -> float:
        """The largest |W| on the edge and in the middle (1 if W = 0): what slow flows are compared with."""
        e = np.stack([np.cos(RAY_ANGLES), np.sin(RAY_ANGLES)], axis=-1)
        values = np.abs(self.frozen_system.W(np.concatenate([e, np.zeros((1, 2))])))
        return float(values.max(initial=0.0)) or 1.0

    @property
    def uncertain(self) -> str | None:
        """Return why a count of this system is uncertain, or None: with a reason, a claim that fails shows nothing."""
        for degeneracy in self.portrait.degeneracies:
            if degeneracy.name in UNCERTAIN:
                return degeneracy.sentence
        return None

    @property
    def psi(self) -> Psi:
        """The regularisation."""
        return self.problem.psi

    @property
    def equator(self) -> EquatorEquilibria:
        """The limit directions."""
        return self.problem.equator

    @property
    def cycle(self) -> EquatorCycle | None:
        """The closed equator."""
        return self.problem.equator_cycle

    @property
    def location(self) -> Location | None:
        """Return the solution of A e + f = 0; None where U is not e-linear."""
        return self.problem.location

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets."""
        return self.problem.critical

    @property
    def portrait(self) -> PortraitName:
        """The portrait's name."""
        return portrait_name(self.problem)

    @property
    def size(self) -> float:
        """The largest coefficient (1 if all are zero): what residuals are compared with."""
        return self.frozen_system.size or 1.0

    @property
    def generic(self) -> bool:
        """Whether the equator is not degenerate and the critical set not on it."""
        equator = self.equator
        flat = bool((equator.multiplicity > 1).any() or equator.radially_degenerate.any())
        return not (
            equator.all_directions
            or len(equator.arcs)
            or flat
            or (self.location is not None and self.location.existence is Existence.EQUATOR)
        )


@dataclass(frozen=True)
class Claim:
    """A claim of the paper, by its label, and what it says in short."""

    theorem: str
    statement: str

    def decided(self, holds: bool, numbers: Iterable[tuple[str, float]], sentence: str) -> Certificate:
        """Say whether it holds, and what shows it."""
        verdict = Verdict.HOLDS if holds else Verdict.FAILS
        return Certificate(self.theorem, self.statement, verdict, tuple(numbers), sentence)

    def not_applicable(self, why: str) -> Certificate:
        """Say why it does not apply."""
        return Certificate(self.theorem, self.statement, Verdict.DOES_NOT_APPLY, (), why)
