"""The panel "Lessons": the course, the open lesson with facts of the present scene, and its questions."""

from __future__ import annotations

from typing import Any, NamedTuple

from codim2_core.scene import Scene

from ..lessons.asking import goal_is_reached, judge, pose, stands
from ..lessons.facts import COMPILED, facts_of
from ..lessons.lesson import Lesson, LessonQuestion, Prose, portrait_of
from ..lessons.library import lessons
from ..lessons.marks import Point
from ..lessons.words import fill_facts
from ..picture.frame.frame_context import FrameContext
from ..picture.state.controls import ExplorerState
from .panel import Panel

#: From the middle of the picture, as far as a mark may be.
FAR_MARK = 4.0


class Quiz(NamedTuple):
    """The state of a quiz: the open question, the seed of its system, and the answer (an option or a marked point)."""

    question: int
    seed: int
    answer: int | Point | None


def add(draft: FrameContext) -> None:
    """Add the list of lessons or the open one, and what its facts and questions need, when the browser lacks it."""
    course = lessons()
    lesson = course.get(draft.values["lesson"])
    if lesson is None:
        if draft.fresh("lesson", course):
            draft.header["lesson"] = {"key": "", "list": [_entry(one) for one in course.values()]}
        return
    if draft.fresh("lesson", lesson):
        parts = [
            _part(p)
            for p in lesson.parts
            if isinstance(p, LessonQuestion) or (isinstance(p, Prose) and not lesson.views)
        ]
        draft.header["lesson"] = {
            "key": lesson.key,
            "title": lesson.title,
            "parts": parts,
            "lecture": bool(lesson.views),
        }
    _add_facts(draft, lesson)
    quiz = read_quiz(draft.values["quiz"], lesson)
    if quiz is not None:
        _add_quiz(draft, lesson, quiz)


def read_quiz(text: str, lesson: Lesson) -> Quiz | None:
    """Return the quiz written as QUESTION.SEED, QUESTION.SEED.CHOICE or QUESTION.SEED.X.Y; None if there is none such.

    X and Y are a point of the picture in thousandths, counted from (-`FAR_MARK`, -`FAR_MARK`): a link has no signs.
    """
    parts = text.split(".")
    if not 2 <= len(parts) <= 4 or not all(part.isascii() and part.isdigit() and len(part) < 10 for part in parts):
        return None
    question, seed, *rest = map(int, parts)
    if question >= len(lesson.questions):
        return None
    asked = lesson.questions[question]
    if len(rest) == 2:
        x, y = (v / 1000 - FAR_MARK for v in rest)
        return Quiz(question, seed, (x, y)) if asked.mark and max(abs(x), abs(y)) <= FAR_MARK else None
    if rest and rest[0] >= len(asked.options):
        return None
    return Quiz(question, seed, rest[0] if rest else None)


def opening_values(lesson: Lesson) -> dict[str, Any]:
    """Return the values of controls with which a lesson opens."""
    return {**lesson.values, "panel": "lessons", "lesson": lesson.key, "quiz": ""}


def _entry(lesson: Lesson) -> dict[str, Any]:
    return {
        "key": lesson.key,
        "title": lesson.title,
        "summary": lesson.summary,
        "questions": len(lesson.questions),
        "lecture": bool(lesson.views),
        "values": opening_values(lesson),
    }


def _part(part: Prose | LessonQuestion) -> dict[str, Any]:
    if isinstance(part, Prose):
        return {"html": part.html}
    return {
        "ask": part.html,
        "options": [option.html for option in part.options],
        "mark": bool(part.mark),
        "hint": part.hint,
        "hide": list(part.hide),
        "vary": None if part.vary is None else {"html": part.vary.html, "hint": part.vary.hint},
    }


def _add_facts(draft: FrameContext, lesson: Lesson) -> None:
    facts = facts_of(draft.scene, lesson.live)
    words = {name: fill_facts(f"{{{name}}}", facts) for name in facts}
    if draft.now.get("facts") != words:
        draft.now["facts"] = words
        draft.header["facts"] = words


def _add_quiz(draft: FrameContext, lesson: Lesson, quiz: Quiz) -> None:
    question = lesson.questions[quiz.question]
    key = (lesson.key, *quiz)
    answer = quiz.answer
    if answer is None:
        drawn = draft.slow("pose", key, _question_values, lesson, question, quiz.seed)
        if drawn is not None:
            draft.header["pose"] = {"question": quiz.question, "values": drawn}
        return
    if draft.now.get("judged") != key:  # an answer is judged once; what moves after it is another system
        scene = draft.scene
        there = (*key, *scene.key("plane", "slow", "psi"))
        said = draft.slow("judgement", there, _judge_answer, question, scene, answer)
        if said is not None:
            draft.now["judged"] = key
            chosen = answer if isinstance(answer, int) else -1
            draft.now["answered"] = (lesson.key, quiz.question, said["right"], chosen)
            draft.header["judged"] = {"question": quiz.question, **said}
    if question.vary is not None and (draft.ready or not question.vary.goal.names & COMPILED):
        now = stands(question.vary.goal, draft.scene)
        draft.header["goal"] = {
            "question": quiz.question,
            "reached": goal_is_reached(question, draft.scene),
            "now": now,
        }


def _question_values(lesson: Lesson, question: LessonQuestion, seed: int) -> dict[str, Any]:
    """Return the values about which a question is asked: those of the lesson, and what is drawn over them."""
    start = ExplorerState.from_values(lesson.values).values()
    drawn = pose(question, start, seed)
    return {**lesson.values, **portrait_of(drawn.get("preset")), **drawn}


def _judge_answer(question: LessonQuestion, scene: Scene, answer: int | Point) -> dict[str, Any]:
    """Judge an answer in a scene of its own, without what others compute meanwhile: jobs run in the background."""
    return judge(question, Scene(scene.system, scene.psi, scene.z), answer)


PANEL = Panel("lessons", "Lessons", add, "A course through the paper, with questions that the present system answers.")
