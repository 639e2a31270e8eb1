"""A process that compiles kernels for a server or a notebook, whose own memory and time that would take."""

from __future__ import annotations

import logging
import os
import signal
import subprocess
import sys
import threading

from codim2_core.formulas.jit import numba_kernels, policy

from . import once, steps

#: How far it stands back behind those that answer.
NICE = 5
CODE = f"from {__name__} import compile_for_parent; compile_for_parent()"


class CompilerProcess:
    """A process that compiles for all that share the folder of kernels, one at a time on a machine.

    Attributes
    ----------
    process : Popen or None
        That which was begun here; it ends with this process, as what it reads then ends.
    """

    def __init__(self) -> None:
        self.process: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Begin it, unless there is one."""
        held = once.try_lock(exclusive=True)
        if held == once.BUSY:
            return
        environment = {**os.environ, "NUMBA_CACHE_LOCATOR_CLASSES": once.config.CACHE_LOCATOR_CLASSES}
        environment["PYTHONPATH"] = os.pathsep.join(path or os.getcwd() for path in sys.path)
        kept = () if held is None else (held,)
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-c", CODE], stdin=subprocess.PIPE, env=environment, pass_fds=kept
        )
        if held is not None:
            os.close(held)  # it holds the lock as long as it lives

    def has_ended(self) -> bool:
        """Whether it was begun here, and is no longer there."""
        return self.process is not None and self.process.poll() is not None

    def is_at_work(self) -> bool:
        """Whether there is one, begun here or elsewhere."""
        held = once.try_lock(exclusive=False)
        if held is None:
            return self.process is not None and self.process.poll() is None
        if held == once.BUSY:
            return True
        os.close(held)
        return False


def compile_for_parent() -> None:
    """Compile all kernels into the disk cache, as a process of its own that ends with the one that has begun it.

    Each step is compiled by a process that is forked for it, where there is fork: the memory that it takes is given
    back, and of two processes that compile at once one waits.
    """
    if hasattr(os, "nice"):
        os.nice(NICE)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C in a terminal reaches all: it ends with who has begun it
    _end_with_parent()
    logging.getLogger(numba_kernels.__name__).setLevel(logging.ERROR)  # who has begun it tells its progress
    once.install()
    policy.choose_way(policy.COMPILE)
    if not hasattr(os, "fork"):
        steps.warm_all()
        return
    for _, make_ in steps.kernel_steps():
        child = os.fork()
        if child == 0:
            _end_with_parent()
            try:
                with once.alone():
                    make_()
            except OSError:  # nothing can be kept: who has begun it does without
                os._exit(1)
            os._exit(0)
        if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]):
            sys.exit(1)


def _end_with_parent() -> None:
    """End this process when that which has begun it has ended: its end of the pipe is closed then."""

    def wait_for_end() -> None:
        os.read(0, 1)
        os._exit(1)

    threading.Thread(target=wait_for_end, daemon=True).start()
