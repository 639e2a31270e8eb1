"""The files of a view that are no pictures, by how their names end."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from .data import csv_zip, json_text, npz
from .snippet import snippet
from .tex.table import latex
from .view import View

DATA: Mapping[str, Callable[[View], bytes]] = MappingProxyType(
    {
        ".zip": csv_zip,
        ".json": json_text,
        ".npz": npz,
        ".py": lambda view: snippet(view).encode(),
        ".tex": lambda view: latex(view).encode(),
    }
)
