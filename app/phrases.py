"""Sentences of the explorer to a visitor: what it leaves out, waits for or cannot show, each written once.

What is said of systems is the core's: `codim2_core.words`. What is said of a wrong value stands where that is checked.
"""

from __future__ import annotations

from codim2_core.words.sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "left out": Sentence("Left out: {names}; {why}.", "layers that are not drawn"),
    "too long a layer": Sentence("computing this takes longer than {seconds:g} s", "a layer of typed formulas"),
    "too wild": Sentence(
        "U is too wild: {directions} limit directions and {sets} critical sets were found, and at most {most} together "
        "can be followed",
        "more than can be followed",
    ),
    "fault": Sentence(
        "This could not be computed: a fault of the program, which its log describes.", "an exception of the program"
    ),
    "stopped": Sentence("This takes too long, and was stopped.", "work beside the frames"),
    "stopped after": Sentence("This takes longer than {seconds:g} s, and was stopped.", "work beside the frames"),
    "lost": Sentence("The process that computed this has ended: move a control to try again.", "a worker that ended"),
    "memory": Sentence("This needs more memory than the server gives it.", "a worker at its bound"),
    "no such place": Sentence("There is none here.", "a place was marked where a question has none"),
    "mark away": Sentence(
        "Your mark is {away} radii of the disc from it.",
        "a mark in a lesson, farther than lessons.marks.MARK_TOLERANCE",
    ),
    "nothing to play": Sentence(
        "A film of play follows the chosen launched orbit: click the picture to launch one, or choose one shown.",
        "codim2 film --play of a view without one, or the button",
    ),
    "film stopped": Sentence("The film was stopped; nothing was made.", "a click on Stop while a film is drawn"),
    "proof stopped": Sentence("The search for a proof was stopped.", "a click on Stop, or a value that moves"),
    "address failed": Sentence(
        "This address could not be opened, a fault of the program: here is the first portrait instead.",
        "an exception of the program",
    ),
    "places taken": Sentence(
        "All places are taken just now, so this picture cannot move. Reload the page: it opens as soon as one is free.",
        "a page came while there was a place, and its websocket when there was none",
    ),
    "no connection": Sentence(
        "This page has no connection to its server, so the picture cannot move. Reload the page; if that does not "
        "help, a proxy on the way lets no websocket through, or the log of the server has the reason.",
        "the websocket is refused, or closed before the explorer has begun",
    ),
    "compiling": Sentence(
        "The integrator is being compiled, once; trajectories are sketched.", "before the compiler is done"
    ),
    "outside the class": Sentence(
        "This Ψ does not meet {which} of Definition 2.3, which the paper’s results assume.", "Ψ breaks a condition"
    ),
    "no slow variable": Sentence("There is no slow variable: m = 0.", "a panel along z"),
    "no parameter to map": Sentence(
        "An atlas needs a parameter; this system has none. Write a line such as k = 0.3 in [0, 1] under “where”, and k "
        "in a formula; or choose Ψ = 3/(3 + (4s)ⁿ), which has n.",
        "numbers only, and m = 0",
    ),
    "one parameter": Sentence(
        "Along {name}, the only parameter. A second one makes a plane: Ψ = 3/(3 + (4s)ⁿ) has n, and equations of your "
        "own have one by a line such as k = 0.3 in [0, 1] under “where”, and k in a formula.",
        "a system with one parameter",
    ),
    "map by curves": Sentence(
        "Curves are followed from where a net sees them: one that keeps within 1/24 of the ranges (within the disc "
        "1/16) can be missed. Zoom in for a finer one.",
        "an atlas of equations that are not e-linear",
    ),
    "regions to come": Sentence(
        "The regions between these curves are being named …", "an atlas whose curves are there"
    ),
    "curves given up": Sentence(
        "Some of these curves may be missing, the search was given up after 100 places without one: {kinds}.",
        "an atlas with a search that fails",
    ),
    "connections not followed": Sentence(
        "Some of these curves may be missing, seen at a place and not followed from there, or not looked for where "
        "there are many saddles: {kinds}.",
        "an atlas with connections of saddles",
    ),
    "degenerate line": Sentence(
        "At {name} = {value:.4g} every direction is a limit direction: nothing is told there.",
        "an atlas with a value at which Θ is zero",
    ),
    "region unlike": Sentence(
        "At {few} of {all} places the portrait is not that of its region: a curve near them is missing.",
        "an atlas of formulas with corners",
    ),
    "regions unproved": Sentence(
        "At {few} of {all} places it is not proved that no limit direction and no critical set is missed.",
        "an atlas of typed formulas with doubts",
    ),
    "no parameter": Sentence(
        "A diagram needs a parameter; this system has none. A name typed in a formula becomes one, and Ψ = 3/(3 + "
        "(4s)ⁿ) has n.",
        "numbers only, and m = 0",
    ),
    "one axis twice": Sentence("Choose two different parameters.", "both axes are one parameter"),
    "n of another Ψ": Sentence("n is a parameter of Ψ = 3/(3 + (4s)ⁿ) only.", "an axis that Ψ does not have"),
    "no such axis": Sentence("{symbol} is not in this system: choose another.", "an axis that the system lacks"),
    "axis given": Sentence("{symbol} is given by your system: choose another.", "an axis that is locked"),
    "over the parameter of Ψ": Sentence(
        "Dashed: over {name} of Ψ = {title}, from {low:g} to {high:g}.", "a family with a parameter"
    ),
    "other Ψ": Sentence("Small dots: the same system with other Ψ.", "a family without a parameter"),
    "request of a wrong kind": Sentence(
        "A request came as {kind}; it is {{id, set, rest}}: left out.", "what no page of ours sends"
    ),
    "values of a wrong kind": Sentence(
        "Values came as {kind}; they are given by the names of controls: left out.", "what no page of ours sends"
    ),
    "too many values": Sentence(
        "{count} values came at once; at most {most} controls can be set: left out.", "what no page of ours sends"
    ),
    "values left out": Sentence("Left out: {names}.", "values that are too large"),
    "address names": Sentence("The address names {names}, which the explorer does not have: left out.", "a link"),
    "address changed": Sentence("The address is cut short or was changed on its way: copy the whole link.", "a link"),
    "address too long": Sentence("The address is too long: its s may have {most} characters.", "a link"),
    "address of a later version": Sentence(
        "The address is of version {version!r}; this release reads up to {newest}.", "a link"
    ),
    "part of the picture": Sentence(
        "seen: {given!r} given; give left,right,bottom,top, {least:g} to {most:g} apart, within {far:g} of the centre.",
        "a link",
    ),
    "controls of a frame": Sentence("controls: give at most {most} names of controls, such as 'f1,n'.", "a link"),
    "views of a link": Sentence(
        "The kept views of this address cannot be read: it was cut short or changed.", "a link"
    ),
    "name of a box": Sentence(
        "{name} names a box, and is no parameter; write its formula here, or give the parameter another name.",
        "a typed name",
    ),
    "name of the regularisation": Sentence(
        "{name}: the system is the one without regularisation; Ψ has a box of its own, and ε is in the panel Orbits.",
        "a typed name",
    ),
    "name of time": Sentence(
        "{name} is time: equations of your own may read it, as t; give the parameter another name.", "a typed name"
    ),
    "no time passes": Sentence("It follows the equator, where no time t passes.", "a launched orbit on the equator"),
    "no such parameter": Sentence("The system has no parameter {names} ({there}): left out.", "a link, or a cell"),
    "no such box": Sentence("The system has no box {names} ({there}): left out.", "a link, or a cell"),
    "no rooms": Sentence("This server opens no rooms.", "a room asked for where there are none"),
    "all rooms taken": Sentence(
        "All {most} rooms of this server are open just now: try again when one has ended.", "a room too many"
    ),
    "no such room": Sentence("There is no room {code!r} now: its code has four letters.", "a code that is typed"),
    "room full": Sentence("The room is full: it holds {most}.", "a phone too many"),
    "too many codes": Sentence("Too many codes were tried: load the page again.", "codes that are guessed"),
    "no such lesson": Sentence("Lessons: there is no {name!r}; choose one such as {some}.", "a link"),
}


def say(key: str, **fields: object) -> str:
    """Return a sentence with its fields filled in."""
    return SENTENCES[key].says.format(**fields)
