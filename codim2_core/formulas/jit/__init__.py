"""The one door through which everything compiled goes: Numba here, in a browser a table of what it has compiled.

A *kernel* is a function of arrays and numbers, declared by a decorator. A *right-hand side* is a function
``(state, out, parameters)`` of three pointers that is called by its address: `compile_address` makes one of a function
of this package, `compile_with_gain` one for each gain of Psi. Formulas that are typed are not compiled, but
interpreted by one of them (`expressions.packed`).

What is neither compiled nor kept on disk runs as Python until that has taken as long as to compile it (`tiers`).
"""

import sys

if sys.platform == "emscripten":
    # By its full name: what Numba keeps on disk does not depend on it (see `stamps`).
    from codim2_core.formulas.jit.kernel_table import (
        SCRATCH_SIZE,
        ahead,
        bits_of_double,
        call_at,
        call_field,
        carray,
        compile_address,
        compile_with_gain,
        contracted_kernel,
        double_of_bits,
        fast_kernel,
        held_kernel,
        inlined_fast_kernel,
        inlined_kernel,
        kernel,
        pointer_to,
        scratch,
        spliced_kernel,
    )
else:
    from .intrinsics import (
        SCRATCH_SIZE,
        ahead,
        bits_of_double,
        call_at,
        call_field,
        carray,
        double_of_bits,
        pointer_to,
        scratch,
    )
    from .numba_kernels import (
        compile_address,
        compile_with_gain,
        contracted_kernel,
        fast_kernel,
        held_kernel,
        inlined_fast_kernel,
        inlined_kernel,
        kernel,
        spliced_kernel,
    )

__all__ = [
    "SCRATCH_SIZE", "ahead", "bits_of_double", "call_at", "call_field", "carray", "compile_address",
    "compile_with_gain", "contracted_kernel", "double_of_bits", "fast_kernel", "held_kernel", "inlined_fast_kernel",
    "inlined_kernel", "kernel", "pointer_to", "scratch", "spliced_kernel",
]  # fmt: skip
