"""Rows of results as small HTML tables, which a notebook shows, as CSV and as data frames."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

MAX_ROWS = 40  # rows that are shown
NEGLIGIBLE = 1e-14  # of the largest coordinate: smaller ones are shown as 0


def table_number(value: float) -> str:
    """Return a number to six digits, with a minus sign; zero has none."""
    return f"{value + 0.0:.6g}".replace("-", "−")


def point(values: Iterable[float]) -> str:
    """Return the coordinates of a point; a dash if there are none. What is rounding next to the largest is 0."""
    values = list(values)
    least = NEGLIGIBLE * max(map(abs, values), default=0.0)
    shown = ", ".join(table_number(0.0 if abs(value) < least else value) for value in values)
    return f"({shown})" if shown else "–"


def html_table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table, or nothing if it has no rows; of many rows the first are shown, and how many there are."""
    if not rows:
        return ""
    left = f"<p>and {len(rows) - MAX_ROWS} more</p>" if len(rows) > MAX_ROWS else ""
    return (
        f"<table><thead>{_table_row('th', head)}</thead>"
        f"<tbody>{''.join(_table_row('td', row) for row in rows[:MAX_ROWS])}</tbody></table>{left}"
    )


def paragraphs(sentences: Iterable[str]) -> str:
    """Return sentences, a paragraph each."""
    return "".join(f"<p>{escape(sentence)}</p>" for sentence in sentences if sentence)


def write_csv(path: str | Path, records: Iterable[Mapping[str, Any]]) -> None:
    """Write records of the same names as CSV, with a line of these; what is None is left empty."""
    import csv

    with Path(path).open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        for i, record in enumerate(records):
            if not i:
                writer.writerow(record)
            writer.writerow(record.values())


def frame(records: Iterable[Mapping[str, Any]] | Mapping[str, Any]) -> Any:
    """Return records of the same names, or columns by name, as a pandas DataFrame."""
    try:
        import pandas
    except ImportError:
        raise ValueError("pandas is not installed, of which to_frame makes a DataFrame: pip install pandas.") from None
    made = pandas.DataFrame(records if isinstance(records, Mapping) else list(records))
    for name, column in made.items():  # numbers of which some are not there
        if column.dtype.kind == "O" and all(one is None or isinstance(one, int | float) for one in column):
            made[name] = column.astype(float)
    return made


def _table_row(kind: str, cells: Sequence[str]) -> str:
    return f"<tr>{''.join(f'<{kind}>{escape(cell)}</{kind}>' for cell in cells)}</tr>"
