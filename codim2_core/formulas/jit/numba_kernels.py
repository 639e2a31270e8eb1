"""The kinds of kernels that Numba compiles, and the right-hand sides that are called by their addresses.

Kernels are kept on disk, under the stamp of all that they are made of (`stamps`).
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from hashlib import blake2b
from pathlib import Path
from typing import Any

from numba import njit, types
from numba.core import caching, event
from numba.core.dispatcher import Dispatcher

from ...results.rebind import rebind
from . import disk_cache, policy
from .disk_cache import CORE_FOLDER, source_stamp
from .right_hand_sides import compile_waiting, right_hand_side
from .tiers import TieredKernel

ARITHMETIC = {"contract", "reassoc", "nsz", "arcp"}  # NaN and infinity keep their meaning

if disk_cache.config.DISABLE_JIT:  # for a debugger, or to measure coverage: kernels run as Python
    disk_cache.config.DISABLE_JIT = 0
    policy.choose_way(policy.PYTHON)
#: Why no kernel can be kept on disk; "" if it can.
UNCACHED = disk_cache.prepare()

COMPILING = (
    "compiling kernels, once on this machine: about 10 s for trajectories, 45 s for motions; "
    "the command `codim2 warm` compiles all of them beforehand."
)


def _kind_of_kernel(nogil: bool = True, **options: Any) -> Callable[[Callable[..., Any]], Dispatcher]:
    """Return a decorator whose kernels are compiled once for a type, whatever constants they are called with.

    A function that closes over a kernel is refused: it would never be found on disk again (see `rebind`).
    """
    compiled = njit(cache=True, nogil=nogil, error_model="numpy", **options)

    def declare(function: Callable[..., Any]) -> Dispatcher:
        if any(isinstance(cell.cell_contents, Dispatcher) for cell in function.__closure__ or ()):
            raise TypeError(f"{function.__qualname__} closes over a kernel: give it by rebind.")
        made: Any = compiled(function)
        typed = made.get_call_template
        made.get_call_template = lambda given, named: typed(
            tuple(map(types.unliteral, given)), {name: types.unliteral(one) for name, one in named.items()}
        )
        made._compile_for_args = TieredKernel(made, compile_waiting).select  # noqa: SLF001 (asked where nothing fits)
        return made

    return declare


#: Decorators. `fast_kernel` may reorder sums, `contracted_kernel` only fuse. LLVM inlines `inlined_kernel`; Numba
#: splices `spliced_kernel` into the caller before it types it, so that functions can be arguments. `held_kernel` holds
#: the interpreter meanwhile, as its callbacks need it.
kernel = _kind_of_kernel()
held_kernel = _kind_of_kernel(nogil=False)
fast_kernel = _kind_of_kernel(fastmath=ARITHMETIC)
inlined_kernel = _kind_of_kernel(forceinline=True)
inlined_fast_kernel = _kind_of_kernel(fastmath=ARITHMETIC, forceinline=True)
contracted_kernel = _kind_of_kernel(fastmath={"contract"}, forceinline=True)
spliced_kernel = _kind_of_kernel(inline="always")


def compile_address(function: Callable[..., None], cache: bool = True) -> Any:
    """Compile a right-hand side, or a gain, to be called by its `address`."""
    return right_hand_side(function, cache, fastmath=ARITHMETIC)


def compile_with_gain(lanes: Callable[..., None], own: Any, whole: bool, cache: bool, **names: Any) -> Any:
    """Compile a function of lanes, which calls ``gain(r2, w, kind(parameter))``, with a gain in its place."""
    gain = njit(fastmath=ARITHMETIC, error_model="numpy", forceinline=True)(rebind(own, **names))
    written = repr((own.__code__.co_code, own.__code__.co_consts, own.__code__.co_names, whole))
    digest = blake2b(written.encode(), digest_size=8).hexdigest()  # a changed gain is another one
    return compile_address(rebind(lanes, digest, gain=gain, kind=int if whole else float), cache)


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
            logging.getLogger(__name__).warning(" ".join(filter(None, (COMPILING, UNCACHED))))

    def on_end(self, event: Any) -> None:
        """Nothing is said."""


event.register("numba:compile", _Notice())
