"""The choice of what is done with kernels that are neither compiled in this process nor kept on disk."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

#: `RENT` runs a kernel as Python until that has taken as long as compiling it does; `COMPILE` compiles it at once;
#: `LOAD` takes it from the disk only; `PYTHON` always runs it as Python.
RENT, COMPILE, LOAD, PYTHON = "rent", "compile", "load", "python"


class NotCompiledError(RuntimeError):
    """A kernel is not on disk, where it is only to be loaded."""


class _Process:
    way = RENT
    at_work: Callable[[], bool] | None = None


class _Thread(threading.local):
    way = ""


_process, _thread = _Process(), _Thread()


def choose_way(way: str) -> None:
    """Let this process do so with kernels that are not at hand."""
    _process.way = way


@contextmanager
def in_thread(way: str) -> Iterator[None]:
    """Let this thread do something else than its process."""
    before, _thread.way = _thread.way, way
    try:
        yield
    finally:
        _thread.way = before


def current_way() -> str:
    """Return what this thread does."""
    return _thread.way or _process.way


def leave_to(at_work: Callable[[], bool] | None) -> None:
    """Let another process compile, as long as it says that it is at work: kernels run as Python, however long."""
    _process.at_work = at_work


def is_left() -> bool:
    """Whether another process compiles the kernels of this one, or nobody does."""
    return current_way() == PYTHON or (_process.at_work is not None and _process.at_work())
