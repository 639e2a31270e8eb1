"""The lessons that are offered: those of the package, and those of a lecturer's own folder."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any
from urllib.parse import unquote

import yaml
from markdown_it.token import Token

from ..picture.draw.layers import LAYERS
from ..picture.state.cleaning import InputError, clean
from ..picture.state.controls import CONTROL_NAMES
from .condition import FactCondition, condition
from .facts import COMPILED, FACT_NAMES
from .lesson import PLACE_CONTROLS, LectureView, Lesson, LessonQuestion, Option, Prose, Vary, portrait_of
from .markdown import LinkError, button, draggable, inline, live, parser, render_html
from .marks import MARKS
from .words import fields

HEAD_FIELDS = frozenset({"title", "summary", "portrait", "set"})
OF_QUESTION = frozenset({"ask", "options", "mark", "explain", "draw", "require", "hide", "hint", "vary"})
OF_VIEW = frozenset({"title", "portrait", "set", "minutes"})
OF_OPTION = frozenset({"say", "when", "wrong"})
OF_VARY = frozenset({"say", "goal", "hint"})


class LessonError(ValueError):
    """A file that is no lesson: which, where, and why."""

    def __init__(self, path: Path, line: int, message: str) -> None:
        super().__init__(f"{path.name}, line {line}: {message}")
        self.path, self.line = path, line


def read_lesson(path: Path) -> Lesson:
    """Return the lesson in a file.

    Parameters
    ----------
    path : Path
        Markdown with front matter (`title`, `summary`, and `portrait` or `set`), and fences ```` ```question ````. With
        fences ```` ```view ```` it is a lecture: what follows each are its presenter's notes, and its polls.

    Raises
    ------
    LessonError
        The file cannot be read, or something in it cannot be used.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise LessonError(path, 1, f"the file cannot be read: {error}.") from error
    tokens = parser().parse(text)
    if not tokens or tokens[0].type != "front_matter":
        raise LessonError(path, 1, "a lesson begins with a line ---, then title: and summary:, then a line ---.")
    head = _mapping(path, 1, tokens[0].content, HEAD_FIELDS, needed=("title", "summary"))
    values = _start(path, head)
    parts: list[Prose | LessonQuestion | LectureView] = []
    shown: Mapping[str, Any] = {}
    gathered: list[Token] = []
    where = 1

    def close() -> None:
        if gathered:
            parts.append(Prose(_html(path, where, gathered)))
            gathered.clear()

    for token in tokens[1:]:
        where = token.map[0] + 1 if token.map else where
        if token.type == "fence" and token.info.strip() == "question":
            close()
            parts.append(_question(path, where, token.content, shown))
        elif token.type == "fence" and token.info.strip() == "view":
            close()
            found = _mapping(path, where, token.content, OF_VIEW, ("title",))
            view = LectureView(str(found["title"]), _start(path, found, where), float(found.get("minutes") or 4))
            shown = {name: value for name, value in view.values.items() if name not in PLACE_CONTROLS}
            parts.append(view)
        else:
            gathered.append(token)
    close()
    return Lesson(path.stem, head["title"], head["summary"], values, tuple(parts))


def _start(path: Path, head: Mapping[str, Any], line: int = 1) -> dict[str, Any]:
    values: dict[str, Any] = {}
    key = head.get("portrait")
    if key is not None:
        values.update(_read_portrait(path, line, str(key)))
    values.update(_values(path, line, head.get("set") or {}))
    return values


def _read_portrait(path: Path, line: int, key: str) -> dict[str, Any]:
    found = portrait_of(key)
    if not found:
        raise LessonError(path, line, f"there is no portrait {key!r}; `codim2 presets` lists them.")
    return {**found, "preset": key}


def _values(path: Path, line: int, wanted: Any) -> dict[str, Any]:
    """Check values of controls."""
    if not isinstance(wanted, Mapping):
        raise LessonError(path, line, f"values are {wanted!r}; give names and values of controls.")
    found = {}
    for name, value in wanted.items():
        if name not in CONTROL_NAMES:
            raise LessonError(path, line, f"there is no control {name!r}; there are {', '.join(CONTROL_NAMES)}.")
        try:
            found[name] = clean(name, value)
        except InputError as error:
            raise LessonError(path, line, str(error)) from error
    return found


