"""Approach outcomes: the ring outside the equator, and the table of limit directions in the panel "Numbers"."""

from __future__ import annotations

from typing import Any

from codim2_core.portrait.approach_outcomes import Outcome, Outcomes
from codim2_core.results.words import written_label
from codim2_core.scene import Scene

from ..frame.budget import wild
from ..frame.frame_context import FrameContext

#: The kinds that the ring tells apart, and what the table says of each.
WORDS = {
    "slide": "slide",
    "cross": "cross",
    "depends": "depends on Ψ",
    "undecided": "undecided",
    "misses": "never reach Σ",
}
#: The three ways to be undecided, each by its name in `Outcome.why`.
UNDECIDED_TEXTS = {
    "several": "more than one ending",
    "neutral": "neutral to first order",
    "unfollowed": "not followed to an end",
}


def add(draft: FrameContext) -> None:
    """Add rows and arcs: with every frame where a theorem answers for every Ψ, else (Case III) at rest."""
    scene = draft.scene
    if not draft.ready:
        return
    if answered_by_theorem(scene):
        found = scene["outcomes"]
        if not draft.fresh("outcomes", found):
            return
    else:
        found = draft.slow("outcomes", scene.key("plane", "slow", "psi"), _scene_outcomes, scene)
        if found is None:
            return
    draft.header["outcomes"] = outcome_columns(found)


def _scene_outcomes(scene: Scene) -> Outcomes:
    if why := wild(scene):
        raise ValueError(f"{why}.")
    return scene["outcomes"]


def answered_by_theorem(scene: Scene) -> bool:
    """Say whether this is Case I or II, in which no other regularisation need be asked."""
    return scene["name"].case in ("I", "II")


def kind(outcome: Outcome) -> str:
    """Return the kind of an outcome: a key of `WORDS`."""
    if outcome.depends_on_psi and outcome.verdict != "misses" and not outcome.slides_alike:
        return "depends"
    return "slide" if outcome.verdict == "cycle" else outcome.verdict


def outcome_columns(outcomes: Outcomes) -> dict[str, Any]:
    """Return the rows of the table and the arcs of the ring.

    Returns
    -------
    dict
        "rows": for each limit direction, or once for all angles, label, kind, words, sentence, and what other
        regularisations give: (words, their Ψ). "start", "end", "kind": the arcs, angles in radians, end > start.
    """
    shown = outcomes.directions if outcomes.whole is None else (outcomes.whole,)
    arcs = outcomes.arcs
    return {
        "rows": [_outcome_row(outcome) for outcome in shown],
        "start": [start for start, _, _ in arcs],
        "end": [end for _, end, _ in arcs],
        "kind": [kind(outcome) for _, _, outcome in arcs],
    }


def _outcome_row(outcome: Outcome) -> list[Any]:
    label = written_label(outcome.label)
    by_verdict: dict[str, list[str]] = {}
    for text, verdict, onto in outcome.families if outcome.depends_on_psi else ():
        by_verdict.setdefault(_verdict(verdict, onto), []).append(text)
    words = UNDECIDED_TEXTS.get(outcome.why) if kind(outcome) == "undecided" else None
    return [
        label,
        kind(outcome),
        words or WORDS[kind(outcome)],
        outcome.reason,
        [list(item) for item in by_verdict.items()],
    ]


def _verdict(verdict: str, onto: str | None) -> str:
    words = {"slide": "slides on", "cycle": "slides around", "cross": "crosses to"}.get(verdict)
    return verdict if words is None or onto is None else f"{words} {written_label(onto)}"
