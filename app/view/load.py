"""How busy this process is, which tells browsers far away whether a second request on its way would wait here."""

from __future__ import annotations

import time

#: Seconds over which the load is measured.
SPAN = 0.25


class Load:
    """The share of its time that the thread which answers is at work, over the last quarter of a second or more."""

    def __init__(self) -> None:
        self.share = 0.0
        self._since = time.perf_counter(), time.thread_time()

    def measured(self) -> float:
        """Return the share, 0 to 1; called with every frame, by the thread that makes it."""
        now = time.perf_counter(), time.thread_time()
        passed = now[0] - self._since[0]
        if passed >= SPAN:
            self.share = round(min(1.0, max(0.0, (now[1] - self._since[1]) / passed)), 2)
            self._since = now
        return self.share


#: Of this process: its thread answers for all sessions.
load = Load()
