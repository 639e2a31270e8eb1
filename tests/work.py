"""Work counted, not timed: the same on a busy machine, a slow one, and under a profiler."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable


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
