"""Sentences about a portrait: its limit directions, its critical sets, and the outcomes of approaches."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    # limit directions
    "all directions": Sentence("Every direction is a limit direction.", "Θ vanishes identically"),
    "closed equator": Sentence(
        "There are no limit directions: the equator is a closed orbit.", "Θ has no zero, exponent 0"
    ),
    "closed equator, stable": Sentence(
        (
            "There are no limit directions: the equator is a closed orbit that attracts outside and repels on "
            "the hemisphere."
        ),
        "Θ has no zero, exponent < 0",
    ),
    "closed equator, unstable": Sentence(
        (
            "There are no limit directions: the equator is a closed orbit that repels outside and attracts on "
            "the hemisphere."
        ),
        "Θ has no zero, exponent > 0",
    ),
    "one arrives": Sentence("Trajectories reach Σ along the only limit direction.", "one zero, λ with index ρ < 0"),
    "one leaves": Sentence("Trajectories leave Σ along the only limit direction.", "one zero, λ with index ρ > 0"),
    "all arrive": Sentence("Trajectories reach Σ along {which} limit directions.", "all radially attracting"),
    "all leave": Sentence("Trajectories leave Σ along {which} limit directions.", "all radially repelling"),
    "both": Sentence(
        "There are {count} limit directions: trajectories reach Σ along {arriving} and leave it along {leaving}.",
        "both kinds",
    ),
    "some arrive": Sentence(
        "There are {count} limit directions: trajectories reach Σ along {moving}.", "the others are neutral"
    ),
    "some leave": Sentence(
        "There are {count} limit directions: trajectories leave Σ along {moving}.", "the others are neutral"
    ),
    "none moves": Sentence("The number of limit directions is {count}.", "every λ with index ρ is 0"),
    "neutral directions": Sentence(
        "{which} radially neutral: to first order trajectories neither reach nor leave Σ there.",
        "λ with index ρ is 0 within rounding",
    ),
    "directions unproved": Sentence(
        "It is not proved that there are no other limit directions.",
        "`EquatorEquilibria.proven` is False",
    ),
    "no directions found": Sentence(
        "No limit direction was found, but it is not proved that there is none.",
        "none, `EquatorEquilibria.proven` is False",
    ),
    # critical sets of the e-linear system
    "crossing": Sentence("There is no critical set, so trajectories that reach Σ cross it.", "|A⁻¹f| > 1"),
    "repelled": Sentence("There is no critical set, and nothing reaches Σ.", "|A⁻¹f| > 1, no direction attracts"),
    "stable sliding": Sentence("The critical set C is a {kind}, so sliding along Σ is stable.", "Case I, stable"),
    "stable, unreached": Sentence(
        "The critical set C is a {kind}, but no trajectory reaches Σ: only a start on Σ slides.",
        "stable, none attracts",
    ),
    "stable in part": Sentence(
        ("The critical set C is a {kind}, so sliding along C is stable. Other trajectories that reach Σ may cross it."),
        "stable, outside Case I",
    ),
    "saddle": Sentence(
        ("The critical set C is a saddle for every Ψ: sliding along Σ is unstable, and almost every orbit leaves."),
        "det A < 0",
    ),
    "unstable": Sentence("The critical set C is an {kind}, so sliding along C is unstable.", "unstable"),
    "centre": Sentence("The critical set C is a centre to first order.", "tr J = 0 within rounding"),
    "closed orbits around": Sentence(
        "The critical set C is a centre: closed orbits surround it.", "tr J = 0 where the layer problem says more"
    ),
    # critical sets of other systems
    "no isolated set": Sentence(
        "There is no isolated critical set on the hemisphere.", "a curve of zeros, or zeros on the equator"
    ),
    "no critical set": Sentence("There is no critical set.", "U has no zero in the disc, proven"),
    "no set found": Sentence(
        "No critical set was found, but it is not proved that there is none.", "none, the search left something open"
    ),
    "only set": Sentence("The only critical set is {kinds}.", "one critical set"),
    "sets": Sentence("There are {count} critical sets: {kinds}.", "several critical sets"),
    "sets unproved": Sentence(
        "It is not proved that there are no other critical sets.", "some, the search left something open"
    ),
    "none stable": Sentence("None is stable.", "several, none stable"),
    "not stable": Sentence("It is not stable.", "one, not stable"),
    "one stable": Sentence("Sliding along Σ is stable.", "one stable"),
    "several stable": Sentence(
        "Sliding along Σ is stable in {count} ways, and the approach decides which.", "several stable, cycles included"
    ),
    # limit cycles that attract
    "stable cycle": Sentence(
        "A stable limit cycle surrounds {sets}: trajectories wind onto it and slide along Σ.", "one stable cycle"
    ),
    "stable cycles": Sentence(
        "{count} stable limit cycles surround {sets}: trajectories wind onto them and slide along Σ.",
        "several stable cycles about the same sets",
    ),
    "semistable cycle": Sentence(
        "A semistable limit cycle surrounds {sets}: it attracts from one side.", "one semistable cycle"
    ),
    "semistable cycles": Sentence(
        "{count} semistable limit cycles surround {sets}: each attracts from one side.",
        "several semistable cycles about the same sets",
    ),
    # what becomes of an approach: who arrives
    "open set": Sentence("An open set of trajectories arrives at {Q}.", "radially and angularly attracting"),
    "one side": Sentence(
        "Trajectories arrive at {Q} from one side only (Θ has a double zero).", "Θ has a double zero, others exist"
    ),
    "one side, all angles": Sentence(
        "Trajectories turn to {Q} from every angle, and arrive from one side (Θ has a double zero).",
        "the only zero of Θ is double",
    ),
    "single direction": Sentence(
        "Only the trajectory aimed exactly along {Q} arrives there; its neighbours turn away.",
        "radially attracting, angularly repelling",
    ),
    "spiral": Sentence(
        "Trajectories from all angles spiral onto the closed equator (Theorem 3.1(c)).",
        "closed, stable outside",
    ),
    "neutral approach": Sentence(
        (
            "{Q} is radially neutral, since a critical set reaches the equator: to first order nothing arrives "
            "or leaves."
        ),
        "λ with index ρ is 0",
    ),
    "repels": Sentence("{Q} repels radially and angularly: nothing tends to it.", "both eigenvalues > 0"),
    "leads away": Sentence(
        "{Q} repels radially: trajectories that turn towards it leave Σ.", "repels radially, not angularly"
    ),
    "turns away": Sentence(
        "Trajectories that come in next to it turn away: crossing, in the words of Section 5.2.",
        "radially repelling, angularly attracting, beside one that attracts radially",
    ),
    "all lead away": Sentence("Every direction leads away from Σ.", "Θ ≡ 0, U.e > 0"),
    "some lead": Sentence(
        "Every direction is a limit direction: some lead to Σ, and others lead away from it.",
        "Θ ≡ 0, U.e of both signs",
    ),
    "at rest": Sentence("U vanishes on the equator: to first order nothing arrives or leaves.", "U ≡ 0"),
    "neutral equator": Sentence(
        "The closed equator is neutral: to first order trajectories neither approach Σ nor leave it.", "exponent 0"
    ),
    "equator repels": Sentence(
        "The closed equator repels outside: trajectories spiral away and never reach Σ.", "exponent > 0"
    ),
    # and where they go
    "slides": Sentence("They reach the critical set {label}, a {kind}, and slide.", "they end at a critical set"),
    "slides around": Sentence(
        ("They wind onto a limit cycle around C and slide, on average with the slow flow of C (Proposition 4.2)."),
        "they end on a limit cycle, e-linear",
    ),
    "slides on a cycle": Sentence(
        "They wind onto a limit cycle and slide with the mean slow flow over the cycle.", "they end on a limit cycle"
    ),
    "crosses": Sentence("They cross Σ and leave along θ = {theta} ({label}).", "they end at a limit direction"),
    "crosses spiralling": Sentence(
        "They reach the closed equator, cross Σ and spiral away.", "they end on the closed equator"
    ),
    "several ends": Sentence(
        "{many}, and they end at different places: {labels}.", "a family of orbits with more than one ending"
    ),
    "saddle ahead": Sentence(
        "They run into the saddle {label}: terms of order ε decide on which side they leave.", "a saddle connection"
    ),
    "neutral ahead": Sentence(
        ("They reach {label}, which is radially neutral: terms of higher order decide whether they leave Σ there."),
        "they end at a limit direction with λ with index ρ = 0",
    ),
    "rest ahead": Sentence(
        "They come to rest at an equilibrium that is not isolated: terms of higher order decide what follows.",
        "they end on a curve of equilibria",
    ),
    "unfollowed": Sentence("They were integrated for a long time and reached no limit set.", "the computation gave up"),
    "alike": Sentence(
        "For other Ψ some slide on C and others around it, with the same slow flow.",
        "e-linear: all families slide, not all on the same set",
    ),
}
