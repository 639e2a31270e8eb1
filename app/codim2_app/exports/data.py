"""Files of data: CSV (one file a table, in a zip), JSON and NPZ, each with what it is data of."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from collections.abc import Mapping
from typing import Any

import numpy as np

from .describe import facts
from .tables import Table, table_rows, tables
from .view import View

#: When the files of a zip were made, so that the same view gives the same file.
WHEN = (1980, 1, 1, 0, 0, 0)


def data_of(view: View) -> dict[str, Table]:
    """Return the tables of all that a view draws."""
    return tables(view.scene(), view.values["layers"])


def csv_zip(view: View) -> bytes:
    """Return a zip of one CSV file a table, and a README.txt.

    A file begins with lines after ``#``: what it is data of, then each column with its unit and meaning, as
    ``pandas.read_csv(file, comment="#")`` leaves out.
    """
    told = [f"{name}: {said}" for name, said in facts(view).items()]
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as files:

        def put(name: str, text: str) -> None:
            files.writestr(zipfile.ZipInfo(name, WHEN), text.encode(), zipfile.ZIP_DEFLATED)

        put("README.txt", "\n".join([*told, "", "Coordinates are those of the picture: the unit disc is the projected",
                                     "hemisphere, outside it is the system without regularisation.", ""]))  # fmt: skip
        for name, table in data_of(view).items():
            text = io.StringIO()
            for line in (*told, *(f"{column} [{unit}]: {said}" for column, (unit, said) in table.columns.items())):
                text.write(f"# {line}\n")
            writer = csv.writer(text, lineterminator="\n")
            writer.writerow(table.columns)
            writer.writerows(table_rows(table))
            put(f"{name}.csv", text.getvalue())
    return packed.getvalue()


def json_text(view: View) -> bytes:
    """Return all tables as JSON.

    ``tables.NAME.data.COLUMN`` is a list, ``tables.NAME.columns.COLUMN`` its unit and meaning.
    """
    made: dict[str, Any] = {"about": facts(view), "tables": {}}
    for name, table in data_of(view).items():
        made["tables"][name] = {
            "columns": {column: {"unit": unit, "meaning": said} for column, (unit, said) in table.columns.items()},
            "data": {column: values.tolist() for column, values in table.data.items()},
        }
    return json.dumps(made, ensure_ascii=False, allow_nan=False).encode()


def npz(view: View) -> bytes:
    """Return all columns as NumPy arrays ``TABLE.COLUMN``; ``about`` is text, and so are ``TABLE.COLUMN.meaning``."""
    arrays: dict[str, Any] = {"about": np.array(_header_lines(facts(view)))}
    for name, table in data_of(view).items():
        for column, (unit, said) in table.columns.items():
            arrays[f"{name}.{column}"] = table.data[column]
            arrays[f"{name}.{column}.meaning"] = np.array(f"{said} [{unit}]")
    packed = io.BytesIO()
    np.savez_compressed(packed, allow_pickle=False, **arrays)
    return packed.getvalue()


def _header_lines(told: Mapping[str, str]) -> str:
    return "\n".join(f"{name}: {said}" for name, said in told.items())
