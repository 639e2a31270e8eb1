"""The functions of one argument that typed text may call: one list, which all forms of a formula read."""

from __future__ import annotations

from .elementary import ELEMENTARY
from .elliptic import ELLIPTIC
from .function import Function

__all__ = ["FIRST_CODE", "FUNCTIONS", "Function", "called", "code", "known"]

FUNCTIONS: tuple[Function, ...] = (*ELEMENTARY, *ELLIPTIC)
FIRST_CODE = 32  # code of the first; those below are operations
known = {one.name: one for one in FUNCTIONS}
called = {one.name: one.scalar for one in FUNCTIONS if not one.source}  # what source calls by its name
code = {one.name: FIRST_CODE + i for i, one in enumerate(FUNCTIONS)}
