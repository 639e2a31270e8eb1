"""The load of this process, by which far-away browsers decide whether to send a second request ahead."""

from __future__ import annotations

import time
from pathlib import Path

#: Seconds over which the load is measured.
MIN_MEASURED_SECONDS = 0.25

_STATISTICS = Path("/proc/thread-self/schedstat")


def processor_seconds() -> float:
    """Return the seconds that this thread has run or, where the system tells it, has waited for a processor to run."""
    try:
        running, waiting, _ = _STATISTICS.read_text().split()
    except (OSError, ValueError):
        return getattr(time, "thread_time", time.perf_counter)()  # a browser does not tell the first
    return 1e-9 * (int(running) + int(waiting))


class Load:
    """The share of its time that the thread which answers has work, over the last quarter of a second or more."""

    def __init__(self) -> None:
        self.share = 0.0
        self._since = time.perf_counter(), processor_seconds()

    def measure(self) -> float:
        """Return the share, 0 to 1; called with every frame, by the thread that makes it."""
        now = time.perf_counter()
        passed = now - self._since[0]
        if passed >= MIN_MEASURED_SECONDS:
            work = processor_seconds()
            self.share = round(min(1.0, max(0.0, (work - self._since[1]) / passed)), 2)
            self._since = now, work
        return self.share


#: Of this process: its thread answers for all sessions.
load = Load()
