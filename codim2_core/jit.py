"""The kinds of kernels that are kept on disk, and when one there is out of date.

Numba keeps a compiled kernel beside its module, under a digest of that one file; but what a kernel calls, and
the constants that it reads, are compiled into it from other modules. Here a kernel is out of date when the text of any
module of this package changes that its own imports, itself or through others: after an upgrade in place, or in another
branch, nobody runs yesterday's formulas.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

from numba import njit, types
from numba.core import caching, event
from numba.core.dispatcher import Dispatcher

CORE_FOLDER = Path(__file__).parent
IMPORT = re.compile(r"^ *from (\.+)([\w.]*) import (?:\(([^)]*)\)|(.*))$", re.MULTILINE)  # a relative one
ARITHMETIC = {"contract", "reassoc", "nsz", "arcp"}  # NaN and infinity keep their meaning

COMPILING = (
    "compiling kernels, once on this machine: about 10 s for trajectories, 45 s for motions; "
    "the command `codim2 warm` compiles all of them beforehand."
)


def _kind_of_kernel(**options: Any) -> Callable[[Callable[..., Any]], Dispatcher]:
    """Return a decorator whose kernels are compiled once for a type, whatever constants they are called with.

    A function that closes over a kernel is refused: it would never be found on disk again (see `rebind`).
    """
    compiled = njit(cache=True, nogil=True, error_model="numpy", **options)

    def declare(function: Callable[..., Any]) -> Dispatcher:
        if any(isinstance(cell.cell_contents, Dispatcher) for cell in function.__closure__ or ()):
            raise TypeError(f"{function.__qualname__} closes over a kernel: give it by rebind.")
        made: Any = compiled(function)
        typed = made.get_call_template
        made.get_call_template = lambda given, named: typed(
            tuple(map(types.unliteral, given)), {name: types.unliteral(one) for name, one in named.items()}
        )
        return made

    return declare


#: Decorators. `fast_kernel` may reorder sums, `contracted_kernel` only fuse. LLVM inlines `inlined_kernel`; Numba
#: splices `spliced_kernel` into the caller before it types it, so that functions can be arguments.
kernel = _kind_of_kernel()
fast_kernel = _kind_of_kernel(fastmath=ARITHMETIC)
inlined_kernel = _kind_of_kernel(forceinline=True)
inlined_fast_kernel = _kind_of_kernel(fastmath=ARITHMETIC, forceinline=True)
contracted_kernel = _kind_of_kernel(fastmath={"contract"}, forceinline=True)
spliced_kernel = _kind_of_kernel(inline="always")


@cache
def source_stamp(path: Path, root: Path = CORE_FOLDER) -> str:
    """Return a digest of the text of a module and of all modules below a folder that it imports, directly or not.

    Parameters
    ----------
    path : Path
        The module's file.
    root : Path
        The folder of the package, whose imports are relative.

    Returns
    -------
    str
    """
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


_locator: Any = caching._SourceFileBackedLocatorMixin  # noqa: SLF001 (Numba hands out no other way)
_stamp_of_file = _locator.get_source_stamp


def _stamp(locator: Any) -> Any:
    path = Path(locator._py_file)  # noqa: SLF001
    return source_stamp(path) if path.is_relative_to(CORE_FOLDER) else _stamp_of_file(locator)


_locator.get_source_stamp = _stamp


class _Notice(event.Listener):
    """Says once in a process that kernels are being compiled, which takes seconds and is silent else."""

    said = False

    def on_start(self, event: Any) -> None:
        """Say it, if the kernel is one that is kept on disk: what is typed is compiled in a moment."""
        if not self.said and isinstance(event.data["dispatcher"]._cache, caching.FunctionCache):  # noqa: SLF001
            self.said = True
            logging.getLogger(__name__).warning(COMPILING)

    def on_end(self, event: Any) -> None:
        """Nothing is said."""


event.register("numba:compile", _Notice())
