"""Sentences about periodic motions: whether one was found, and whether it is stable."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "repeats": Sentence("The motion repeats after T = {period:.10g}.", "a periodic motion is found"),
    "repeats sooner": Sentence(
        "Its least period is T/{count}, since it has repeated {count} times by then.", "a multiple of a period"
    ),
    "periodic stable": Sentence(
        "It is stable: no multiplier exceeds {size:.6g} in modulus.", "all multipliers inside the unit circle"
    ),
    "periodic unstable": Sentence(
        "It is unstable: a multiplier has modulus {size:.6g}.", "a multiplier outside the unit circle"
    ),
    "periodic undecided": Sentence(
        "Its stability is undecided: a multiplier is {where}, to within {error:.1e}.",
        "a multiplier as close to the unit circle as it is known",
    ),
    "periodic beside a line": Sentence(
        (
            "Its stability is undecided: it stays in an invariant line that repels, beside which no derivative "
            "exists. Within the line, no multiplier exceeds {size:.6g} in modulus."
        ),
        "in an invariant line that repels, all multipliers within it inside the unit circle",
    ),
    "start is lost": Sentence(
        "It forgets its start on Σ: {count} of its multipliers, exactly 0.", "ε = 0, a slide or a crossing"
    ),
    "not isolated": Sentence(
        "It may not be isolated: a multiplier is +1, as at a fold or in a family.",
        "a multiplier +1 within its error",
    ),
    "no periodic motion": Sentence(
        ("No periodic motion was found: Newton's method stopped at a residual of {residual:.1e}. Start closer to one."),
        "no convergence",
    ),
    "no derivative": Sentence(
        (
            "No periodic motion was found: the derivatives over a period are not all known. Start elsewhere on "
            "it, or closer."
        ),
        "a motion at which no derivative exists",
    ),
    "motion ends early": Sentence(
        "No periodic motion was found: the motion ends before a period is over.", "no motion to return"
    ),
    "comes to rest": Sentence(
        "No periodic motion was found: the search led to an equilibrium. Start further from it.", "an equilibrium"
    ),
    "exponents": Sentence("{count} periods were counted, {time:.6g} units of time.", "Lyapunov exponents"),
    "response": Sentence("{count} motions, for {name} from {low:.6g} to {high:.6g}.", "a response curve"),
    "response folds": Sentence(
        "{name} = {value:.6g}: the curve turns, and two periodic motions meet and vanish.", "a multiplier +1, a turn"
    ),
    "branches off": Sentence(
        "{name} = {value:.6g}: a multiplier is +1, and another curve of periodic motions may branch off.",
        "a multiplier +1, no turn",
    ),
    "doubles": Sentence(
        "{name} = {value:.6g}: a multiplier is −1, and a motion of twice the period branches off.", "a multiplier −1"
    ),
    "becomes a torus": Sentence(
        "{name} = {value:.6g}: two complex multipliers cross the unit circle, and a torus branches off.",
        "a complex pair of modulus 1",
    ),
    "sticks change": Sentence(
        "{name} = {value:.6g}: a stick begins or ends. A period has {below} below this value, and {above} above it.",
        "slides of a period",
    ),
    "passages change": Sentence(
        (
            "{name} = {value:.6g}: in a period the motion passes Σ {below} times below this value, and {above} times "
            "above it."
        ),
        "crossings of a period",
    ),
}
