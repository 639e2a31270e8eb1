"""Sentences about periodic motions: whether one was found, and whether it is stable."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "repeats": Sentence("The motion repeats itself after T = {period:.10g}.", "a periodic motion is found"),
    "repeats sooner": Sentence(
        "It has done so {count} times by then: its own period is T/{count}.", "a multiple of a period"
    ),
    "periodic stable": Sentence(
        "It is stable: no multiplier is larger than {size:.6g} in modulus.", "all multipliers inside the unit circle"
    ),
    "periodic unstable": Sentence(
        "It is unstable: a multiplier has the modulus {size:.6g}.", "a multiplier outside the unit circle"
    ),
    "periodic undecided": Sentence(
        "Whether it is stable is not decided: a multiplier is {where}, to within {error:.1e}.",
        "a multiplier as close to the unit circle as it is known",
    ),
    "periodic beside a line": Sentence(
        "Whether it is stable is not decided: it stays in an invariant line that repels, and no derivative tells what "
        "becomes of motions beside the line; in it, no multiplier is larger than {size:.6g} in modulus.",
        "in an invariant line that repels, all multipliers within it inside the unit circle",
    ),
    "start is lost": Sentence(
        "It loses its start at Σ: {count} of its multipliers, exactly 0.", "ε = 0, a slide or a crossing"
    ),
    "not isolated": Sentence(
        "It is not isolated as far as is known: a multiplier is +1, as at a fold and in a family.",
        "a multiplier +1 within its error",
    ),
    "no periodic motion": Sentence(
        "No periodic motion was found: Newton's method stopped at a residual of {residual:.1e}; begin closer to one.",
        "no convergence",
    ),
    "no derivative": Sentence(
        "No periodic motion was found: the derivatives over a period are not all known; begin elsewhere on it, or "
        "closer.",
        "a motion at which no derivative exists",
    ),
    "motion ends early": Sentence(
        "No periodic motion was found: what is followed from there ends before a period is over.", "no motion to return"
    ),
    "comes to rest": Sentence(
        "No periodic motion was found: what was come to stands still; begin further from it.", "an equilibrium"
    ),
}
