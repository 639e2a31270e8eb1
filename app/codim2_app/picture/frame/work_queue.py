"""A fair queue for workers: browsers take turns, so that nobody waits for all that another has requested.

What several ask for is computed once, and stopped when none of them wants it any more. Where it is computed is an
executor's affair: a thread in a notebook, processes on a server, or the host's own (`WorkQueue(executor, at_once)`).
"""

from __future__ import annotations

import logging
import pickle
import time
from collections import OrderedDict, deque
from collections.abc import Callable, Hashable
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ThreadPoolExecutor
from copy import copy
from dataclasses import dataclass, field
from functools import cache
from threading import RLock
from typing import Any

from codim2_core.scene import Scene

from ..phrases import say
from .faults import FAULT, sentence_of

#: Results kept for all browsers of a process, and what they may hold together, in bytes.
MAX_KEPT_RESULTS = 128
MAX_KEPT_BYTES = 64_000_000


@dataclass(frozen=True, slots=True)
class FailedResult:
    """In place of a result that cannot be had: the sentence that says why."""

    sentence: str


class KeptResults:
    """Results by key, the most recently used last; bounded in number and in size."""

    def __init__(self, most: int = MAX_KEPT_RESULTS, most_bytes: int = MAX_KEPT_BYTES) -> None:
        self.most, self.most_bytes = most, most_bytes
        self.size = 0
        self._kept: OrderedDict[Hashable, tuple[Any, int]] = OrderedDict()

    def __len__(self) -> int:
        return len(self._kept)

    def get(self, key: Hashable) -> Any:
        """Return a result, or None."""
        if key not in self._kept:
            return None
        self._kept.move_to_end(key)
        return self._kept[key][0]

    def put(self, key: Hashable, result: Any, size: int | None) -> None:
        """Keep a result of so many bytes, and forget those not used for longest."""
        self.size -= self._kept.pop(key, (None, 0))[1]
        if size is None or size > self.most_bytes:
            return
        self._kept[key] = result, size
        self.size += size
        while len(self._kept) > self.most or self.size > self.most_bytes:
            self.size -= self._kept.popitem(last=False)[1][1]


def result_size(result: Any) -> int | None:
    """Return about how many bytes a result holds; what cannot be sent by a process has no size that is known."""
    try:
        return len(pickle.dumps(result, pickle.HIGHEST_PROTOCOL))
    except (pickle.PicklingError, TypeError, AttributeError):
        return None


@dataclass(eq=False)
class QueuedWork:
    """One thing to compute: its call, those who want it, and the future that they wait for."""

    key: Hashable
    call: tuple[Any, ...]
    owners: set[Hashable]
    future: Future[Any] = field(default_factory=Future)
    under_way: Future[Any] | None = None
    since: float = 0.0
    again: bool = True  # if its worker is lost


