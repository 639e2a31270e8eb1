"""The towed wheel against its equations of motion solved as numbers, and where it rolls in closed form."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core.motion.initial_value.field import field

PSI = c2.psi.constant()
PARTS = {"V": 3.0, "l": 0.2, "a": 0.1, "r": 0.12, "j": 0.2, "k": 400.0, "b": 0.5, "f": 4.0}


def cubic(V, l, a, r, k, b, **_):  # noqa: E741
    """With l psi' = q' - V psi and the contact's force eliminated from the two linear equations of motion."""
    return [(l - a) ** 2 + r**2, V * (l - a) + b * l**2, l * (b * V + k * l), k * l * V]


def moved(z, xy, e, V, l, a, r, j, k, b, f):  # noqa: E741
    """(x, y, q, psi, u)' by Newton and Euler: forces at the centre of mass, the king pin and the contact, as numbers.

    The unknowns are u', psi'', the spin's and the king pin's force along the way, which keeps V.
    """
    q, psi, u = z
    cos, sin = math.cos(psi), math.sin(psi)
    along, across = np.array([cos, sin]), np.array([-sin, cos])
    w = (u * cos - V * sin - xy[1]) / l  # y = u cos - V sin - l w
    F = -f * (e[0] * along + e[1] * across)
    arm, rest = -a * along, (a - l) * along  # king pin to centre of mass, and on to the contact
    # the centre of mass, per mass: (0, u') + w' turned - w^2 arm = F + (P, -k q - b u), turned = arm by a quarter
    matrix, right = np.zeros((3, 3)), np.zeros(3)
    turned = np.array([-arm[1], arm[0]])
    matrix[:2, 0], matrix[:2, 1], matrix[:2, 2] = [0.0, 1.0], turned, [-1.0, 0.0]
    right[:2] = F + [0.0, -k * q - b * u] + w**2 * arm
    # about it: r^2 w' = rest x F + (-arm) x (P, -k q - b u)
    matrix[2, 1], matrix[2, 2] = r**2, -arm[1]
    right[2] = rest[0] * F[1] - rest[1] * F[0] - arm[0] * (-k * q - b * u)
    du, dw, _ = np.linalg.solve(matrix, right)
    spin = -(along @ F) / j  # the wheel is turned by what holds it back
    x = du * sin + u * cos * w - V * sin * w - spin
    y = du * cos - u * sin * w - V * cos * w - l * dw
    return np.array([x, y, u, w, du])


some = st.floats(-1.2, 1.2)


@settings(max_examples=20)
@given(some, some, some, some, some, st.floats(-3.0, 3.0))
def test_it_moves_by_newtons_and_eulers_equations(q, psi, u, x, y, theta):
    """In all of its motions, slipping or not."""
    wheel, e, z = c2.examples.towed_wheel(**PARTS), 0.7 * np.array([math.cos(theta), math.sin(theta)]), (q, psi, u)
    found = np.array(field(wheel).value(*e.tolist(), x, y, *z))
    expected = moved(z, (x, y), e, **PARTS)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("b", [0.0, 0.5, 3.0])
@pytest.mark.parametrize("V", [1.0, 8.0])
def test_rolling_straight_has_the_roots_of_a_cubic(V, b):
    """Of the slow flow at z = 0, by differences; it is stable as Routh and Hurwitz say, and as the docstring says."""
    parts = {**PARTS, "V": V, "b": b}
    wheel, h = c2.examples.towed_wheel(**parts), 1e-5
    flow = lambda z: np.array(c2.critical_sets(wheel, PSI, tuple(z.tolist()))[0].slow_flow)
    M = np.column_stack([(flow(d) - flow(-d)) / (2.0 * h) for d in h * np.eye(3)])
    roots, known = np.linalg.eigvals(M), np.roots(cubic(**parts))
    for root in roots:
        assert np.abs(known - root).min() < 1e-6 * np.abs(known).max()
    l, a, r, k = (parts[name] for name in "lark")  # noqa: E741
    stable = (V * (l - a) + b * l**2) * (b * V + k * l) > k * V * ((l - a) ** 2 + r**2)
    assert (roots.real.max() < 0.0) == stable


@pytest.mark.parametrize("share", [0.98, 1.02])
def test_with_the_caster_straight_it_slips_where_the_spring_pulls_too_much(share):
    """It holds while |k q (a^2 + r^2 - a l)| < f ((l - a)^2 + r^2)."""
    l, a, r, k, f = (PARTS[name] for name in "larkf")  # noqa: E741
    most = f * ((l - a) ** 2 + r**2) / (k * (a**2 + r**2 - a * l))
    sets = c2.critical_sets(c2.examples.towed_wheel(**PARTS), PSI, (share * most, 0.0, 0.0))
    assert len(sets) == (1 if share < 1.0 else 0)
    if sets:
        np.testing.assert_allclose(sets[0].e, [0.0, -share], atol=1e-9)


def test_shimmy_grows_until_the_wheel_slips_and_with_damping_it_dies_out():
    start, span = (0.0, 0.0, 0.01, 0.0, 0.0), (0.0, 4.0)
    wild = c2.simulate_nonsmooth(c2.examples.towed_wheel(**PARTS), start, span, PSI)
    kinds = [phase.kind for phase in wild.phases]
    assert kinds[0] == "slide"
    assert kinds.count("slip") > 2
    late = wild.states[wild.times > 3.0, 2]
    assert 0.02 < np.abs(late).max() < 0.1  # friction bounds it
    calm = c2.simulate_nonsmooth(c2.examples.towed_wheel(**{**PARTS, "b": 10.0}), start, span, PSI)
    assert [phase.kind for phase in calm.phases] == ["slide"]
    rate = np.roots(cubic(**{**PARTS, "b": 10.0})).real.max()
    assert np.abs(calm.states[-1, 2:]).max() < 0.5 * math.exp(4.0 * rate)
