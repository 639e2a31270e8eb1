"""Garbage is looked for often, by searches that are short: they leave out what lives for long.

A search through all stops every visitor for 0.1 to 0.4 s, and nearly all that it meets are modules and kernels. These
are taken out of it once they are there (`gc.freeze`), and what formulas have left whenever the last visitor has gone:
what is frozen stays, so nobody may be there. A search then meets what has come since, and what
those hold who are there: 3000 objects, 1 to 3 ms each. What waits for one is memory, 0.6 MB for each visit.
"""

from __future__ import annotations

import gc
import time

EVERY = 1.0  # seconds between looks
QUIET = 0.5  # seconds without a request
REST = 5.0  # seconds without a request or a session's end, after which it looks for what that left, however little
#: Searches through the young after which there is enough for a whole one (objects that stayed: 7000 each, five visits);
#: and beyond which it no longer waits.
SOME, MOST = 1, 2
NEVER = 10**6

_asked = 0.0
_ended = 0.0  # when a session last ended whose garbage has not been looked for; 0 for none
_there = 0  # sessions


def asked() -> None:
    """Note that a visitor waits for an answer."""
    global _asked
    _asked = time.monotonic()


def begun() -> None:
    """Note that a session has begun."""
    global _there
    _there += 1


def ended() -> None:
    """Note that a session has ended: nothing young may come for long that would have its garbage looked for."""
    global _ended, _there
    _ended = time.monotonic()
    _there -= 1


def begin() -> None:
    """Leave out what was there before the first visitor, and let Python's own search keep to the young."""
    gc.set_threshold(*gc.get_threshold()[:2], NEVER)
    keep()


def keep() -> None:
    """Leave out of later searches what lives now."""
    gc.freeze()


def look() -> None:
    """Search if there is enough, or a session has ended, and nobody waits; through all once nobody is there."""
    global _ended
    left, now = gc.get_count()[2], time.monotonic()
    quiet = now - _asked
    resting = bool(_ended) and min(quiet, now - _ended) >= REST
    if not (resting or left >= MOST or (left >= SOME and quiet >= QUIET)):
        return
    if resting:
        _ended = 0.0
    if resting and not _there:
        gc.unfreeze()
        gc.collect()
        keep()
    else:
        gc.collect()
