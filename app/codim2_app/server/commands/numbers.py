"""Numbers of the command line: read as the page does, written with six digits."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence

from codim2_core.results.words import written_number


def number(text: str) -> float:
    """Read a number as the page does: -.5, 1e-3, −7,5; and a fraction, -2/3."""
    top, _, bottom = text.strip().replace("−", "-").replace(",", ".").partition("/")
    try:
        return float(top) / float(bottom or 1)
    except (ValueError, ZeroDivisionError):
        raise argparse.ArgumentTypeError(f"{text!r} given; give a number such as -0.5, 1e-3 or 2/3.") from None


#: Options whose value is a formula, which may begin with a minus sign.
FORMULA_OPTIONS = ("-U", "-W")


def join_negative_numbers(words: Sequence[str]) -> list[str]:
    """Join an option and its negative number or formula, which argparse takes for an option: "-d", "-1e-3"."""
    joined: list[str] = []
    for word in words:
        negative = re.match(r"[-−][.\d]", word)
        formula = bool(joined) and joined[-1] in FORMULA_OPTIONS
        if formula or (negative and joined and joined[-1].startswith("-") and "=" not in joined[-1]):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def natural_count(text: str) -> int:
    """Read a whole number, also as 1e6."""
    value = number(text)
    if not value.is_integer():
        raise argparse.ArgumentTypeError(f"{text} is no whole number")
    return int(value)


def six(value: float) -> str:
    """Write a number with six digits."""
    return written_number(float(value), 6)
