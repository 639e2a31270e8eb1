"""Compiled kernels on disk: found where they are, also where nothing may be written; without them all goes on, slower.

Numba refuses to load a module whose cache it cannot write, and fails when the disk is full. A container with a
read-only root, another user, no home or a full disk is no reason to show nobody anything.
"""

from __future__ import annotations

import logging
import os
from functools import cache
from pathlib import Path
from typing import Any

from numba.core import caching
from numba.core import config as numba_config

import codim2_core

config: Any = numba_config  # its names are made at run time

UNCACHED = "the compiled kernels cannot be kept on disk ({why}): what is not there yet is compiled anew at every start."


class AsItIs(caching.InTreeCacheLocator):
    """The cache as it is, read and never made: in NUMBA_CACHE_DIR, else beside the modules."""

    def __init__(self, py_func: Any, py_file: str) -> None:
        super().__init__(py_func, py_file)
        if config.CACHE_DIR:
            self._cache_path = caching.UserProvidedCacheLocator(py_func, py_file).get_cache_path()

    def ensure_cache_path(self) -> None:
        """Leave the folder alone."""


@cache
def prepare() -> str:
    """Let kernels be loaded whatever can be written; return a sentence if nothing can, or "".

    Called before the first kernel is imported, in every process.
    """
    save = caching.FunctionCache.save_overload

    def saved_if_possible(self: Any, sig: Any, data: Any) -> None:
        try:
            save(self, sig, data)
        except OSError as error:
            _say_once(UNCACHED.format(why=error.strerror))

    caching.FunctionCache.save_overload = saved_if_possible
    given = Path(config.CACHE_DIR) if config.CACHE_DIR else None
    if given is not None and given.is_dir() and not os.access(given, os.W_OK):
        # Numba would go on to the home, where nothing is, though the host has warmed this folder
        config.CACHE_LOCATOR_CLASSES = f"{__name__}.{AsItIs.__name__}"
        return "" if next(given.rglob("*.nbi"), None) else UNCACHED.format(why=f"{given} cannot be written")
    module = str(Path(codim2_core.__file__))
    if config.CACHE_LOCATOR_CLASSES or any(
        locator.from_function(prepare.__wrapped__, module)
        for locator in caching.CacheImpl._locator_classes[:3]  # noqa: SLF001
    ):
        return ""
    config.CACHE_LOCATOR_CLASSES = f"{__name__}.{AsItIs.__name__}"
    return UNCACHED.format(why="no folder for them can be written")


@cache
def _say_once(sentence: str) -> None:
    logging.getLogger(__name__).warning(sentence)
