"""A limit of processor time for what one process computes, kept between two instructions of the interpreter."""

from __future__ import annotations

import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from numba.core import event
from numba.core.compiler_lock import global_compiler_lock

#: Seconds of processor time after which an alarm that was not heard comes again.
ALARM_INTERVAL_SECONDS = 0.05


class CompileClock(event.Listener):
    """A clock of the time in which this thread compiled kernels: it is not counted against a formula.

    Numba tells every listener of what any thread compiles.
    """

    def __init__(self) -> None:
        self._thread = threading.get_ident()
        self._depth = 0  # one kernel compiles those that it calls
        self._since = self._seconds = 0.0

    def on_start(self, event: event.Event) -> None:  # noqa: ARG002 (Numba gives it)
        """Begin to count."""
        if threading.get_ident() != self._thread:
            return
        if self._depth == 0:
            self._since = time.thread_time()
        self._depth += 1

    def on_end(self, event: event.Event) -> None:  # noqa: ARG002 (Numba gives it)
        """Stop counting."""
        if threading.get_ident() != self._thread:
            return
        self._depth -= 1
        if self._depth == 0:
            self._seconds += time.thread_time() - self._since

    @property
    def seconds(self) -> float:
        """Seconds of processor time, that of a compilation under way included."""
        return self._seconds + (time.thread_time() - self._since if self._depth else 0.0)


@contextmanager
def at_most(seconds: float, compiling: CompileClock | None = None) -> Iterator[None]:
    """Raise TimeoutError after so many seconds of processor time, between kernels, in the main thread of a process.

    What is compiled meanwhile does not count; the clock that is given tells it.
    """
    if threading.current_thread() is not threading.main_thread() or not hasattr(signal, "setitimer"):
        yield
        return
    began = time.thread_time()
    compiling = CompileClock() if compiling is None else compiling

    def stop(*_: object) -> None:
        # Not while this thread holds the compiler's lock: what is raised as it is taken leaves it taken for ever.
        if not global_compiler_lock.is_locked() and time.thread_time() - began - compiling.seconds >= seconds:
            raise TimeoutError

    def report_unraisable(found: Any) -> None:
        # The interpreter drops what is raised in a callback of its garbage collector. That alarm is not a fault.
        if found.exc_type is not TimeoutError:
            hook(found)

    hook, sys.unraisablehook = sys.unraisablehook, report_unraisable
    before = signal.signal(signal.SIGPROF, stop)  # processor time: a busy machine is not the formula's fault
    try:
        try:
            with event.install_listener("numba:compile", compiling):
                signal.setitimer(signal.ITIMER_PROF, seconds, ALARM_INTERVAL_SECONDS)
                yield
        finally:
            signal.setitimer(signal.ITIMER_PROF, 0.0)
    finally:  # also if the alarm came on the line before
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
        sys.unraisablehook = hook
