"""Stopping when the platform asks: a container is sent SIGTERM, and killed after its grace."""

from __future__ import annotations

import os
import signal
import threading

GRACE = 4.0  # seconds for what is under way; platforms kill after ten


def stop_when_asked() -> None:
    """Let SIGTERM interrupt this process as Ctrl+C does, and end it after `GRACE` seconds at the latest.

    Without this the first process of a container ignores SIGTERM: the kernel gives process 1 no default.
    """

    def stop(*_: object) -> None:
        late = threading.Timer(GRACE, os._exit, (0,))  # a panel's job may be under way in a thread
        late.daemon = True
        late.start()
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, stop)
