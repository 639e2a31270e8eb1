"""The files of a view that are no pictures, by how their names end."""

from __future__ import annotations

import csv
import io
import json
import zipfile
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

import codim2_core as c2
from codim2_core import __version__
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import catalogue
from codim2_core.systems.psi.function import Psi
from codim2_core.systems.typed import System

from ..picture.draw.layers import layers_in_paint_order
from .describe import facts
from .tables import Table, table_rows, tables
from .tex.table import latex
from .view import View

#: Inputs of a scene that are written where they differ from the first values.
INPUTS = ("count", "length", "view", "pixel", "window", "cut")


def snippet(view: View) -> str:
    """Return the code.

    Raises
    ------
    ValueError
        The system is frozen at one z, or its Psi is of a family that is registered in one program only.
    """
    scene = view.scene()
    first = c2.Scene(scene.system, scene.psi, scene.z)
    inputs = [f"{name}={getattr(scene, name)!r}" for name in INPUTS if getattr(scene, name) != getattr(first, name)]
    if len(scene.launch):
        inputs.append(f"launch={scene.launch.tolist()!r}")
    arguments = ", ".join(["system", "psi", *([f"z={scene.z!r}"] if scene.z else []), *inputs])
    there = [layer for layer in layers_in_paint_order() if len(scene.launch) or not layer.optional]
    names = [part.scene for layer in there if layer.name in view.values["layers"] for part in layer.parts]
    drawn = dict.fromkeys([*(name for name in names if name), *_equilibrium_lines(view.values["layers"])])
    where = f"# the same in a browser: the explorer's address with ?{view.query}\n" if view.query else ""
    return (
        f"# codim2 {__version__}\n{where}import codim2_core as c2\n\n"
        f"system = {_system(view, scene.system)}\npsi = {_psi(scene.psi)}\n"
        f"scene = c2.Scene({arguments})\n\n"
        'print(scene["classification"].sentence)\n'
        f"drawn = {{name: scene[name] for name in {list(drawn)!r}}}\n"
        "# scene.plot() is the picture (HoloViews)\n"
    )


def _equilibrium_lines(layers: list[str]) -> list[str]:
    return [name for name in ("equator", "critical", "outcomes") if name in layers]


def _system(view: View, system: Any) -> str:
    choice = view.values["system"]
    if view.system is None and choice in catalogue and hasattr(c2.examples, choice):
        ranges = catalogue[choice].ranges
        given = ", ".join(f"{name}={value!r}" for name, value in system.parameters.items() if name in ranges)
        return f"c2.examples.{choice}({given})"
    parameters = f"parameters={dict(system.parameters)!r}" if getattr(system, "parameters", ()) else ""
    if isinstance(system, ELinear):
        slow = [f"{name}={_entries(getattr(system, name))}" for name in ("B", "g") if getattr(system, name) is not None]
        f = f"f={_entries(system.f)}"
        if system.given_matrix is not None:
            inside = ", ".join(filter(None, (_entries(system.given_matrix), f, *slow, parameters)))
            return f"c2.ELinear.from_matrix({inside})"
        inside = ", ".join(filter(None, (*map(_entry, (system.a, system.b, system.d)), f, *slow, parameters)))
        return f"c2.ELinear({inside})"
    if isinstance(system, System):
        slow = [f"W={_entries(system.W)}"] if system.W else []
        named = [f"definitions={dict(system.definitions)!r}"] if system.definitions else []
        return f"c2.System({', '.join(filter(None, (f'U={_entries(system.U)}', *slow, parameters, *named)))})"
    raise ValueError(
        "The system is frozen at one z, and no code makes it again: give the explorer the system at all z."
    )


def _entries(values: Any) -> str:
    """Return a tuple of numbers and texts, or of tuples of them, as code."""
    inner = [_entries(value) if isinstance(value, tuple) else _entry(value) for value in values]
    return f"({', '.join(inner)}{',' if len(inner) == 1 else ''})"


def _entry(value: Any) -> str:
    return repr(value) if isinstance(value, (int, float)) else repr(value.text)


def _psi(psi: Psi) -> str:
    family = c2.psi.FAMILIES.get(psi.family)
    if family is None:
        raise ValueError(f"Ψ is of the family {psi.family!r}, which only the program that registered it can make.")
    if family.typed:
        return f"c2.psi.{psi.family}({psi.text!r})"
    return f"c2.psi.{psi.family}({psi.parameter!r})" if psi.parameter else f"c2.psi.{psi.family}()"


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
    lines = [f"{name}: {said}" for name, said in facts(view).items()]
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as files:

        def put(name: str, text: str) -> None:
            files.writestr(zipfile.ZipInfo(name, WHEN), text.encode(), zipfile.ZIP_DEFLATED)

        put("README.txt", "\n".join([*lines, "", "Coordinates are those of the picture: the unit disc is the projected",
                                     "hemisphere, outside it is the system without regularisation.", ""]))  # fmt: skip
        for name, table in data_of(view).items():
            text = io.StringIO()
            for line in (*lines, *(f"{column} [{unit}]: {said}" for column, (unit, said) in table.columns.items())):
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


def _header_lines(facts_of_view: Mapping[str, str]) -> str:
    return "\n".join(f"{name}: {said}" for name, said in facts_of_view.items())


DATA: Mapping[str, Callable[[View], bytes]] = MappingProxyType(
    {
        ".zip": csv_zip,
        ".json": json_text,
        ".npz": npz,
        ".py": lambda view: snippet(view).encode(),
        ".tex": lambda view: latex(view).encode(),
    }
)
