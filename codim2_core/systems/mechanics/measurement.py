"""A measured slip in a CSV file: time and two velocities a line."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from ...results.arrays import Array
from ..reading import short_repr

MOST_LINES = 1_000_000


def read_measurement(path: str | Path) -> tuple[Array, Array]:
    """Read times (k,) and velocities (k, 2) from a file of three columns.

    They are parted by commas, semicolons, tabs or blanks; between semicolons a comma is a decimal one. Empty lines,
    lines that begin with # and a first line of names are passed over.

    Raises ValueError: There is no such file, it is no text, it is too long, or a line is not of three numbers.
    """
    file = Path(path)
    try:
        with file.open(encoding="utf-8-sig") as lines:
            rows = [_numbers(line) for _, line in zip(range(MOST_LINES + 1), lines, strict=False)]
    except (OSError, UnicodeDecodeError, ValueError) as error:
        why = "is no text in UTF-8" if isinstance(error, ValueError) else "cannot be opened"
        raise ValueError(f"times is {short_repr(str(path))}, which {why}; give a CSV file, or an array.") from None
    if len(rows) > MOST_LINES:
        raise ValueError(f"times is {short_repr(str(path))}, of more than {MOST_LINES} lines; give fewer.")
    first = next((i for i, row in enumerate(rows) if row is not None), 0)
    if rows and rows[first] == []:
        rows[first] = None
    for i, row in enumerate(rows):
        if row == []:
            raise ValueError(
                f"times is {short_repr(str(path))}, whose line {i + 1} is not of three numbers; give time, v_x and v_y."
            )
    found = np.array([row for row in rows if row is not None], float).reshape(-1, 3)
    return found[:, 0], found[:, 1:]


def _numbers(line: str) -> list[float] | None:
    """Three numbers; none in a line that is passed over, and an empty list in any other."""
    text = line.strip()
    if not text or text.startswith("#"):
        return None
    if ";" in text:
        text = text.replace(",", ".")
    parts = [part.strip() for part in re.split(r"[;,\t]" if re.search(r"[;,\t]", text) else r"\s+", text)]
    try:
        found = [float(part) for part in parts]
    except ValueError:
        return []
    return found if len(found) == 3 else []
