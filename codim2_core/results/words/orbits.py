"""Sentences about an orbit, launched or a separatrix: its limit sets, and why it ends."""

from __future__ import annotations

from .sentence import Sentence

SENTENCES: dict[str, Sentence] = {
    "reached t_max": Sentence("It reached t_max. Increase t_max to follow it further.", "the status of a trajectory"),
    "reached an equilibrium": Sentence(
        "It reached an equilibrium of the layer problem, a critical set, within the capture distance.",
        "the status of a trajectory",
    ),
    "left the view": Sentence(
        "It left the view. Increase the view to follow it further.", "the status of a trajectory"
    ),
    "arrives": Sentence("Arrives on the equator at a limit direction.", "the status of a trajectory"),
    "spirals": Sentence("Spirals onto the equator, which is a closed orbit.", "the status of a trajectory"),
    "on the equator, from the start": Sentence(
        "It started on the equator and follows it.", "the status of a trajectory"
    ),
    "too many steps": Sentence(
        "It stopped at the step limit before t_max. Lower t_max or raise rtol.",
        "the status of a trajectory",
    ),
    "full length": Sentence(
        "It is drawn to its full length. Increase the length to follow it further.", "the status of a trajectory"
    ),
    "into a saddle": Sentence(
        "It runs into a saddle: a saddle connection.", "within the resolution of the integration"
    ),
    "to a neutral direction": Sentence(
        "It reaches a limit direction that is radially neutral.", "λ with index ρ is 0 there"
    ),
    "to a degenerate equilibrium": Sentence(
        "It reaches a degenerate equilibrium on the equator.", "Θ or U.e vanishes to second order there"
    ),
    "onto a cycle": Sentence("It winds onto a limit cycle.", "the end is a limit cycle"),
    "saddle connection": Sentence(
        "A saddle connection leads from {leaving} to {entering}, within {gap:.1e}.", "two branches meet within a gap"
    ),
    "branches not followed": Sentence(
        "{Q} is radially neutral, since a critical set reaches the equator: its branches are not followed.",
        "λ with index ρ is 0",
    ),
    "branch undecided": Sentence(
        "A branch of {origin} is undecided: {status}", "the computation gave up, or the end is neutral"
    ),
    "no separatrices": Sentence(
        ("Every direction is a limit direction, so the equator is a line of equilibria and there are no separatrices."),
        "Θ vanishes identically",
    ),
    "stays on the equator": Sentence("Stays on the equator, where it starts.", "launched on the equator"),
    "not followed": Sentence("It was not followed to its end: {why}", "the computation gave up, or the end is neutral"),
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
    "then undecided": Sentence("It is undecided what follows.", "its approach is undecided"),
    "then crosses": Sentence("It crosses Σ and leaves along θ = {theta:.4g}.", "its approach crosses"),
    "then crosses, in a spiral": Sentence("It crosses Σ and leaves in a spiral.", "its approach crosses, no direction"),
    "then slides": Sentence("It slides on {onto}.", "its approach slides"),
    "ray arrives": Sentence(
        "It is the ray of {Q}, as f is constant, and it reaches Σ.", "a separatrix outside, f constant"
    ),
    "ray leaves": Sentence(
        "It is the ray of {Q}, as f is constant, and it leaves Σ.", "a separatrix outside, f constant"
    ),
    "branch arrives": Sentence("It reaches Σ from outside along {Q}.", "a separatrix outside"),
    "branch leaves": Sentence("It leaves Σ along {Q}.", "a separatrix outside"),
}
