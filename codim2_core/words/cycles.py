"""Sentences about limit cycles: how many were found, or why there is none; how a branch begins and ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "band counted": Sentence(
        "Closed orbits fill a band (a centre): those are not counted as limit cycles.",
        "a return map that is the identity",
    ),
    "no set to surround": Sentence(
        "No limit cycle: no critical set lies on the hemisphere, and a closed orbit would have to surround one "
        "(index).",
        "no critical set",
    ),
    "only saddles": Sentence(
        "No limit cycle: all critical sets are saddles, and the equilibria inside a closed orbit have indices that "
        "add up to 1.",
        "every critical set is a saddle",
    ),
    "searched about some": Sentence(
        "Searched about {searched} of {count} critical sets only: cycles around others may be missing.",
        "more sets than are searched about",
    ),
    "turn not closed": Sentence(
        "A fixed point of the first turn was found whose orbit could not be closed.",
        "a fixed point whose orbit does not close",
    ),
    "not all followed": Sentence(
        "Some orbits were not followed to a decision: they pass an equilibrium too slowly.",
        "an orbit that passes an equilibrium",
    ),
    "too small, about a set": Sentence(
        "A cycle too small to resolve surrounds a critical set: it was just born in a Hopf bifurcation.",
        "just past a Hopf bifurcation",
    ),
    "semistable": Sentence(
        "A cycle is semistable within resolution: a fold, where two cycles meet.", "multiplier 1 within resolution"
    ),
    "only a saddle": Sentence(
        "No limit cycle: the only critical set is a saddle (det A < 0), and the equilibria inside a closed orbit "
        "have indices that add up to 1 (Theorem 4.4).",
        "det A < 0",
    ),
    "preserves area": Sentence(
        "No limit cycle: for a = d = 0 the layer problem preserves area (no divergence in κ₂); closed orbits fill "
        "bands.",
        "a = d = 0",
    ),
    "Bendixson": Sentence(
        "No limit cycle: the divergence is {sign} on all of κ₂ (Bendixson, Theorem 4.3).", "a and d of one sign"
    ),
    "linear orbits": Sentence(
        "No limit cycle: for f = 0 the orbits are those of the linear system x₂′ = A x₂, whatever Ψ is.", "f = 0"
    ),
    "reversible": Sentence(
        "No limit cycle: for a = −d, |f₁| = |f₂| the layer problem is reversible about a diagonal through C; closed "
        "orbits fill bands.",
        "a = −d, f on a diagonal",
    ),
    "too many steps to close": Sentence(
        "A fixed point of the return map was found whose cycle takes too many steps to follow.",
        "a fixed point whose orbit is too long",
    ),
    "too steep": Sentence(
        "The return map is so steep in places that its samples do not resolve it: cycles may hide there.",
        "samples do not resolve the map",
    ),
    "identity": Sentence(
        "The return map is the identity within resolution: closed orbits fill a band (a centre).",
        "the return map is the identity",
    ),
    "band": Sentence("Closed orbits fill a band within resolution.", "closed orbits within resolution"),
    "near a loop": Sentence(
        "Near a loop through the equator: the last orbit that returns misses its start by {gap:.1e} in ln|x₂ − C|; "
        "beyond it orbits go to the equator.",
        "the last orbit that returns",
    ),
    "near a fold": Sentence(
        "Near a fold of cycles: at an extremum the return map is within {gap:.1e} of its diagonal (in the logarithm "
        "of the distance). Whether there are two cycles or none is undecided within that.",
        "an extremum of the displacement near zero",
    ),
    "too small, about C": Sentence(
        "A cycle too small to resolve surrounds C: it was just born in a Hopf bifurcation.",
        "just past a Hopf bifurcation",
    ),
    "cycles not looked for": Sentence("Limit cycles were not looked for.", "only what stands still was asked for"),
    "no cycle on the span": Sentence("No limit cycle anywhere on the span.", "along one parameter"),
    "band at one value": Sentence(
        "{name} = {value:.6g}: the layer problem is reversible; closed orbits fill a band, and none is a limit cycle.",
        "a centre along one parameter",
    ),
    "band at one value, typed": Sentence(
        "{name} = {value:.6g}: closed orbits fill a band within resolution, and none is a limit cycle.",
        "closed orbits at one value of a parameter",
    ),
    "loop without a cycle": Sentence(
        "A loop closes at {name} = {value:.6g} with no cycle seen beside it.", "along one parameter"
    ),
    "birth not caught": Sentence(
        "The cycle born at {kind} {name} = {value:.6g} was not caught.", "along one parameter"
    ),
    "branch closed": Sentence("The branch is closed.", "along one parameter"),
    "end of the branch span": Sentence("{name} = {value:.6g}: the end of the span.", "along one parameter"),
    "followed no further": Sentence(
        "The branch was followed to {name} = {value:.6g} and no further.", "along one parameter"
    ),
    "branch folds": Sentence(
        "{name} = {value:.6g}: two cycles, one stable and one unstable, meet and vanish.", "along one parameter"
    ),
    "no cycle, turn": Sentence(
        "No limit cycle found, from the first turn of orbits about {about}, sampled on a ray to the equator until "
        "its samples resolve it. That there is none is not proved.",
        "the search found none",
    ),
    "one cycle, turn": Sentence(
        "1 limit cycle, from the first turn of orbits about {about}, sampled on a ray to the equator until its "
        "samples resolve it. That there are no more is not proved.",
        "the search found one",
    ),
    "cycles, turn": Sentence(
        "{count} limit cycles, from the first turn of orbits about {about}, sampled on a ray to the equator until "
        "its samples resolve it. That there are no more is not proved.",
        "the search found some",
    ),
    "no cycle, section": Sentence(
        "No limit cycle found, from the return map on a section from C to the equator, which every cycle crosses, "
        "sampled until its samples resolve it. That there is none is not proved.",
        "the search found none",
    ),
    "one cycle, section": Sentence(
        "1 limit cycle, from the return map on a section from C to the equator, which every cycle crosses, sampled "
        "until its samples resolve it. That there are no more is not proved.",
        "the search found one",
    ),
    "cycles, section": Sentence(
        "{count} limit cycles, from the return map on a section from C to the equator, which every cycle crosses, "
        "sampled until its samples resolve it. That there are no more is not proved.",
        "the search found some",
    ),
    "no isolated set to surround": Sentence(
        "No limit cycle: a closed orbit would have to surround an isolated critical set.",
        "det A = 0, or on the equator",
    ),
    "elsewhere": Sentence("Elsewhere on the span:", "between two reasons"),
    "no branch": Sentence(
        "No limit cycle for {name} from {low:.6g} to {high:.6g}: no Hopf point, no end on the equator, and none at "
        "the {count} values where all were looked for.",
        "along one parameter",
    ),
    "one branch": Sentence(
        "1 branch of limit cycles, from the return map on a section from C to the equator.", "along one parameter"
    ),
    "branches": Sentence(
        "{count} branches of limit cycles, from the return map on a section from C to the equator.",
        "along one parameter",
    ),
    "born, supercritical": Sentence(
        "{name} = {value:.6g}: Hopf bifurcation of C, supercritical (first Lyapunov coefficient {number:.3g}).",
        "a branch begins",
    ),
    "born, subcritical": Sentence(
        "{name} = {value:.6g}: Hopf bifurcation of C, subcritical (first Lyapunov coefficient {number:.3g}).",
        "a branch begins",
    ),
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
    "no branch, typed": Sentence(
        "No limit cycle for {name} from {low:.6g} to {high:.6g}: none is born at a Hopf point, and none was found at "
        "the {count} values where all were looked for.",
        "along one parameter",
    ),
    "one branch, typed": Sentence(
        "1 branch of limit cycles, from the first turn of orbits about a point inside them.", "along one parameter"
    ),
    "branches, typed": Sentence(
        "{count} branches of limit cycles, from the first turn of orbits about a point inside them.",
        "along one parameter",
    ),
    "cycle not continued": Sentence(
        "A limit cycle at {name} = {value:.6g} was seen and not followed from there.", "along one parameter"
    ),
    "becomes homoclinic": Sentence(
        "{name} = {value:.6g}: the cycle becomes a loop through one saddle: its period grows beyond bounds.",
        "a branch ends",
    ),
    "becomes heteroclinic": Sentence(
        "{name} = {value:.6g}: the cycle becomes a loop through several saddles: its period grows beyond bounds.",
        "a branch ends",
    ),
    "meets two sets": Sentence(
        "{name} = {value:.6g}: two critical sets appear on the cycle, and motion along it stops there.",
        "a branch ends",
    ),
    "becomes the equator": Sentence(
        "{name} = {value:.6g}: the cycle becomes the equator, which is a closed orbit and changes its stability.",
        "a branch ends",
    ),
    "meets a line": Sentence(
        "{name} = {value:.6g}: the cycle meets a whole line of equilibria, where motion stops: its period "
        "grows beyond bounds.",
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
        "That there are these limit cycles and no other is proved: by a Dulac-Cherkas function, a polynomial that "
        "increases along all orbits wherever it vanishes.",
        "a certificate was accepted",
    ),
    "proofs e-linear only": Sentence(
        "The count is not proved: that is done for e-linear systems only.", "a proof for a typed system"
    ),
    "proof not for this Psi": Sentence(
        "The count is not proved: that is done for Ψ constant, rational, exponential, s/sinh²√s, or of the Hill family "
        "with n at least 1.",
        "a proof for another Psi",
    ),
    "proof finds no function": Sentence(
        "The count is not proved: no polynomial was found that would prove it.",
        "cycles close to each other, or weak, or steep; or loops through limit directions",
    ),
    "proof refused": Sentence(
        "The count is not proved: the polynomials that were found do not decide it.", "the checker refuses"
    ),
}
