"""Stamps of what a kernel on disk was compiled from.

Numba keeps a compiled kernel next to its module, under a digest of that one file; but what a kernel calls, and
the constants that it reads, are compiled into it from other modules. Here a kernel is out of date when the text of any
module of this package changes that its own imports, itself or through others: after an upgrade in place, or in another
branch, nobody runs yesterday's formulas.
"""

from __future__ import annotations

import re
from functools import cache
from hashlib import blake2b
from pathlib import Path

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
