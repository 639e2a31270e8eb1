"""One process at a time compiles: the others wait, and then find on disk what it has compiled."""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from numba.core import config as numba_config

import codim2_core

config: Any = numba_config  # its names are made at run time


def lock_path() -> Path:
    """Return the file that stands for the folder of compiled kernels, and is held by whoever compiles into it."""
    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = f"{config.CACHE_DIR} {codim2_core.__file__} {sys.version}"
    return Path(tempfile.gettempdir()) / f"codim2-{user}-{hashlib.sha256(folder.encode()).hexdigest()[:16]}.lock"


@contextmanager
def alone() -> Iterator[None]:
    """Wait for other processes that compile into the same folder, and let them wait; where that cannot be, go on.

    Within it nothing waits for another thread of this process that wants it too.
    """
    try:
        import fcntl

        held = os.open(lock_path(), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except (ImportError, OSError):  # Windows; a machine without a folder for such files
        yield
        return
    try:
        fcntl.flock(held, fcntl.LOCK_EX)
        yield
    finally:
        os.close(held)
