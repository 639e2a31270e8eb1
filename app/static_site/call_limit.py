"""A limit of time for what a thread computes where there are no signals, kept between two calls of functions."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager


class _OutOfTime(BaseException):
    """Passes those who handle errors."""


@contextmanager
def at_most(seconds: float) -> Iterator[None]:
    """Raise TimeoutError at the first call or return of a function, or of a kernel, after so many seconds."""
    end = time.perf_counter() + seconds

    def check(*_: object) -> None:
        if time.perf_counter() > end:
            sys.setprofile(None)
            raise _OutOfTime

    sys.setprofile(check)
    try:
        yield
    except _OutOfTime:
        raise TimeoutError from None
    finally:
        sys.setprofile(None)
