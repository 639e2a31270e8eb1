"""Every sentence once, with when it is said: `say` makes it, `recognise` finds it again in a text."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from string import Formatter

from ..special_kinds import SPECIAL_KINDS
from .number_text import power, written_label, written_number
from .sentence import Sentence, read_tables

#: The sentences of each room, by the room's name.
ROOMS: dict[str, dict[str, Sentence]] = read_tables(Path(__file__).with_name("words.toml"))
ROOMS["changes"] = {one.kind: Sentence(one.says, one.when) for one in SPECIAL_KINDS} | ROOMS["changes"]

SENTENCES: dict[str, Sentence] = {key: one for room in ROOMS.values() for key, one in room.items()}


@cache
def _parse_fields(key: str) -> tuple[tuple[str, str | None, str | None], ...]:
    """Text, and the name and format of the field that follows it, as often as there are fields, and the rest."""
    return tuple((text, name, format_) for text, name, format_, _ in Formatter().parse(SENTENCES[key].says))


def _write_field(value: object, format_: str) -> str:
    """Numbers and names are written in one way."""
    if isinstance(value, float):
        return power(value) if format_.endswith("e") else written_number(value, int(format_.strip(".g") or 6))
    return written_label(str(value))


def say(key: str, **fields: object) -> str:
    """Return a sentence with its fields filled in."""
    return "".join(
        [
            text if name is None else text + _write_field(fields[name], format_ or "")
            for text, name, format_ in _parse_fields(key)
        ]
    )


@cache
def _patterns() -> dict[str, re.Pattern[str]]:
    return {key: _pattern(sentence.says) for key, sentence in SENTENCES.items()}


def _pattern(template: str) -> re.Pattern[str]:
    parts, fields = list[str](), set[str]()
    for text, name, _, _ in Formatter().parse(template):
        parts += [re.escape(text), "" if not name else f"(?P={name})" if name in fields else f"(?P<{name}>.+?)"]
        fields |= {name} if name else set()
    return re.compile("".join(parts) + r"(?= |$)")


def recognise(text: str) -> list[tuple[str, dict[str, str]]]:
    """Return the key and the fields of each sentence of a text, in its order.

    Raises ValueError: Part of the text is no sentence that is listed here.
    """
    found, rest = [], text.strip()
    while rest:
        matches = [(m, key) for key, pattern in _patterns().items() if (m := pattern.match(rest))]
        if not matches:
            raise ValueError(f"{rest!r} begins with no sentence that is listed.")
        match, key = max(matches, key=lambda pair: len(SENTENCES[pair[1]].says))
        found.append((key, match.groupdict()))
        rest = rest[match.end() :].strip()
    return found
