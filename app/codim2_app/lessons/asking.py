"""Posing a question and judging an answer: the scene decides, nothing is stored."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from codim2_core.scene import Scene

from ..picture.frame.scenes import make_scene
from ..picture.phrases import say
from .condition import FactCondition
from .facts import FACTS, Fact, facts_of
from .lesson import LessonQuestion, portrait_of
from .marks import MARK_TOLERANCE, Point, gap
from .words import fill_facts

MOST_DRAWN = 60  # tries to fulfil what a question requires
DRAWN_DIGITS = 2  # of drawn numbers: what a slider shows


def pose(question: LessonQuestion, values: Mapping[str, Any], seed: int) -> dict[str, Any]:
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
    wanted = chance.randrange(len(question.options) + bool(question.mark))  # the last: there is a place to mark
    admitted: dict[str, Any] | None = None
    for _ in range(MOST_DRAWN):
        drawn = {name: _draw_value(chance, value) for name, value in question.draw.items()}
        scene = make_scene({**values, **portrait_of(drawn.get("preset")), **drawn})
        if holds(question.require, scene, default=True) and not goal_is_reached(question, scene):
            admitted = drawn
            if not _varies(question) or wanted == _answer(question, scene):
                return drawn
    if admitted is None:
        needed = "what it asks for" if question.require is None else repr(question.require.text)
        raise ValueError(f"no system out of {MOST_DRAWN} that this question draws fulfils {needed}.")
    return admitted


def holds(condition: FactCondition | None, scene: Scene, default: bool = False) -> bool:
    """Say whether a condition holds in a scene."""
    return default if condition is None else condition(facts_of(scene, condition.names))


def _answer(question: LessonQuestion, scene: Scene) -> int | None:
    """Return the index of the option that holds, one more where a place is to be marked instead."""
    holding = [i for i, option in enumerate(question.options) if holds(option.when, scene)]
    return holding[0] if holding else len(question.options) if question.mark else None


def _varies(question: LessonQuestion) -> bool:
    return any(isinstance(value, tuple) for value in question.draw.values())


def _draw_value(chance: random.Random, value: Any) -> Any:
    return round(chance.uniform(*value), DRAWN_DIGITS) if isinstance(value, tuple) else value


def judge(question: LessonQuestion, scene: Scene, answer: int | Point) -> dict[str, Any]:
    """Return what the present scene says of an answer.

    Parameters
    ----------
    question : Question
    scene : Scene
    answer : int or tuple of float
        Index of the chosen option, or the point of the picture that was marked.

    Returns
    -------
    dict
        "right" : bool; "truth" : index of the option that holds, or None; "why" : HTML, the reason of a wrong answer;
        "explain" : HTML.
    """
    facts = facts_of(scene, question.facts)
    truth = right_option(question, facts)
    if isinstance(answer, int):
        right = answer == truth
        why = "" if right else fill_facts(question.options[answer].wrong, facts)
    else:
        away = gap(question.mark, scene, answer)
        right = away is not None and away <= MARK_TOLERANCE
        why = say("no such place") if away is None else "" if right else say("mark away", away=f"{away:.2f}")
    return {"right": right, "truth": truth, "why": why, "explain": fill_facts(question.explain, facts)}


def right_option(question: LessonQuestion, facts: Mapping[str, Fact]) -> int | None:
    """Return the index of the option that holds; None where none does, or several do."""
    holding = [i for i, option in enumerate(question.options) if option.when(facts)]
    return holding[0] if len(holding) == 1 else None


def goal_is_reached(question: LessonQuestion, scene: Scene) -> bool:
    """Say whether the present scene reaches the goal of `vary`."""
    return question.vary is not None and holds(question.vary.goal, scene)


def stands(goal: FactCondition, scene: Scene) -> str:
    """Return where the present scene stands with what a goal reads."""
    names = sorted(goal.names)
    facts = facts_of(scene, names)
    return ", ".join(f"{FACTS[name][0]}: {fill_facts(f'{{{name}}}', facts)}" for name in names)
