"""Compile the integrator in the background, once for each process."""

from __future__ import annotations

import threading

from codim2_core.trajectories import is_warm, warm

_lock = threading.Lock()
_thread: threading.Thread | None = None


def start() -> None:
    """Begin compiling (or loading from the cache) in a background thread; further calls do nothing."""
    global _thread
    with _lock:
        if _thread is None and not is_warm():
            _thread = threading.Thread(target=warm, name="codim2-warm-up", daemon=True)
            _thread.start()


def is_ready() -> bool:
    """Say whether trajectories can be drawn without waiting for the compiler.

    If compiling failed, trajectories are asked for all the same, so that their error is seen.
    """
    return is_warm() or (_thread is not None and not _thread.is_alive())
