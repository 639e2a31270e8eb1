"""Sentences about a motion: why each phase begins, and why it ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "starts outside": Sentence("The motion starts outside Σ.", "(x, y) ≠ 0 at the start"),
    "starts in a line": Sentence("The motion starts at Σ, in an invariant line.", "(x, y) = 0, in an invariant line"),
    "rests on a repelling set": Sentence(
        "It rests on a critical set that repels along the line.", "in a line, nowhere to go"
    ),
    "slides in a line": Sentence(
        "It meets the critical set {onto} on the line and slides.", "in a line, a critical set ahead"
    ),
    "crosses in a line": Sentence(
        "There is no critical set on the line: it crosses Σ and leaves along θ = {theta:.4g}.",
        "in a line, the equator ahead",
    ),
    "starts on a repelling set": Sentence(
        "It starts exactly on {onto}, which does not attract, and stays: any disturbance would make it leave.",
        "a motion that starts at x = y = 0, which is invariant",
    ),
    "load jumps": Sentence("The load jumps.", "a slide on Sigma where a formula jumps in time"),
    "load sets in": Sentence("A load sets in.", "a slide on Sigma where a formula has a kink in time"),
    "load switches on a cycle": Sentence(
        "A formula switches while it slides on a limit cycle, and what follows is not known.",
        "a kink or a jump in z within a slide on a limit cycle of a general system",
    ),
    "load switches back": Sentence(
        "Both sides of a jump of its formulas lead back to it: give a formula that does not jump there.",
        "a motion would slide along a jump in the slow variables",
    ),
    "not bounded": Sentence(
        "In {count} of its steps the formulas could not be bounded, and were sampled.",
        "interval bounds along the steps of a motion decide nothing",
    ),
    "arrives in a line": Sentence("It reaches Σ in an invariant line.", "a slip ends, in an invariant line"),
    "variation undefined": Sentence(
        "The derivatives are unknown after t = {t:.6g}, where those of a formula are not finite.",
        "D (U, W) is not finite",
    ),
    "variation on a cycle": Sentence(
        "The derivatives are unknown after t = {t:.6g}, where the motion begins to slide on a limit cycle.",
        "a slide on a limit cycle of a general system",
    ),
    "variation at a jump": Sentence(
        "The derivatives are unknown after t = {t:.6g}, where a formula jumps.",
        "a jump whose time depends on the state, or on a number that is varied",
    ),
    "variation past an end": Sentence(
        "The derivatives are unknown after t = {t:.6g}, where sliding ends away from the equator.",
        "a fold, a Hopf bifurcation, the end of a cycle",
    ),
    "variation ends at Sigma": Sentence(
        "The derivatives are unknown at t = {t:.6g}, where the motion ends as it reaches Σ.",
        "no phase after an arrival",
    ),
    "leaves": Sentence("It leaves Σ along θ = {theta:.4g}.", "after a crossing"),
    "ends at the equator": Sentence(
        "{C} reaches the equator (Figure 19), so sliding ends and the motion leaves along θ = {theta:.4g}.",
        "a critical set comes to the equator",
    ),
    "static holds": Sentence(
        "Static friction holds the contact: rest needs {share:.4g} times the kinetic friction, and {reach:.4g} is "
        "available.",
        "on Σ, static above kinetic friction",
    ),
    "static gives way": Sentence(
        "Rest needs more than {reach:.4g} times the kinetic friction, so the contact slips along θ = {theta:.4g}.",
        "at rest by static friction, |e| = S₀/S",
    ),
    "static unknown": Sentence(
        "It is unknown whether static friction holds: D + Dᵀ is not negative definite for the derivative D of U by e.",
        "on Σ, static above kinetic friction, no dissipation",
    ),
    "cycle shrinks": Sentence(
        "The limit cycle shrinks onto {C} in a Hopf bifurcation, and the motion slides on {C}.",
        "a Hopf bifurcation, passed backwards",
    ),
    "cycle ends at once": Sentence(
        "The limit cycle ends at once: it is unknown where orbits go from it.", "a cycle of a typed system that is gone"
    ),
    "fold in a line": Sentence("{C} ends in a fold.", "det J = 0, in an invariant line"),
    "fold": Sentence("{C} ends in a fold (det J = 0).", "det J = 0"),
    "transcritical": Sentence(
        "{C} meets another critical set, which passes through it (transcritical, det J = 0).",
        "det J = 0, the sets cross",
    ),
    "pitchfork": Sentence(
        "{C} meets a pair of critical sets, which ends on it or begins (pitchfork, det J = 0).",
        "det J = 0, the sets cross, odd across",
    ),
    "exchange, moving": Sentence(
        "{C} moves as it loses its stability: terms of order ε decide which set the motion follows.",
        "det J = 0, an exchange of stability on a set that is not at rest",
    ),
    "canard point": Sentence(
        (
            "{C} ends in a fold where the slow flow also changes direction (a canard point). Terms of order ε "
            "decide whether the motion leaves, stays, or follows the repelling set."
        ),
        "det J = 0, W = 0, m = 1",
    ),
    "folded node": Sentence(
        (
            "{C} ends in a fold at a folded node. Canards follow the repelling set beyond for some time, and all "
            "other motions leave."
        ),
        "det J = 0, a folded singularity, both eigenvalues of one sign",
    ),
    "folded saddle": Sentence(
        (
            "{C} ends in a fold at a folded saddle, and the limit is a canard. Terms of order ε decide how long "
            "it follows the repelling set."
        ),
        "det J = 0, a folded singularity, eigenvalues of two signs",
    ),
    "folded, degenerate": Sentence(
        ("{C} ends in a fold at a folded singularity with an eigenvalue 0: terms of order ε decide what follows."),
        "det J = 0, a folded singularity, an eigenvalue 0",
    ),
    "cycle ends": Sentence("The limit cycle ends.", "a limit cycle vanishes as z moves"),
    "cycle ends, not found": Sentence("It was not found where orbits go from it.", "no single cycle just before"),
    "cycle ends, not decided": Sentence(
        "It is undecided, within resolution, where orbits go from it.", "a cycle is found again beside it"
    ),
    "onward depends": Sentence("What follows may depend on Ψ: give it.", "no family of Ψ was given"),
    "Hopf, delayed": Sentence(
        (
            "{C} loses its stability ({how}), but the motion stays near it: up to the end of this phase it is "
            "attracted more than repelled."
        ),
        "tr J = 0 or an exchange of stability, way out after the end",
    ),
    "Hopf, delayed until": Sentence(
        (
            "{C} loses its stability ({how}), but the motion stays near it until repulsion balances attraction "
            "(way in = way out). A disturbance that is not exponentially small in 1/ε ends this sooner."
        ),
        "tr J = 0, analytic",
    ),
    "Hopf, delayed until the buffer": Sentence(
        (
            "{C} loses its stability ({how}). The motion stays near it up to a buffer point, "
            "where an eigenvalue at complex time is 0 or singular. "
            "A disturbance that is not exponentially small in 1/ε ends this sooner."
        ),
        "tr J = 0, analytic, C moves",
    ),
    "delay, open": Sentence(
        (
            "{C} loses its stability ({how}), but the motion stays near it to the end of the range: so far it is "
            "attracted more than repelled."
        ),
        "tr J = 0, way out after the end of the range",
    ),
    "Hopf, left": Sentence("The motion leaves {C}, which is unstable.", "the end of a delay"),
    "Hopf, not analytic": Sentence(
        "{C} loses its stability (Hopf). The delay is unknown, since its eigenvalues are not smooth in time.",
        "tr J = 0, a kink",
    ),
    "Hopf depends": Sentence(
        "{C} loses its stability ({how}). Where, and after what delay, depends on Ψ: give it.",
        "tr J = 0, no family of Ψ was given",
    ),
    "border moves in": Sentence("It moves inwards, and the motion slides.", "a critical set on the equator, moving in"),
    "border moves out": Sentence(
        "It moves outwards, and the motion slips.", "a critical set on the equator, moving out"
    ),
    "arrival depends": Sentence(
        "It reaches Σ at θ = {theta:.4g}. What follows depends on Ψ: give it.",
        "no family of Ψ was given, and they differ",
    ),
    "saddle reached": Sentence(
        "But {onto} is a {kind}: terms of order ε decide on which side it leaves.",
        "the orbit ends on a critical set that is not stable",
    ),
    "spiral phase": Sentence(
        "Terms of order ε decide at which phase of the spiral it leaves.", "crossing, with no limit direction"
    ),
    "middle is stable": Sentence(
        "On Σ, x = y = 0 is the {kind} {onto}, and the motion slides.", "e = 0 is a stable critical set"
    ),
    "middle is a set": Sentence(
        "On Σ, x = y = 0 is {onto} itself, which does not attract.",
        "e = 0 is a critical set that is not stable",
    ),
    "on the equator": Sentence("The critical set lies on the equator.", "λ with index ρ is 0"),
    "middle": Sentence("On Σ, x = y = 0 is the middle of the hemisphere.", "e = 0 is no critical set"),
    "stability depends": Sentence(
        "Whether the critical set is stable depends on Ψ: give it.", "no family of Ψ was given, and they differ"
    ),
    "several to slide on": Sentence(
        "There are {count} stable critical sets, so sliding is not unique on Σ.",
        "no Ψ given, several stable critical sets",
    ),
    "cycles to slide on": Sentence(
        "There are limit cycles and no Ψ was given, so sliding is not unique on Σ.",
        "no Ψ given, stable limit cycles",
    ),
    "one way out": Sentence(
        "Nothing attracts on Σ, and the only way out is θ = {theta:.4g} ({Q}).", "nothing attracts, one direction does"
    ),
    "other ways": Sentence(
        "Not all of the hemisphere leads there: {which} leads away from Σ.",
        "some of the hemisphere leads to a limit direction",
    ),
    "starts, follows nothing": Sentence(
        "The motion starts within O(ε) of Σ and follows no critical set.", "(x, y) = 0, ε > 0"
    ),
    "passes": Sentence(
        "It passes Σ within {near:g} ε and follows no critical set: it crosses.", "within 20 ε for a time, ε > 0"
    ),
    "has left": Sentence("It leaves Σ and is further than {near:g} ε away.", "after a crossing, ε > 0"),
    "no longer follows": Sentence("It no longer follows {onto}, and slips away.", "a slide ends, ε > 0"),
    "end of span": Sentence("It reached the end of the time span.", "the status of a simulation"),
    "at an event": Sentence("It stopped at a terminal event.", "the status of a simulation"),
    "not unique": Sentence(
        "It stopped: in the limit ε → 0 what follows is not unique, or not known.", "the status of a simulation"
    ),
    "pole on the hemisphere": Sentence(
        "U has a pole on the hemisphere there. If a constraint brings the normal force, the contact jams (Painlevé): "
        "with friction in some directions a normal force presses the bodies together.",
        "an arrival at Sigma where a divisor in U vanishes for some |e| <= 1",
    ),
    "past on Sigma": Sentence(
        "It is known from the moment at which it left Σ.", "a past in the limit that begins on Sigma"
    ),
    "past ends": Sentence("It stopped: the state does not tell what came before.", "the status of a past"),
    "has left Sigma": Sentence(
        "It left Σ at t = {t:.6g}, where motions meet.", "a past in the limit that begins on Sigma"
    ),
    "past forgotten": Sentence(
        ("Sliding forgets where it came from: before t = {t:.6g} errors within the tolerance would grow beyond 0.01."),
        "a motion followed backwards",
    ),
    "blows up": Sentence("It stopped: the motion becomes infinite in finite time.", "the status of a simulation"),
    "step limit": Sentence(
        (
            "It stopped at the step limit: the motion is too fast, as on a limit cycle, or its formulas are undefined. "
            "Shorten the span, raise max_steps, or take the limit ε → 0."
        ),
        "the status of a simulation",
    ),
    "repels angularly": Sentence(
        "θ = {theta:.4g} also repels angularly: orbits leave in a whole sector around it.",
        "nothing single to leave along",
    ),
    "nothing leaves": Sentence(
        "No trajectory leaves Σ along θ = {theta:.4g}, since its radial eigenvalue does not become positive.",
        "λ with index ρ is not positive",
    ),
    "phases differ": Sentence(
        (
            "For ε = {eps:.3g} the phases differ from those of the limit. From about t = {t:.4g} the motion "
            "{here}, while in the limit it {there}. ε is not yet small enough there."
        ),
        "ε > 0 beside the limit",
    ),
    "blow-up time": Sentence("The motion becomes infinite near t = {t:.10g}.", "a solution grows beyond bounds"),
    "undefined from": Sentence("Its formulas are undefined after t = {t:.10g}.", "a formula ends"),
    "no way out": Sentence(
        "Nothing attracts on Σ, and no single direction leads away, so what follows is not unique.",
        "no Ψ given, neither an attractor nor a way out",
    ),
    "several ways out": Sentence(
        "Nothing attracts on Σ, and {count} directions lead away from it, so what follows is not unique.",
        "no Ψ given, several ways out",
    ),
    "one to slide on": Sentence(
        "Σ has one stable critical set, {onto}, and the motion slides.", "no Ψ given, one stable critical set"
    ),
    "starts, follows": Sentence("The motion starts within O(ε) of Σ, follows {onto} and slides.", "on Σ, ε > 0"),
    "comes, follows": Sentence("It comes within O(ε) of Σ, follows {onto} and slides.", "a slip ends, ε > 0"),
    "goes on": Sentence("It stays within O(ε) of Σ, passes to {onto} and slides.", "from one set to another, ε > 0"),
    "passed": Sentence(
        (
            "{onto} loses its stability here, but the motion stays near it until repulsion balances attraction "
            "(way in = way out), or up to a buffer point. A disturbance that is not exponentially small in 1/ε ends "
            "this sooner."
        ),
        "a loss of stability with the distance carried as a logarithm, ε > 0",
    ),
    "phases agree": Sentence(
        "The phases are those of the limit ε → 0, from which it differs by O(ε).", "ε > 0 beside the limit"
    ),
    "phases agree, less": Sentence(
        "The phases are those of the limit ε → 0, from which it differs by O(ε^{order:.3g}), a lower order because "
        "it leaves Σ.",
        "ε > 0 beside the limit, an exit",
    ),
    "no z to follow": Sentence("There is no slow variable to follow (m = 0).", "a cycle of a typed system, m = 0"),
}
