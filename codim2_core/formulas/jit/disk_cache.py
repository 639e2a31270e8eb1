"""Compiled kernels on disk: found where they are, also where nothing may be written; without them all goes on, slower.

Numba refuses to load a module whose cache it cannot write, and fails when the disk is full. A container with a
read-only root, another user, no home or a full disk is no reason to compute nothing.
"""

from __future__ import annotations

import logging
from functools import cache
from pathlib import Path
from typing import Any

from numba.core import caching
from numba.core import config as numba_config

from .stamps import CORE_FOLDER

config: Any = numba_config  # its names are made at run time

UNCACHED = "the compiled kernels cannot be kept on disk ({why}): what is not there yet is compiled anew at every start."


class AsGiven(caching.UserProvidedCacheLocator):
    """The folder in NUMBA_CACHE_DIR as it is, where it cannot be written: read, and never made."""

    def ensure_cache_path(self) -> None:
        """Leave the folder alone; without one, let the next locator answer."""
        if not Path(config.CACHE_DIR).is_dir():
            raise FileNotFoundError(config.CACHE_DIR)


class AsItIs(caching.InTreeCacheLocator):
    """A cache locator for read-only installations: it reads the index next to the modules, and never writes."""

    def ensure_cache_path(self) -> None:
        """Leave the folder alone."""


def _locators() -> list[type[Any]]:
    """Return Numba's locators, in the order in which it asks them, with those that only read.

    A folder that the host has warmed comes before a home that can be written, where nothing is.
    """
    first, *others = caching.CacheImpl._locator_classes  # noqa: SLF001 (Numba hands out no other way to them)
    return [first, AsGiven, *others, AsItIs]


@cache
def prepare() -> str:
    """Let kernels be loaded whatever can be written; return a sentence if nothing can be kept, else "".

    Called before the first kernel is declared.
    """
    save = caching.FunctionCache.save_overload

    def saved_if_possible(self: Any, sig: Any, data: Any) -> None:
        try:
            save(self, sig, data)
        except OSError as error:
            _say_once(UNCACHED.format(why=error.strerror))

    load = caching.IndexDataCacheFile._load_index  # noqa: SLF001 (it has no public name)

    def loaded_if_possible(self: Any) -> dict[Any, Any]:
        try:
            return load(self)
        except (ImportError, AttributeError):  # of an older version of this package, where a type had another home
            return {}

    caching.FunctionCache.save_overload = saved_if_possible
    caching.IndexDataCacheFile._load_index = loaded_if_possible  # noqa: SLF001
    if config.CACHE_LOCATOR_CLASSES:
        return ""  # the host has named its own
    locators = _locators()
    config.CACHE_LOCATOR_CLASSES = ",".join(f"{one.__module__}.{one.__name__}" for one in locators)
    package = str(CORE_FOLDER / "__init__.py")
    found = next(one for locator in locators if (one := locator.from_function(prepare.__wrapped__, package)))
    if isinstance(found, AsItIs):
        return UNCACHED.format(why="no folder for them can be written")
    if isinstance(found, AsGiven) and not next(Path(config.CACHE_DIR).rglob("*.nbi"), None):
        return UNCACHED.format(why=f"{config.CACHE_DIR} cannot be written")
    return ""


@cache
def _say_once(sentence: str) -> None:
    logging.getLogger(__name__).warning(sentence)
