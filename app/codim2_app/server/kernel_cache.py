"""Compiled kernels on disk, for servers: one process compiles for all, and the server tells its own progress."""

from __future__ import annotations

import logging
from functools import cache

from codim2_core.formulas.jit import disk_cache, numba_kernels, policy

from ..view.compiling import once


@cache
def prepare() -> str:
    """Let one of several processes compile; return a sentence if no kernel can be kept on disk, else ""."""
    once.install()
    logging.getLogger(numba_kernels.__name__).setLevel(logging.ERROR)  # a server tells its own progress
    return disk_cache.prepare()


def begin_early() -> None:
    """Let kernels of a worker be loaded as they appear on disk, and run as Python until then."""
    from ..view.compiling.process import CompilerProcess  # late: it imports kernels

    prepare()
    policy.leave_to(CompilerProcess().is_at_work)
