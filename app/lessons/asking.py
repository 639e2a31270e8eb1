"""Posing a question and judging an answer: the scene decides, nothing is stored."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from codim2_core.scene import Scene

from ..frame.scenes import make_scene
from .condition import FactCondition
from .facts import Fact, facts_of
from .lesson import Question, portrait_of
from .words import filled

MOST_DRAWN = 60  # tries to fulfil what a question requires
DIGITS = 2  # of drawn numbers: what a slider shows


def pose(question: Question, values: Mapping[str, Any], seed: int) -> dict[str, Any]:
    """Return the values of controls about which a question is asked: each option is the right one equally often.

    (As far as systems for it are found; an option may be there that never holds.)

    Parameters
    ----------
    question : Question
    values : mapping
        Of the controls, as the lesson opens.
    seed : int
        The same seed draws the same system.

    Raises
    ------
    ValueError
        Nothing that was drawn fulfils what the question requires.
    """
    chance = random.Random(seed)
    wanted = chance.randrange(len(question.options))
    admitted: dict[str, Any] | None = None
    for _ in range(MOST_DRAWN):
        drawn = {name: _drawn(chance, value) for name, value in question.draw.items()}
        scene = make_scene({**values, **portrait_of(drawn.get("preset")), **drawn})
        if _holds(question.require, scene, default=True) and not reached(question, scene):
            admitted = drawn
            if not _varies(question) or _holds(question.options[wanted].when, scene):
                return drawn
    if admitted is None:
        needed = "what it asks for" if question.require is None else repr(question.require.text)
        raise ValueError(f"no system out of {MOST_DRAWN} that this question draws fulfils {needed}.")
    return admitted


def _holds(condition: FactCondition | None, scene: Scene, default: bool = False) -> bool:
    return default if condition is None else condition(facts_of(scene, condition.names))


def _varies(question: Question) -> bool:
    return any(isinstance(value, tuple) for value in question.draw.values())


def _drawn(chance: random.Random, value: Any) -> Any:
    return round(chance.uniform(*value), DIGITS) if isinstance(value, tuple) else value


def judge(question: Question, scene: Scene, choice: int) -> dict[str, Any]:
    """Return what the present scene says of an answer.

    Parameters
    ----------
    question : Question
    scene : Scene
    choice : int
        Index of the chosen option.

    Returns
    -------
    dict
        "right" : bool; "truth" : index of the option that holds, or None; "explain" : HTML.
    """
    facts = facts_of(scene, question.facts)
    truth = right_option(question, facts)
    return {"right": choice == truth, "truth": truth, "explain": filled(question.explain, facts)}


def right_option(question: Question, facts: Mapping[str, Fact]) -> int | None:
    """Return the index of the option that holds; None where none does, or several do."""
    holding = [i for i, option in enumerate(question.options) if option.when(facts)]
    return holding[0] if len(holding) == 1 else None


def reached(question: Question, scene: Scene) -> bool:
    """Say whether the present scene reaches the goal of `vary`."""
    return question.vary is not None and _holds(question.vary.goal, scene)
