"""Typed formulas in WebAssembly are those that Numba compiles."""

import base64
import ctypes
import json
import os
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from codim2_core import System, psi
from codim2_core.jit import formulas
from codim2_core.stepping import fields, fields_typed, layout, psi_gain
from codim2_core.stepping.field_parameters import FACTOR, GAIN, OWN_NUMBERS

RUN = Path(__file__).with_name("run_module.mjs")
NAMES = {
    "LANES": layout.LANES,
    "PARAMETERS": layout.PARAMETERS,
    "SIGN": layout.SIDE_SIGN,
    "WIDTH": layout.ROW_WIDTH,
    "FACTOR": FACTOR,
    "GAIN": GAIN,
    "OWN": OWN_NUMBERS,
}
#: Math.* of Node and the C library here differ by a rounding or two.
ROUNDINGS = 1e-14
TEXTS = (
    ("c - 3*s + k*c**3", "3*c - s"),
    ("max(c, s) + tanh(s)", "x*exp(-y) + |s| + 1/(2 + c**2)"),
    ("c*min(s, c) + sign(k)*sqrt(2 + s)", "cosh(c) - sinh(s) + log(2 + c*s)"),
    ("(2 + c)**1.5 + (2 + s)**-2", "atan(c) + sin(s)*cos(c) - tan(s/2)"),
)
PSIS = ("1/(1+s)**2", "max(1 - s, 0)", "exp(-s)*(1 + sqrt(s))/2", "tanh(1/(1+s))")


def in_wasm(modules, state, out, parameters):
    """Return what the first of some modules writes; the others have the next addresses, from 2."""
    node = shutil.which("node")
    if node is None:
        (pytest.fail if os.environ.get("CI") else pytest.skip)("no Node")
    given = {"modules": [base64.b64encode(one).decode() for one in modules]}
    given |= {"state": list(state), "out": list(out), "parameters": list(parameters)}
    done = subprocess.run([node, str(RUN)], input=json.dumps(given), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return np.array(json.loads(done.stdout))


def natively(compiled, state, out, parameters):
    written = np.array(out)
    call = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(compiled.address)
    state, parameters = np.array(state), np.array(parameters)
    call(state.ctypes.data, written.ctypes.data, parameters.ctypes.data)
    return written


def given(seed):
    rng = np.random.default_rng(seed)
    state = rng.uniform(-1.0, 1.0, layout.ROW_WIDTH)
    state[2 * layout.LANES :] = np.abs(state[2 * layout.LANES :])
    parameters = rng.uniform(0.2, 1.0, layout.WITH_EACH)
    parameters[layout.SIDE_SIGN : layout.SIDE_SIGN + layout.LANES] = rng.choice([-1.0, 1.0], layout.LANES)
    return state, np.zeros(layout.ROW_WIDTH), parameters


def nowhere(*key):
    raise AssertionError(key)


@pytest.mark.parametrize("which", range(len(TEXTS)))
def test_a_field_with_the_gain_that_it_calls(which):
    system, own = System(U=TEXTS[which], parameters={"k": 0.3}), psi.custom(PSIS[which])
    source, _ = fields_typed._source(system)
    variant = psi_gain.variant(own, smooth=False)
    gain = psi_gain._typed_gain(variant.key, variant.parameter, variant.saturation)
    field = formulas.module_of_text(source, NAMES, nowhere)
    gains = formulas.module_of_lanes(psi_gain._gains, gain, {}, nowhere)
    state, out, parameters = given(which)
    parameters[GAIN] = 2.0
    found = in_wasm([field, gains], state, out, parameters)
    compiled = psi_gain.gains(own, smooth=False)
    parameters[GAIN] = compiled.address
    expected = natively(fields_typed.general_field(system).function, state, out, parameters)
    np.testing.assert_allclose(found, expected, rtol=ROUNDINGS, atol=ROUNDINGS)


@pytest.mark.parametrize(
    ("lanes", "native"),
    [
        (fields._psi_field, fields.field),
        (fields._field_of_each, lambda own: fields.field_of_each(own, same=False)),
        (psi_gain._gains_of_block, lambda own: psi_gain.gains_of_block(own, smooth=True)),
        (psi_gain._one_gain, psi_gain.one_gain),
    ],
    ids=["field", "of each", "block", "one"],
)
def test_all_that_calls_a_typed_gain(lanes, native):
    own = psi.custom(PSIS[2])
    variant = psi_gain.variant(own, smooth=True)
    gain = psi_gain._typed_gain(variant.key, variant.parameter, variant.saturation)
    state, out, parameters = given(7)
    found = in_wasm([formulas.module_of_lanes(lanes, gain, {}, nowhere)], state, out, parameters)
    np.testing.assert_allclose(found, natively(native(own), state, out, parameters), rtol=ROUNDINGS, atol=ROUNDINGS)


def test_a_function_that_was_compiled_beforehand_is_called_at_its_address():
    asked = []
    twice = formulas.module_of_text(
        "def f(state, out, parameters):\n    carray(out, (1,))[0] = ellipk(carray(state, (1,))[0])\n",
        {},
        lambda *key: asked.append(key) or 3,
    )
    assert asked == [("function", "ellipk")]
    assert b"\x41\x03\x11\x01\x00" in twice  # i32.const 3, call_indirect of a function of one number


def test_what_is_not_read_is_named():
    with pytest.raises(NotImplementedError, match="while"):
        formulas.module_of_text("def f(state, out, parameters):\n    while True:\n        pass\n", {}, nowhere)
    with pytest.raises(NotImplementedError, match=r"erf .*give one of"):
        formulas.module_of_text("def f(state, out, parameters):\n    a = math.erf(1.0)\n", {}, nowhere)
