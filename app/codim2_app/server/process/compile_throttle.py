"""A thread that compiles stands back while a visitor is answered: both need the interpreter, and would halve it.

Numba tells of each pass of its compiler before it begins; a kernel takes some hundreds, of a few milliseconds each.
"""

from __future__ import annotations

import threading
import time
from functools import cache
from typing import Any

from numba.core.event import Listener, register

#: Seconds for which a pass is put off at most; nor for longer than has been compiled since, so that a process which
#: always answers compiles too, and whoever waits for the compiler does so for twice as long at most.
MAX_PAUSE_SECONDS = 0.05
LOOK = 0.0005


class Answering:
    """Whether a visitor is being answered: held by the thread that answers, by several at once that await."""

    def __init__(self) -> None:
        self._count, self._thread = 0, 0

    def __enter__(self) -> None:
        self._count, self._thread = self._count + 1, threading.get_ident()

    def __exit__(self, *_: object) -> None:
        self._count -= 1

    def elsewhere(self) -> bool:
        """Whether a visitor is answered by another thread than this one."""
        return self._count > 0 and self._thread != threading.get_ident()


answering = Answering()


class _Before(Listener):
    """Waits before a pass begins."""

    def __init__(self) -> None:
        self._owed, self._since = 0.0, 0.0  # one thread compiles at a time

    def on_start(self, event: Any) -> None:  # noqa: ARG002 (Numba's)
        """Wait while a visitor is answered, if it may."""
        began = now = time.monotonic()
        self._owed = min(MAX_PAUSE_SECONDS, self._owed + began - self._since)
        while answering.elsewhere() and now - began < self._owed:
            time.sleep(LOOK)
            now = time.monotonic()
        self._owed -= min(self._owed, now - began)
        self._since = now

    def on_end(self, event: Any) -> None:
        """Nothing waits after a pass."""


@cache
def stand_back() -> None:
    """Let the threads of this process that compile stand back from now on."""
    register("numba:run_pass", _Before())
