"""Calls of the kernels: a function in C for each, that takes a row of numbers of eight bytes, and a table of them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

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
