"""What a session leaves is met by the next search for garbage, though it was left out of all searches before.

`gc.freeze` leaves out what lives, and only all of it comes back. A session's end brings back what that session had:
what is reached from it, but not what was there before the first visitor. That is handed to the collector as if it
were new, by two functions of Python's stable C interface. Whoever still uses some of it keeps it: the search decides.
"""

from __future__ import annotations

import gc
from collections import deque
from collections.abc import Iterable, Iterator
from ctypes import py_object, pythonapi
from functools import cache
from itertools import chain, compress, cycle
from operator import call
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Objects of one session that are followed. It has 2000; what it would reach beyond is another's, or kept for all.
MOST = 20_000
#: What is made of formulas is kept for as long as the process lives.
KEPT = ("numba", "llvmlite")

_untrack, _track = pythonapi.PyObject_GC_UnTrack, pythonapi.PyObject_GC_Track
_untrack.argtypes = _track.argtypes = [py_object]
_untrack.restype = _track.restype = None
_call: Any = call  # map cannot tell its types


class Old:
    """What was there before the first visitor, and stays."""

    def __init__(self) -> None:
        gc.unfreeze()  # what is frozen is not told of
        self._objects = gc.get_objects()  # held, so that nothing else comes where one of them was
        gc.freeze()
        self._places = np.sort(_places(self._objects))

    def without(self, objects: list[Any]) -> Iterator[Any]:
        """Return those objects that are not among these."""
        places = _places(objects)
        found = np.minimum(np.searchsorted(self._places, places), len(self._places) - 1)
        return compress(objects, (self._places[found] != places).tolist())


def _places(objects: list[Any]) -> NDArray[np.int64]:
    return np.fromiter(map(id, objects), np.int64, len(objects))


@cache
def _followed(kind: type) -> bool:
    return not issubclass(kind, type | ModuleType) and not kind.__module__.startswith(KEPT)


def reached(roots: Iterable[Any], old: Old) -> list[Any]:
    """Return what the collector knows of that is reached from some objects, nearest first, but nothing old."""
    level, found, known = list(roots), [], set()
    while level and len(found) < MOST:
        fresh = []
        for thing in old.without(level):
            if id(thing) not in known and gc.is_tracked(thing) and _followed(type(thing)):
                known.add(id(thing))
                fresh.append(thing)
        found += fresh
        level = gc.get_referents(*fresh)
    return found


def bring_back(roots: Iterable[Any], old: Old) -> None:
    """Let the next search meet all that is reached from some objects."""
    found = reached(roots, old)
    searching = gc.isenabled()
    gc.disable()
    try:
        # All in one call: between the two no other thread may come, which could track a dictionary that it writes to
        deque(map(_call, cycle((_untrack, _track)), chain.from_iterable(zip(found, found, strict=True))), maxlen=0)
    finally:
        if searching:
            gc.enable()
