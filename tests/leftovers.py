"""No test leaves a process behind: what the suite started is counted when it ends, and fails it.

A port is held by a process: where none is left, no port is taken.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

#: In the environment of all that a run starts, whoever its parent is by then; its value is the process of the run.
MARK = "CODIM2_TEST_RUN"
#: Seconds that a process, told to end, may take: a browser writes its profile, a worker ends what it computes.
PATIENCE = 30.0


def running(mark: str) -> list[str]:
    """Return the processes of a run, as ``PID command``; none where there is no /proc.

    Without this one, and without those of Python's own that end with it.
    """
    found, wanted = [], f"{MARK}={mark}".encode()
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            if wanted in (folder / "environ").read_bytes().split(b"\0") and folder.name != str(os.getpid()):
                words = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace").split()
                # without words it has ended, and nobody has asked how
                if words and not (parent(folder) == os.getpid() and "multiprocessing" in " ".join(words)):
                    found.append(f"{folder.name} {' '.join(words)[:200]}")
        except OSError:  # ended meanwhile, or another user's
            continue
    return found


def parent(folder: Path) -> int:
    """Return the process that started one."""
    return int((folder / "stat").read_text().rpartition(")")[2].split()[1])


def pytest_sessionstart() -> None:
    """Mark all processes that this run will start."""
    if "PYTEST_XDIST_WORKER" not in os.environ:
        os.environ[MARK] = str(os.getpid())


@pytest.hookimpl(wrapper=True)
def pytest_sessionfinish(session: pytest.Session) -> Iterator[None]:
    """Let a run fail that leaves a process behind."""
    yield
    if "PYTEST_XDIST_WORKER" in os.environ or not (mark := os.environ.pop(MARK, "")):
        return
    end = time.monotonic() + PATIENCE
    while (left := running(mark)) and time.monotonic() < end:
        time.sleep(0.1)
    if left:
        print("\nThese processes were left behind:", *left, sep="\n  ")
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
