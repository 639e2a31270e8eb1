"""Slow results of panels, computed beside the frames so that no slider ever waits for one.

One thread a process works through what is asked, and what is found is shared: forty students who look at the same
figure cost one computation. A browser has at most one wish for each thing it shows; a newer one replaces it.
"""

from __future__ import annotations

import logging
from collections import OrderedDict
from collections.abc import Callable, Hashable
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache
from threading import Lock
from typing import Any

import numpy as np

#: What the core raises for input that it cannot use.
FAILURES = (ValueError, ArithmeticError, np.linalg.LinAlgError)

#: Results kept for all browsers of a process.
KEPT = 128


@dataclass(frozen=True, slots=True)
class Failed:
    """In place of a result that cannot be had: the sentence that says why."""

    sentence: str


class _Shared:
    """Results by key, the most recently used last; read and written by several threads."""

    def __init__(self) -> None:
        self._results: OrderedDict[Hashable, Any] = OrderedDict()
        self._lock = Lock()

    def get(self, key: Hashable) -> Any:
        with self._lock:
            if key in self._results:
                self._results.move_to_end(key)
            return self._results.get(key)

    def put(self, key: Hashable, result: Any) -> None:
        with self._lock:
            self._results[key] = result
            while len(self._results) > KEPT:
                self._results.popitem(last=False)


@cache
def _shared() -> _Shared:
    return _Shared()


@cache
def _thread() -> ThreadPoolExecutor:
    """Return the one worker of this process, made when first needed: a fork has no threads of its parent's."""
    return ThreadPoolExecutor(1, thread_name_prefix="codim2-panels")


class Jobs:
    """The slow results that one browser waits for.

    Parameters
    ----------
    executor : Executor, optional
        What computes; default one thread for the whole process.
    """

    def __init__(self, executor: Executor | None = None) -> None:
        self._executor = executor
        self._wishes: dict[str, tuple[Hashable, Future[Any]]] = {}

    def ask(self, name: str, key: Hashable, make: Callable[[], Any]) -> Any:
        """Return the result for this key, or None while it is being computed.

        Parameters
        ----------
        name : str
            What it is for; a wish of the same name with another key is dropped.
        key : hashable
            Everything that the result depends on.
        make : callable
            Computes it; must not be None. Input that the core refuses gives `Failed`.
        """
        whole = (name, key)
        result = _shared().get(whole)
        if result is not None:
            self._wishes.pop(name, None)
            return result
        wish = self._wishes.get(name)
        if wish is not None and wish[0] == key:
            if wish[1].done():
                self._wishes.pop(name)
                return wish[1].result()
            return None
        if wish is not None:
            wish[1].cancel()
        executor = _thread() if self._executor is None else self._executor
        self._wishes[name] = (key, executor.submit(_compute, whole, make))
        return None


def _compute(whole: Hashable, make: Callable[[], Any]) -> Any:
    kept = _shared().get(whole)  # another browser may have asked for it meanwhile
    if kept is None:
        try:
            kept = make()
        except FAILURES as error:
            kept = Failed(str(error))
        except Exception:  # a panel must not take the picture with it
            logging.getLogger(__name__).exception("a panel could not be computed")
            kept = Failed("This could not be computed: a fault of the program, which its log describes.")
        _shared().put(whole, kept)
    return kept
