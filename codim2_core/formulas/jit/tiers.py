"""The two tiers of a kernel: as Python at first, and compiled once that has taken as long as compiling does.

To rent or to buy: a kernel that is neither compiled in this process nor kept on disk runs as Python until that has
taken the seconds that its compilation would; so a small job is done at once, and a long one takes at most twice the
time. A call under way is given up then, what it wrote into its arguments is put back, and it runs compiled.

Numba's dispatcher stays in front: it asks only where it has found no machine code.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from functools import cached_property, partial
from typing import Any

import numpy as np
from numba.core.caching import FunctionCache
from numba.core.registry import cpu_target
from numba.core.typing.typeof import Purpose, typeof

from . import interpreted, policy

#: Seconds that a byte of Python's code costs to compile, all functions that a kernel is made of counted once: the
#: kernels of this package take 0.2 to 0.7 ms.
SECONDS_PER_BYTE = 3e-4
#: Seconds between two looks on the disk, where another process may have left the compiled kernel.
LOOK_SECONDS = 0.5


class _GivenUpError(Exception):
    """A kernel that runs as Python is to run compiled."""


def is_on_disk(cache: Any, signature: Any) -> bool:
    """Whether a compiled function is kept on disk for a signature; of what is kept nowhere, it is not."""
    if not isinstance(cache, FunctionCache):
        return False
    context: Any = cpu_target.target_context
    key = cache._index_key(signature, context.codegen())  # noqa: SLF001 (Numba tells no other way)
    try:
        return key in cache._cache_file._load_index()  # noqa: SLF001
    except (OSError, EOFError):  # it is being written
        return False


def may_wait(cache: Any, signature: Any, name: str) -> bool:
    """Whether a function is neither to be compiled now nor loaded; raises NotCompiledError."""
    way = policy.current_way()
    if way == policy.PYTHON:
        return True
    if way == policy.COMPILE or is_on_disk(cache, signature):
        return False
    if way == policy.LOAD and isinstance(cache, FunctionCache):
        raise policy.NotCompiledError(f"{name} is not compiled; run `codim2 warm`.")
    return True


class TieredKernel:
    """The tiers of one kernel; `before` is called before machine code that calls right-hand sides by address."""

    def __init__(self, kernel: Any, before: Callable[[], None]) -> None:
        self.kernel, self.seconds, self._before = kernel, 0.0, before
        self._next_looks: dict[Any, float] = {}

    @cached_property
    def _functions(self) -> set[Any]:
        return interpreted.called_functions(self.kernel.py_func)

    @cached_property
    def cost(self) -> float:
        """Seconds that it takes to compile, about."""
        return SECONDS_PER_BYTE * sum(len(one.__code__.co_code) for one in self._functions)

    @cached_property
    def _calls_addresses(self) -> bool:
        return any({"call_field", "call_at"} & set(one.__code__.co_names) for one in self._functions)

    def select(self, *given: Any) -> Callable[..., Any]:
        """Return what runs these arguments: asked by Numba's dispatcher where it has no machine code for them."""
        try:
            signature = tuple(typeof(one, Purpose.argument) for one in given)
        except ValueError:  # Numba says which has no type
            return self._compile(given)
        now = time.perf_counter()
        is_due = now >= self._next_looks.get(signature, 0.0) or policy.current_way() != policy.RENT
        if is_due and not may_wait(self.kernel._cache, signature, self.kernel.__name__):  # noqa: SLF001
            return self._compile(given)
        if is_due:
            self._next_looks[signature] = now + LOOK_SECONDS
        return partial(self._run, signature) if self._may_go_on(0.0) else self._compile(given)

    def _may_go_on(self, seconds: float) -> bool:
        """Whether it runs as Python after so many seconds more."""
        return policy.is_left() or self.seconds + seconds < self.cost

    def _compile(self, given: tuple[Any, ...]) -> Callable[..., Any]:
        if self._calls_addresses:
            self._before()
        return type(self.kernel)._compile_for_args(self.kernel, *given)  # noqa: SLF001

    def _run(self, signature: Any, *given: Any) -> Any:
        """Run it as Python, and compiled where that takes too long or is no arithmetic of Python's."""
        began = time.perf_counter()
        before = [(one, one.copy()) for one in given if isinstance(one, np.ndarray) and one.flags.writeable]

        def look() -> float:
            now = time.perf_counter()
            loads = policy.current_way() != policy.PYTHON and is_on_disk(self.kernel._cache, signature)  # noqa: SLF001
            if loads or not self._may_go_on(now - began):
                raise _GivenUpError
            return now + LOOK_SECONDS

        try:
            left = LOOK_SECONDS if policy.is_left() else min(LOOK_SECONDS, self.cost - self.seconds)
            return interpreted.run(self.kernel, given, began + left, look)
        except (_GivenUpError, ArithmeticError, ValueError):
            for array, copy in before:
                array[...] = copy
        finally:
            self.seconds += time.perf_counter() - began
        return self._compile(given)(*given)
