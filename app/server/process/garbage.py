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
REST = 5.0  # seconds without a request or a session's end, after which it looks for what that left, however little
#: Searches through the young after which there is enough for a whole one (objects that stayed: 7000 each); and beyond
#: which it no longer waits.
SOME, MOST = 10, 25
NEVER = 10**6

_asked = 0.0
_ended = 0.0  # when a session last ended whose garbage has not been looked for; 0 for none


def asked() -> None:
    """Note that a visitor waits for an answer."""
    global _asked
    _asked = time.monotonic()


def ended() -> None:
    """Note that a session has ended: nothing young may come for long that would have its garbage looked for."""
    global _ended
    _ended = time.monotonic()


def keep_to_the_young() -> None:
    """Let Python's own search leave out what has lived for long."""
    gc.set_threshold(*gc.get_threshold()[:2], NEVER)


def look() -> None:
    """Search through all if there is enough, or a session has ended, and nobody waits."""
    global _ended
    left, now = gc.get_count()[2], time.monotonic()
    quiet = now - _asked
    if left >= MOST or (left >= SOME and quiet >= QUIET) or (_ended and min(quiet, now - _ended) >= REST):
        _ended = 0.0
        gc.collect()
