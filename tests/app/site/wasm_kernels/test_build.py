"""The kernels become one WebAssembly object with a call for each; all of a page runs them in tests/browser."""

import pickle
import subprocess
import sys

import pytest
from codim2_app.site.wasm_kernels.build import make_object, write_trampolines
from codim2_app.site.wasm_kernels.extraction import Extract

ONE = """
import pickle, sys
import numpy as np
from codim2_app.site.wasm_kernels import extraction
extraction.leave_unoptimised()
from codim2_core.portrait.stepping.layout import states_of
states_of(np.eye(2))
sys.stdout.buffer.write(pickle.dumps(extraction._of_kernel(states_of, states_of.signatures[0])))
"""
FOREIGN = 'target datalayout = ""\ntarget triple = ""\ndeclare double @somewhere(double)\n' + (
    "define double @f(double %x) {\n  %y = call double @somewhere(double %x)\n  ret double %y\n}\n"
)


@pytest.fixture(scope="module")
def extract():
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", ONE], capture_output=True, check=True)
    return pickle.loads(done.stdout)


def test_what_a_kernel_takes_and_returns_is_told(extract):
    assert extract.key == ("codim2_core.portrait.stepping.layout", "states_of")
    assert (extract.takes, extract.returns) == (
        [["float64", 2]],
        ["tuple", [["float64", 2], ["float64", 1], ["float64"]]],
    )


def test_it_is_one_object_of_webassembly_in_which_its_symbol_is(extract):
    free, strict = make_object([extract, extract]), make_object([extract], strict=True)
    for written in (free, strict):
        assert written[:4] == b"\0asm"
        assert extract.symbol.encode() in written


def test_a_call_reads_its_arguments_from_a_row_and_writes_what_is_returned(extract):
    address = Extract(("somewhere", "field"), "field_symbol", "")
    source, table = write_trampolines([extract, address])
    assert table["kernels"] == [
        {
            "module": extract.key[0],
            "name": "states_of",
            "takes": extract.takes,
            "returns": extract.returns,
            "call": "call0",
        }
    ]
    assert table["addresses"] == [{"key": ("somewhere", "field"), "address": "address1"}]
    # an array: its place, shape and strides; no owner, its number of elements, eight bytes each
    assert "k0(&r, &e, 0, 0, s[1].i*s[2].i, 8, (void*)(uintptr_t)s[0].i, s[1].i, s[2].i, s[3].i, s[4].i)" in source
    # two arrays, of owner, data and shape each, and a number
    assert "s[0].i=(uintptr_t)r.r0.m; s[1].i=(uintptr_t)r.r0.d; s[2].i=r.r0.s[0]; s[3].i=r.r0.s[1];" in source
    assert "s[6].i=r.r1.s[0]; s[7].d=r.r2;" in source
    assert '__asm__("field_symbol")' in source


def test_what_the_runtime_does_not_have_is_refused():
    with pytest.raises(ValueError, match=r"ask for somewhere, which runtime\.c does not have"):
        make_object([Extract(("a", "b"), "f", FOREIGN)])
