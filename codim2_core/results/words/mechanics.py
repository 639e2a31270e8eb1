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
    "grips just": Sentence(
        "It just holds: sticking needs a friction of {needed:.4g}, and no more is available in that direction.",
        "a critical set on the equator, to rounding",
    ),
    "grip lost": Sentence(
        (
            "It cannot stick: this needs a friction of {needed:.4g}, and only {there:.4g} is available in that "
            "direction."
        ),
        "no critical set inside",
    ),
    "cannot stick, opens": Sentence(
        "The contact opens: sticking would need a normal force of {normal:.4g}.", "N is not positive"
    ),
    "contact presses": Sentence("The contact presses.", "N > 0, and more of it parts the bodies"),
    "contact opens": Sentence("The contact opens: no normal force is needed to keep the bodies apart.", "N falls to 0"),
    "contact jams": Sentence(
        "The contact jams (Painlevé): with its friction a normal force presses the bodies together, and none holds "
        "them apart.",
        "a normal force with its friction gives no positive normal acceleration, and the bodies approach without it",
    ),
    "contact not unique": Sentence(
        "The motion is not unique (Painlevé): with its friction a normal force presses the bodies together, and they "
        "part without it.",
        "a normal force with its friction gives no positive normal acceleration, and the bodies part without it",
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
        "{count} of {of} contacts stick. The acceleration is unique, and so is the friction at each of them.",
        "which contacts stick at a state, the Delassus matrix regular",
    ),
    "contacts redundant": Sentence(
        (
            "{count} of {of} contacts stick. The acceleration is unique, but the contacts are redundant, and Ψ decides "
            "how they share the friction."
        ),
        "which contacts stick at a state, the Delassus matrix singular",
    ),
    "contacts start": Sentence("The motion starts.", "the first phase of a motion with several contacts"),
    "contact arrives": Sentence("The slip ends at {where}.", "a contact arrives at its set, and sticks"),
    "contact arrives, slips": Sentence(
        "The slip ends at {where}, and a contact begins to slip.", "a contact arrives, and it or another slips"
    ),
    "contact departs": Sentence(
        "Friction no longer holds {where}.", "the force that holds a contact is at its bound, and it begins to slip"
    ),
    "contact without friction": Sentence(
        "It stopped where a contact has no friction.", "the status of a motion with several contacts"
    ),
    "contact, mu N": Sentence("The bound μN of contact {which} is not positive there.", "mu N <= 0 in a motion"),
    "contact steps": Sentence("The last time is t = {t:.6g}.", "a motion with several contacts, too many steps"),
}
