"""A module's functions, changed while they live: what a mutant costs is then its tests, and no import.

A mutant that changes only bodies of functions is put in by exchanging their code. One that changes what runs on import
(constants, defaults of arguments and fields, decorators), or what Numba compiles, cannot be, and is imported afresh.
"""

from __future__ import annotations

import functools
import gc
import types
from collections.abc import Iterator

ON_IMPORT = ("<genexpr>", "<listcomp>", "<setcomp>", "<dictcomp>")  # in a module's or a class's body: run with it
OPTIMIZED = 0x1  # code of a function; a module's and a class's body have not got it
Where = tuple[str, int]  # qualified name, first line


def functions(paths: frozenset[str]) -> dict[str, dict[Where, list[types.FunctionType]]]:
    """All living functions that were written in these files, by file, name and line."""
    found: dict[str, dict[Where, list[types.FunctionType]]] = {}
    for thing in gc.get_objects():
        if type(thing) is types.FunctionType and thing.__code__.co_filename in paths:
            code = thing.__code__
            found.setdefault(code.co_filename, {}).setdefault((code.co_qualname, code.co_firstlineno), []).append(thing)
    return found


def caches(packages: tuple[str, ...]) -> list[functools._lru_cache_wrapper]:
    """The caches of functions of these packages: what they hold was computed by functions as they were."""
    return [
        thing
        for thing in gc.get_objects()
        if type(thing) is functools._lru_cache_wrapper and (thing.__module__ or "").split(".")[0] in packages
    ]


def changes(before: types.CodeType, after: types.CodeType) -> list[types.CodeType] | None:
    """New code of the outermost functions that differ, or None if what runs on import differs."""
    if before == after:
        return []
    if before.co_flags & OPTIMIZED:
        return [after]
    old, new = list(_inner(before)), list(_inner(after))
    if len(old) != len(new) or _bare(before) != _bare(after):
        return None
    found: list[types.CodeType] = []
    for one, other in zip(old, new, strict=True):
        if one != other and one.co_name in ON_IMPORT:
            return None
        part = changes(one, other)
        if part is None:
            return None
        found += part
    return found


def _inner(code: types.CodeType) -> Iterator[types.CodeType]:
    return (const for const in code.co_consts if isinstance(const, types.CodeType))


def _bare(code: types.CodeType) -> tuple:
    """All of a body's own code but its functions and classes."""
    plain = tuple(None if isinstance(c, types.CodeType) else (type(c), c) for c in code.co_consts)
    return code.co_code, plain, code.co_names


def put_in(new: list[types.CodeType], living: dict[Where, list[types.FunctionType]]) -> bool:
    """Exchange the code of the functions that a mutant changes; whether that was possible."""
    try:
        for code in new:
            for function in living[code.co_qualname, code.co_firstlineno]:
                function.__code__ = code
    except (KeyError, ValueError):  # not living under this name, or with other free variables
        return False
    return True
