"""The panel "Lessons": the course, the open lesson with facts of the present scene, and its questions."""

from __future__ import annotations

from typing import Any, NamedTuple

from codim2_core.scene import Scene

from ..frame.draft import Draft
from ..lessons.asking import judge, pose, reached
from ..lessons.facts import COMPILED, facts_of
from ..lessons.lesson import Lesson, Prose, Question, portrait_of
from ..lessons.library import lessons
from ..lessons.words import filled
from ..state.controls import ExplorerState
from .panel import Panel


class Quiz(NamedTuple):
    """Which question is open, the seed of its system, and the chosen option (None before there is one)."""

    question: int
    seed: int
    choice: int | None


def add(draft: Draft) -> None:
    """Add the list of lessons or the open one, and what its facts and questions need, when the browser lacks it."""
    course = lessons()
    lesson = course.get(draft.values["lesson"])
    if lesson is None:
        if draft.fresh("lesson", course):
            draft.header["lesson"] = {"key": "", "list": [_entry(one) for one in course.values()]}
        return
    if draft.fresh("lesson", lesson):
        draft.header["lesson"] = {"key": lesson.key, "title": lesson.title, "parts": [_part(p) for p in lesson.parts]}
    _add_facts(draft, lesson)
    quiz = read_quiz(draft.values["quiz"], lesson)
    if quiz is not None:
        _add_quiz(draft, lesson, quiz)


def read_quiz(text: str, lesson: Lesson) -> Quiz | None:
    """Return the quiz written as QUESTION.SEED or QUESTION.SEED.CHOICE; None if the lesson has no such question."""
    parts = text.split(".")
    if len(parts) not in (2, 3) or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        return None
    question, seed, *rest = map(int, parts)
    choice = rest[0] if rest else None
    if question >= len(lesson.questions):
        return None
    if choice is not None and choice >= len(lesson.questions[question].options):
        return None
    return Quiz(question, seed, choice)


def opening_values(lesson: Lesson) -> dict[str, Any]:
    """Return the values of controls with which a lesson opens."""
    return {**lesson.values, "panel": "lessons", "lesson": lesson.key, "quiz": ""}


def _entry(lesson: Lesson) -> dict[str, Any]:
    return {
        "key": lesson.key,
        "title": lesson.title,
        "summary": lesson.summary,
        "questions": len(lesson.questions),
        "values": opening_values(lesson),
    }


def _part(part: Prose | Question) -> dict[str, Any]:
    if isinstance(part, Prose):
        return {"html": part.html}
    return {
        "ask": part.html,
        "options": [option.html for option in part.options],
        "hint": part.hint,
        "hide": list(part.hide),
        "vary": None if part.vary is None else {"html": part.vary.html, "hint": part.vary.hint},
    }


def _add_facts(draft: Draft, lesson: Lesson) -> None:
    facts = facts_of(draft.scene, lesson.live)
    words = {name: filled(f"{{{name}}}", facts) for name in facts}
    if draft.now.get("facts") != words:
        draft.now["facts"] = words
        draft.header["facts"] = words


def _add_quiz(draft: Draft, lesson: Lesson, quiz: Quiz) -> None:
    question = lesson.questions[quiz.question]
    key = (lesson.key, *quiz)
    if quiz.choice is None:
        drawn = draft.slow("pose", key, _posed, lesson, question, quiz.seed)
        if drawn is not None:
            draft.header["pose"] = {"question": quiz.question, "values": drawn}
        return
    if draft.now.get("judged") != key:  # an answer is judged once; what moves after it is another system
        scene, choice = draft.scene, quiz.choice
        there = (*key, *scene.key("plane", "slow", "psi"))
        said = draft.slow("judgement", there, _judged, question, scene, choice)
        if said is not None:
            draft.now["judged"] = key
            draft.now["answered"] = (lesson.key, quiz.question, said["right"])
            draft.header["judged"] = {"question": quiz.question, **said}
    if question.vary is not None and (draft.ready or not question.vary.goal.names & COMPILED):
        draft.header["goal"] = {"question": quiz.question, "reached": reached(question, draft.scene)}


def _posed(lesson: Lesson, question: Question, seed: int) -> dict[str, Any]:
    """Return the values about which a question is asked: those of the lesson, and what is drawn over them."""
    start = ExplorerState.of(lesson.values).values()
    drawn = pose(question, start, seed)
    return {**lesson.values, **portrait_of(drawn.get("preset")), **drawn}


def _judged(question: Question, scene: Scene, choice: int) -> dict[str, Any]:
    """Judge an answer in a scene of its own, without what others compute meanwhile: jobs run beside the frames."""
    return judge(question, Scene(scene.system, scene.psi, scene.z), choice)


PANEL = Panel("lessons", "Lessons", add, "A course through the paper, with questions that the present system answers.")
