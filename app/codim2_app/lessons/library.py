"""The lessons that are offered: those of the package, and those of a lecturer's own folder."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from .lesson import Lesson
from .reading import LessonError, read_lesson

#: A lesson is one file here; its name's number gives the order.
LESSON_FOLDER = Path(__file__).parent / "text"
LECTURE_FOLDER = Path(__file__).parent / "lectures"

_own: dict[str, Lesson] = {}


@lru_cache(maxsize=1)
def lessons() -> Mapping[str, Lesson]:
    """Return all that is offered by key: the course, lectures, then one's own. One object until more are offered."""
    return MappingProxyType({**built_in(), **lectures(), **_own})


def add_lessons(found: Mapping[str, Lesson]) -> None:
    """Offer lessons besides the course, as `codim2 serve --lessons DIR` does; one of the same key replaces another."""
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
