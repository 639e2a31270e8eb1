"""Compiled kernels on disk: found where they are, also where nothing may be written; without them all goes on, slower.

Numba refuses to load a module whose cache it cannot write, and fails when the disk is full. A container with a
read-only root, another user, no home or a full disk is no reason to compute nothing.

Stamps of what a kernel on disk was compiled from.

Numba keeps a compiled kernel next to its module, under a digest of that one file; but what a kernel calls, and
the constants that it reads, are compiled into it from other modules. Here a kernel is out of date when the text of any
module of this package changes that its own imports, itself or through others: after an upgrade in place, or in another
branch, nobody runs yesterday's formulas.
"""

from __future__ import annotations

import logging
import re
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

from numba.core import caching
from numba.core import config as numba_config

CORE_FOLDER = Path(__file__).parents[2]
IMPORT = re.compile(r"^ *from (\.+)([\w.]*) import (?:\(([^)]*)\)|(.*))$", re.MULTILINE)  # a relative one


@cache
def source_stamp(path: Path, root: Path = CORE_FOLDER) -> str:
    """Return a digest of the text of a module and of all modules below a folder that it imports, directly or not."""
    reached, waiting = set[Path](), [path]
    while waiting:
        here = waiting.pop()
        if here not in reached:
            reached.add(here)
            waiting.extend(_read_module(here, root)[1])
    digest = blake2b(digest_size=16)
    for one in sorted(reached):
        digest.update(_read_module(one, root)[0])
    return digest.hexdigest()


@cache
def _read_module(path: Path, root: Path) -> tuple[bytes, tuple[Path, ...]]:
    """Return a digest of a module's text, and the files below the root that it imports."""
    text = path.read_bytes()
    found: list[Path] = []
    for dots, name, *names in IMPORT.findall(text.decode()):
        folder = path.parents[len(dots) - 1].joinpath(*name.split("."))
        for one in (folder, *(folder / name for name in re.findall(r"\w+", "".join(names)))):
            found += [file for file in (one.with_suffix(".py"), one / "__init__.py") if file.is_file()]
    # the root's own __init__ offers everything, and nothing is taken from there
    return blake2b(text, digest_size=16).digest(), tuple(
        file for file in found if file.is_relative_to(root) and file != root / "__init__.py"
    )


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
    """Return Numba's locators in its order, with those that only read: a warmed folder comes before a home."""
    first, *others = caching.CacheImpl._locator_classes  # noqa: SLF001 (Numba hands out no other way to them)
    return [first, AsGiven, *others, AsItIs]


@cache
def prepare() -> str:
    """Let kernels be loaded, before the first is declared, whatever can be written; say if nothing can be kept."""
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
