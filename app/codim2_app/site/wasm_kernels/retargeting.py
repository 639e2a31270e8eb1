"""The kernels' IR, for WebAssembly: one LLVM module, optimised for it, as an object file.

Nothing is rewritten for 32 bits: pointers are opaque, Numba's `intp` stays 64 bits wide, and the address of a function
is its place in the table of functions.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

import llvmlite.binding as llvm

from .extraction import Extract

TRIPLE = "wasm32-unknown-emscripten"
#: What all browsers of the last years have, and Node 20.
FEATURES = "+bulk-memory,+sign-ext,+nontrapping-fptoint,+mutable-globals,+simd128"
#: What fast-math says in the IR, which `strict` leaves out: then the arithmetic is that of any processor.
FREEDOM = re.compile(
    r"\b(fadd|fsub|fmul|fdiv|fneg|fcmp|frem|call)((?: (?:contract|reassoc|nsz|arcp|fast|nnan|ninf|afn))+)"
)
#: What the object asks of others; anything else would end the interpreter that loads it.
KNOWN = frozenset(
    (
        *("NRT_Allocate", "NRT_Free", "NRT_MemInfo_alloc", "NRT_MemInfo_alloc_aligned", "NRT_MemInfo_call_dtor"),
        *("NRT_MemInfo_new_varsize_dtor", "PyErr_SetString", "numba_attempt_nocopy_reshape", "numba_ez_cgeev"),
        *("numba_fatal_error", "numba_frexp", "numba_ldexp", "atan", "atan2", "cosh", "hypot", "sinh", "tan", "tanh"),
        *("sin", "cos", "exp", "log", "pow"),
    )
)


def make_object(extracts: Sequence[Extract], strict: bool = False) -> bytes:
    """Return the object file of all functions.

    Parameters
    ----------
    extracts : sequence of Extract
    strict : bool
        Without the freedom to reorder sums.

    Raises
    ------
    ValueError
        It asks for a function that is not there.
    """
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine: Any = llvm.Target.from_triple(TRIPLE).create_target_machine(opt=3, features=FEATURES, reloc="pic")
    whole, seen = None, set[str]()
    for one in extracts:
        if one.symbol in seen:
            continue
        seen.add(one.symbol)
        module: Any = llvm.parse_assembly(_retarget(one.ir, machine, strict))
        module.verify()
        if whole is None:
            whole = module
        else:
            whole.link_in(module)
    assert whole is not None
    for function in whole.functions:
        if not function.is_declaration:
            function.linkage = "external" if function.name in seen else "internal"
    for variable in whole.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    _optimise(whole, machine)
    asked = {one.name for one in whole.functions if one.is_declaration and not one.name.startswith("llvm.")}
    if asked - KNOWN:
        raise ValueError(f"kernels ask for {', '.join(sorted(asked - KNOWN))}, which runtime.c does not have.")
    return machine.emit_object(whole)


def _retarget(ir: str, machine: Any, strict: bool) -> str:
    ir = re.sub(r'target triple = ".*"', f'target triple = "{TRIPLE}"', ir)
    ir = re.sub(r'target datalayout = ".*"', f'target datalayout = "{machine.target_data}"', ir)
    # A call of sqrt is no instruction, and ends vectors.
    ir = re.sub(r'@"?sqrt"?\(', "@llvm.sqrt.f64(", ir)
    ir = re.sub(r"(?m)^declare double @llvm\.sqrt\.f64\(double[^\n]*\n", "", ir)
    ir += "\ndeclare double @llvm.sqrt.f64(double)\n"
    return FREEDOM.sub(r"\1", ir) if strict else ir


def _optimise(module: Any, machine: Any) -> None:
    """Remove what nobody calls, and counts of references, as Numba does; then all that LLVM can."""

    def builder(level: int, vectors: bool) -> Any:
        options: Any = llvm.PipelineTuningOptions(speed_level=level)
        options.loop_vectorization = options.slp_vectorization = vectors
        options.loop_unrolling = True
        return llvm.create_pass_builder(machine, options)

    passes: Any = llvm.create_new_module_pass_manager()
    passes.add_global_dead_code_eliminate_pass()
    passes.run(module, builder(1, False))
    simple = builder(1, False)
    passes = simple.getModulePassManager()
    passes.add_loop_rotate_pass()
    passes.add_instruction_combine_pass()
    passes.add_jump_threading_pass()
    passes.add_refprune_pass()
    passes.run(module, simple)
    full = builder(3, True)
    passes = full.getModulePassManager()
    passes.add_refprune_pass()
    passes.run(module, full)
