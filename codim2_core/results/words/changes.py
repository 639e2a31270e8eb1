"""Sentences about a change: at a value of one parameter, or on a curve in the plane of two."""

from __future__ import annotations

from ..special_kinds import SPECIAL_KINDS
from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    **{change.kind: Sentence(change.says, change.when) for change in SPECIAL_KINDS},
    "pitchfork in the plane": Sentence(
        "Θ has a triple zero, and b = 0 makes the system symmetric: a pitchfork of limit directions (D2).",
        "a triple zero, b = 0",
    ),
    "cusp in the plane": Sentence(
        "Θ has a triple zero: two saddle-nodes of limit directions meet in a cusp.", "a triple zero"
    ),
    "directions meet": Sentence("Two limit directions meet: Θ has a double zero.", "a curve"),
    "nothing turns at f = 0": Sentence(
        "a = d, b = 0 and f = 0: Θ ≡ 0, every direction is a limit direction.", "a = d, b = 0"
    ),
    "two for every f": Sentence(
        "a = d and b = 0: there are two limit directions for every f except f = 0.", "a = d, b = 0"
    ),
    "two cusps have met": Sentence("Θ has a fourfold zero: two cusps have met.", "a fourfold zero"),
    "two double zeros": Sentence("Θ has two double zeros at the same f.", "the curve crosses itself"),
    "still at f = 0": Sentence(
        "A = 0: every point is an equilibrium at f = 0, and there is no critical set elsewhere.", "A = 0"
    ),
    "line on a segment": Sentence(
        "det A = 0: there is a line of critical sets on this segment, and none elsewhere.", "det A = 0"
    ),
    "reaches where they meet": Sentence(
        "The critical set reaches the equator exactly where two limit directions meet: λ_ρ = λ_θ = 0.",
        "λ with index ρ and with index θ vanish",
    ),
    "reaches, and elsewhere they meet": Sentence(
        "The critical set reaches the equator, and two limit directions meet elsewhere on it.", "both at one f"
    ),
    "reaches the equator": Sentence(
        ("|A⁻¹f| = 1: the critical set reaches the equator, and one limit direction changes its radial stability."),
        "a curve",
    ),
    "fold ends, saddle-node": Sentence(
        "The fold ends where the critical set reaches the equator in a saddle-node of limit directions.",
        "a fold of cycles",
    ),
    "cusp of cycles": Sentence("Three limit cycles meet: two folds of cycles end here in a cusp.", "a fold of cycles"),
    "fold ends, neutral loop": Sentence(
        "The fold ends where the loop through the equator is neutral.", "a fold of cycles"
    ),
    "two cycles meet": Sentence("Two limit cycles, one stable and one unstable, meet and vanish.", "a fold of cycles"),
    "folds need R3": Sentence(
        "Folds of cycles are traced for Ψ > 0 (R3) only; branches finds them along one parameter.", "|e_Ψ| reaches 1"
    ),
    "no fold of cycles": Sentence(
        "No fold of cycles begins on the Hopf curve, and none was found on {lines} lines across the disc of C.",
        "the search found none",
    ),
    "fold not caught": Sentence("The fold that begins here was not found.", "a fold of cycles"),
    "fold reaches the equator": Sentence("The fold of cycles reaches the equator here.", "a fold of cycles"),
    "fold followed no further": Sentence("The fold of cycles could be continued only to here.", "a fold of cycles"),
    "connection followed no further": Sentence("The {kind} could be continued only to here.", "of saddles"),
    "connection ends beside": Sentence(
        "The {kind} could be continued only to here, beside a curve of the kind {beside}.", "of saddles"
    ),
    "neutral connection": Sentence(
        (
            "The saddles' ratios of eigenvalues multiply to 1 here: the {kind} attracts on one side along its "
            "curve and repels on the other."
        ),
        "along a curve of loops",
    ),
    "no cycles at all": Sentence(
        ("The layer problem has no limit cycles, since a and d have one sign or det A ≤ 0 (only Case III has them)."),
        "not Case III",
    ),
    "equator turns": Sentence(
        (
            "The closed equator changes its stability, and a limit cycle is born from it or vanishes in it, "
            "whatever Ψ is."
        ),
        "a curve",
    ),
    "equator keeps": Sentence("The closed equator keeps its stability wherever it has no equilibria.", "no curve"),
    "neutral loop": Sentence(
        "The loop is neutral, since the saddles' ratios multiply to 1: a fold of cycles ends here.",
        "the saddles' ratios multiply to 1",
    ),
    "loop through the equator": Sentence(
        "A limit cycle becomes a loop, made of an orbit between two half-saddles and an arc of the equator.",
        "a curve",
    ),
    "no loop": Sentence(
        "No loop of half-saddles of the equator was found, so limit cycles do not end in one.", "no curve"
    ),
    "reversible, equator": Sentence(
        "a = −d: on these lines the layer problem is reversible and closed orbits fill bands.", "a = −d"
    ),
    "changes over Ψ": Sentence("{name} = {value:.6g}: C changes from {before} to {after}.", "along the parameter of Ψ"),
    "trace vanishes": Sentence(
        "a = d = 0: tr J = 0 wherever there is a critical set, so none of them is a Hopf bifurcation.", "a = d = 0"
    ),
    "no Hopf outside Case III": Sentence(
        "tr J = 0 < det J needs a and d of opposite sign and det A > 0 (Case III): no Hopf bifurcation.",
        "the signs of a, d, det A",
    ),
    "no Hopf with this Ψ": Sentence(
        "tr J keeps one sign wherever there is a critical set: no Hopf bifurcation with this Ψ.", "no zero of the trace"
    ),
    "reversible lines": Sentence(
        "a = −d: on the two straight lines the layer problem is reversible and C is a centre; its first Lyapunov "
        "coefficient is zero there.",
        "a = −d",
    ),
    "Hopf curve": Sentence(
        (
            "C changes from a stable to an unstable focus, and a limit cycle is born. It is stable where the "
            "first Lyapunov coefficient is negative, and unstable where it is positive."
        ),
        "a curve",
    ),
    "Bautin": Sentence(
        "The first Lyapunov coefficient is zero (Bautin): a fold of cycles ends here.",
        "the Lyapunov coefficient is zero",
    ),
    "saddle or none": Sentence("det A ≤ 0: the critical set is a saddle, or there is none.", "det A ≤ 0"),
    "both eigenvalues agree": Sentence(
        "J is a multiple of the identity, so both eigenvalues agree.", "J a multiple of the identity"
    ),
    "node-focus curve": Sentence(
        "The discriminant tr(J)² − 4 det J is zero: C changes between node and focus.", "a curve"
    ),
    "one kind": Sentence("C is of one kind, node or focus, wherever it exists.", "no curve"),
    "line at one value": Sentence(
        "det A = 0 and f is in the range of A: the line A e = −f consists of equilibria.",
        "det A = 0, f in the range of A",
    ),
    "through infinity": Sentence(
        "det A = 0: A e = −f has no solution, as −A⁻¹f passes through infinity.",
        "det A = 0, f not in the range of A",
    ),
    "trace touches zero": Sentence(
        "tr J = 0 at this value only, without a change of sign: C is a centre to first order.", "no change of sign"
    ),
    "meet at": Sentence("Two limit directions meet at {at}: Θ has a double zero.", "Θ has a double zero"),
    "pass through": Sentence(
        "Two limit directions pass through each other at {at} and exchange their angular stability.",
        "two branches cross",
    ),
    "touch": Sentence(
        "Two limit directions exist at this value only, both at {at}: Θ has a double zero and no sign change.",
        "no change of sign",
    ),
    "splits, D2": Sentence(
        "One limit direction splits into three at {at}: Θ has a triple zero, and b = 0 makes it symmetric (D2).",
        "b = 0",
    ),
    "passes a cusp": Sentence(
        "Θ has a triple zero at {at}: the parameter passes through a cusp of the saddle-node curve.",
        "Θ has a triple zero",
    ),
    "equator neutral, a cycle may leave": Sentence(
        (
            "The closed equator is neutral to first order: it changes its stability, and a limit cycle may be "
            "born from it."
        ),
        "exponent 0",
    ),
    "set reaches the equator": Sentence(
        ("A critical set reaches the equator at θ = {theta:.4g}, and the limit direction changes its stability."),
        "e comes to the circle",
    ),
    "two sets meet": Sentence("Two critical sets meet: a {one} and a {other}.", "two branches end in one point"),
    "one comes or goes": Sentence("A single critical set appears or vanishes here.", "a branch ends alone"),
    "set splits": Sentence(
        "det J = 0: three critical sets meet, and one changes between a saddle and another kind.",
        "two come to a third, which turns",
    ),
    "splits": Sentence(
        "One limit direction splits into three at {at}: Θ has a triple zero.", "Θ has a triple zero, symmetric"
    ),
    "on the circle": Sentence("For a = d this lies on the circle |f| = |b| (D1).", "a = d"),
    "border, turns back": Sentence(
        (
            "|A⁻¹f| = 1: the critical set touches the equator at θ = {theta:.4g} and turns back, so nothing else "
            "changes there."
        ),
        "|A⁻¹f| − 1 keeps its sign",
    ),
    "Hopf, supercritical": Sentence(
        (
            "tr J = 0 < det J, and the first Lyapunov coefficient is {number:.4g}: the bifurcation is "
            "supercritical, and a stable limit cycle is born."
        ),
        "negative",
    ),
    "Hopf, subcritical": Sentence(
        (
            "tr J = 0 < det J, and the first Lyapunov coefficient is {number:.4g}: the bifurcation is "
            "subcritical, and an unstable limit cycle is born."
        ),
        "positive",
    ),
    "gap": Sentence(
        "There is no result for {name} from {low:.6g} to {high:.6g}, where the coefficients are not finite.",
        "a pole, or no value",
    ),
    "Hopf, degenerate": Sentence(
        (
            "tr J = 0 < det J, and the first Lyapunov coefficient is {number:.4g}, zero within rounding: the "
            "bifurcation is degenerate."
        ),
        "zero",
    ),
    "cusp of directions": Sentence(
        "Θ has a triple zero at θ = {theta:.4g}: two saddle-nodes of limit directions meet in a cusp.", "a cusp"
    ),
    "two borders touch": Sentence(
        (
            "A critical set reaches the equator at θ = {theta:.4g}, exactly where two limit directions meet: λ_ρ "
            "= λ_θ = 0."
        ),
        "U = 0 and Θ′ = 0 on the equator",
    ),
    "fold on the equator": Sentence(
        "Two critical sets meet on the equator, at θ = {theta:.4g}: det J = 0 there.", "U = 0 and det J = 0 on it"
    ),
    "cusp of sets": Sentence(
        "Three critical sets meet: two folds of critical sets end in a cusp.", "a cusp of det J = 0"
    ),
    "both eigenvalues zero": Sentence(
        "Bogdanov–Takens: tr J = det J = 0, so that both eigenvalues are zero. A Hopf curve ends on the fold here.",
        "tr J = det J = 0",
    ),
    "Lyapunov turns": Sentence(
        "The first Lyapunov coefficient is zero (Bautin): a curve on which two limit cycles meet begins here.",
        "the Lyapunov coefficient changes its sign",
    ),
    "two at once": Sentence(
        "Two things happen at different places of the portrait: {one}; {other}.", "two curves cross"
    ),
}