def _draw(path: Path, line: int, wanted: Any) -> dict[str, Any]:
    """Check what a question draws: values, or (low, high) for numbers."""
    if not isinstance(wanted, Mapping):
        raise LessonError(path, line, f"draw is {wanted!r}; give names of controls, each with a value or [low, high].")
    ranges = {name: span for name, span in wanted.items() if isinstance(span, list) and name != "layers"}
    found = _values(path, line, {name: value for name, value in wanted.items() if name not in ranges})
    for name, span in ranges.items():
        if len(span) != 2 or not all(isinstance(end, (int, float)) for end in span) or not span[0] < span[1]:
            raise LessonError(path, line, f"{name} is drawn from {span!r}; give [low, high] with low < high.")
        ends = _values(path, line, {name: span[0]}), _values(path, line, {name: span[1]})
        found[name] = (ends[0][name], ends[1][name])
    return found


def _mapping(path: Path, line: int, text: str, known: frozenset[str], needed: tuple[str, ...] = ()) -> dict[str, Any]:
    try:
        found = yaml.safe_load(text)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        at = line + 1 + (mark.line if mark else 0)
        raise LessonError(path, at, f"this is no YAML: {getattr(error, 'problem', None) or error}.") from error
    return _keys(path, line, found, known, needed)


def _keys(path: Path, line: int, found: Any, known: frozenset[str], needed: tuple[str, ...]) -> dict[str, Any]:
    if not isinstance(found, dict):
        raise LessonError(path, line, f"give {', '.join(sorted(known))}, each on a line with its value.")
    for name in found:
        if name not in known:
            raise LessonError(path, line, f"{name!r} means nothing here; known are {', '.join(sorted(known))}.")
    for name in needed:
        if not found.get(name):
            raise LessonError(path, line, f"{name!r} is missing.")
    return found


def _question(path: Path, line: int, text: str, shown: Mapping[str, Any]) -> LessonQuestion:
    found = _mapping(path, line, text, OF_QUESTION, ("ask", "explain"))
    mark, options = found.get("mark") or "", found.get("options") or []
    if mark and mark not in MARKS:
        raise LessonError(path, line, f"mark: no {mark!r}; on the picture can be marked {', '.join(MARKS)}.")
    if not isinstance(options, list) or (len(options) > 1 if mark else len(options) < 2):
        few = "at most one, that there is none," if mark else "two or more, or mark:,"
        raise LessonError(path, line, f"options: give {few} each with say: and when:.")
    made = [_option(path, line, option) for option in options]
    hide = tuple(found.get("hide") or ())
    if unknown := [layer for layer in hide if layer not in LAYERS]:
        raise LessonError(path, line, f"hide: no layer {unknown[0]!r}; they are {', '.join(LAYERS)}.")
    explain = _explanation_html(path, line, "explain", found["explain"])
    require = found.get("require")
    return LessonQuestion(
        html=_read_line(path, line, found["ask"]),
        options=tuple(made),
        explain=explain,
        draw={**shown, **_draw(path, line, found.get("draw") or {})},
        require=None if require is None else _condition(path, line, require),
        hide=hide,
        hint=_read_line(path, line, found.get("hint") or ""),
        vary=_vary(path, line, found["vary"]) if found.get("vary") else None,
        mark=mark,
    )


def _option(path: Path, line: int, given: Any) -> Option:
    words = _keys(path, line, given, OF_OPTION, ("say", "when"))
    wrong = _explanation_html(path, line, "wrong", words.get("wrong") or "")
    return Option(_read_line(path, line, words["say"]), _condition(path, line, words["when"]), wrong)


