"""Sentences about a portrait: its limit directions, its critical sets, and the outcomes of approaches."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    # limit directions
    "all directions": Sentence("Every direction is a limit direction.", "Θ vanishes identically"),
    "closed equator": Sentence("No limit directions: the equator is a closed orbit.", "Θ has no zero, exponent 0"),
    "closed equator, stable": Sentence(
        "No limit directions: the equator is a closed orbit that attracts outside and repels on the hemisphere.",
        "Θ has no zero, exponent < 0",
    ),
    "closed equator, unstable": Sentence(
        "No limit directions: the equator is a closed orbit that repels outside and attracts on the hemisphere.",
        "Θ has no zero, exponent > 0",
    ),
    "one arrives": Sentence("1 limit direction: trajectories reach Σ along it.", "one zero, λ with index ρ < 0"),
    "one leaves": Sentence("1 limit direction: trajectories leave Σ along it.", "one zero, λ with index ρ > 0"),
    "all arrive": Sentence("{count} limit directions: trajectories reach Σ along them.", "all radially attracting"),
    "all leave": Sentence("{count} limit directions: trajectories leave Σ along them.", "all radially repelling"),
    "both": Sentence(
        "{count} limit directions: trajectories reach Σ along {arriving} and leave it along {leaving}.", "both kinds"
    ),
    "some arrive": Sentence(
        "{count} limit directions: trajectories reach Σ along {moving} of them.", "the others are neutral"
    ),
    "some leave": Sentence(
        "{count} limit directions: trajectories leave Σ along {moving} of them.", "the others are neutral"
    ),
    "none moves": Sentence("Limit directions: {count}.", "every λ with index ρ is 0"),
    "neutral directions": Sentence(
        "{which} radially neutral: to first order trajectories neither reach Σ nor leave it there.",
        "λ with index ρ is 0 within rounding",
    ),
    "directions unproved": Sentence(
        "These limit directions were found; that there are no more is not proved.",
        "`EquatorEquilibria.proven` is False",
    ),
    "no directions found": Sentence(
        "No limit direction was found; that there is none is not proved.", "none, `EquatorEquilibria.proven` is False"
    ),
    # critical sets of the e-linear system
    "crossing": Sentence("There is no critical set, so nothing slides: what reaches Σ crosses it.", "|A⁻¹f| > 1"),
    "repelled": Sentence("There is no critical set, and nothing reaches Σ.", "|A⁻¹f| > 1, no direction attracts"),
    "stable sliding": Sentence("The critical set C is a {kind}: stable sliding along Σ.", "Case I, stable"),
    "stable, unreached": Sentence(
        "The critical set C is a {kind}, but nothing reaches Σ: only what is there slides.", "stable, none attracts"
    ),
    "stable in part": Sentence(
        "The critical set C is a {kind}: sliding along C is stable. What arrives elsewhere may cross.",
        "stable, outside Case I",
    ),
    "saddle": Sentence(
        "The critical set C is a saddle whatever Ψ is: sliding along Σ is unstable, almost every orbit leaves.",
        "det A < 0",
    ),
    "unstable": Sentence("The critical set C is an {kind}: sliding along C itself is unstable.", "unstable"),
    "centre": Sentence("The critical set C is a centre to first order.", "tr J = 0 within rounding"),
    "closed orbits around": Sentence(
        "The critical set C is a centre: closed orbits surround it.", "tr J = 0 where the layer problem says more"
    ),
    # critical sets of other systems
    "no isolated set": Sentence("No isolated critical set inside.", "a curve of zeros, or zeros on the equator"),
    "no critical set": Sentence("There is no critical set.", "U has no zero in the disc, proven"),
    "no set found": Sentence(
        "No critical set was found inside; that there is none is not proved.", "none, the search left something open"
    ),
    "sets unproved": Sentence(
        "Critical sets found: {kinds}; that there are no more is not proved.", "some, the search left something open"
    ),
    "none stable": Sentence("Critical sets: {kinds}. None is stable.", "none stable"),
    "one stable": Sentence("Critical sets: {kinds}. There is one way to slide stably along Σ.", "one stable"),
    "several stable": Sentence(
        "Critical sets: {kinds}. There are {count} ways to slide stably along Σ: it depends on the approach.",
        "several stable, cycles included",
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
        "Only the trajectories exactly along {Q} arrive at it: those beside it turn to the next ones.",
        "radially attracting, angularly repelling",
    ),
    "spiral": Sentence(
        "Trajectories from all angles spiral onto the closed equator (Theorem 3.1(c)).",
        "closed, stable outside",
    ),
    "neutral approach": Sentence(
        "{Q} is radially neutral (a critical set comes to the equator): to first order nothing arrives or leaves.",
        "λ with index ρ is 0",
    ),
    "repels": Sentence("{Q} repels radially and angularly: nothing tends to it.", "both eigenvalues > 0"),
    "leads away": Sentence("{Q} repels radially: what turns towards it leaves Σ.", "repels radially, not angularly"),
    "turns away": Sentence(
        "Those that come in beside it turn away: crossing, in the words of Section 5.2.",
        "radially repelling, angularly attracting, beside one that attracts radially",
    ),
    "all lead away": Sentence("Every direction leads away from Σ.", "Θ ≡ 0, U.e > 0"),
    "some lead": Sentence(
        "Every direction is a limit direction, and some lead to Σ, others away from it.", "Θ ≡ 0, U.e of both signs"
    ),
    "at rest": Sentence("U vanishes on the equator: to first order nothing arrives or leaves.", "U ≡ 0"),
    "neutral equator": Sentence(
        "The closed equator is neutral: to first order trajectories neither approach Σ nor leave it.", "exponent 0"
    ),
    "equator repels": Sentence(
        "The closed equator repels outside: trajectories spiral away and never reach Σ.", "exponent > 0"
    ),
    # and where they go
    "slides": Sentence("They reach the critical set {label}, a {kind}: sliding.", "they end at a critical set"),
    "slides around": Sentence(
        "They wind onto a limit cycle around C: sliding, with the slow flow of C on average (Proposition 4.2).",
        "they end on a limit cycle, e-linear",
    ),
    "slides on a cycle": Sentence(
        "They wind onto a limit cycle: sliding, with the mean slow flow over the cycle.", "they end on a limit cycle"
    ),
    "crosses": Sentence("They leave along θ = {theta} ({label}): crossing.", "they end at a limit direction"),
    "crosses spiralling": Sentence(
        "They come down to the closed equator and spiral away: crossing.", "they end on the closed equator"
    ),
    "several ends": Sentence(
        "{many}, and they end at different places: {labels}.", "a family of orbits with more than one ending"
    ),
    "saddle ahead": Sentence("They run into the saddle {label}: which side is left to ε.", "a saddle connection"),
    "neutral ahead": Sentence(
        "They come to {label}, which is radially neutral: terms of higher order decide whether they leave Σ there.",
        "they end at a limit direction with λ with index ρ = 0",
    ),
    "rest ahead": Sentence(
        "They come to rest at an equilibrium that is not isolated: terms of higher order decide what they do there.",
        "they end on a curve of equilibria",
    ),
    "unfollowed": Sentence("They were followed for long and came to no end.", "the computation gave up"),
    "alike": Sentence(
        "With other Ψ some slide on C and others around it: the slow flow is the same.",
        "e-linear: all families slide, not all on the same set",
    ),
}
