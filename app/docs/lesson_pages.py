"""The lessons as pages, from the same Markdown: what is moved or answered there is a link into the explorer."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from ..frame.scenes import make_scene
from ..lessons.facts import facts_of
from ..lessons.lesson import Lesson
from ..lessons.library import LESSON_FOLDER, built_in
from ..lessons.words import fill_facts
from ..state.controls import first_values

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

```{{toctree}}
:hidden:

{pages}
```
"""


def write_lessons(folder: Path, explorer: str, pictures: bool) -> None:
    """Write a page for each lesson, and their list, into a folder of sources.

    Parameters
    ----------
    folder : Path
    explorer : str
        The address of the explorer, as seen from the site.
    pictures : bool
        Whether the site has the gallery's pictures.
    """
    rows = []
    for number, (key, lesson) in enumerate(built_in().items(), 1):
        text = (LESSON_FOLDER / f"{key}.md").read_text(encoding="utf-8")
        (folder / f"lesson-{key}.md").write_text(_lesson_page(text, key, lesson, explorer, pictures), encoding="utf-8")
        rows.append(f"| {number} | [{lesson.title}](lesson-{key}.md) | {lesson.summary} |")
    pages = "\n".join(f"lesson-{key}" for key in built_in())
    (folder / "lessons.md").write_text(LESSONS.format(rows="\n".join(rows), pages=pages), encoding="utf-8")


def _lesson_page(text: str, key: str, lesson: Lesson, explorer: str, pictures: bool) -> str:
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
    if pictures and portrait:
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
