"""Let one of several processes compile a kernel; the others wait for it, and load the result.

Numba asks the disk before it compiles, but processes that begin together, as servers behind one port or those that
share the tests, all find nothing, and each compiles everything.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import zlib
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache, wraps
from pathlib import Path
from typing import Any

from numba.core import caching, compiler_lock
from numba.core import config as numba_config
from numba.core.ccallback import CFunc
from numba.core.dispatcher import Dispatcher

import codim2_core

BUSY = -1  # in place of a file that another process holds

_one_thread: Any = compiler_lock.global_compiler_lock
config: Any = numba_config  # its names are made at run time


def lock_path() -> Path:
    """Return the file that stands for the folder of compiled kernels, and is held by whoever compiles into it.

    It is in that folder if one is named and can be written, and goes with it; else in the machine's temporary one.
    """
    user = os.getuid() if hasattr(os, "getuid") else 0
    folder = f"{config.CACHE_DIR} {codim2_core.__file__} {sys.version}"
    name = f"codim2-{user}-{hashlib.sha256(folder.encode()).hexdigest()[:16]}.lock"
    return Path(_own_folder() or tempfile.gettempdir()) / name


def _own_folder() -> str:
    """Return the folder of kernels that is named, made if it is not there; "" if nothing can be written there."""
    if config.CACHE_DIR:
        with suppress(OSError):
            os.makedirs(config.CACHE_DIR, exist_ok=True)
            return config.CACHE_DIR if os.access(config.CACHE_DIR, os.W_OK) else ""
    return ""


@contextmanager
def alone() -> Iterator[None]:
    """Wait for other processes that compile into the same folder, and let them wait; where that cannot be, go on.

    Within it nothing waits for another thread of this process that wants it too.
    """
    with ExitStack() as held:
        with suppress(ImportError, OSError):  # Windows; no folder for such files; a file system without locks
            import fcntl

            file = os.open(lock_path(), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
            held.callback(os.close, file)
            fcntl.flock(file, fcntl.LOCK_EX)
        yield


@cache
def install() -> None:
    """Let all that is compiled from now on, and kept on disk, be compiled by one process."""
    for kind in (Dispatcher, CFunc):
        kind.compile = once(kind.compile)


def once(compile_: Callable[..., Any]) -> Callable[..., Any]:
    """Return Numba's method with its search on disk, the compiling and what is kept done by one process at a time.

    The one thread that compiles in this process waits. It holds none but the functions that call the one that it waits
    for, and none calls itself by others: no two processes wait for each other.
    """

    @wraps(compile_)
    def compile_once(self: Any, *signature: Any) -> Any:
        if not isinstance(self._cache, caching.FunctionCache):  # nothing of it is kept
            return compile_(self, *signature)
        with _one_thread, hold_name(f"{self._cache.cache_path} {self.__qualname__}"):
            return compile_(self, *signature)

    return compile_once


@contextmanager
def hold_name(name: str) -> Iterator[None]:
    """Wait for other processes that hold this name, and let them wait; where that cannot be, go on.

    A name is a byte of one file: what two names share by chance is compiled one after the other.
    """
    try:
        import fcntl

        file, byte = _open_lock(lock_path().with_suffix(".kernels")), zlib.crc32(name.encode())
        fcntl.lockf(file, fcntl.LOCK_EX, 1, byte)
    except (ImportError, OSError):  # Windows; no folder for such files; a file system without locks
        yield
        return
    try:
        yield
    finally:
        fcntl.lockf(file, fcntl.LOCK_UN, 1, byte)


@cache
def _open_lock(path: Path) -> int:
    """Return the file, open for as long as the process lives: closing it would give up all that is held of it."""
    return os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)


def try_lock(exclusive: bool) -> int | None:
    """Lock the file that stands for the process that compiles; return it, `BUSY`, or None where there are no locks."""
    try:
        import fcntl

        held = os.open(lock_path().with_suffix(".compiler"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    except (ImportError, OSError):  # as above
        return None
    try:
        fcntl.flock(held, (fcntl.LOCK_EX if exclusive else fcntl.LOCK_SH) | fcntl.LOCK_NB)
    except OSError as error:
        os.close(held)
        return BUSY if isinstance(error, BlockingIOError) else None
    return held
