"""What has had the loop of a server, callback by callback, and what each waited for while it had it."""

from __future__ import annotations

import asyncio
import gc
import json
import os
import resource
import threading
import time
from collections import deque
from dataclasses import astuple, dataclass
from typing import Any
from urllib.request import urlopen

LEAST = 0.001  # seconds: shorter callbacks are not told
MOST = 100_000  # callbacks


@dataclass(frozen=True)
class Held:
    """One callback of a server's loop.

    Attributes
    ----------
    name : str
    began : float
        By the clock of the machine, which is the same for all its processes.
    took : float
        Seconds by the clock.
    worked : float
        Seconds of processor time of the thread that answers.
    queued : float
        Seconds for which this thread waited for a processor that others had.
    locked : float
        Seconds for which other threads of the process did, one of which may have had the interpreter's lock.
    faults : int
        Pages of programs and libraries that had to be read from the disk meanwhile.
    search : float
        Seconds of processor time of the searches for garbage.
    """

    name: str
    began: float
    took: float
    worked: float
    queued: float
    locked: float
    faults: int
    search: float

    @property
    def own(self) -> float:
        """Seconds for which it had the loop, without those for which this thread waited for a processor."""
        return max(self.worked, self.took - self.queued)

    @property
    def alone(self) -> float:
        """The same, without those either for which others did while this one slept: they may have had the lock."""
        return max(self.worked, self.own - self.locked)


def held(port: int) -> list[Held]:
    """Return what has had the loop of a watched server since this was asked last."""
    return [Held(*each) for each in json.loads(urlopen(f"http://localhost:{port}/held").read())]


class _Queued:
    """Seconds for which the threads of this process have waited for a processor."""

    def __init__(self) -> None:
        self._files: dict[int, int] = {}
        self._own = os.open("/proc/thread-self/schedstat", os.O_RDONLY)

    def own(self) -> float:
        """Of the thread that made this."""
        return 1e-9 * int(os.pread(self._own, 99, 0).split()[1])

    def others(self) -> float:
        """Of all Python's threads; those that end are left out."""
        here, total = threading.get_native_id(), 0
        living = {one.native_id for one in threading.enumerate()} - {here, None}
        for thread in self._files.keys() - living:
            os.close(self._files.pop(thread))
        for thread in living:
            try:
                if thread not in self._files:
                    self._files[thread] = os.open(f"/proc/self/task/{thread}/schedstat", os.O_RDONLY)
                total += int(os.pread(self._files[thread], 99, 0).split()[1])
            except OSError:  # it has just ended
                continue
        return 1e-9 * total


def watch(server: Any) -> None:
    """Note all that has the loop of a server that is about to start, and tell it at ``/held``."""
    from tornado.web import RequestHandler

    kept: deque[Held] = deque(maxlen=MOST)
    waits = _Queued()
    searched = [0.0, 0.0]  # by all searches for garbage, and when the one under way began

    def searching(phase: str, _: object) -> None:
        if phase == "start":
            searched[1] = time.thread_time()
        else:
            searched[0] += time.thread_time() - searched[1]

    gc.callbacks.append(searching)
    handle: Any = asyncio.events.Handle
    run = handle._run

    def timed(self: Any) -> None:
        began, worked = time.perf_counter(), time.thread_time()
        before = waits.own(), waits.others(), _faults(), searched[0]
        run(self)
        took = time.perf_counter() - began
        if took >= LEAST:
            after = waits.own(), waits.others(), _faults(), searched[0]
            queued, locked, faults, search = (new - old for new, old in zip(after, before, strict=True))
            name = _named(self._callback)
            kept.append(
                Held(name, began, took, time.thread_time() - worked, queued, max(0.0, locked), int(faults), search)
            )

    class Told(RequestHandler):
        def get(self) -> None:
            self.write(json.dumps([astuple(each) for each in kept]))
            kept.clear()

    handle._run = timed
    server._tornado.add_handlers(r".*", [("/held", Told)])


def _faults() -> int:
    return resource.getrusage(resource.RUSAGE_THREAD).ru_majflt


def _named(callback: Any) -> str:
    """Name a callback of the loop; a step of a task by its coroutine."""
    task = getattr(callback, "__self__", None)
    coroutine = task.get_coro() if isinstance(task, asyncio.Task) else None
    while hasattr(callback, "func"):
        callback = callback.func
    found = getattr(coroutine or callback, "__qualname__", "") or type(callback).__name__
    return found.rpartition(".<locals>.")[2]
