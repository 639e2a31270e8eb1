"""Build the kernels for browsers: ``codim2 kernels``.

The wheels of llvmlite hold LLVM's WebAssembly target, and `ziglang` (PyPI) is clang and wasm-ld.
"""

from __future__ import annotations

import json
import pickle
import re
import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import llvmlite.binding as llvm

import codim2_core

from .extraction import Extract

RUNTIME = tuple(Path(__file__).with_name(name) for name in ("runtime.c", "eigenvalues.c"))
TYPES = {"float64": "double", "int64": "int64_t", "uint64": "int64_t", "int32": "int32_t", "bool": "int8_t"}
SIZES = {"bool": 1, "complex128": 16}  # of an element; others have eight bytes
EXPORT = '__attribute__((visibility("default")))'


def write_trampolines(extracts: Sequence[Extract]) -> tuple[str, dict[str, Any]]:
    """Return the C file, and what `jit.kernel_table` reads."""
    lines = [*(path.read_text(encoding="utf-8") for path in RUNTIME), "typedef union {double d; int64_t i;} slot;"]
    written: dict[str, Any] = {"kernels": [], "addresses": []}
    for number, one in enumerate(extracts):
        if one.takes is None:
            lines.append(
                f'extern void* f{number}(void) __asm__("{one.symbol}");\n'
                f"{EXPORT} uintptr_t address{number}(void) {{ return (uintptr_t)f{number}; }}"
            )
            written["addresses"].append({"key": one.key, "address": f"address{number}"})
        else:
            assert one.returns is not None
            lines.append(_trampoline(number, one.symbol, one.takes, one.returns[1]))
            module, name = one.key
            called = {"module": module, "name": name, "takes": one.takes, "returns": one.returns}
            written["kernels"].append({**called, "call": f"call{number}"})
    lines.append(f"{EXPORT} void let_go(MemInfo*m) {{ release(m); }}")
    return "\n".join(lines) + "\n", written


def _trampoline(number: int, symbol: str, takes: list[list[Any]], returns: list[list[Any]]) -> str:
    declared, given, k = [], [], 0
    for kind in takes:
        if len(kind) > 1:
            n = kind[1]
            declared += ["void*", "void*", "int64_t", "int64_t", "void*", *["int64_t"] * (2 * n)]
            given += ["0", "0", "*".join(f"s[{k + 1 + i}].i" for i in range(n)), str(SIZES.get(kind[0], 8))]
            given += [f"(void*)(uintptr_t)s[{k}].i", *(f"s[{k + 1 + i}].i" for i in range(2 * n))]
            k += 1 + 2 * n
        else:
            declared.append(TYPES[kind[0]])
            given.append(f"s[{k}].d" if kind[0] == "float64" else f"({TYPES[kind[0]]})s[{k}].i")
            k += 1
    fields, back, j = [], [], 0
    for q, kind in enumerate(returns):
        if len(kind) > 1:
            n = kind[1]
            fields.append(f"struct {{void*m,*p; int64_t n,z; void*d; int64_t s[{n}],t[{n}];}} r{q};")
            back.append(f"s[{j}].i=(uintptr_t)r.r{q}.m; s[{j + 1}].i=(uintptr_t)r.r{q}.d;")
            back += [f"s[{j + 2 + i}].i=r.r{q}.s[{i}];" for i in range(n)]
            j += 2 + n
        else:
            fields.append(f"{TYPES[kind[0]]} r{q};")
            back.append(f"s[{j}].{'d' if kind[0] == 'float64' else 'i'}=r.r{q};")
            j += 1
    return (
        f"typedef struct {{{' '.join(fields) or 'void*none;'}}} ret{number};\n"
        f'extern int32_t k{number}({", ".join([f"ret{number}*", "void**", *declared])}) __asm__("{symbol}");\n'
        f"{EXPORT} int32_t call{number}(slot*s) {{ ret{number} r={{0}}; void*e=0; "
        f"int32_t status=k{number}({', '.join(['&r', '&e', *given])}); if(status) return status; "
        f"{' '.join(back)} return 0; }}"
    )


# The kernels' IR, for WebAssembly: one LLVM module, optimised for it, as an object file.
#
# Nothing is rewritten for 32 bits: pointers are opaque, Numba's `intp` stays 64 bits wide, and the address of a
# function is its place in the table of functions.
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


#: Where a page without a server finds them.
FOLDER = Path(codim2_core.__file__).parent / "formulas" / "jit" / "compiled"
PROCESSOR = "mvp+bulk_memory+sign_ext+nontrapping_fptoint+mutable_globals+simd128"
COMPILE = ("cc", "-target", "wasm32-emscripten", f"-mcpu={PROCESSOR}", "-fPIC", "-O2", "-c")
LINK = (
    "wasm-ld", "-shared", "--experimental-pic", "--no-entry", "--export-dynamic", "--allow-undefined", "--strip-all",
    "--gc-sections",
)  # fmt: skip


def missing() -> bool:
    """Whether `ziglang` is not installed."""
    return find_spec("ziglang") is None


def extract_all() -> list[Extract]:
    """Return what a process of its own has compiled, in some minutes."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "extracts"
        subprocess.run([sys.executable, "-m", "codim2_app.site.wasm_kernels.extraction", str(path)], check=True)
        return pickle.loads(path.read_bytes())  # written by that process


def build_kernels(folder: Path, extracts: list[Extract], strict: bool = False) -> None:
    """Write ``kernels.so`` and ``kernels.json``.

    Parameters
    ----------
    folder : Path
    extracts : list of Extract
    strict : bool
        Without the freedom to reorder sums: the same bits as the same of Numba's.

    Raises
    ------
    subprocess.CalledProcessError
        The compiler or the linker fails, or `ziglang` is not installed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    source, written = write_trampolines(extracts)
    with TemporaryDirectory() as temporary:
        place = Path(temporary)
        (place / "kernels.o").write_bytes(make_object(extracts, strict))
        (place / "calls.c").write_text(source, encoding="utf-8")
        _zig(*COMPILE, str(place / "calls.c"), "-o", str(place / "calls.o"))
        _zig(*LINK, str(place / "kernels.o"), str(place / "calls.o"), "-o", str(folder / "kernels.so"))
    (folder / "kernels.json").write_text(json.dumps(written, separators=(",", ":")))


def _zig(*given: str) -> None:
    subprocess.run([sys.executable, "-m", "ziglang", *given], check=True)
