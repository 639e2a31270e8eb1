"""What a certificate is, and the facts about one system that all certificates read."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np

from ..layer_problem.closed_equator import EquatorCycle
from ..layer_problem.critical import CriticalSet, Existence, Location
from ..layer_problem.equator import EquatorEquilibria
from ..layer_problem.problem import LayerProblem
from ..portrait.classify import Classification, portrait
from ..psi.function import Psi
from ..systems.coefficients import Coefficients

CLOSE = 1e-9  # of the size of what is compared
RAYS = np.linspace(0.0, 2.0 * math.pi, 48, endpoint=False)


class Verdict(Enum):
    """What a certificate finds; the value is shown."""

    HOLDS = "holds"
    DOES_NOT_APPLY = "does not apply"
    FAILS = "fails"


@dataclass(frozen=True, slots=True)
class Certificate:
    """One claim of the paper, evaluated.

    Attributes
    ----------
    theorem : str
        The paper's label, with the part: "thm:case1(a)".
    statement : str
        What it says, in short.
    verdict : Verdict
    numbers : tuple of (name, value)
        What shows it.
    sentence : str
        What it comes to here, or why it does not apply.
    """

    theorem: str
    statement: str
    verdict: Verdict
    numbers: tuple[tuple[str, float], ...]
    sentence: str


@dataclass(frozen=True)
class Facts:
    """Everything the theorems speak of, of one e-linear layer problem."""

    problem: LayerProblem

    @property
    def at(self) -> Coefficients:
        """The coefficients."""
        form = self.problem.at.as_given
        assert form is not None
        return form

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
    def location(self) -> Location:
        """Where A e + f = 0."""
        assert self.problem.location is not None
        return self.problem.location

    @property
    def critical(self) -> tuple[CriticalSet, ...]:
        """The critical sets."""
        return self.problem.critical

    @property
    def portrait(self) -> Classification:
        """The portrait's name."""
        return self.problem.keep(portrait)

    @property
    def size(self) -> float:
        """The largest coefficient (1 if all are zero): what residuals are compared with."""
        return self.at.size or 1.0

    @property
    def generic(self) -> bool:
        """Whether the equator is not degenerate and the critical set not on it."""
        equator = self.equator
        flat = bool((equator.multiplicity > 1).any() or equator.radially_degenerate.any())
        return not (equator.all_directions or flat or self.location.existence is Existence.EQUATOR)


def verdict_of(holds: bool) -> Verdict:
    """Turn a truth value into HOLDS or FAILS."""
    return Verdict.HOLDS if holds else Verdict.FAILS


def not_applicable(theorem: str, statement: str, why: str) -> Certificate:
    """Say why a claim does not apply."""
    return Certificate(theorem, statement, Verdict.DOES_NOT_APPLY, (), why)
