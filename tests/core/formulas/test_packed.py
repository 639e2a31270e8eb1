"""Packed formulas, as right-hand sides interpret them, are the formulas."""

import ctypes
from functools import reduce

import numpy as np
import pytest

from codim2_core.formulas import packed
from codim2_core.formulas.arrays import path_program
from codim2_core.formulas.expression import parse
from codim2_core.formulas.functions import FUNCTIONS
from codim2_core.formulas.jit import SCRATCH_SIZE, interpreted
from codim2_core.formulas.packed import ROWS, pack, result, run_packed
from codim2_core.motion.initial_value import functions
from codim2_core.motion.initial_value.kernels.rate import VALUE_FORMULAS

NAMES = ("c", "s", "x", "y", "z1", "z2")
TEXTS = (
    "c - 3*s + 0.3*c**3", "max(c, s) + min(x, 0.1)*tanh(s)", "x*exp(-y) + |s| + 1/(2 + c**2)", "(2 + c)**1.5",
    "(2 + s)**-2 + c**7 + x**0 + (2 + c)**(1 + s)", "c*min(s, c) + sign(x)*sqrt(2 + s)", "sqrt(c*c + s*s)/sqrt(3 + z1)",
    "floor(5*z1) + mod(z2, 0.3) + (x < y)", "2", "c", "-z2", "1/(c - c) + s",
)  # fmt: skip
OF_ONE = tuple(f"{one.name}(0.5 + 0.3*c)" for one in FUNCTIONS)


def at_one_place(T, places, out):
    """Call the compiled right-hand side of motions at each place."""
    call = ctypes.CFUNCTYPE(None, *[ctypes.c_void_p] * 3)(functions._interpreters()[0].address)
    parameters = np.zeros(VALUE_FORMULAS + 1)
    parameters[VALUE_FORMULAS] = T.ctypes.data
    for place, values in zip(places, out, strict=True):
        call(place.ctypes.data, values.ctypes.data, parameters.ctypes.data)


def side_by_side(T, places, out):
    """Evaluate eight places at once, as Python."""

    def evaluate(width):
        R = np.empty(SCRATCH_SIZE)
        for first in range(0, len(places), width):
            here = places[first : first + width]
            for v, values in enumerate(here.T):
                R[v * width : v * width + len(here)] = values
            interpreted.interpreted(run_packed)(T, R, width, len(here))
            for r in range(out.shape[1]):
                out[first : first + width, r] = interpreted.interpreted(result)(T, R, r, width, len(here))

    with np.errstate(all="ignore"):
        evaluate(min(8, SCRATCH_SIZE // int(T[ROWS])))


def places(count=37):
    return np.random.default_rng(1).uniform(-1.0, 1.0, (count, len(NAMES)))


def expected(rows, at):
    with np.errstate(all="ignore"):
        known = dict(zip(NAMES, at.T, strict=True))
        return np.stack([np.broadcast_to(one.evaluate(known), len(at)) for one in rows], axis=-1)


@pytest.mark.parametrize("evaluate", [at_one_place, side_by_side])
def test_they_have_the_values_of_the_formulas(evaluate):
    rows = tuple(parse(text, NAMES) for text in TEXTS + OF_ONE)
    slopes = tuple(one.derivative(name) for one in rows for name in NAMES)
    for some in (rows, slopes):
        T, at = pack(path_program(some), len(NAMES), bound=len(NAMES)), places()
        out = np.empty((len(at), len(some)))
        evaluate(T, at, out)
        np.testing.assert_allclose(out, expected(some, at), rtol=1e-13, atol=1e-14)


def joined(op, terms):
    both = parse(f"p {op} q", ("p", "q"))
    return reduce(lambda one, other: both.substitute("p", one).substitute("q", other), terms)


def keeping(count):
    """Sums that enter a product from the last to the first: all of them are kept until then."""
    sums = [parse(f"c + s*{k}/1000", ("c", "s")) for k in range(count)]
    factors = [parse("1 + p/1000", ("p",)).substitute("p", one) for one in reversed(sums)]
    return joined("+", [joined("+", sums), joined("*", factors)])


def test_more_values_than_there_is_room_for_are_refused(monkeypatch):
    monkeypatch.setattr(packed, "SCRATCH_SIZE", 50)
    with pytest.raises(ValueError, match="give formulas that keep at most 50"):
        pack(path_program((keeping(60),)), 4)
