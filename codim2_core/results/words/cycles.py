"""Sentences about limit cycles: how many were found, or why there is none; how a branch begins and ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "band counted": Sentence(
        "Closed orbits fill a band (a centre), so they are not counted as limit cycles.",
        "a return map that is the identity",
    ),
    "no set to surround": Sentence(
        "There is no limit cycle: it would have to surround a critical set (index), and there is none.",
        "no critical set",
    ),
    "only saddles": Sentence(
        ("There is no limit cycle: all critical sets are saddles, but the indices inside a closed orbit add up to 1."),
        "every critical set is a saddle",
    ),
    "searched about some": Sentence(
        ("Only {searched} of {count} critical sets were searched about: limit cycles around others may be missing."),
        "more sets than are searched about",
    ),
    "turn not closed": Sentence(
        "A fixed point of the first turn was found, but its orbit could not be closed.",
        "a fixed point whose orbit does not close",
    ),
    "not all followed": Sentence(
        "Some orbits are undecided: they pass an equilibrium too slowly.",
        "an orbit that passes an equilibrium",
    ),
    "too small, about a set": Sentence(
        "A cycle too small to resolve surrounds a critical set: it was born in a nearby Hopf bifurcation.",
        "just past a Hopf bifurcation",
    ),
    "semistable": Sentence(
        "A cycle is semistable within resolution: two cycles meet in a fold.", "multiplier 1 within resolution"
    ),
    "only a saddle": Sentence(
        (
            "There is no limit cycle, since the only critical set is a saddle (det A < 0). "
            "The indices inside a closed orbit add up to 1 (Theorem 4.4)."
        ),
        "det A < 0",
    ),
    "preserves area": Sentence(
        (
            "There is no limit cycle: for a = d = 0 the layer problem preserves area in κ₂, and closed orbits "
            "fill bands."
        ),
        "a = d = 0",
    ),
    "Bendixson": Sentence(
        "There is no limit cycle: the divergence is {sign} on all of κ₂ (Bendixson, Theorem 4.3).",
        "a and d of one sign",
    ),
    "linear orbits": Sentence(
        "There is no limit cycle: for f = 0 the orbits are those of x₂′ = A x₂ for every Ψ.", "f = 0"
    ),
    "reversible": Sentence(
        (
            "There is no limit cycle: for a = −d, |f₁| = |f₂| the layer problem is reversible about a diagonal "
            "through C. Closed orbits fill bands."
        ),
        "a = −d, f on a diagonal",
    ),
    "too steep": Sentence(
        (
            "The return map is too steep to be resolved by its samples in some places: limit cycles may be "
            "missing there."
        ),
        "samples do not resolve the map",
    ),
    "near a loop": Sentence(
        (
            "A loop through the equator is near: the last orbit that returns misses its start by {gap:.1e} in "
            "ln|x₂ − C|. Beyond it orbits go to the equator."
        ),
        "the last orbit that returns",
    ),
    "near a fold": Sentence(
        (
            "A fold of cycles is near: at an extremum the return map is within {gap:.1e} of its diagonal, in "
            "logarithmic distance. It is undecided whether there are two cycles or none."
        ),
        "an extremum of the displacement near zero",
    ),
    "cycles not looked for": Sentence(
        "No search for limit cycles was asked for.", "only what stands still was asked for"
    ),
    "band at one value": Sentence(
        "{name} = {value:.6g}: closed orbits fill a band within resolution, so none is a limit cycle.",
        "closed orbits at one value of a parameter",
    ),
    "birth not caught": Sentence(
        "The cycle that is born at {kind} {name} = {value:.6g} was not found.", "along one parameter"
    ),
    "branch closed": Sentence("The branch is closed.", "along one parameter"),
    "end of the branch span": Sentence("{name} = {value:.6g}: the end of the span.", "along one parameter"),
    "followed no further": Sentence(
        "The branch could be continued only to {name} = {value:.6g}.", "along one parameter"
    ),
    "branch folds": Sentence(
        "{name} = {value:.6g}: two cycles, one stable and one unstable, meet and vanish.", "along one parameter"
    ),
    "no cycle, turn": Sentence(
        (
            "No limit cycle was found, but it is not proved that there is none. Return maps about {about} were "
            "sampled until they were resolved."
        ),
        "the search found none",
    ),
    "one cycle, turn": Sentence(
        (
            "One limit cycle was found; it is not proved that there are no others. Return maps about {about} were "
            "sampled until they were resolved."
        ),
        "the search found one",
    ),
    "cycles, turn": Sentence(
        (
            "{count} limit cycles were found; it is not proved that there are no others. Return maps about "
            "{about} were sampled until they were resolved."
        ),
        "the search found some",
    ),
    "no isolated set to surround": Sentence(
        "There is no limit cycle: it would have to surround an isolated critical set.",
        "det A = 0, or on the equator",
    ),
    "elsewhere": Sentence("Elsewhere on the span:", "between two reasons"),
    "born, stable": Sentence(
        "{name} = {value:.6g}: Hopf bifurcation of a critical set, supercritical: the cycle born there is stable.",
        "a branch begins, exponent negative",
    ),
    "born, unstable": Sentence(
        "{name} = {value:.6g}: Hopf bifurcation of a critical set, subcritical: the cycle born there is unstable.",
        "a branch begins, exponent positive",
    ),
    "born, in a band": Sentence(
        "{name} = {value:.6g}: Hopf bifurcation of a critical set, degenerate: closed orbits fill a band there.",
        "a branch begins, exponent 0",
    ),
    "no branch": Sentence(
        (
            "No limit cycle was found for {name} from {low:.6g} to {high:.6g}. None is born at a Hopf point, and "
            "none was found at {count} sampled values."
        ),
        "along one parameter",
    ),
    "one branch": Sentence(
        "One branch of limit cycles was continued, by first turns about a point inside them.", "along one parameter"
    ),
    "branches": Sentence(
        "{count} branches of limit cycles were continued, by first turns about a point inside them.",
        "along one parameter",
    ),
    "cycle not continued": Sentence(
        "A limit cycle was found at {name} = {value:.6g}, but it could not be continued.", "along one parameter"
    ),
    "becomes homoclinic": Sentence(
        "{name} = {value:.6g}: the cycle becomes a homoclinic loop, and its period tends to infinity.",
        "a branch ends",
    ),
    "becomes heteroclinic": Sentence(
        "{name} = {value:.6g}: the cycle becomes a heteroclinic loop, and its period tends to infinity.",
        "a branch ends",
    ),
    "meets two sets": Sentence(
        "{name} = {value:.6g}: two critical sets appear on the cycle and stop the motion along it.",
        "a branch ends",
    ),
    "becomes the equator": Sentence(
        "{name} = {value:.6g}: the cycle becomes the equator, a closed orbit that changes its stability.",
        "a branch ends",
    ),
    "meets a line": Sentence(
        "{name} = {value:.6g}: the cycle meets a line of equilibria, and its period tends to infinity.",
        "a branch ends, det A = 0",
    ),
    "meets a saddle-node": Sentence(
        "{name} = {value:.6g}: the cycle reaches the equator in a loop through a saddle-node of limit directions.",
        "a branch ends",
    ),
    "becomes a loop": Sentence(
        "{name} = {value:.6g}: the cycle becomes a loop of two limit directions and the equator between them, {how} "
        "from inside.",
        "a branch ends",
    ),
    "proved by a certificate": Sentence(
        (
            "It is proved that there are no other limit cycles, by a Dulac-Cherkas function: a polynomial "
            "that increases along all orbits where it vanishes."
        ),
        "a certificate was accepted",
    ),
    "nothing to surround": Sentence(
        (
            "It is proved that there is no limit cycle: it would surround a critical set that is no saddle, and there "
            "is none."
        ),
        "a certificate was accepted, of critical sets",
    ),
    "portrait degenerate": Sentence(
        "The count is not proved: a critical set is degenerate, or on the equator, or two are very close.",
        "the checker refuses the critical sets",
    ),
    "proofs of polynomials only": Sentence(
        "The count is not proved: proofs exist where U is a polynomial in c and s, of degree up to 16.",
        "a proof for a typed system that is no polynomial",
    ),
    "proof not for this Psi": Sentence(
        (
            "The count is not proved: proofs exist for Ψ constant, rational, exponential, s/sinh²√s, or of the "
            "Hill family with n ≥ 1."
        ),
        "a proof for another Psi",
    ),
    "proof finds no function": Sentence(
        "The count is not proved: no suitable polynomial was found.",
        "cycles close to each other, or weak, or steep; or loops through limit directions",
    ),
    "proof refused": Sentence(
        "The count is not proved: the polynomials that were found do not decide it.", "the checker refuses"
    ),
}
