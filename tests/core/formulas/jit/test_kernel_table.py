"""How kernels that were compiled beforehand are called: a row of numbers of eight bytes in, and one out."""

import ctypes
from types import SimpleNamespace

import numpy as np
import pytest

from codim2_core.formulas.jit import kernel_table

#: Arrays that a played kernel has made, by the number of their owner.
made = {}


def slots(address, kind, count):
    return (kind * count).from_address(address)


def give_array(numbers, k, array):
    """Write what a kernel returns of an array, as `wasm_kernels.trampolines` has it."""
    owner = len(made) + 1
    made[owner] = array
    numbers[k : k + 2 + array.ndim] = [owner, array.ctypes.data, *array.shape]
    return k + 2 + array.ndim


def scaled(address):
    """Return t * points and how many there are, of points (n, 2), t and a flag; write into places (n,)."""
    numbers, reals = slots(address, ctypes.c_int64, 16), slots(address, ctypes.c_double, 16)
    data, n, two, row, step = numbers[:5]
    t, flag = reals[5], numbers[6]
    places, count, size = numbers[7:10]
    assert (two, row, step, size, count) == (2, 16, 8, 8, n)
    points = np.array(slots(data, ctypes.c_double, 2 * n)).reshape(n, 2)
    slots(places, ctypes.c_int64, n)[:] = list(range(n))
    k = give_array(numbers, 0, t * points if flag else -t * points)
    k = give_array(numbers, k, np.arange(n))
    reals[k] = 0.5 * t
    numbers[k + 1] = 1
    return 0


TAKES = [["float64", 2], ["float64"], ["bool"], ["int64", 1]]
RETURNS = ["tuple", [["float64", 2], ["int64", 1], ["float64"], ["bool"]]]


def scale(points, t, flag, places):
    """Scale."""


@pytest.fixture
def kernel(monkeypatch):
    library = SimpleNamespace(let_go=made.pop)
    table = SimpleNamespace(kernels={(__name__, "scale"): [(scaled, TAKES, RETURNS)]}, library=library, addresses={})
    monkeypatch.setattr(kernel_table, "table", lambda: table)
    yield kernel_table.TabledKernel(scale)
    assert made == {}  # all are let go


@pytest.mark.parametrize("dtype", [np.int64, np.int32])
def test_arrays_are_passed_and_returned_and_narrow_ones_widened(kernel, dtype):
    points, places = np.array([[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]), np.full(3, 9, dtype)
    found, numbers, half, flag = kernel(points, 2.0, np.True_, places)
    assert found.tolist() == (2.0 * points).tolist()
    assert numbers.tolist() == places.tolist() == [0, 1, 2]
    assert (numbers.dtype, half, flag) == (np.intp, 1.0, True)
    found[0, 0] = 7.0  # it is the caller's own


def test_a_right_hand_side_is_found_by_what_it_was_compiled_from(kernel):
    addresses = kernel_table.table().addresses
    addresses[__name__, "scale"] = 11
    addresses[__name__, "scale", __name__, "scaled", "int"] = 12
    assert kernel_table.compile_address(scale).address == 11
    assert kernel_table.compile_with_gain(scale, scaled, whole=True, cache=True).address == 12
    with pytest.raises(NotImplementedError, match="of float was not compiled"):
        kernel_table.compile_with_gain(scale, scaled, whole=False, cache=True)