def _explanation_html(path: Path, line: int, key: str, text: Any) -> str:
    """Return the HTML of words with facts in them."""
    html = _read_line(path, line, text)
    if unknown := [name for name in fields(html) if name not in FACT_NAMES]:
        raise LessonError(path, line, f"{key}: no fact {unknown[0]!r}; facts are {', '.join(sorted(FACT_NAMES))}.")
    return html


def _vary(path: Path, line: int, found: Any) -> Vary:
    words = _keys(path, line, found, OF_VARY, ("say", "goal"))
    hint = _read_line(path, line, words.get("hint") or "")
    return Vary(_read_line(path, line, words["say"]), _condition(path, line, words["goal"]), hint)


def _condition(path: Path, line: int, text: Any) -> FactCondition:
    try:
        return condition(str(text), FACT_NAMES)
    except ValueError as error:
        raise LessonError(path, line, str(error)) from error


def _html(path: Path, line: int, tokens: list[Token]) -> str:
    try:
        return render_html(tokens, _resolver(path, line))
    except LinkError as error:
        raise LessonError(path, line, str(error)) from error


def _read_line(path: Path, line: int, text: Any) -> str:
    try:
        return inline(str(text).strip(), _resolver(path, line))
    except LinkError as error:
        raise LessonError(path, line, str(error)) from error


def _resolver(path: Path, line: int):
    def resolve(scheme: str, target: str, words: str) -> str:
        target = unquote(target)
        match scheme:
            case "portrait":
                return button(_read_portrait(path, line, target), words)
            case "set":
                pairs = dict(pair.split("=", 1) for pair in target.split(",") if "=" in pair)
                if "layers" in pairs:  # commas stand between controls: layers are joined by +
                    pairs["layers"] = pairs["layers"].replace("+", ",")
                return button(_values(path, line, pairs), words)
            case "drag" if target in CONTROL_NAMES:
                return draggable(target, words or target)
            case "fact" if target in FACT_NAMES - COMPILED:  # shown in every frame of a drag
                return live(target)
            case "lesson":
                return button({"lesson": target, "quiz": ""}, words)
        raise LinkError(
            f"a link to {scheme}:{target} leads nowhere; give portrait:KEY, set:NAME=VALUE, drag:NAME, "
            "fact:NAME or lesson:KEY."
        )

    return resolve


#: A lesson is one file here; its name's number gives the order.
LESSON_FOLDER = Path(__file__).parent / "text"
LECTURE_FOLDER = Path(__file__).parent / "lectures"

_own: dict[str, Lesson] = {}


@lru_cache(maxsize=1)
def lessons() -> Mapping[str, Lesson]:
    """Return all that is offered by key: the course, lectures, then one's own. One object until more are offered."""
    return MappingProxyType({**built_in(), **lectures(), **_own})


def add_lessons(found: Mapping[str, Lesson]) -> None:
    """Offer more lessons, as `codim2 serve --lessons DIR` does; one of the same key replaces another."""
    _own.update(found)
    lessons.cache_clear()


@lru_cache(maxsize=1)
def built_in() -> Mapping[str, Lesson]:
    """Return the package's own lessons by key, in order; a broken one raises LessonError."""
    return MappingProxyType({path.stem: read_lesson(path) for path in sorted(LESSON_FOLDER.glob("*.md"))})


@lru_cache(maxsize=1)
def lectures() -> Mapping[str, Lesson]:
    """Return the package's own lectures by key."""
    return MappingProxyType({path.stem: read_lesson(path) for path in sorted(LECTURE_FOLDER.glob("*.md"))})


def from_folder(folder: Path) -> tuple[dict[str, Lesson], list[LessonError]]:
    """Return the lessons of a folder by key, in order, and what is wrong with the others.

    Parameters
    ----------
    folder : Path

    Raises
    ------
    ValueError
        It is no folder.
    """
    if not folder.is_dir():
        raise ValueError(f"{folder} is no folder; give one that holds lessons as Markdown files.")
    found: dict[str, Lesson] = {}
    errors: list[LessonError] = []
    for path in sorted(folder.glob("*.md")):
        try:
            found[path.stem] = read_lesson(path)
        except LessonError as error:
            errors.append(error)
    return found, errors
