"""Sentences about a mechanism: whether its contact grips."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "grips": Sentence(
        (
            "It cannot start to slip: sticking needs a friction of {needed:.4g}, and {there:.4g} is available in "
            "that direction."
        ),
        "Coulomb's law with one coefficient, a critical set inside",
    ),
    "can grip": Sentence(
        "It can stick: this needs a friction of {needed:.4g}, and {there:.4g} is available in that direction.",
        "a critical set inside, friction by a matrix or a constraint",
    ),
    "grip lost": Sentence(
        (
            "It cannot stick: this needs a friction of {needed:.4g}, and only {there:.4g} is available in that "
            "direction."
        ),
        "no critical set inside",
    ),
    "contact opens": Sentence(
        "The contact opens: sticking would need a normal force of {normal:.4g}.", "N is not positive"
    ),
    "fitted": Sentence(
        "{found}; it slips at {angle:.4g}° ({low:.4g} to {high:.4g}) at the end, and does not stop.",
        "least squares, 95 % sure; the motion that fits goes on",
    ),
    "fitted until it stops": Sentence(
        "{found}; it stops at t = {stop:.4g}, at {angle:.4g}° ({low:.4g} to {high:.4g}).",
        "least squares, 95 % sure; the motion that fits comes to rest",
    ),
    "motion of a mechanism": Sentence("It {course}.", "a motion in an engineer's words, times in seconds"),
    "contacts decided": Sentence(
        "Of {of} contacts {count} stick: the acceleration is unique, and so is the friction at each of them.",
        "which contacts stick at a state, the Delassus matrix regular",
    ),
    "contacts redundant": Sentence(
        (
            "Of {of} contacts {count} stick: the acceleration is unique, but the contacts are redundant, so Ψ decides "
            "how they share the friction."
        ),
        "which contacts stick at a state, the Delassus matrix singular",
    ),
    "contacts start": Sentence("The motion starts.", "the first phase of a motion with several contacts"),
    "contact arrives": Sentence("The slip of contact {which} ends: it sticks.", "a contact arrives at its set"),
    "contact arrives, slips": Sentence(
        "The slip of contact {which} ends, and a contact begins to slip.", "a contact arrives, and one goes on"
    ),
    "contact departs": Sentence(
        "Contact {which} needs more friction than it has: it begins to slip.", "the force that holds it is at its bound"
    ),
    "contact opens in motion": Sentence("A contact loses its friction.", "mu N is not positive"),
    "contact without friction": Sentence("Contact {which} has no friction from here.", "mu N is not positive"),
    "contact steps": Sentence("It stops at t = {t:.6g}.", "a motion with several contacts, too many steps"),
}
