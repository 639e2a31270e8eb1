"""A limit of time for what a thread computes where there are no signals, kept between two calls of functions."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any


class _OutOfTime(BaseException):
    """Passes those who handle errors."""


def call_within(seconds: float, function: Callable[[], Any]) -> Any:
    """Return what a function returns.

    Raises
    ------
    TimeoutError
        After so many seconds another function was called, or returned.
    """
    end = time.perf_counter() + seconds

    def check(_frame: object, event: str, _argument: object) -> None:
        if event in ("call", "return") and time.perf_counter() > end:
            sys.setprofile(None)
            raise _OutOfTime

    sys.setprofile(check)
    try:
        return function()
    except _OutOfTime:
        raise TimeoutError from None
    finally:
        sys.setprofile(None)
