"""A lesson: prose, and questions whose answers are conditions on the scene that the student sees."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ..picture.state.controls import preset_values
from .condition import FactCondition
from .words import fields

SHOWN = re.compile(r'data-fact="(\w+)"')


@dataclass(frozen=True)
class LectureView:
    """A view of a lecture: its title, values of controls, and for how many minutes it is shown."""

    title: str
    values: Mapping[str, Any]
    minutes: float


@dataclass(frozen=True)
class Prose:
    """A stretch of text."""

    # safe HTML. ``<button data-set='{...}'>`` sets values of controls, ``<span data-drag="f1">`` is a number that
    # can be dragged, ``<output data-fact="stable">`` shows a fact of the present scene
    html: str


@dataclass(frozen=True)
class Option:
    """One possible answer: its words, when it is the right one, and why it is wrong where it is ("" says nothing)."""

    html: str
    when: FactCondition
    wrong: str = ""


@dataclass(frozen=True)
class Vary:
    """A goal to reach with the controls: what to do, when it is reached, and a hint."""

    html: str
    goal: FactCondition
    hint: str = ""


@dataclass(frozen=True)
class LessonQuestion:
    """Predict, reveal, explain, vary."""

    html: str  # what is asked about the system on the sliders
    # exactly one is right at every setting that `require` admits; which one, the scene decides. Where a place is to
    # be marked there may be one, that there is none
    options: tuple[Option, ...]
    explain: str  # HTML, shown once an answer is given; ``{limit_directions}`` stands for a fact
    # values of controls that the question starts from; a pair of numbers is a range to draw from
    draw: Mapping[str, Any] = field(default_factory=dict)
    require: FactCondition | None = None  # what the drawn system must fulfil; it is drawn again until it does
    hide: tuple[str, ...] = ()  # layers hidden until the answer is given
    hint: str = ""
    vary: Vary | None = None
    mark: str = ""  # what is to be marked on the picture, a key of `marks.MARKS`; "" where an option is to be chosen

    @property
    def facts(self) -> frozenset[str]:
        """Names of the facts that answering and explaining it needs."""
        needed = set(fields(self.explain))
        for option in self.options:
            needed |= option.when.names | set(fields(option.wrong))
        if self.vary is not None:
            needed |= self.vary.goal.names
        return frozenset(needed)


#: Values that say where in the course somebody is: no portrait that a lesson shows may move them.
PLACE_CONTROLS = frozenset({"panel", "lesson", "quiz"})


def portrait_of(key: str | None) -> dict[str, Any]:
    """Return the values of a portrait as a lesson shows it; none if there is no such portrait."""
    return {name: value for name, value in preset_values(key).items() if name not in PLACE_CONTROLS}


@dataclass(frozen=True)
class Lesson:
    """One station of the course."""

    key: str  # the name of its file without ending; the key in links
    title: str
    summary: str  # one line for the list of lessons
    values: Mapping[str, Any]  # of the controls, when the lesson opens: those of its portrait, and its own
    # in the order of the file; of a lecture, prose is what its lecturer reads
    parts: tuple[Prose | LessonQuestion | LectureView, ...]

    @property
    def live(self) -> frozenset[str]:
        """Names of the facts of the present scene that its text shows."""
        return frozenset(name for part in self.parts if isinstance(part, Prose) for name in SHOWN.findall(part.html))

    @property
    def views(self) -> list[tuple[LectureView, str, list[int]]]:
        """Return the views of a lecture, each with its notes as HTML and the numbers of its questions."""
        found: list[tuple[LectureView, str, list[int]]] = []
        question = -1
        for part in self.parts:
            question += isinstance(part, LessonQuestion)
            if isinstance(part, LectureView):
                found.append((part, "", []))
            elif found and isinstance(part, Prose):
                view, notes, asked = found[-1]
                found[-1] = view, notes + part.html, asked
            elif found:
                found[-1][2].append(question)
        return found

    @property
    def questions(self) -> tuple[LessonQuestion, ...]:
        """The questions, in order."""
        return tuple(part for part in self.parts if isinstance(part, LessonQuestion))