class WorkQueue:
    """Work by owner: the one who has been served least comes next, and has one work under way at a time.

    Parameters
    ----------
    executor : Executor
        Runs picklable calls if it is one of processes. If its futures can be cancelled while they run
        (`workers.Workers`), work that nobody wants any more ends at once; else it is finished for nobody.
    at_once : int
        So many works are given to the executor at a time.
    """

    def __init__(self, executor: Executor, at_once: int = 1) -> None:
        self.executor, self.at_once = executor, at_once
        self.results = KeptResults()
        self._lock = RLock()
        self._works: dict[Hashable, QueuedWork] = {}
        self._queues: OrderedDict[Hashable, deque[QueuedWork]] = OrderedDict()
        self._used: dict[Hashable, float] = {}
        self._running: dict[QueuedWork, Hashable] = {}

    def result(self, key: Hashable) -> Any:
        """Return a result that is kept, or None."""
        with self._lock:
            return self.results.get(key)

    def want(self, owner: Hashable, key: Hashable, function: Callable[..., Any], *args: Any) -> Future[Any]:
        """Return the future of ``function(*args)``, for which `key` stands; `drop` it, do not cancel it."""
        with self._lock:
            work = self._works.get(key)
            if work is None:
                work = self._works[key] = QueuedWork(key, (function, *args), {owner})
                if owner not in self._queues:
                    self._queues[owner] = deque()
                    least = min((self._used[one] for one in self._queues if one in self._used), default=0.0)
                    self._used[owner] = max(self._used.get(owner, 0.0), least)
                self._queues[owner].append(work)
            work.owners.add(owner)
            self._next()
            return work.future

    def drop(self, owner: Hashable, key: Hashable, grace: float = 0.0) -> None:
        """Forget that `owner` wants this; what nobody wants is stopped, once it has run for so many seconds."""
        with self._lock:
            work = self._works.get(key)
            if work is None:
                return
            work.owners.discard(owner)
            if work.owners:
                return
            del self._works[key]
            for queue in self._queues.values():
                if work in queue:
                    queue.remove(work)
            runs_for = self._running.get(work)
        self.stop_unwanted(runs_for, grace)
        self._forget_idle()

    def stop_unwanted(self, owner: Hashable, grace: float) -> None:
        """Stop what `owner` was given though nobody wants it, if it has not begun or has run for so many seconds."""
        before = time.monotonic() - grace
        with self._lock:
            unwanted = [
                (work.since, work.under_way)
                for work, one in self._running.items()
                if one == owner and self._works.get(work.key) is not work
            ]
        for since, under_way in unwanted:
            if under_way is not None and (since <= before or not under_way.running()):
                under_way.cancel()

    def leave(self, owner: Hashable) -> None:
        """Forget all that `owner` wants."""
        with self._lock:
            wanted = [key for key, work in self._works.items() if owner in work.owners]
        for key in wanted:
            self.drop(owner, key)
        self.stop_unwanted(owner, 0.0)
        with self._lock:
            self._used.pop(owner, None)

    @property
    def pending(self) -> int:
        """Number of works that wait or run."""
        with self._lock:
            return len(self._works)

    def _forget_idle(self) -> None:
        with self._lock:
            busy = set(self._running.values())
            for owner in [one for one, queue in self._queues.items() if not queue and one not in busy]:
                del self._queues[owner]

    def _next(self) -> None:
        while len(self._running) < self.at_once:
            busy = set(self._running.values())
            free = [owner for owner, queue in self._queues.items() if queue and owner not in busy]
            if not free:
                return
            owner = min(free, key=lambda one: self._used.get(one, 0.0))
            work = self._queues[owner].popleft()
            self._queues.move_to_end(owner)
            self._running[work] = owner
            work.since = time.monotonic()
            try:
                work.under_way = self.executor.submit(compute, *work.call)
            except RuntimeError:  # it has been shut down, as at the end of the process: nobody waits for what is left
                del self._running[work]
                self._queues.clear()
                return
            work.under_way.add_done_callback(lambda done, work=work: self._done(work, done))

    def _done(self, work: QueuedWork, done: Future[Any]) -> None:
        result, lost = _outcome(done)
        size = result_size(result)  # before the lock: pickling takes long, and whoever answers visitors waits for it
        with self._lock:
            owner = self._running.pop(work, None)
            if owner in self._used:
                self._used[owner] += time.monotonic() - work.since
            work.under_way = None  # the two hold each other
            wanted = self._works.get(work.key) is work
            again = wanted and lost and work.again
            if again:
                work.again = False
                self._queues.setdefault(owner, deque()).appendleft(work)
            elif wanted:
                del self._works[work.key]
                self.results.put(work.key, result, size)
            self._next()
        self._forget_idle()
        if wanted and not again:
            work.future.set_result(result)


def _outcome(done: Future[Any]) -> tuple[Any, bool]:
    """Return the result, and whether the worker was lost.

    Nothing is raised: an error's traceback would hold the future, which holds the error and those who waited for it.
    """
    error = CancelledError() if done.cancelled() else done.exception()
    if error is None:
        return done.result(), False
    if isinstance(error, TimeoutError):
        return FailedResult(str(error) or say("stopped")), False
    if isinstance(error, BrokenExecutor | CancelledError):
        return FailedResult(say("lost")), True
    # of the host's executor: a panel says so, the picture stands, the log has the rest
    logging.getLogger(__name__).error("work next to the frames failed", exc_info=error)
    return FailedResult(FAULT), False


def compute(function: Callable[..., Any], *args: Any) -> Any:
    """Return the result, or `FailedResult` where there is none; runs where the executor runs."""
    # a scene goes by its inputs, also within a process: what others compute in it meanwhile is theirs
    own = [copy(each) if isinstance(each, Scene) else each for each in args]
    try:
        return function(*own)
    except MemoryError:
        return FailedResult(say("memory"))
    except Exception as error:  # a panel must not take the picture with it
        return FailedResult(sentence_of(error, "a panel"))


@cache
def in_a_thread() -> WorkQueue:
    """Return the work queue of a notebook: one thread of this process, made when first needed (a fork has none)."""
    return WorkQueue(ThreadPoolExecutor(1, thread_name_prefix="codim2-panels"))
