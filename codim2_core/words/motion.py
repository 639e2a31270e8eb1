"""Sentences about a motion: why each phase begins, and why it ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "starts outside": Sentence("The motion starts outside Σ.", "(x, y) ≠ 0 at the start"),
    "starts in a line": Sentence("The motion starts at Σ, in an invariant line.", "(x, y) = 0, in an invariant line"),
    "rests on a repelling set": Sentence(
        "It rests on a critical set that repels along the line.", "in a line, nowhere to go"
    ),
    "slides in a line": Sentence("Along it comes the critical set {onto}: sliding.", "in a line, a critical set ahead"),
    "crosses in a line": Sentence(
        "Along it there is no critical set: crossing, it leaves along θ = {theta:.4g}.", "in a line, the equator ahead"
    ),
    "arrives in a line": Sentence("Arrives at Σ in an invariant line.", "a slip ends, in an invariant line"),
    "variation undefined": Sentence(
        "The derivatives are not known past t = {t:.6g}: those of a formula are not finite there.",
        "D (U, W) is not finite",
    ),
    "variation on a cycle": Sentence(
        "The derivatives are not known past t = {t:.6g}: the motion slides on a limit cycle from there.",
        "a slide on a limit cycle of a general system",
    ),
    "variation past an end": Sentence(
        "The derivatives are not known past t = {t:.6g}: sliding does not end at the equator there.",
        "a fold, a Hopf bifurcation, the end of a cycle",
    ),
    "variation ends at Sigma": Sentence(
        "The derivatives are not known at t = {t:.6g}: the motion ends as it arrives at Σ.", "no phase after an arrival"
    ),
    "leaves": Sentence("Leaves Σ along θ = {theta:.4g}.", "after a crossing"),
    "ends at the equator": Sentence(
        "{C} reaches the equator (Figure 19) and sliding ends: slips away along θ = {theta:.4g}.",
        "a critical set comes to the equator",
    ),
    "cycle shrinks": Sentence(
        "The limit cycle shrinks onto {C} (Hopf): sliding on {C}.", "a Hopf bifurcation, passed backwards"
    ),
    "cycle ends at once": Sentence(
        "The limit cycle ends at once: where orbits go from it is not known.", "a cycle of a typed system that is gone"
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
        "{C} moves as it loses its stability: which set the motion follows on is left to terms of order ε.",
        "det J = 0, an exchange of stability on a set that is not at rest",
    ),
    "canard point": Sentence(
        "{C} ends in a fold at which the slow flow turns too (a canard point): whether the motion leaves there, stays, "
        "or follows the repelling set beyond for a time (a canard) is left to terms of order ε.",
        "det J = 0, W = 0, m = 1",
    ),
    "folded node": Sentence(
        "{C} ends in a fold at a folded node, to which a whole range of motions comes: canards follow the repelling "
        "set beyond for a time, all others leave there.",
        "det J = 0, a folded singularity, both eigenvalues of one sign",
    ),
    "folded saddle": Sentence(
        "{C} ends in a fold at a folded saddle: the motion is a canard in the limit, and for how long it follows the "
        "repelling set beyond is left to ε.",
        "det J = 0, a folded singularity, eigenvalues of two signs",
    ),
    "folded, degenerate": Sentence(
        "{C} ends in a fold at a folded singularity with an eigenvalue 0: what follows is left to ε.",
        "det J = 0, a folded singularity, an eigenvalue 0",
    ),
    "cycle ends": Sentence("The limit cycle ends.", "a limit cycle vanishes as z moves"),
    "cycle ends, not found": Sentence("Where orbits go from it was not found.", "no single cycle just before"),
    "cycle ends, not decided": Sentence(
        "Where orbits go from it is not decided within resolution.", "a cycle is found again beside it"
    ),
    "onward depends": Sentence("Where orbits go from there may depend on Ψ: give it.", "no family of Ψ was given"),
    "Hopf, delayed": Sentence(
        "{C} loses its stability ({how}), and the motion stays near it: to the end of this phase it is attracted more "
        "than repelled.",
        "tr J = 0 or an exchange of stability, way out after the end",
    ),
    "Hopf, delayed until": Sentence(
        "{C} loses its stability ({how}), and the motion stays near it until it is repelled as much as it was "
        "attracted (way in = way out). Any disturbance that is not exponentially small in 1/ε ends that sooner.",
        "tr J = 0, analytic",
    ),
    "Hopf, delayed until the buffer": Sentence(
        "{C} loses its stability ({how}), and the motion stays near it: a complex time at which an eigenvalue is 0 or "
        "singular (buffer point) ends that before way in = way out. Any disturbance that is not exponentially small in "
        "1/ε ends it sooner.",
        "tr J = 0, analytic, C moves",
    ),
    "delay, open": Sentence(
        "{C} loses its stability ({how}), and the motion stays near it as far as it was followed: till there it is "
        "attracted more than repelled.",
        "tr J = 0, way out after the end of the range",
    ),
    "Hopf, left": Sentence("The motion leaves {C}, which is unstable.", "the end of a delay"),
    "Hopf, not analytic": Sentence(
        "{C} loses its stability (Hopf): after what delay is not known, for its eigenvalues are not smooth in time.",
        "tr J = 0, a kink",
    ),
    "Hopf depends": Sentence(
        "{C} loses its stability ({how}): where, and after what delay, depends on Ψ: give it.",
        "tr J = 0, no family of Ψ was given",
    ),
    "border moves in": Sentence("It moves inwards: sliding.", "a critical set on the equator, moving in"),
    "border moves out": Sentence("It moves out: slips.", "a critical set on the equator, moving out"),
    "arrival depends": Sentence(
        "Arrives at Σ at θ = {theta:.4g}; what follows depends on Ψ: give it.",
        "no family of Ψ was given, and they differ",
    ),
    "saddle reached": Sentence(
        "But {onto} is a {kind}: which side is left to ε.", "the orbit ends on a critical set that is not stable"
    ),
    "spiral phase": Sentence(
        "At which phase of the spiral it leaves is left to ε.", "crossing, with no limit direction"
    ),
    "middle is stable": Sentence("On Σ, x = y = 0 is the {kind} {onto}: sliding.", "e = 0 is a stable critical set"),
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
        "There are {count} stable critical sets: sliding is not unique on Σ.",
        "no Ψ given, several stable critical sets",
    ),
    "cycles to slide on": Sentence(
        "There are limit cycles, and no Ψ was given: sliding is not unique on Σ.", "no Ψ given, stable limit cycles"
    ),
    "one way out": Sentence(
        "On Σ nothing attracts; the one way out is θ = {theta:.4g} ({Q}).", "nothing attracts, one direction does"
    ),
    "other ways": Sentence(
        "Not all of the hemisphere leads there: {which} leads away from Σ.",
        "some of the hemisphere leads to a limit direction",
    ),
    "starts, follows nothing": Sentence(
        "The motion starts within O(ε) of Σ, and follows nothing there.", "(x, y) = 0, ε > 0"
    ),
    "passes": Sentence(
        "Passes Σ within {near:g} ε, and follows nothing there: crossing.", "within 20 ε for a time, ε > 0"
    ),
    "has left": Sentence("Leaves Σ: further than {near:g} ε away.", "after a crossing, ε > 0"),
    "no longer follows": Sentence("No longer follows {onto}, and slips away.", "a slide ends, ε > 0"),
    "end of span": Sentence("Reached the end of the time span.", "the status of a simulation"),
    "at an event": Sentence("Stopped at a terminal event.", "the status of a simulation"),
    "not unique": Sentence(
        "Stopped: in the limit ε → 0 what follows is not unique, or not known.", "the status of a simulation"
    ),
    "past on Sigma": Sentence("It is known from where it left Σ.", "a past in the limit that begins on Sigma"),
    "past ends": Sentence("Stopped: what was before is not told by the state.", "the status of a past"),
    "has left Sigma": Sentence(
        "It left Σ at t = {t:.6g}, where motions meet.", "a past in the limit that begins on Sigma"
    ),
    "past forgotten": Sentence(
        "What slides forgets where it came from: before t = {t:.6g} differences of the tolerance would have grown "
        "beyond a hundredth.",
        "a motion followed backwards",
    ),
    "blows up": Sentence("Stopped: the motion grows beyond all bounds in finite time.", "the status of a simulation"),
    "step limit": Sentence(
        "Stopped at the step limit: the motion varies too fast for the time span (around a limit cycle once in a "
        "time of order ε), or comes to where its formulas are undefined; shorten the span, allow more steps, or "
        "take the limit ε → 0.",
        "the status of a simulation",
    ),
    "repels angularly": Sentence(
        "θ = {theta:.4g} repels angularly too: orbits leave in a whole sector around it.",
        "nothing single to leave along",
    ),
    "nothing leaves": Sentence(
        "Nothing leaves Σ along θ = {theta:.4g} there: its radial eigenvalue is not positive, and does not become so.",
        "λ with index ρ is not positive",
    ),
    "phases differ": Sentence(
        "The phases for ε = {eps:.3g} are not those of the limit: from about t = {t:.4g} on the motion {here}, and "
        "in the limit it {there}. ε is not yet small against what happens there.",
        "ε > 0 beside the limit",
    ),
    "blow-up time": Sentence("It blows up near t = {t:.10g}.", "a solution grows beyond bounds"),
    "undefined from": Sentence("Its formulas are undefined from t = {t:.10g} on.", "a formula ends"),
    "no way out": Sentence(
        "On Σ nothing attracts, and no one direction collects what leaves it: what follows is not unique.",
        "no Ψ given, neither an attractor nor a way out",
    ),
    "several ways out": Sentence(
        "On Σ nothing attracts, and {count} directions lead away from it: what follows is not unique.",
        "no Ψ given, several ways out",
    ),
    "one to slide on": Sentence(
        "On Σ there is one stable critical set, {onto}: sliding.", "no Ψ given, one stable critical set"
    ),
    "starts, follows": Sentence("The motion starts within O(ε) of Σ, and follows {onto}: sliding.", "on Σ, ε > 0"),
    "comes, follows": Sentence("Comes within O(ε) of Σ, and follows {onto}: sliding.", "a slip ends, ε > 0"),
    "goes on": Sentence("Goes on within O(ε) of Σ, to {onto}: sliding.", "from one set to another, ε > 0"),
    "errors decide": Sentence(
        "{onto} repels from here on, and the motion is nearer to it than errors of the computation: when it leaves, "
        "and to which side, may be decided by them.",
        "a loss of stability after attraction by more than 1/rtol, ε > 0",
    ),
    "phases agree": Sentence(
        "The phases are those of the limit ε → 0, from which it differs by O(ε).", "ε > 0 beside the limit"
    ),
    "phases agree, less": Sentence(
        "The phases are those of the limit ε → 0, from which it differs by O(ε^{order:.3g}), a lower order because "
        "it leaves Σ.",
        "ε > 0 beside the limit, an exit",
    ),
    "no z to follow": Sentence("There is no z to follow (m = 0).", "a cycle of a typed system, m = 0"),
}
