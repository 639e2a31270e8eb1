"""The portrait's name: case (tab:cases), name (fig:sketches, fig:3cases), degeneracies, and a student's sentence."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from .critical import CriticalSet, Existence, Location, critical_sets, determinant_sign, locate
from .equator import EquatorCycle, EquatorEquilibria, equator_cycle, equator_equilibria
from .regularisation import Psi
from .systems import Coefficients, ELinear


@dataclass(frozen=True, slots=True)
class Degeneracy:
    """Something that a small change of the system would destroy: its name, and a sentence that explains it."""

    name: str
    sentence: str


@dataclass(frozen=True, slots=True)
class Classification:
    """Name of a phase portrait.

    Attributes
    ----------
    case : "I", "II", "III" or None
        tab:cases; None on the borders between the cases.
    name : str
        "CM" or "NCM" (critical set or none) and the number of distinct equilibria on the equator, as in
        fig:sketches: "CM0", "CM2", "CM4", "NCM2", "NCM4"; other numbers only where `degeneracies` says why.
    sentence : str
    degeneracies : tuple of Degeneracy
    """

    case: str | None
    name: str
    sentence: str
    degeneracies: tuple[Degeneracy, ...]


_MULTIPLE = {
    2: Degeneracy(
        "saddle-node",
        "Θ has a double zero: two limit directions have just met (fig:SNBIF, eq:tangencies). Counted once here.",
    ),
    3: Degeneracy(
        "pitchfork",
        "Θ has a triple zero with λ_θ = 0: one limit direction is splitting into three (degenerate case D2). "
        "Counted once here.",
    ),
    4: Degeneracy("quadruple zero", "Θ has a fourfold zero: all four limit directions have met. Counted once here."),
}


def _equator_degeneracies(equator: EquatorEquilibria, cycle: EquatorCycle | None) -> list[Degeneracy]:
    found = []
    if equator.all_directions:
        found.append(
            Degeneracy(
                "all directions",
                "a = d, b = 0 and f = 0: Θ ≡ 0, every direction is a limit direction (the ball at z = 0).",
            )
        )
    found += [_MULTIPLE[k] for k in sorted({int(k) for k in equator.multiplicity if k > 1})]
    if cycle is not None and cycle.exponent == 0.0:
        found.append(
            Degeneracy(
                "neutral equator",
                "The equator is a closed orbit with exponent 0: it neither attracts nor repels to first order.",
            )
        )
    return found


def _critical_degeneracies(location: Location, critical: tuple[CriticalSet, ...]) -> list[Degeneracy]:
    names = {
        Existence.EQUATOR: "transcritical",
        Existence.SINGULAR_NONE: "det A = 0",
        Existence.SINGULAR_OUTSIDE: "det A = 0",
        Existence.SINGULAR_LINE: "line of critical points",
        Existence.EVERYTHING: "everything stands still",
    }
    found = []
    if location.existence in names:
        found.append(Degeneracy(names[location.existence], location.existence.value))
    if any(C.kind == "centre (linear)" for C in critical):
        found.append(
            Degeneracy(
                "tr J = 0",
                "tr J = 0 within rounding: a Hopf bifurcation of the layer problem. The linearisation is a centre; "
                "whether C is stable is decided by nonlinear terms.",
            )
        )
    return found


def _case(coefficients: Coefficients) -> tuple[str | None, list[Degeneracy]]:
    a, b, d = coefficients.a, coefficients.b, coefficients.d
    if a == 0.0 or d == 0.0:
        which = "a = d = 0" if a == d == 0.0 else "a = 0" if a == 0.0 else "d = 0"
        return None, [Degeneracy(which, f"{which}: on the border between Case I and Cases II, III (tab:cases).")]
    if (a > 0.0) == (d > 0.0):
        return "I", []
    sign = determinant_sign(a, b, d)
    return (None if sign == 0 else "III" if sign > 0 else "II"), []


def _directions(equator: EquatorEquilibria, cycle: EquatorCycle | None) -> str:
    if equator.all_directions:
        return "Every direction is a limit direction."
    count = len(equator.theta)
    if count == 0:
        if cycle is None or cycle.exponent == 0.0:
            return "No limit directions: the equator is a closed orbit."
        outer, inner = ("attracts", "repels") if cycle.exponent < 0.0 else ("repels", "attracts")
        return f"No limit directions: the equator is a closed orbit that {outer} outside and {inner} on the hemisphere."
    arriving = int((equator.lambda_rho < 0.0).sum())
    leaving = int((equator.lambda_rho > 0.0).sum())
    noun = "limit direction" if count == 1 else "limit directions"
    if leaving == 0:
        return f"{count} {noun}: trajectories reach Σ along {'it' if count == 1 else 'them'}."
    if arriving == 0:
        return f"{count} {noun}: trajectories leave Σ along {'it' if count == 1 else 'them'}."
    return f"{count} {noun}: trajectories reach Σ along {arriving} and leave it along {leaving}."


def _consequence(location: Location, critical: tuple[CriticalSet, ...]) -> str:
    if not critical:
        if location.existence is Existence.NONE:
            return "There is no critical set, so nothing slides: what reaches Σ crosses it."
        return location.existence.value
    kind = critical[0].kind
    if kind.startswith("stable"):
        return f"The critical set C is a {kind}: stable sliding along Σ."
    if kind == "saddle":
        return "The critical set C is a saddle whatever Ψ is: sliding along Σ is unstable, almost every orbit leaves."
    if kind.startswith("unstable"):
        return f"The critical set C is an {kind}: sliding along C itself is unstable."
    return "The critical set C is a centre to first order."


def portrait(
    coefficients: Coefficients,
    equator: EquatorEquilibria,
    cycle: EquatorCycle | None,
    location: Location,
    critical: tuple[CriticalSet, ...],
) -> Classification:
    """Name a portrait from its parts (all at one z)."""
    case, degeneracies = _case(coefficients)
    degeneracies += _equator_degeneracies(equator, cycle) + _critical_degeneracies(location, critical)
    count = "∞" if equator.all_directions else str(len(equator.theta))
    name = ("CM" if critical else "NCM") + count
    prefix = f"Case {case}, {name}. " if case else f"{name}. "
    sentence = prefix + _directions(equator, cycle) + " " + _consequence(location, critical)
    return Classification(case, name, sentence, tuple(degeneracies))


def classify(system: ELinear | Coefficients, psi: Psi, z: ArrayLike = ()) -> Classification:
    """Case, portrait name, sentence and degeneracies of the e-linear system at z.

    Parameters
    ----------
    system : ELinear, or Coefficients
    psi : Psi
        Decides the kind of the critical set (Case III: sec:case3), never the name.
    z : (m,) floats

    Returns
    -------
    Classification
    """
    coefficients = system.at(z)
    location = locate(coefficients)
    return portrait(
        coefficients,
        equator_equilibria(coefficients),
        equator_cycle(coefficients),
        location,
        critical_sets(coefficients, psi),
    )
