"""What surely slides where it arrives at Sigma."""

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core.initial_value.field import field
from codim2_core.initial_value.functions import functions_of
from codim2_core.initial_value.kernels import slow
from codim2_core.initial_value.kernels.arrival import slides
from codim2_core.stepping.field_parameters import PSI
from codim2_core.stepping.layout import PARAMETERS

from .placing import HILL, TANH, directions, placed


def _slides(system, theta, psi=None, affine=False, line=(0.0, 0.0), z=()):
    S, P = placed(system, z, psi or TANH), np.zeros(PARAMETERS)
    P[PSI] = (psi or TANH).parameter
    gain = int(functions_of(field(system), psi or TANH, many=True).addresses[2])
    found = slides(S, P, gain, 2 + len(z), affine, psi is not None, *line, theta)
    return bool(found), (float(S[slow.SET_PLACE]), float(S[slow.SET_PLACE + 1]))


@pytest.mark.parametrize(
    ("C", "A", "expected"),
    [
        ((0.4, -0.2), (-1.0, 2.0, -0.5, -1.5), True),  # A + A^T negative definite
        ((0.9, -0.6), (-1.0, 2.0, -0.5, -1.5), False),  # outside
        ((0.4, -0.2), (-1.0, 2.6, 0.5, -1.5), False),  # A + A^T is not
        ((0.4, -0.2), (-2.0, 0.0, 0.0, -1e-7), False),  # hardly
        ((-0.3, 0.8), (-1.0, -3.0, 3.0, -0.2), True),  # round and round onto it: there is no direction
        ((0.4, -0.2), (-1.0, 0.6, -0.2, -1.5), True),
    ],
)
def test_what_arrives_slides_on_the_only_set(C, A, expected):
    a, b, c, d = A
    system = System(U=(f"{a}*(c - {C[0]}) + {b}*(s - {C[1]})", f"{c}*(c - {C[0]}) + {d}*(s - {C[1]})"))
    found, place = _slides(system, 0.3, affine=True)
    assert found is expected
    if expected:
        assert place == pytest.approx(C, abs=1e-14)


def test_what_arrives_slides_where_two_orbits_end():
    system = System(U=("-(c - 0.4) + 0.6*(s + 0.2)", "-0.2*(c - 0.4) - 1.5*(s + 0.2)"))
    theta = _attracting(system)
    found, place = _slides(system, theta, TANH)
    assert found
    assert place == pytest.approx((0.4, -0.2), abs=1e-9)
    assert _slides(system, theta + 0.1, TANH)[0]
    assert not _slides(system, theta + 0.5, TANH)[0]  # no direction is near
    assert not _slides(system, theta)[0]  # with no Psi known


def _attracting(system):
    for theta in directions(system, ()):
        c, s = math.cos(theta), math.sin(theta)
        D = field(system).jacobian(c, s, 0.0, 0.0, ())[:2, :2]
        u, v = field(system).value(c, s, 0.0, 0.0)[:2]
        if c * u + s * v < 0.0 and -s * (D[0] @ [-s, c]) + c * (D[1] @ [-s, c]) < c * u + s * v:
            return theta
    raise AssertionError("there is none")


@pytest.mark.parametrize("psi", [TANH, HILL], ids=lambda psi: psi.text)
def test_of_two_sets_the_direction_tells_the_one(psi):
    """c = 0.5 and c = -0.5 attract, 0 repels in c; all attract in s."""
    two = System(U=("3*c*(0.25 - c**2)", "-4*s"))
    for theta, e in ((0.05, 0.5), (math.pi - 0.05, -0.5)):
        found, place = _slides(two, theta, psi)
        assert found
        assert place == pytest.approx((e, 0.0), abs=1e-9)
    assert not _slides(two, 0.5 * math.pi, psi)[0]  # where nothing arrives


def test_where_orbits_on_both_sides_end_on_two_sets_it_is_not_sure():
    """The one between them, up c = 0, ends at the saddle."""
    assert not _slides(System(U=("c*(0.5 - 4*s**2 - c**2)", "-1.5*s")), 0.5 * math.pi, TANH)[0]


def test_in_a_line_it_slides_on_the_first_zero_if_that_attracts():
    n = (0.6, -0.8)
    q = "(0.6*c - 0.8*s)"
    line = System(U=(f"0.6*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})", f"-0.8*({q} - 0.2)*({q} + 0.5)*(-1.3 - {q})"))
    theta = math.atan2(-0.8, 0.6)
    found, place = _slides(line, theta, line=n)
    assert found
    assert place == pytest.approx((0.2 * 0.6, -0.2 * 0.8), abs=1e-12)
    assert not _slides(line, theta + math.pi, line=n)[0]  # it leaves at that end
    through = System(U=("-0.6 + 0*c", "0.8 + 0*c"))
    assert not _slides(through, theta, line=n)[0]
    flat = System(U=(f"-0.6*({q} - 0.2)**3", f"0.8*({q} - 0.2)**3"))
    assert not _slides(flat, theta, line=n)[0]  # it may attract or not
    near = System(U=("-0.6*(0.6*c - 0.8*s + 0.9999999)", "0.8*(0.6*c - 0.8*s + 0.9999999)"))
    assert not _slides(near, theta, line=n)[0]  # within 1e-6 of the other end
