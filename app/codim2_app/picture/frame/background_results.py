"""Slow results of one browser, computed in workers so that no slider ever waits for them.

A browser has at most one wish for each thing it shows; a newer one replaces it, and what nobody wants any more ends.
What is found is shared: forty students who look at the same figure cost one computation.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from concurrent.futures import Executor, Future
from typing import Any
from weakref import WeakKeyDictionary

from .work_queue import WorkQueue, in_a_thread

#: For which work goes on that a newer wish has replaced: a worker that is stopped leaves its place to one that must
#: load all kernels, and in a drag no picture would ever be done.
GRACE_SECONDS = 1.0

#: Has a function called by the thread that answers; any thread may ask.
Scheduler = Callable[[Callable[[], None]], Any]

_served: list[WorkQueue] = []
_given: WeakKeyDictionary[Executor, WorkQueue] = WeakKeyDictionary()


def serve_with(queue: WorkQueue) -> None:
    """Give the jobs of this process this work queue: a server shares its worker processes by it."""
    _served[:] = [queue]


class Jobs:
    """The slow results that one browser waits for.

    Parameters
    ----------
    executor : Executor, optional
        What computes; default what the server has for all (`serve_with`), else one thread for the whole process.
    """

    def __init__(self, executor: Executor | None = None) -> None:
        self._given = None if executor is None else _queue_of(executor)
        self._wishes: dict[str, tuple[Hashable, Future[Any]]] = {}

    @property
    def queue(self) -> WorkQueue:
        """Return the work queue that all browsers share."""
        if self._given is not None:
            return self._given
        return _served[0] if _served else in_a_thread()

    def ask(self, name: str, key: Hashable, make: Callable[..., Any], *arguments: Any) -> Any:
        """Return the result for this key, or None while it is being computed.

        Parameters
        ----------
        name : str
            What it is for; a wish of the same name with another key is dropped, and its work stopped if it is long.
        key : hashable
            Everything that the result depends on.
        make : callable
            ``make(*arguments)`` computes it; must not be None. Input that the core refuses gives `FailedResult`. On a
            server both travel to another process: functions of modules, and values that can be pickled.
        """
        whole = (name, key)
        queue = self.queue
        wish = self._wishes.get(name)
        if wish is not None and wish[0] != key:
            queue.drop(id(self), (name, wish[0]), GRACE_SECONDS)
            wish = None
        result = queue.result(whole)
        if result is not None:
            self._wishes.pop(name, None)
            return result
        if wish is None:
            self._wishes[name] = key, queue.want(id(self), whole, make, *arguments)
        elif wish[1].done():
            self._wishes.pop(name)
            return wish[1].result()
        queue.stop_unwanted(id(self), GRACE_SECONDS)
        return None

    def drop(self, name: str) -> None:
        """Want nothing under a name any more: its work is stopped, unless another browser wants it."""
        wish = self._wishes.pop(name, None)
        if wish is not None:
            self.queue.drop(id(self), (name, wish[0]))

    def future(self, name: str) -> Future[Any] | None:
        """Return what is being waited for under a name, if anything is."""
        wish = self._wishes.get(name)
        return None if wish is None else wish[1]

    def leave(self) -> None:
        """End what this browser alone wanted: it has gone."""
        self._wishes.clear()
        self.queue.leave(id(self))


def _queue_of(executor: Executor) -> WorkQueue:
    """Return the work queue of an executor, the same one for all that name it."""
    return _given.setdefault(executor, WorkQueue(executor))
