"""Work counted, not timed, and waiting for what happens: the same on a busy machine and under a profiler."""

from __future__ import annotations

import asyncio
import gc
import sys
import time
from collections.abc import Callable, Coroutine
from concurrent.futures import ThreadPoolExecutor
from typing import Any, TypeVar

T = TypeVar("T")
#: Seconds that a test waits for anything: five times what a worker may take, as where other work has the machine.
PATIENCE = 300.0


def talk(doing: Coroutine[Any, Any, T]) -> T:
    """Run a coroutine in a thread of its own: Playwright's loop may be running in this one."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, doing).result()


def wait_until(condition: Callable[[], T], patience: float = PATIENCE) -> T:
    """Wait until a condition holds, at most that many seconds; return what it is in the end."""
    end = time.monotonic() + patience
    while not (found := condition()) and time.monotonic() < end:
        time.sleep(0.01)
    return found


def calls(do: Callable[[], object]) -> int:
    """Run something, and return how many functions it entered, Python's and C's (compiled kernels count as none)."""
    entered = 0

    def note(frame, event, argument):
        nonlocal entered
        entered += event in ("call", "c_call")
        if before is not None:
            before(frame, event, argument)

    before, collecting = sys.getprofile(), gc.isenabled()
    gc.disable()  # finalisers of earlier tests are not this one's work
    sys.setprofile(note)
    try:
        do()
    finally:
        sys.setprofile(before)
        if collecting:
            gc.enable()
    return entered
