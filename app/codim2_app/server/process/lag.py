"""The lag of the loop: it rises with whatever keeps a process from answering."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable

from tornado.ioloop import IOLoop

#: Seconds between two probes, and for which the worst of them counts.
PROBE_SECONDS, MEMORY_SECONDS = 0.25, 5.0


class LoopLag:
    """The lag of a loop, probed while it runs.

    Parameters
    ----------
    observe : callable
        Called with the seconds by which each probe was late.
    """

    def __init__(self, observe: Callable[[float], object]) -> None:
        self._observe = observe
        self._late: deque[tuple[float, float]] = deque()  # when, and how much
        self._due = time.monotonic() + PROBE_SECONDS

    def begin(self) -> None:
        """Probe from now on, in the loop that runs."""
        self._due = time.monotonic() + PROBE_SECONDS
        IOLoop.current().call_later(PROBE_SECONDS, self._probe)

    def _probe(self) -> None:
        now = time.monotonic()
        self._late.append((now, now - self._due))
        self._observe(max(0.0, now - self._due))
        while self._late[0][0] < now - MEMORY_SECONDS:
            self._late.popleft()
        self.begin()

    @property
    def worst(self) -> float:
        """Seconds by which the loop was late at most in the last few, with the probe that is due now."""
        now = time.monotonic()
        return max(now - self._due, 0.0, *(late for when, late in self._late if when >= now - MEMORY_SECONDS))
