"""Sentences about an orbit, launched or a separatrix: its limit sets, and why it ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "reached t_max": Sentence("Reached t_max; a larger t_max follows it further.", "the status of a trajectory"),
    "reached an equilibrium": Sentence(
        "Reached an equilibrium of the layer problem: a critical set (within the capture distance).",
        "the status of a trajectory",
    ),
    "left the view": Sentence("Left the view; a larger view follows it further.", "the status of a trajectory"),
    "arrives": Sentence("Arrives on the equator at a limit direction.", "the status of a trajectory"),
    "spirals": Sentence("Spirals onto the equator, which is a closed orbit.", "the status of a trajectory"),
    "on the equator, from the start": Sentence("Follows the equator, where it started.", "the status of a trajectory"),
    "too many steps": Sentence(
        "Stopped at the step limit before t_max: the time is too long for the speed of this system, or the "
        "tolerance too tight; lower t_max or raise rtol.",
        "the status of a trajectory",
    ),
    "full length": Sentence(
        "Drawn to the full length; a larger length follows it further.", "the status of a trajectory"
    ),
    "into a saddle": Sentence("Runs into a saddle: a saddle connection.", "within the resolution of the integration"),
    "to a neutral direction": Sentence(
        "Comes to a limit direction that is radially neutral.", "λ with index ρ is 0 there"
    ),
    "to a degenerate equilibrium": Sentence(
        "Comes to a degenerate equilibrium on the equator.", "Θ or U.e vanishes to second order there"
    ),
    "onto a cycle": Sentence("Winds onto a limit cycle.", "the end is a limit cycle"),
    "saddle connection": Sentence(
        "Saddle connection from {leaving} to {entering}, within {gap:.1e}.", "two branches meet within a gap"
    ),
    "branches not followed": Sentence(
        "{Q} is radially neutral (a critical set comes to the equator): its branches are not followed.",
        "λ with index ρ is 0",
    ),
    "branch undecided": Sentence(
        "A branch of {origin} is undecided: {status}", "the computation gave up, or the end is neutral"
    ),
    "no separatrices": Sentence(
        "Every direction is a limit direction: the equator is a line of equilibria, with no separatrices.",
        "Θ vanishes identically",
    ),
    "stays on the equator": Sentence("Stays on the equator, where it starts.", "launched on the equator"),
    "not followed": Sentence("Not followed to an end: {why}", "the computation gave up, or the end is neutral"),
    "comes from a set": Sentence("Comes from {label}, {kind}.", "a launched orbit, backward"),
    "tends to a set": Sentence("Tends to {label}, {kind}: sliding.", "a launched orbit, inside"),
    "unwinds": Sentence("Unwinds from limit {label}.", "a launched orbit, backward"),
    "winds": Sentence("Winds onto limit {label}.", "a launched orbit, inside"),
    "comes up": Sentence("Comes up from {label}, θ = {theta:.4g}.", "a launched orbit, backward"),
    "comes down": Sentence("Comes down to {label} and leaves Σ along θ = {theta:.4g}.", "a launched orbit, inside"),
    "spirals up": Sentence("Spirals up from the closed equator.", "a launched orbit, backward"),
    "spirals down": Sentence("Spirals down to the equator and leaves Σ.", "a launched orbit, inside"),
    "comes from outside": Sentence("Comes from outside the picture.", "a launched orbit, backward"),
    "leaves the picture": Sentence("Leaves the picture.", "a launched orbit, outside"),
    "left": Sentence("Left Σ along {label}, θ = {theta:.4g}.", "a launched orbit, backward, drawn in part"),
    "left, timed": Sentence("Left Σ along {label}, θ = {theta:.4g}, t = {t:.3g} ago.", "a launched orbit, backward"),
    "left, in a spiral": Sentence("Left Σ in a spiral.", "a launched orbit, backward, drawn in part"),
    "left, in a spiral, timed": Sentence("Left Σ in a spiral, t = {t:.3g} ago.", "a launched orbit, backward"),
    "reached": Sentence("Reaches Σ along {label}, θ = {theta:.4g}.", "a launched orbit, outside, drawn in part"),
    "reached, timed": Sentence("Reaches Σ along {label}, θ = {theta:.4g}, after t = {t:.3g}.", "a launched orbit"),
    "reached, in a spiral": Sentence("Reaches Σ in a spiral.", "a launched orbit, outside, drawn in part"),
    "reached, in a spiral, timed": Sentence("Reaches Σ in a spiral, after t = {t:.3g}.", "a launched orbit, outside"),
    "then undecided": Sentence("What follows is not decided.", "its approach is undecided"),
    "then crosses": Sentence("It crosses: leaves along θ = {theta:.4g}.", "its approach crosses"),
    "then crosses, in a spiral": Sentence("It crosses: leaves in a spiral.", "its approach crosses, no direction"),
    "then slides": Sentence("It slides on {onto}.", "its approach slides"),
    "ray arrives": Sentence("The ray of {Q} itself, as f is constant: it arrives.", "a separatrix outside, f constant"),
    "ray leaves": Sentence("The ray of {Q} itself, as f is constant: it leaves.", "a separatrix outside, f constant"),
    "branch arrives": Sentence("Outside, from {Q}: it arrives.", "a separatrix outside"),
    "branch leaves": Sentence("Outside, from {Q}: it leaves.", "a separatrix outside"),
}
