"""What is said of settings whose degeneracy is known in closed form."""

import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi

from .recognition import recognise

SETTINGS = [
    (ELinear(-1, 1, -1, (1, 0)), ["two have met"]),
    (ELinear(-1, 0, -1.5, (-0.5, 0)), ["one splits, D2"]),
    (ELinear(0, 1.5, 1, (2**0.5, -(2**0.5))), ["between the cases", "four have met"]),
    (ELinear(-1, 0, -1), ["nothing turns"]),
    (ELinear(0, 0, 0), ["between the cases", "nothing turns", "everything, e-linear"]),
    (ELinear(0, 2, 0, (0.3, 0.1)), ["between the cases", "neutral closed equator", "true centre"]),
    (ELinear(-1, 3, 1, (0.4, -0.4)), ["neutral closed equator", "true centre"]),
    (ELinear(-1, 0, -1, (1, 0)), ["exists on the equator"]),
    (ELinear(-1, 0, 0, (0.3, 0.2)), ["between the cases", "singular, none"]),
    (ELinear(-1, 0, 0, (0.3, 0)), ["between the cases", "singular, a line"]),
    (ELinear(-1, 0, 0, (1.3, 0)), ["between the cases", "singular, outside"]),
    (System(U=("-s", "c - c**3")), ["two have met", "zero on the equator", "linear centre, one of them"]),
    (System(U=("-c**3", "-s*c**2")), ["no turning", "curve of zeros"]),
    (System(U=("-c", "-s + abs(c) - c")), ["arc of directions", "on a net"]),
]


@pytest.mark.parametrize(("system", "keys"), SETTINGS, ids=str)
def test_of_degenerate_settings(system, keys):
    found = c2.classify(system, psi.constant()).degeneracies
    assert {key for item in found for key, _ in recognise(item.sentence)} - {"nearer"} == set(keys)
