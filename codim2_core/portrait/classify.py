"""The portrait's name: case (Table 1), name (Figure 15, Figure 16), degeneracies, and a student's sentence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from numpy.typing import ArrayLike

from ..numerics.fourier_zeros import ROUNDINGS, UNIT
from ..results.words import count_word, say
from ..systems.coefficients import Coefficients
from ..systems.frozen import FrozenSystem
from ..systems.kinds import AnySystem, takes_names
from ..systems.psi.function import Psi
from .cycles.limit_cycles import closed_orbits
from .layer_problem.closed_equator import EquatorCycle
from .layer_problem.critical import CriticalSet
from .layer_problem.disc_zeros import DiscZeros, disc_zeros
from .layer_problem.equator import EquatorEquilibria, arcs_of
from .layer_problem.linearisation import NEUTRAL_TRACE, Existence, Location, matrix_determinant
from .layer_problem.problem import LayerProblem, found_once
from .omega_limits import radially_neutral_ones
from .portrait_name import (
    NEUTRAL_CLOSED_EQUATOR,
    Classification,
    Degeneracy,
    PortraitName,
    attracting_cycles,
    directions,
    undecided_degeneracy,
)

TYPED_ROUNDING = ROUNDINGS * UNIT
TERMS = "the terms of U"


def general_name(
    at: FrozenSystem, equator: EquatorEquilibria, cycle: EquatorCycle | None, critical: tuple[CriticalSet, ...]
) -> PortraitName:
    """Name the portrait of a system that is not e-linear, from its parts (all at one z)."""
    found = disc_zeros(at.key)
    lines = "every direction" if equator.all_directions else _count(len(equator), "limit direction", equator.proven)
    if len(equator.arcs):
        arcs = "an arc" if len(equator.arcs) == 1 else f"{len(equator.arcs)} arcs"
        lines = f"{lines} and {arcs} of them" if len(equator) else f"{arcs} of limit directions"
    name = f"{_count(len(critical), 'critical set', found.proven)}, {lines}"
    degenerate = equator_degeneracies(equator, cycle, {}, TYPED_ROUNDING, TERMS)
    return PortraitName(None, name, (*degenerate, *_general_critical_degeneracies(critical, found)))


def _count(k: int, noun: str, proven: bool) -> str:
    count = f"no {noun}" if k == 0 else f"{k} {noun}" + ("" if k == 1 else "s")
    return count if proven else f"{count} found"


def _count_phrase(k: int, kind: str) -> str:
    noun = kind.replace("degenerate", "degenerate one")
    if k == 1:
        return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"
    for one, many in (("focus", "foci"), ("centre", "centres"), ("saddle-node", "saddle-nodes")):
        if one in noun:
            return f"{count_word(k)} {noun.replace(one, many)}"
    return f"{count_word(k)} {noun}s"


def general_consequence(critical: tuple[CriticalSet, ...], found: DiscZeros, cycles: int) -> str:
    """Say which critical sets there are, and how many ways to slide stably, next to so many stable limit cycles."""
    if not critical:
        if found.everything or found.curve or found.on_equator:
            return say("no isolated set")
        return say("no critical set" if found.proven else "no set found")
    kinds = [C.kind for C in critical]
    phrases = [_count_phrase(kinds.count(kind), kind) for kind in sorted(set(kinds))]
    counted = " and ".join(filter(None, (", ".join(phrases[:-1]), phrases[-1])))
    sets = (
        say("only set", kinds=counted) if len(kinds) == 1 else say("sets", count=count_word(len(kinds)), kinds=counted)
    )
    if not found.proven:
        return f"{sets} {say('sets unproved')}"
    stable = sum(kind.startswith("stable") for kind in kinds)
    if stable == 0:
        return f"{sets} {say('not stable' if len(kinds) == 1 else 'none stable')}"
    if stable + cycles == 1:
        return f"{sets} {say('one stable')}"
    return f"{sets} {say('several stable', count=count_word(stable + cycles))}"


_MULTIPLE = {2: "saddle-node", 3: "pitchfork", 4: "quadruple zero"}
_DIRECTIONS_MEET = {
    0: say("no turning"), 2: say("two have met"), 3: say("one splits"), 4: say("four directions have met")
}  # fmt: skip


def equator_degeneracies(
    equator: EquatorEquilibria, cycle: EquatorCycle | None, said: Mapping[int, str], *within: Any
) -> list[Degeneracy]:
    """Name what is degenerate on the equator, in the words that are `said` of a zero of Theta of some multiplicity."""
    said = _DIRECTIONS_MEET | dict(said)
    named = [("all directions", said[0])] if equator.all_directions else []
    named += [("arc of directions", text) for text in arcs_of(equator.arcs)]
    for m in sorted({int(m) for m in equator.multiplicity if m > 1}):
        if m == 3 and not equator.symmetric:
            named.append(("cusp", say("cusp")))
        else:
            named.append((_MULTIPLE.get(m, f"zero of multiplicity {m}"), said.get(m) or say("many have met", count=m)))
    found = [undecided_degeneracy(name, text, *within) for name, text in named]
    if not equator.proven:
        found.append(Degeneracy("limit directions uncertain", equator.certificate))
    return found if cycle is None or not cycle.neutral else [*found, NEUTRAL_CLOSED_EQUATOR]


def _general_critical_degeneracies(critical: tuple[CriticalSet, ...], found: DiscZeros) -> list[Degeneracy]:
    kinds = [C.kind for C in critical]
    named = []
    if found.everything:
        named.append(("everything stands still", say("everything at rest")))
    if found.curve:
        named.append(("curve of equilibria", say("curve of zeros")))
    if found.on_equator:
        named.append(("transcritical", say("zero on the equator")))
    if "saddle-node" in kinds:
        named.append(("fold", say("sets have met")))
    met = int((found.degenerate & ~found.rough & (found.index != 0)).sum())
    if met:
        named.append(("degenerate critical set", say("more sets have met")))
    degeneracies = [undecided_degeneracy(name, text, TYPED_ROUNDING, TERMS) for name, text in named]
    if kinds.count("degenerate") > met:
        text = say("corner")
        degeneracies.append(Degeneracy("corner at a critical set", text))
    if "centre (linear)" in kinds:
        text = say("linear centre, one of them")
        degeneracies.append(undecided_degeneracy("tr J = 0", text, NEUTRAL_TRACE, "the terms of the trace"))
    if not found.proven:
        degeneracies.append(
            Degeneracy(
                "critical sets uncertain",
                say("undecided somewhere"),
            )
        )
    if found.consistent is False:
        degeneracies.append(
            Degeneracy(
                "index mismatch",
                say("index mismatch", indices=int(found.index.sum()), degree=found.degree),
            )
        )
    return degeneracies


# What is said of an affine field in other words than of a general one.
_AFFINE_DIRECTIONS_MEET = {0: say("nothing turns"), 3: say("one splits, D2"), 4: say("four have met")}
_EXISTENCE_DEGENERACIES = {
    Existence.EQUATOR: "transcritical",
    Existence.SINGULAR_NONE: "det A = 0",
    Existence.SINGULAR_OUTSIDE: "det A = 0",
    Existence.SINGULAR_LINE: "line of equilibria",
    Existence.EVERYTHING: "everything stands still",
}


def _true_centre(coefficients: Coefficients) -> bool:
    """Whether a C with tr J = 0 is a centre for every Psi: the layer problem preserves area, or is reversible.

    For a = d = 0 it has no divergence; for a = -d and |f1| = |f2| it is reversible about a diagonal, which the one C
    lies on. For f = 0 its orbits are those of x' = A x.
    """
    a, _, d, f1, f2 = coefficients.plane
    return a == d == 0.0 or (a == -d and abs(f1) == abs(f2))


def _critical_degeneracies(
    location: Location, critical: tuple[CriticalSet, ...], coefficients: Coefficients
) -> list[Degeneracy]:
    found = []
    if location.existence in _EXISTENCE_DEGENERACIES:
        found.append(undecided_degeneracy(_EXISTENCE_DEGENERACIES[location.existence], location.existence.value))
    if any(C.kind == "centre (linear)" for C in critical):
        found.append(
            undecided_degeneracy(
                "tr J = 0",
                say("true centre" if _true_centre(coefficients) else "linear centre"),
                NEUTRAL_TRACE,
                "the terms of the trace",
            )
        )
    return found


def _case(coefficients: Coefficients) -> tuple[str | None, list[Degeneracy]]:
    a, d = coefficients.a, coefficients.d
    if a == 0.0 or d == 0.0:
        which = "a = d = 0" if a == d == 0.0 else "a = 0" if a == 0.0 else "d = 0"
        return None, [Degeneracy(which, say("between the cases", which=which))]
    if (a > 0.0) == (d > 0.0):
        return "I", []
    sign = matrix_determinant(*coefficients.affine[:4])[1]
    return (None if sign == 0 else "III" if sign > 0 else "II"), []


def _arrives(equator: EquatorEquilibria, cycle: EquatorCycle | None) -> bool:
    """Whether some trajectory reaches Sigma, to first order."""
    if equator.all_directions or cycle is not None:
        return cycle is None or cycle.exponent < 0.0
    neutral = radially_neutral_ones(equator)
    return any(rho < 0.0 and not still for rho, still in zip(equator.lambda_rho.tolist(), neutral, strict=True))


def _consequence(
    location: Location, critical: tuple[CriticalSet, ...], case: str | None, arrives: bool, coefficients: Coefficients
) -> str:
    if not critical:
        if location.existence is Existence.NONE:
            return say("crossing" if arrives else "repelled")
        return location.existence.value
    kind = critical[0].kind
    if kind.startswith("stable"):
        if not arrives:
            return say("stable, unreached", kind=kind)
        if case == "I":  # all that arrives ends on C, Theorem 4.3(a)
            return say("stable sliding", kind=kind)
        return say("stable in part", kind=kind)
    if kind == "saddle":
        return say("saddle")
    if kind.startswith("unstable"):
        return say("unstable", kind=kind)
    return say("closed orbits around" if _true_centre(coefficients) else "centre")


def _affine_normal_form(problem: LayerProblem) -> tuple[Coefficients, Location] | None:
    """Return the normal form that names a portrait, with where its critical set is; None where none does."""
    coefficients, location = problem.at.normal_form, problem.location
    if coefficients is None or location is None or (location.e is None) == bool(problem.critical):
        return None
    return coefficients, location


@found_once("name")
def portrait_name(problem: LayerProblem) -> PortraitName:
    """Name the portrait of a layer problem: its case, its name and what is degenerate."""
    equator, cycle, critical = problem.equator, problem.equator_cycle, problem.critical
    affine = _affine_normal_form(problem)
    if affine is None:
        return general_name(problem.at, equator, cycle, critical)
    coefficients, location = affine
    case, degeneracies = _case(coefficients)
    degeneracies += equator_degeneracies(equator, cycle, _AFFINE_DIRECTIONS_MEET) + _critical_degeneracies(
        location, critical, coefficients
    )
    count = "∞" if equator.all_directions else str(len(equator.theta))
    many = location.existence in (Existence.SINGULAR_LINE, Existence.EVERYTHING)  # equilibria that are not isolated
    return PortraitName(case, ("CM" if critical or many else "NCM") + count, tuple(degeneracies))


@found_once("classification")
def portrait(problem: LayerProblem) -> Classification:
    """Name the portrait of a layer problem, and say what attracts in it."""
    case, name, degeneracies = portrait_name(problem)
    equator, cycle, critical = problem.equator, problem.equator_cycle, problem.critical
    cycles = closed_orbits(problem).cycles
    affine = _affine_normal_form(problem)
    if affine is None:
        prefix, stable = "", sum(cycle.stable for cycle in cycles)
        consequence = general_consequence(critical, disc_zeros(problem.at.key), stable)
    else:
        prefix = f"Case {case}, {name}. " if case else f"{name}. "
        coefficients, location = affine
        consequence = _consequence(location, critical, case, _arrives(equator, cycle), coefficients)
    said = " ".join(filter(None, (directions(equator, cycle), consequence, attracting_cycles(cycles, critical))))
    return Classification(case, name, prefix + said, degeneracies)


@takes_names
def classify(system: AnySystem, psi: Psi, z: ArrayLike = ()) -> Classification:
    """Case, portrait name, sentence and degeneracies of the system at z.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
        A general system that is affine in (c, s) is named as its e-linear normal form (Lemma B.1); any other
        has no case, and its name counts the critical sets and limit directions.
    psi : Psi
        Decides the kind of the critical sets and the limit cycles (Case III: Section 4.3.3), never the name.
    z : (m,) floats

    Returns
    -------
    Classification

    Examples
    --------
    >>> from codim2_core import ELinear, classify, psi
    >>> found = classify(ELinear(-2, 0, -1, (-0.5, 0)), psi.hill(3))
    >>> found.case, found.name, found.degeneracies
    ('I', 'CM4', ())
    """
    return portrait(LayerProblem(system.at(z), psi))
