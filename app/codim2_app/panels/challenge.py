"""A challenge: a goal that came with a link, and whether the present system meets it."""

from __future__ import annotations

from ..lessons.asking import holds, stands
from ..lessons.condition import condition
from ..lessons.facts import COMPILED, FACT_NAMES
from ..picture.frame.frame_context import FrameContext

#: What "Share" offers, in words; a link may have any condition that a lesson may have.
GOALS = {
    **{f"the portrait is {name}": f"name == '{name}'" for name in ("CM0", "CM2", "CM4", "NCM2", "NCM4")},
    **{f"C is {kind}": f"kind == '{kind.partition(' ')[2]}'"
       for kind in ("a stable node", "a stable focus", "a saddle", "an unstable node", "an unstable focus")},
    "a motion returns, again and again": "cycles >= 1",
    "sliding is stable in two ways": "stable >= 2",
}  # fmt: skip
_WORDS = {text: words for words, text in GOALS.items()}


def add(draft: FrameContext) -> None:
    """Add the goal in words, whether it is met, and where the present system stands with it."""
    text = draft.values["goal"]
    try:
        goal = condition(text, FACT_NAMES)
    except ValueError as error:
        draft.header["challenge"] = {"goal": text, "error": str(error)}
        return
    if draft.ready or not goal.names & COMPILED:
        challenge = {"goal": text, "words": _WORDS.get(text, text), "met": holds(goal, draft.scene)}
        draft.header["challenge"] = {**challenge, "now": stands(goal, draft.scene)}
