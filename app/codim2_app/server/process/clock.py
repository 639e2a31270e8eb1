"""The clock of the loop: one that nobody sets.

Tornado's own is the machine's. Where that is set back by an hour, as on a machine that learns the time only after its
start, all that comes at intervals (signs of life to pages, what looks after rooms) comes an hour late.
"""

from __future__ import annotations

import time

from tornado.ioloop import IOLoop


def keep_steady(loop: IOLoop) -> None:
    """Let a loop tell its intervals by a clock that only goes on; before anything has been begun by it."""
    loop.time = time.monotonic  # type: ignore[method-assign]  # all of Tornado's deadlines read it
