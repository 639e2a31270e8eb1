"""A process of its own for each mutant: forked, bounded in time and memory, and pytest within it."""

from __future__ import annotations

import os
import resource
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

TESTS = Path(__file__).parents[1]
ROOT = TESTS.parent
# Seconds of processor time on a machine that does `_work` in PACE: `slow` times as many on this one.
PACE = 3.2e-3
# A test that takes longer than FIRST and three times what it takes as it is has noticed a mutant that loops.
FIRST = 3.0
MEMORY = 3 << 30
UNFIT = 77  # exit code


def preload() -> None:
    """Import what every run needs and no mutant changes."""
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):
        os.environ[name] = "1"
    os.environ["CI"] = "1"  # the same examples in every run
    import hypothesis
    import mpmath  # noqa: F401
    import numba  # noqa: F401
    import numpy  # noqa: F401
    import scipy.integrate
    import scipy.optimize  # noqa: F401

    # A failure is all that is asked for: no smaller example of it, no memory of it.
    phases = (hypothesis.Phase.explicit, hypothesis.Phase.generate)
    hypothesis.settings.register_profile("mutation", deadline=None, derandomize=True, database=None, phases=phases)


def settle() -> None:
    """Wait for threads that compile: a fork has not got them, and keeps for ever a lock that one of them holds."""
    for thread in threading.enumerate():
        if thread.name.startswith("codim2-compile"):
            thread.join()


def forked(do: Callable[[], int], seconds: float) -> str:
    """Run this in a fork; "passed" if it returns 0, "afresh" if UNFIT, "timeout" if late, else "failed"."""
    settle()
    child = os.fork()
    if child == 0:
        code = 3
        try:
            os.setpgid(0, 0)
            own = resource.getrusage(resource.RUSAGE_SELF)
            spent = own.ru_utime + own.ru_stime
            most = int(spent + seconds) + 1
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
            size = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
            resource.setrlimit(resource.RLIMIT_AS, (size + MEMORY, size + MEMORY))
            signal.signal(signal.SIGXCPU, signal.SIG_DFL)
            code = do()
        finally:
            os._exit(code)
    end = time.monotonic() + 60.0 + 30.0 * seconds  # a mutant that waits for ever
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            code = os.waitstatus_to_exitcode(status)
            late = {-signal.SIGXCPU: "timeout", -signal.SIGPROF: "timeout", -signal.SIGKILL: "timeout"}
            return {0: "passed", UNFIT: "afresh", **late}.get(code, "failed")
        time.sleep(0.002)
    os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return "timeout"


def pytest_main(tests: tuple[str, ...], plugins: list[Any], says: str | Path = os.devnull) -> int:
    """Run pytest in this process; what it says goes into a file."""
    file = os.open(says, os.O_WRONLY | os.O_CREAT)
    os.dup2(file, 1)
    os.dup2(file, 2)
    options = ["-x", "-q", "-n0", "-p", "no:cacheprovider", "--hypothesis-profile=mutation", "--rootdir", str(ROOT)]
    options += ["--tb=native", "-W", "ignore::pytest.PytestAssertRewriteWarning"]  # hypothesis is loaded already
    return int(pytest.main([*options, *(str(TESTS / test) for test in tests)], plugins=plugins))


def _work() -> float:
    start = time.process_time()
    sum(i * i for i in range(100_000))
    return time.process_time() - start


def slow() -> float:
    """How many times slower this machine is, loaded as it is now."""
    return max(1.0, min(_work() for _ in range(3)) / PACE)
