"""A lecture's pages: the presenter's window, a worksheet with codes for phones, and its answer key."""

from __future__ import annotations

import base64
import json
import re
from functools import lru_cache
from typing import Any

import segno

from ..exports.figure import Style, figure
from ..exports.view import View
from ..lessons.asking import pose, right_option
from ..lessons.facts import facts_of
from ..lessons.lesson import Lesson, portrait_of
from ..lessons.library import lessons
from ..lessons.words import fill_facts
from ..picture.frame.scenes import make_scene
from ..picture.state.controls import ExplorerState, first_values
from ..picture.state.links import PageView, compress_query, write_link
from .markup import digest, template

SEED = 1  # with which the presenter's window asks
PICTURE = 60.0  # mm
SHEETS = ("", "questions", "key")  # the presenter's window, and what is printed


def lecture_html(lesson: Lesson, sheet: str, explorer: str) -> str:
    """Return the presenter's window of a lecture, or what is printed for the class: "questions", or their "key"."""
    return template("lecture.html").render(
        lesson=lesson, sheet=sheet, digest=digest(), data=_presenter_json(lesson),
        questions=[_with_code(one, explorer) for one in _sheet_questions(lesson.key)] if sheet else [],
    )  # fmt: skip


def _with_code(question: dict[str, Any], explorer: str) -> dict[str, Any]:
    """Return a question with the code that opens it: the address of the explorer is the visitor's own."""
    code = segno.make_qr(f"{explorer}?{question['link']}", error="l")
    return {**question, "code": code.svg_inline(scale=2, svgclass="qr", lineclass=None)}


def _presenter_json(lesson: Lesson) -> str:
    first = first_values()
    views = [
        {"name": view.title, "seen": None, "set": {name: v for name, v in view.values.items() if v != first[name]}}
        for view, _, _ in lesson.views
    ]
    polls = [{"ask": _plain(q.html), "options": [_plain(one.html) for one in q.options]} for q in lesson.questions]
    of = {"key": lesson.key, "title": lesson.title, "views": views}
    return json.dumps({"of": of, "polls": polls}).replace("<", "\\u003c")


def _plain(html: str) -> str:
    return re.sub(r"<[^>]*>", "", html)


@lru_cache(maxsize=4)
def _sheet_questions(key: str) -> list[dict[str, Any]]:
    """Return each question with its picture, its link, the option that holds and the explanation: seconds of work."""
    lesson = lessons()[key]
    start = {**ExplorerState.from_values(lesson.values).values(), "panel": "lessons", "lesson": key}
    found = []
    for number, question in enumerate(lesson.questions):
        drawn = pose(question, start, SEED)
        values = {**start, **portrait_of(drawn.get("preset")), **drawn, "quiz": f"{number}.{SEED}"}
        scene = make_scene(values)
        facts = facts_of(scene, question.facts)
        shown = {**values, "layers": [name for name in values["layers"] if name not in question.hide]}
        drawing = figure(View(shown), Style(size=PICTURE, legend=False))
        found.append(
            {
                "ask": question.html,
                "options": [option.html for option in question.options],
                "truth": right_option(question, facts),
                "explain": fill_facts(question.explain, facts),
                "picture": f"data:image/svg+xml;base64,{base64.b64encode(drawing.encode()).decode()}",
                "link": compress_query(write_link(values, PageView())),
            }
        )
    return found
