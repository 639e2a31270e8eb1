"""The lessons as pages, from the same Markdown: what is moved or answered there is a link into the explorer."""

from __future__ import annotations

import re
from typing import Any

import yaml

from ...lessons.facts import facts_of
from ...lessons.lesson import Lesson
from ...lessons.library import LESSON_FOLDER, built_in
from ...lessons.words import fill_facts
from ...picture.frame.scenes import make_scene
from ...picture.state.controls import first_values

_NESTED = "[^()]*"
for _ in range(5):  # formulas in links have parentheses within parentheses
    _NESTED = rf"(?:[^()]|\({_NESTED}\))*"
_LINK = re.compile(rf"\[([^\]]*)\]\((portrait|set|drag|fact|lesson):({_NESTED})\)")
_HEAD = re.compile(r"\A---\n.*?\n---\n", re.DOTALL)
_QUESTION = re.compile(r"^```question\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LESSONS = """# Lessons

A course through the paper in its order and beyond it. Read it here, or take it in the explorer: there its numbers can
be dragged, and its questions are judged by the system on your own sliders.

| | lesson | what it is about |
|---|---|---|
{rows}

"""


def lessons_page() -> str:
    """Return the list of lessons as Markdown."""
    rows = (
        f"| {number} | [{lesson.title}](lesson-{key}.md) | {lesson.summary} |"
        for number, (key, lesson) in enumerate(built_in().items(), 1)
    )
    return LESSONS.format(rows="\n".join(rows))


def lesson_page(key: str, explorer: str) -> str:
    """Return a lesson as Markdown; `explorer`: its address from the site."""
    text = (LESSON_FOLDER / f"{key}.md").read_text(encoding="utf-8")
    return _lesson_page(text, key, built_in()[key], explorer)


def _lesson_page(text: str, key: str, lesson: Lesson, explorer: str) -> str:
    opened = f"{explorer}?panel=lessons&amp;lesson={key}"
    scene = make_scene({**first_values(), **lesson.values})

    def link(match: re.Match[str]) -> str:
        words, scheme, target = match.groups()
        match scheme:
            case "portrait":
                return _anchor(f"{explorer}?preset={target}", words)
            case "lesson":
                return f"[{words}](lesson-{target}.md)"
            case "drag":
                return _anchor(opened, words)
            case "fact":
                return fill_facts(f"**{{{target}}}**", facts_of(scene, [target]))
        return _anchor(opened, words)

    def question(match: re.Match[str]) -> str:
        return "\n".join(_question(yaml.safe_load(match[1]), opened))

    body = _LINK.sub(link, _QUESTION.sub(question, _HEAD.sub("", text)))
    portrait = str(lesson.values.get("preset", ""))
    shown = ""
    if portrait:
        images = "".join(
            f'<img class="only-{theme}" src="_static/portraits/{portrait}-{theme}.svg" alt="{lesson.title}">'
            for theme in ("light", "dark")
        )
        shown = f'\n```{{raw}} html\n<figure class="portrait">{images}</figure>\n```\n'
    return f"# {lesson.title}\n\n{_anchor(opened, 'Take this lesson in the explorer')}\n{shown}\n{body}"


def _anchor(address: str, words: str) -> str:
    return f'<a class="live" href="{address}">{words}</a>'


def _question(found: dict[str, Any], opened: str) -> list[str]:
    options = [f"- {one['say']}" for one in found.get("options", ())]
    further = [f"\nThen: {found['vary']['say']}"] if "vary" in found else []
    answer = _anchor(opened, "Answer it in the explorer")
    return ["::::{admonition} Question", f"{found['ask']}\n", *options, *further, f"\n{answer}", "::::"]
