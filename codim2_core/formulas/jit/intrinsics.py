"""Operations of kernels that are none of Python: calls at an address, pointers into arrays, the bits of a double."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic
from numba.np.numpy_support import carray

from .interpreted import SCRATCH_SIZE

__all__ = [
    "POINTER", "SCRATCH_SIZE", "ahead", "bits_of_double", "call_at", "call_field", "carray", "double_of_bits",
    "pointer_to", "scratch",
]  # fmt: skip

POINTER = types.CPointer(types.float64)
NOTHING = ir.IntType(8).as_pointer()  # what a C function of Numba that returns nothing returns


def _call_field(typing_context, address, S, source, target, P):  # noqa: ARG001 (numba's protocol)
    """Call the field at `address` on ``S[source:]``, ``S[target:]`` and P."""
    signature = types.void(types.int64, S, types.int64, types.int64, P)

    def generate(context, builder, _, arguments):
        address, array, source, target, parameters = arguments
        data = context.make_array(S)(context, builder, array).data
        pointer = ir.DoubleType().as_pointer()
        function = ir.FunctionType(NOTHING, [pointer, pointer, pointer])
        places = [builder.gep(data, [source]), builder.gep(data, [target])]
        places.append(context.make_array(P)(context, builder, parameters).data)
        builder.call(builder.inttoptr(address, function.as_pointer()), places)
        return context.get_dummy_value()

    return signature, generate


call_field: Any = intrinsic(_call_field)


def _call_at(typing_context, address, state, out, parameters):  # noqa: ARG001
    """Call the right-hand side at `address` from within another, on its own three pointers."""

    def generate(context, builder, _signature, arguments):
        address, *places = arguments
        function = ir.FunctionType(NOTHING, [place.type for place in places])
        builder.call(builder.inttoptr(address, function.as_pointer()), places)
        return context.get_dummy_value()

    return types.void(types.int64, POINTER, POINTER, POINTER), generate


call_at: Any = intrinsic(_call_at)


def _advance_pointer(typing_context, pointer, places):  # noqa: ARG001
    """Point some places further on."""
    return POINTER(POINTER, types.int64), lambda _c, builder, _s, a: builder.gep(a[0], [a[1]])


ahead: Any = intrinsic(_advance_pointer)


def _pointer_to(typing_context, address):  # noqa: ARG001
    """Return the pointer to doubles at an address."""
    pointer = ir.DoubleType().as_pointer()
    return POINTER(types.int64), lambda _c, builder, _s, a: builder.inttoptr(a[0], pointer)


pointer_to: Any = intrinsic(_pointer_to)


def _scratch(typing_context):  # noqa: ARG001
    """Return the pointer to `SCRATCH_SIZE` doubles on the stack of the function."""
    room = ir.ArrayType(ir.DoubleType(), SCRATCH_SIZE)

    def generate(_c, builder, _s, _a):
        with builder.goto_entry_block():  # not by Numba's `alloca_once`, which writes zeros
            place = builder.alloca(room)
        return builder.bitcast(place, ir.DoubleType().as_pointer())

    return POINTER(), generate


scratch: Any = intrinsic(_scratch)


def _double_of_bits(typing_context, bits):  # noqa: ARG001
    """Return the double with these 64 bits."""
    return types.float64(types.int64), lambda _c, builder, _s, a: builder.bitcast(a[0], ir.DoubleType())


def _bits_of_double(typing_context, value):  # noqa: ARG001
    """Return the 64 bits of a double."""
    return types.int64(types.float64), lambda _c, builder, _s, a: builder.bitcast(a[0], ir.IntType(64))


double_of_bits: Any = intrinsic(_double_of_bits)
bits_of_double: Any = intrinsic(_bits_of_double)
