"""Another worker of a page computes what takes long: calls as bytes, there and back, while this one answers frames.

Until the other worker has come, and on a device without a processor for it, calls run here between two messages.
"""

from __future__ import annotations

import pickle
import sys
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, Executor, Future
from functools import partial
from itertools import count
from typing import Any

from ...picture.frame.background_results import Scheduler
from ...picture.phrases import say


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


#: Seconds after which work is stopped: others wait for it.
MAX_WORK_SECONDS = 10.0


class OtherWorker(Executor):
    """Runs what it is given in another worker; in a later task of this thread while there is none.

    Parameters
    ----------
    later : Scheduler
    """

    def __init__(self, later: Scheduler) -> None:
        self._later = later
        self._load: Callable[[], Any] | None = None
        self._post: Callable[[int, bytes], Any] | None = None
        self._numbers, self._out = count(1), dict[int, Future[Any]]()

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Have ``fn(*args, **kwargs)`` run; after `MAX_WORK_SECONDS` its future has TimeoutError."""
        load, self._load = self._load, None
        if load is not None:
            load()
        future: Future[Any] = Future()
        if self._post is None:
            self._later(partial(_run, future, partial(fn, *args, **kwargs)))
            return future
        future.set_running_or_notify_cancel()
        number = next(self._numbers)
        self._out[number] = future
        self._post(number, pickle.dumps((fn, args, kwargs)))
        return future

    def load_with(self, load: Callable[[], Any]) -> None:
        """Have another worker loaded by this function once there is something to compute; it is to `meet` this."""
        self._load = load

    def meet(self, post: Callable[[int, bytes], Any]) -> None:
        """Send calls, by number, to a worker that has come, which answers by `run_call`."""
        self._post = post

    def hear(self, number: int, answer: bytes) -> None:
        """Take what `run_call` has returned there."""
        result, error = pickle.loads(answer)
        future = self._out.pop(number)
        if error is None:
            future.set_result(result)
        else:
            future.set_exception(error)

    def lose(self) -> None:
        """Do without the other worker, which has ended."""
        self._post = None
        for number in tuple(self._out):
            self._out.pop(number).set_exception(BrokenExecutor())


def run_call(call: bytes) -> bytes:
    """Run a call that `OtherWorker` has sent, and return what it is to hear."""
    fn, args, kwargs = pickle.loads(call)
    future: Future[Any] = Future()
    _run(future, partial(fn, *args, **kwargs))
    error = future.exception()
    return pickle.dumps((None, error) if error else (future.result(), None))


def _run(future: Future[Any], call: Callable[[], Any]) -> None:
    if not future.set_running_or_notify_cancel():
        return
    try:
        result = call_within(MAX_WORK_SECONDS, call)
    except TimeoutError:
        future.set_exception(TimeoutError(say("stopped after", seconds=MAX_WORK_SECONDS)))
    except Exception as error:  # whoever waits has it
        future.set_exception(error)
    else:
        future.set_result(result)
