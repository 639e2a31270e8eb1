"""What was freed goes back to the system: the C library would keep all that was ever needed at once, in pieces.

Between two pieces of what lives it keeps what is free, for whoever asks next. Over a thousand visits that grew to
100 MB: what a visit asks for seldom fits what others have left.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache
from typing import Any


def give_back() -> None:
    """Give back the pages in which nothing lives: a millisecond."""
    _trim()(0)


@cache
def _trim() -> Callable[[int], Any]:
    """Return glibc's function for it; elsewhere nothing is done."""
    try:
        return ctypes.CDLL(None).malloc_trim
    except (AttributeError, OSError, TypeError):
        return lambda _: None
