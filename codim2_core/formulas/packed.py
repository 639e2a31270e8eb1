"""Formulas as one array that compiled right-hand sides interpret at its address: nothing that is typed is compiled.

The array says how many operations and rows there are; then come the operations, each the row of its result, its code,
the rows of what it acts on, and its number; and the rows of the formulas. The rows, of one number for each place at
which the formulas are evaluated, are the caller's: the array is only read, by several threads at once too.
"""

from __future__ import annotations

import math

import numpy as np

from ..results.arrays import Array
from .arrays import Program
from .functions import code, kernels
from .jit import SCRATCH_SIZE, ahead, carray, inlined_fast_kernel, pointer_to
from .opcodes import ADD, BESIDE, DIV, HYPOT, MAX, MIN, MUL, NEG, NUM, POW, POWI, SUB, VAR

OPERATIONS, RESULTS, ROWS, SIZE, BOUND, FIRST_OPERATION = range(6)
OPERATION, LEFT, RIGHT, NUMBER, EACH = range(1, 6)  # of an operation, behind the row of its result
SQUARE_ROOT = code["sqrt"]


def pack(program: Program, inputs: int, bound: float = 0.0) -> Array:
    """Return a program as one array, the rows of its variables first; ValueError where it needs too much room."""
    op, left, right, number, roots = (part.tolist() for part in program.arrays)
    last_use = {i: i for i in range(len(op))}
    for i, k in enumerate(op):
        if k not in (NUM, VAR):
            last_use[left[i]] = last_use[right[i]] = i
    last_use |= dict.fromkeys(roots, len(op))
    row, free, rows, operations = list[int](), list[int](), inputs, list[float]()
    for i, k in enumerate(op):
        if k == VAR:
            row.append(left[i])
            continue
        if k == NUM and last_use[i] == i:  # it was folded away
            row.append(0)
            continue
        a, b = (row[left[i]], row[right[i]]) if k != NUM else (0, 0)
        for used in {left[i], right[i]} if k != NUM else ():
            if last_use[used] == i and op[used] != VAR:
                free.append(row[used])
        if not free:
            free.append(rows)
            rows += 1
        row.append(free.pop())
        is_root = k == POW and op[right[i]] == NUM and number[right[i]] == 0.5
        operations += (row[i], SQUARE_ROOT if is_root else k, a, b, number[i])
    if rows > SCRATCH_SIZE:
        raise ValueError(f"The formulas keep {rows} values at a time; give formulas that keep at most {SCRATCH_SIZE}.")
    results = FIRST_OPERATION + len(operations)
    head = len(operations) // EACH, results, rows, results + len(roots), bound
    return np.array([*head, *operations, *(row[i] for i in roots)], float)


@inlined_fast_kernel
def at_address(address):
    """Return the array of a packed program."""
    return carray(pointer_to(address), (int(carray(pointer_to(address), (FIRST_OPERATION,))[SIZE]),))


@inlined_fast_kernel
def row(R, number, width, count):
    """Return the first places of one of the rows at a pointer, each of which is `width` long."""
    return carray(ahead(R, width * number), (count,))


@inlined_fast_kernel
def result(T, R, number, width, count):
    """Return the first places of a formula."""
    return row(R, int(T[int(T[RESULTS]) + number]), width, count)


@inlined_fast_kernel
def run_packed(T, R, width, count):
    """Evaluate a packed program at the first places of rows at R, of which those of its variables are filled in."""
    place = FIRST_OPERATION
    for _ in range(int(T[OPERATIONS])):
        k, to = int(T[place + OPERATION]), row(R, int(T[place]), width, count)
        a, b = row(R, int(T[place + LEFT]), width, count), row(R, int(T[place + RIGHT]), width, count)
        if k == NUM:
            value = T[place + NUMBER]
            for j in range(count):
                to[j] = value
        elif k == ADD:
            for j in range(count):
                to[j] = a[j] + b[j]
        elif k == SUB:
            for j in range(count):
                to[j] = a[j] - b[j]
        elif k == MUL:
            for j in range(count):
                to[j] = a[j] * b[j]
        elif k == DIV:
            for j in range(count):
                to[j] = a[j] / b[j]
        elif k == NEG:
            for j in range(count):
                to[j] = -a[j]
        elif k == POWI:
            _raise_to(to, a, int(T[place + NUMBER]), count)
        elif k == SQUARE_ROOT:
            for j in range(count):
                to[j] = math.sqrt(a[j])
        elif k == POW:
            for j in range(count):
                to[j] = math.pow(a[j], b[j])
        elif k == HYPOT:
            for j in range(count):
                to[j] = math.hypot(a[j], b[j])
        elif k == MIN:
            for j in range(count):
                u, v = a[j], b[j]
                to[j] = v if v < u or v != v else u
        elif k == MAX:
            for j in range(count):
                u, v = a[j], b[j]
                to[j] = v if v > u or v != v else u
        elif k == BESIDE:
            for j in range(count):
                u, v = a[j], b[j]
                to[j] = 0.0 if (u == 0.0 and math.isinf(v)) or (v == 0.0 and math.isinf(u)) else u * v
        else:
            for j in range(count):
                to[j] = kernels.value(k, a[j])
        place += EACH


@inlined_fast_kernel
def _raise_to(to, a, exponent, count):
    """Write whole powers, as products."""
    if exponent == 2:
        for j in range(count):
            to[j] = a[j] * a[j]
    elif exponent == 3:
        for j in range(count):
            to[j] = a[j] * a[j] * a[j]
    else:
        for j in range(count):
            power, product, left = a[j], 1.0, abs(exponent)
            while left > 0:
                if left % 2 == 1:
                    product *= power
                power *= power
                left //= 2
            to[j] = product if exponent >= 0 else 1.0 / product
