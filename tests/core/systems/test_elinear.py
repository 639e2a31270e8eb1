import math
import re

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, branches, psi

number = st.floats(-10, 10).map(lambda v: round(v, 9))


def test_numbers_and_text_give_the_same_coefficients():
    plain = ELinear(-2.0, 0.5, -1.0, (0.3, -0.4), B=[[1.0, 2.0]], g=[0.25]).at(0.5)
    typed = ELinear("-4*z", "z1", "-2*z", ("0.3 + 0*z", "-0.8*z"), B=[["2*z", 2.0]], g=["z**2"]).at(0.5)
    assert typed.plane == plain.plane
    np.testing.assert_array_equal(typed.B, plain.B)
    np.testing.assert_array_equal(typed.g, plain.g)


def test_a_b_d_of_a_matrix_are_those_of_its_normal_form():
    given = ELinear.from_matrix([[1, -2], [3, -4]], f=(0.1, 0.2), B=[[1.0, -2.0]], g=[0.5])
    turned = given.rotated()
    assert (turned.at().plane, turned.at().B.tolist()) == (given.at().plane, given.at().B.tolist())
    assert (given.a, given.b, given.d) == (turned.a, turned.b, turned.d)
    assert f"a={given.a}" in repr(given)
    assert given.evolve(a=-1.0, f1=0.3) == turned.evolve(a=-1.0, f1=0.3)
    family = psi.hill(3)
    found, expected = (branches(one, family, "a", (-5, 2), with_cycles=False).special for one in (given, turned))
    assert [(one.kind, one.value) for one in found] == [(one.kind, one.value) for one in expected]
    assert found


@settings(max_examples=20)
@given(st.lists(number, min_size=4, max_size=4), number, number, st.floats(-4, 4))
@example([0.0, 0.0, 0.0, -0.0], 0.0, 1.0, 0.0)
@example([0.0, 1.0, -1.0, -0.0], 0.5, 0.0, 1.0)
def test_from_matrix_is_the_same_system_seen_in_rotated_axes(entries, f1, f2, theta):
    A = np.array(entries).reshape(2, 2)
    at = ELinear.from_matrix(A, (f1, f2), B=[[1.0, -2.0]], g=[0.5]).at()
    if max(map(abs, at.plane)) == 0:
        return
    c, s = math.cos(at.rotation), math.sin(at.rotation)
    R = np.array([[c, -s], [s, c]])
    e = np.array([math.cos(theta), math.sin(theta)])
    scale = 1 + np.abs(A).max() + abs(f1) + abs(f2)
    np.testing.assert_allclose(at.U(R @ e), R @ (A @ e + [f1, f2]), rtol=0.0, atol=4e-15 * scale)
    np.testing.assert_allclose(at.W(R @ e), [e[0] - 2 * e[1] + 0.5], rtol=0.0, atol=1e-14)
    assert abs(at.a * at.d + at.b**2 - np.linalg.det(A)) <= 1e-13 * scale**2


def test_from_matrix_takes_entries_that_depend_on_z():
    system = ELinear.from_matrix([["z", 1.0], [0.0, "-z"]])
    fixed = ELinear.from_matrix([[0.7, 1.0], [0.0, -0.7]])
    assert system.m == 1
    assert system.at(0.7).plane == fixed.at().plane


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: ELinear(1, math.inf, 1), "b is inf"),
        (lambda: ELinear(1, 0, 1e200), "rescales time"),
        (lambda: ELinear(1, 0, 1, (1e-200, 0)).evolve(a=0, d=0).at(), "rescales time"),
        (lambda: ELinear(1, 0, 1, 3), "f is 3"),
        (lambda: ELinear(1, 0, 1, (1, 2, 3)), "two coefficients"),
        (lambda: ELinear(1, 0, 1, B=[[1, 2, 3]]), "(m, 2)"),
        (lambda: ELinear(1, 0, 1, B=[[1, 2]], g=[1, 2]), "both need m"),
        (lambda: ELinear("q + 1", 0, 1), "q"),
        (lambda: ELinear("__import__('os')", 0, 1), "a: "),
        (lambda: ELinear("z", 0, 1).at(), "m = 1"),
        (lambda: ELinear("z", 0, 1).at(math.nan), "finite"),
        (lambda: ELinear("1/z", 0, 1).at(0.0), "a"),
        (lambda: ELinear(1, 0, 1).at(3.0), "no slow variable"),
        (lambda: ELinear(1, 0, 1).evolve(q=3), "'q' is no coefficient"),
        (lambda: ELinear("z2", 0, 1, g=[1.0]).m, "a names z2, but g has 1 row: use z, or give B and g 2 rows"),
        (lambda: ELinear.from_matrix([1, 2, 3]), "(2, 2)"),
        (lambda: ELinear.from_matrix([["z", 2], [3, 4]]).evolve(a=1), "holds text"),
    ],
)
def test_bad_input_says_what_and_how_to_mend(make, says):
    with pytest.raises(ValueError, match=re.escape(says)):
        make()
