"""Garbage is looked for while nobody waits.

A search through all that lives takes 0.1 to 0.3 s once a few formulas have been compiled, and stops every visitor
meanwhile. So Python's own search keeps to what is young, and the whole one waits until nobody has asked for a while.
(What formulas leave cannot be taken out of it by `gc.freeze`: a connection that is just opened would stay for good.)
"""

from __future__ import annotations

import gc
import time

EVERY = 1.0  # seconds between looks
QUIET = 0.5  # seconds without a request
#: Searches through the young after which there is enough for a whole one (objects that stayed: 7000 each); and beyond
#: which it no longer waits.
SOME, MOST = 10, 25
NEVER = 10**6

_asked = 0.0


def asked() -> None:
    """Note that a visitor waits for an answer."""
    global _asked
    _asked = time.monotonic()


def keep_to_the_young() -> None:
    """Let Python's own search leave out what has lived for long."""
    gc.set_threshold(*gc.get_threshold()[:2], NEVER)


def look() -> None:
    """Search through all if there is enough and nobody waits."""
    left = gc.get_count()[2]
    if left >= MOST or (left >= SOME and time.monotonic() - _asked >= QUIET):
        gc.collect()
