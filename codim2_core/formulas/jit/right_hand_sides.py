"""Right-hand sides at addresses, compiled when a compiled kernel is about to call one; as Python until then."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable
from functools import cached_property
from typing import Any

from llvmlite import binding as llvm
from numba import types
from numba.core.ccallback import CFunc

from . import interpreted, tiers
from .intrinsics import POINTER

FIELD = types.void(POINTER, POINTER, POINTER)
#: Machine code at an address of its own, which goes on at that in a slot.
JUMP = """define ptr @jump(ptr %a, ptr %b, ptr %c) {{
  %there = load ptr, ptr inttoptr (i64 {slot} to ptr)
  %found = tail call ptr %there(ptr %a, ptr %b, ptr %c)
  ret ptr %found
}}"""

_lock = threading.RLock()
_machine_code_runs = False  # it calls right-hand sides: none may wait any longer


class RightHandSide:
    """A right-hand side that waits to be compiled, at an `address` that it keeps."""

    def __init__(self, function: Callable[..., None], compiled: CFunc) -> None:
        self._function, self._compiled = function, compiled
        self._slot = ctypes.c_void_p()
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        machine = llvm.Target.from_default_triple().create_target_machine(jit=True)
        code = llvm.parse_assembly(JUMP.format(slot=ctypes.addressof(self._slot)))
        self._engine = llvm.create_mcjit_compiler(code, machine)
        self._engine.finalize_object()
        self.address: int = self._engine.get_function_address("jump")
        interpreted.waiting[self.address] = self

    @cached_property
    def python(self) -> Callable[..., None]:
        """The same as Python."""
        return interpreted.interpret(self._function)

    def compile(self) -> None:
        """Have its address lead to machine code."""
        self._compiled.compile()
        self._slot.value = self._compiled.address
        interpreted.waiting.pop(self.address, None)


def right_hand_side(function: Callable[..., None], cache: bool, **options: Any) -> Any:
    """Return a right-hand side with its `address`, compiled if it is called by machine code, or on disk."""
    made: Any = CFunc(function, (FIELD.args, FIELD.return_type), {}, {"error_model": "numpy", "nogil": True, **options})
    if cache:
        made.enable_caching()
    with _lock:
        if tiers.may_wait(made._cache, made._sig, made.__name__) and not _machine_code_runs:  # noqa: SLF001
            return RightHandSide(function, made)
    made.compile()
    return made


def compile_waiting() -> None:
    """Compile all right-hand sides that are in use: machine code is about to call them, and from now on."""
    global _machine_code_runs
    with _lock:
        _machine_code_runs = True
        for one in list(interpreted.waiting.values()):
            one.compile()
