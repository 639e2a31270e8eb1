"""Sentences of the explorer to a visitor: what it leaves out, waits for or cannot show, each written once.

Sentences about systems are the core's (`codim2_core.results.words`); what is wrong with a value is written
where the value is checked.
"""

from __future__ import annotations

from codim2_core.results.words.sentence import Sentence

#: What the page asks; also the title of a file that is none of the paper's figures.
PAGE_TITLE = "When friction stops pointing anywhere"

SENTENCES: dict[str, Sentence] = {
    "left out": Sentence("These layers are not drawn: {names}. {why}.", "layers that are not drawn"),
    "too long a layer": Sentence("Computing it takes longer than {seconds:g} s", "a layer of typed formulas"),
    "too wild": Sentence(
        (
            "This U is too complicated: {directions} limit directions and {sets} critical sets were found, but "
            "at most {most} together can be followed"
        ),
        "more than can be followed",
    ),
    "fault": Sentence(
        "A fault of the program prevented this computation. The server’s log describes it.",
        "an exception of the program",
    ),
    "at rest": Sentence("At rest under these forces: {contacts}.", "which contacts of a mechanism stick at rest"),
    "at rest, stick": Sentence("{contact} sticks", "a part of the sentence above"),
    "at rest, slip": Sentence("{contact} begins to slip", "a part of the sentence above"),
    "stopped": Sentence("This took too long and was stopped.", "work beside the frames"),
    "no scipy": Sentence(
        "SciPy computes this; a page without a server does not have it.", "a page that computes in the browser"
    ),
    "stopped after": Sentence("This took longer than {seconds:g} s and was stopped.", "work beside the frames"),
    "lost": Sentence("The process that computed this has ended. Move a control to try again.", "a worker that ended"),
    "memory": Sentence("This needs more memory than the server gives it.", "a worker at its bound"),
    "no such place": Sentence("There is none here.", "a place was marked where a question has none"),
    "mark away": Sentence(
        "The right place is {away} radii of the disc from your mark.",
        "a mark in a lesson, farther than lessons.marks.MARK_TOLERANCE",
    ),
    "nothing to play": Sentence(
        "A film of play needs a launched orbit. Click the picture to launch one, or choose one shown.",
        "codim2 film --play of a view without one, or the button",
    ),
    "film stopped": Sentence("The film was stopped, and no file was made.", "a click on Stop while a film is drawn"),
    "proof stopped": Sentence("The search for a proof was stopped.", "a click on Stop, or a value that moves"),
    "address failed": Sentence(
        "A fault of the program kept this address from opening. The first portrait is shown instead.",
        "an exception of the program",
    ),
    "places taken": Sentence(
        ("This server is full, so the picture is frozen. Reload the page later: it opens when a place is free."),
        "a page came while there was a place, and its websocket when there was none",
    ),
    "no connection": Sentence(
        (
            "This page cannot reach its server, so the picture cannot move. Reload the page; if that fails, "
            "check that your proxy allows websockets, or read the server’s log."
        ),
        "the websocket is refused, or closed before the explorer has begun",
    ),
    "compiling": Sentence(
        "The integrator is being compiled, once. Trajectories are drawn at rest meanwhile.",
        "before the compiler is done",
    ),
    "outside the class": Sentence(
        "This Ψ violates {which} of Definition 2.3, which the paper’s results assume.", "Ψ breaks a condition"
    ),
    "no slow variable": Sentence("There is no slow variable (m = 0).", "a panel along z"),
    "no parameter to map": Sentence(
        (
            "This system has no parameter to vary. Write a line such as k = 0.3 in [0, 1] under “where” and use "
            "k in a formula. Or choose Ψ = 3/(3 + (4s)ⁿ)."
        ),
        "numbers only, and m = 0",
    ),
    "one parameter": Sentence(
        (
            "This system has only the parameter {name}. For a plane, choose Ψ = 3/(3 + (4s)ⁿ), or add a line "
            "such as k = 0.3 in [0, 1] under “where”."
        ),
        "a system with one parameter",
    ),
    "map by curves": Sentence(
        ("Curves smaller than 1/24 of the plot (1/16 within the disc) may be missed. Zoom in for a finer search."),
        "an atlas of equations that are not e-linear",
    ),
    "regions to come": Sentence(
        "The regions between these curves are being named …", "an atlas whose curves are there"
    ),
    "curves given up": Sentence(
        "Some of these curves may be missing, since their search stopped after 100 failed places: {kinds}.",
        "an atlas with a search that fails",
    ),
    "connections not followed": Sentence(
        ("Some of these curves may be missing, since they could not be continued or there are many saddles: {kinds}."),
        "an atlas with connections of saddles",
    ),
    "degenerate line": Sentence(
        "At {name} = {value:.4g} every direction is a limit direction, so no portrait is named there.",
        "an atlas with a value at which Θ is zero",
    ),
    "region unlike": Sentence(
        "At {few} of {all} places the portrait differs from that of its region: a curve near them is missing.",
        "an atlas of formulas with corners",
    ),
    "regions unproved": Sentence(
        "At {few} of {all} places it is not proved that all limit directions and critical sets are found.",
        "an atlas of typed formulas with doubts",
    ),
    "no parameter": Sentence(
        "This system has no parameter to vary. Type a name in a formula, or choose Ψ = 3/(3 + (4s)ⁿ).",
        "numbers only, and m = 0",
    ),
    "no parameter of the motion": Sentence(
        "A motion in time does not depend on this. Choose a parameter of the system.", "a response along z or Ψ"
    ),
    "no periodic motion to follow": Sentence(
        (
            "This motion is not periodic. Add a periodic force, for example F*sin(w*t), or choose another start in "
            "the panel Motion."
        ),
        "a response curve of a motion that comes to rest or leaves",
    ),
    "one axis twice": Sentence("Choose two different parameters.", "both axes are one parameter"),
    "n of another Ψ": Sentence("Only Ψ = 3/(3 + (4s)ⁿ) has the parameter n.", "an axis that Ψ does not have"),
    "no such axis": Sentence("{symbol} is not in this system. Choose another.", "an axis that the system lacks"),
    "axis given": Sentence("Your system fixes {symbol}. Choose another.", "an axis that is locked"),
    "over the parameter of Ψ": Sentence(
        "The dashed curve varies {name} of Ψ = {title} from {low:g} to {high:g}.", "a family with a parameter"
    ),
    "other Ψ": Sentence("Small dots show the same system with other Ψ.", "a family without a parameter"),
    "request of a wrong kind": Sentence(
        "A request was ignored: it came as {kind} instead of {{id, set, rest}}.", "what no page of ours sends"
    ),
    "values of a wrong kind": Sentence(
        "Values were ignored: they came as {kind} instead of names of controls.", "what no page of ours sends"
    ),
    "too many values": Sentence(
        "Values were ignored: {count} came at once, and at most {most} controls can be set.",
        "what no page of ours sends",
    ),
    "values left out": Sentence("These values were ignored: {names}.", "values that are too large"),
    "address names": Sentence(
        "The address names {names}, which the explorer does not have. They were ignored.", "a link"
    ),
    "address changed": Sentence("The address is incomplete or was changed. Copy the whole link.", "a link"),
    "address too long": Sentence("The address is too long. Its s may have {most} characters.", "a link"),
    "address of a later version": Sentence(
        "The address is of version {version!r}, but this release reads up to {newest}. Update the explorer.", "a link"
    ),
    "part of the picture": Sentence(
        (
            "{given!r} is no part of the picture. Give seen as left,right,bottom,top, {least:g} to {most:g} "
            "apart and within {far:g} of the centre."
        ),
        "a link",
    ),
    "controls of a frame": Sentence(
        "Too many or unknown controls. Give at most {most} names, such as 'f1,n'.", "a link"
    ),
    "views of a link": Sentence(
        ("The saved views of this address cannot be read: it is incomplete or was changed. Copy the whole link."),
        "a link",
    ),
    "name of a box": Sentence(
        "{name} is the name of a box, not a parameter. Write its formula here, or rename the parameter.",
        "a typed name",
    ),
    "name of the regularisation": Sentence(
        (
            "{name} does not belong in the system, which has no regularisation. Ψ has its own box, and ε is in "
            "the panel Motion."
        ),
        "a typed name",
    ),
    "name of time": Sentence(
        "{name} is the time t, which your equations may read. Rename the parameter.", "a typed name"
    ),
    "no time passes": Sentence("It follows the equator, where no time passes.", "a launched orbit on the equator"),
    "no such parameter": Sentence(
        "The system has no parameter {names} ({there}). They were ignored.", "a link, or a cell"
    ),
    "no such box": Sentence("The system has no box {names} ({there}). They were ignored.", "a link, or a cell"),
    "no rooms": Sentence("This server opens no rooms.", "a room asked for where there are none"),
    "all rooms taken": Sentence(
        "All {most} rooms that you can have here are in use. Try again when one has ended.", "a room too many"
    ),
    "no such room": Sentence("There is no room {code!r}. Check its code of six letters.", "a code that is typed"),
    "room full": Sentence("The room is full: it holds {most} visitors.", "a phone too many"),
    "too many codes": Sentence(
        "Too many codes were tried from your network. Wait a minute, and check the code.", "codes that are guessed"
    ),
    "no such lesson": Sentence("There is no lesson {name!r}. Choose one such as {some}.", "a link"),
}


def say(key: str, **fields: object) -> str:
    """Return a sentence with its fields filled in."""
    return SENTENCES[key].says.format(**fields)
