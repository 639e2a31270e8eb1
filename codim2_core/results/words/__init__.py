"""Sentences about systems, portraits and motions: each written once, with its condition; the rooms say them by `say`.

A sentence without a check of its own in `tests/words`, against what motions do, is a failing test.
"""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from string import Formatter
from typing import Any

from ..special_kinds import SPECIAL_KINDS


@dataclass(frozen=True, slots=True)
class Sentence:
    """One sentence."""

    says: str  # with {fields}
    when: str  # when it is said


def read_tables(path: Path) -> dict[str, Any]:
    """Read a TOML file of tables; those with `says` and `when` become sentences."""
    return _sentences(tomllib.loads(path.read_text("utf-8")))


def _sentences(table: dict[str, Any]) -> dict[str, Any]:
    return {key: Sentence(**one) if "says" in one else _sentences(one) for key, one in table.items()}


_LOWERED, _RAISED = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉"), str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


_COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve")


def count_word(number: int) -> str:
    """Return a count as a word, up to twelve."""
    return _COUNTS[number] if number < len(_COUNTS) else str(number)


def subscript(number: int) -> str:
    """Return a number as lowered digits."""
    return str(number).translate(_LOWERED)


def written_label(label: str) -> str:
    """Return a label as it is written in a sentence: "Q1" as Q₁, "f2" as f₂; "cycle 1" as it is."""
    return re.sub(r"(?<=[QC])\d+|(?<=\b[fgkxzB])\d+\b", lambda digits: digits[0].translate(_LOWERED), label)


def written_number(value: float, digits: int = 4) -> str:
    """Return a number as it is written in a sentence: 0 within rounding as 0, with a minus sign and raised powers."""
    if math.isinf(value):
        return "∞" if value > 0.0 else "−∞"
    text = f"{0.0 if abs(value) < 1e-12 else value:.{digits}g}"
    mantissa, _, exponent = text.partition("e")
    text = mantissa.replace("-", "−")
    return f"{text} · 10{str(int(exponent)).translate(_RAISED)}" if exponent else text


_QUOTED = re.compile(r"""('[^']*'|"[^"]*")""")
_EXPONENT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)e([+-]?\d+)\b")
_MINUS = re.compile(r"(?<![\w.)\]}/-])-(?=\.?\d|inf\b)")


def printed_sentence(sentence: str) -> str:
    """Return a sentence that was made for Python with its numbers as they are read: minus signs, raised powers, ∞."""
    parts = _QUOTED.split(sentence)
    for i in range(0, len(parts), 2):
        text = _MINUS.sub("−", parts[i])
        text = _EXPONENT.sub(lambda found: f"{found[1]} · 10{str(int(found[2])).translate(_RAISED)}", text)
        parts[i] = re.sub(r"\binf\b", "∞", text).replace(" <= ", " ≤ ").replace("is nan", "has no value")
    return "".join(parts)


def power(value: float) -> str:
    """Return a small or large positive number such as 1.6e-16 as 1.6 · 10⁻¹⁶."""
    if math.isinf(value):
        return "∞"
    mantissa, _, exponent = f"{value:.1e}".partition("e")
    return f"{mantissa} · 10{str(int(exponent)).translate(_RAISED)}"


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
