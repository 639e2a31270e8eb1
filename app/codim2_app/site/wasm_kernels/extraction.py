"""The core's kernels as Numba types them, before they are optimised for this processor: a process of its own.

``python -m codim2_app.site.wasm_kernels.extraction FILE`` compiles all that `warm_all` does, and writes a list of
`Extract`. Two steps of Numba are switched off in that process, and nothing is read from the disk or kept there.
"""

from __future__ import annotations

import pickle
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Extract:
    """One compiled function."""

    key: tuple[str, ...]  # a kernel's module and name; what a right-hand side was compiled from
    symbol: str  # its name in the IR
    ir: str  # the LLVM module
    # of a kernel: dtype, and dimensions of an array, of each argument; "tuple", "one" or "none", and of each value
    takes: list[list[Any]] | None = None
    returns: list[Any] | None = None


def leave_unoptimised() -> None:
    """Have Numba compile in this process, and stop before it optimises."""
    from numba.core import caching, codegen

    from codim2_core.formulas.jit import policy

    policy.choose_way(policy.COMPILE)
    library: Any = codegen.CPUCodeLibrary
    library._optimize_functions = lambda _self, _module: None  # noqa: SLF001
    library._optimize_final_module = lambda _self: None  # noqa: SLF001
    store: Any = caching.FunctionCache
    store.load_overload = lambda _self, _signature, _context: None
    store.save_overload = lambda _self, _signature, _data: None


def extract() -> list[Extract]:
    """Compile everything, and return what is called from Python or by its address."""
    leave_unoptimised()
    from numba.core import dispatcher

    import codim2_core.formulas.jit as door

    asked: list[tuple[Any, Any]] = []
    base: Any = dispatcher._DispatcherBase  # noqa: SLF001
    compile_for = base._compile_for_args  # noqa: SLF001

    def noted(self: Any, *given: Any, **named: Any) -> Any:
        before = set(self.overloads)
        made = compile_for(self, *given, **named)
        asked.extend((self, signature) for signature in self.overloads if signature not in before)
        return made

    base._compile_for_args = noted  # noqa: SLF001
    addresses: dict[tuple[str, ...], Any] = {}
    plain, with_gain = door.compile_address, door.compile_with_gain

    def compile_address(function: Any, cache: bool = True) -> Any:
        made = plain(function, cache)
        addresses[function.__module__, function.__name__] = made
        return made

    def compile_with_gain(lanes: Any, own: Any, whole: bool, cache: bool, **names: Any) -> Any:
        made, kind = with_gain(lanes, own, whole, cache, **names), "int" if whole else "float"
        addresses[lanes.__module__, lanes.__name__, own.__module__, own.__name__, kind] = made
        return made

    door.compile_address, door.compile_with_gain = compile_address, compile_with_gain
    _compile_everything()
    return [
        *(_of_kernel(made, signature) for made, signature in asked if made.py_func.__module__.startswith("codim2_")),
        *(Extract(key, made._wrapper_name, str(made._library._final_module)) for key, made in addresses.items()),  # noqa: SLF001
    ]


def _compile_everything() -> None:
    from codim2_core.portrait.stepping import psi_gain, right_hand_side
    from codim2_core.systems.psi import FAMILIES, custom, hill, make

    from ...view.compiling.steps import warm_all

    for psi in (*(make(family.name) for family in FAMILIES.values() if not family.typed), hill(2.5), custom("1/(1+s)")):
        for smooth in (True, False):
            right_hand_side.field_of_psi(psi)
            psi_gain.gains(psi, smooth)
            psi_gain.one_gain(psi)
    warm_all()


def _of_kernel(made: Any, signature: Any) -> Extract:
    compiled = made.overloads[signature]
    key = (made.py_func.__module__, made.py_func.__name__)
    return Extract(
        key,
        compiled.fndesc.llvm_func_name,
        str(compiled.library._final_module),  # noqa: SLF001
        [_kind(one) for one in signature],
        _returned(compiled.signature.return_type),
    )


def _kind(one: Any) -> list[Any]:
    """Return the dtype of a number; of an array that, and its dimensions."""
    from numba import types

    one = types.unliteral(one)
    if isinstance(one, types.Array):
        if one.layout != "C":
            raise ValueError(f"{one}: give contiguous arrays to kernels that Python calls.")
        return [str(one.dtype), one.ndim]
    return [str(one)]


def _returned(kind: Any) -> list[Any]:
    from numba import types

    if isinstance(kind, types.NoneType):
        return ["none", []]
    members = getattr(kind, "types", None)
    if members is not None:
        return ["tuple", [_kind(one) for one in members]]
    return ["one", [_kind(kind)]]


if __name__ == "__main__":
    from codim2_app.site.wasm_kernels import extraction  # under its name: what it writes is read elsewhere

    Path(sys.argv[1]).write_bytes(pickle.dumps(extraction.extract()))
