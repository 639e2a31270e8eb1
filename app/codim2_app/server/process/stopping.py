"""Stopping when the platform asks: a container is sent SIGTERM, and killed after its grace."""

from __future__ import annotations

import asyncio
import os
import signal
import threading

GRACE = 4.0  # seconds for what is under way; platforms kill after ten


def stop_when_asked() -> None:
    """Let SIGTERM and Ctrl+C stop the loop of this process, and end it after `GRACE` seconds at the latest.

    Where no loop runs they interrupt it. Without this the first process of a container ignores SIGTERM: the kernel
    gives process 1 no default.
    """

    def stop(*_: object) -> None:
        late = threading.Timer(GRACE, os._exit, (0,))  # a panel's job may be under way in a thread
        late.daemon = True
        late.start()
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            raise KeyboardInterrupt from None
        loop.call_soon_threadsafe(loop.stop)  # an exception here would be one of whatever handler runs

    for asked in (signal.SIGTERM, signal.SIGINT):
        signal.signal(asked, stop)
