"""Numbers and names as they are written in a sentence."""

from __future__ import annotations

import math
import re

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
    """Return a sentence that was made for Python with its numbers as they are read: minus signs, raised powers, ∞.

    What is quoted stays as it was typed, and names are those that are typed.
    """
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
