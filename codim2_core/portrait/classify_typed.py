"""The name of a general system's portrait: counts, what is degenerate, and whether the counts are certain."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..numerics.fourier_zeros import ROUNDINGS, UNIT
from ..results.words import count_word, say
from ..systems.frozen import FrozenSystem
from .classification import NEUTRAL_CLOSED_EQUATOR, Degeneracy, PortraitName, undecided_degeneracy
from .layer_problem.critical import CriticalSet
from .layer_problem.disc_zeros import DiscZeros, disc_zeros
from .layer_problem.equator import EquatorCycle, EquatorEquilibria, arcs_of
from .layer_problem.linearisation import NEUTRAL_TRACE

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
    return PortraitName(None, name, (*degenerate, *_critical_degeneracies(critical, found)))


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
    """Name what is degenerate on the equator, in the words that are `said` of a zero of Theta of some multiplicity.

    0 stands for a Theta that vanishes; `within` is how far it is undecided, and of what (`undecided_degeneracy`).
    """
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


def _critical_degeneracies(critical: tuple[CriticalSet, ...], found: DiscZeros) -> list[Degeneracy]:
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
