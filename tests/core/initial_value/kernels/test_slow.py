"""The slow flow on a critical set, and the sets themselves."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core import psi as families
from codim2_core.expressions.names import MOST_SLOW_VARIABLES
from codim2_core.initial_value.compiled import functions_of
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import ends, rate, slow

from .placing import MOVES, TANH, placed

# A(z) e = f(z), with strong coupling: det A < 0.
COUPLED = System(
    U=("(1 + 0.2*z1)*c + (3 - z2)*s - 1.1*z1*z2 + x - 2*y", "2*c + (1 - 0.3*z1*z2)*s - sin(z1) + 0.5*x + y"),
    W=("1.5 - 0.7*c*z2 + x", "0.4*s + z1**2 - 3*z2 - y"),
)


def _coupled(z):
    """Its e and W at z."""
    z1, z2 = z
    A = np.array([[1.0 + 0.2 * z1, 3.0 - z2], [2.0, 1.0 - 0.3 * z1 * z2]])
    c, s = np.linalg.solve(A, [1.1 * z1 * z2, math.sin(z1)])
    return np.array([c, s]), np.array([1.5 - 0.7 * c * z2, 0.4 * s + z1**2 - 3.0 * z2])


def _slope(function, z, h=1e-4):
    """The derivative by z, by differences of fourth order, for `function` with values (k,): (k, m)."""
    columns = []
    for step in h * np.eye(len(z)):
        near, far = function(z + step) - function(z - step), function(z + 2.0 * step) - function(z - 2.0 * step)
        columns.append((8.0 * near - far) / (12.0 * h))
    return np.array(columns).T


def _flow(system, e, z):
    """(e', z') and the slopes that are written, near a set."""
    value, slopes = slow.flow()
    gain = int(functions_of(field(system), families.constant()).addresses[2])
    motion = rate.Motion(value.address, slopes.address, gain, 2 + len(z), 1.0, 1e-6, 0.01, 0.0, 0.0)
    S, found, J = placed(system, np.zeros(len(z))), np.zeros(2 + len(z)), np.full((2 + len(z),) * 2, math.nan)
    S[rate.VALUE : rate.SLOPES], S[rate.SLOPES : rate.PLACES] = 7.0, math.nan  # all that is read is written first
    y = np.array([*e, *z])
    rate.rate(motion, y, S, found)
    rate.jacobian(motion, y, S, J)
    return found, J


def test_sets_near_points_and_their_slopes():
    own = functions_of(field(MOVES), TANH).addresses
    points = np.array([[0.1, 0.1, 0.4, 2.0], [-0.2, 0.5, -0.7, 1.0]])
    e, D = slow.sets(own[:2].view(float), points)
    np.testing.assert_allclose(e, [[0.4, 0.3], [-0.7, 0.3]], atol=1e-14)
    np.testing.assert_allclose(D, [[[-2.0, 0.7], [-0.9, -1.0]]] * 2, atol=1e-14)
    S = placed(MOVES, (0.4, 2.0))
    assert slow.found_set(S, 2)
    assert ends.determinant(S, 4) == pytest.approx(2.0 + 0.7 * 0.9, abs=1e-14)
    lost = System(U=("z1 - c**2", "-s"))
    e, _ = slow.sets(functions_of(field(lost), TANH).addresses[:2].view(float), np.array([[0.3, 0.0, -0.5]]))
    assert np.isnan(e).all()


@pytest.mark.parametrize("z", [(0.3, 0.4), (-0.5, 0.2)])
def test_the_slow_flow_moves_e_as_the_set_moves_with_z(z):
    """e' = D_z e W and D_z z' = dW/dz along the set, by differences of e = A^-1 f; e' as if D_z e were constant."""
    z = np.array(z)
    e, W = _coupled(z)
    found, J = _flow(COUPLED, e + np.array([0.05, -0.03]), z)
    moved, along = _slope(lambda at: _coupled(at)[0], z), _slope(lambda at: _coupled(at)[1], z)
    np.testing.assert_allclose(found, [*(moved @ W), *W], atol=1e-11)
    np.testing.assert_allclose(J[2:, 2:], along, atol=1e-11)
    np.testing.assert_allclose(J[:2, 2:], moved @ along, atol=1e-11)
    np.testing.assert_array_equal(J[:, :2], 0.0)


def test_it_is_known_for_as_many_slow_variables_as_there_may_be():
    """e = (z1 z_m, sum of z); z_k' = k + z_k."""
    m = MOST_SLOW_VARIABLES
    names = [f"z{k}" for k in range(1, m + 1)]
    system = System(
        U=(f"-c + 0.5*s + z1*z{m} - 0.5*({'+'.join(names)})", f"{'+'.join(names)} - s"),
        W=tuple(f"{k} + {name}" for k, name in enumerate(names)),
    )
    z = 0.1 * np.cos(np.arange(m))
    e, W = np.array([z[0] * z[-1], z.sum()]), np.arange(m) + z
    found, J = _flow(system, e + 0.02, z)
    np.testing.assert_allclose(found, [W[0] * z[-1] + z[0] * W[-1], W.sum(), *W], atol=1e-12)
    np.testing.assert_allclose(J[2:, 2:], np.eye(m), atol=1e-12)
    np.testing.assert_allclose(J[1, 2:], 1.0, atol=1e-12)
    np.testing.assert_allclose(J[0, 2:], [z[-1], *np.zeros(m - 2), z[0]], atol=1e-12)


def test_where_there_is_no_set_nothing_is_said_of_its_motion():
    system = System(U=("z1 - c**2", "-s"), W=("-1 + 0.1*c",))
    found, J = _flow(system, (0.3, 0.0), np.array([-0.5]))
    assert np.isnan(found).all()
    np.testing.assert_array_equal(J, 0.0)
    assert np.isfinite(_flow(system, (0.3, 0.0), np.array([0.05]))[0]).all()


@pytest.mark.parametrize("away", [(0.9, 0.0), (0.0, 0.9), (-0.9, 0.3)])
def test_of_an_affine_field_the_set_is_found_at_once_unless_it_is_too_far(away):
    z = np.array([0.3, 0.4])
    e = _coupled(z)[0]
    for times, there in ((1.0, True), (1.2, False)):
        S = placed(COUPLED, z)
        S[slow.PLACE : slow.PLACE + 4] = *(e + times * np.array(away)), 5.0, -7.0  # x and y are set to 0
        assert bool(slow.found_set(S, 2)) is there
        if there:
            np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 6], [*e, 0.0, 0.0, *z], atol=1e-15)
            np.testing.assert_allclose(S[slow.RATES : slow.RATES + 4], [0.0, 0.0, *_coupled(z)[1]], atol=1e-14)


def test_a_set_has_all_digits_where_newtons_method_ends():
    """c' = -50 (c - 0.2) (c - 0.18): a step of 3e-7 leaves 5e-12."""
    S = placed(System(U=("-(c - 0.2) - 50*(c - 0.2)**2", "-s - 50*(s + 0.1)**2 - 0.1")), ())
    S[slow.PLACE : slow.PLACE + 2] = 0.2 + 7.7e-5, -0.1 + 7.7e-5
    assert slow.found_set(S, 0)
    np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 2], [0.2, -0.1], atol=1e-15)


def test_where_newtons_method_goes_round_there_is_no_set():
    """c^2 + 0.16 = 0 from 0.4 cot(pi/3): to and fro between that and its negative."""
    S = placed(System(U=("c**2 + 0.16", "-s")), ())
    S[slow.PLACE] = 0.4 / math.tan(math.pi / 3.0)
    assert not slow.found_set(S, 0)


def test_slopes_that_are_undefined_are_those_just_beside():
    """Of c^3/(c^2 + (z1 - 3)^2) at its corner, and of what is too large; what lies behind a table is not looked at."""
    system = System(
        U=("c**3/(c**2 + (z1 - 3)**2) - 2*s**2 + x", "(1e200*s)**3 + c*y + 5*s"), W=("1 + 0.25*c*s + y**2",)
    )
    S = placed(system, (3.0,))
    S[slow.PLACE : slow.PLACE + 4] = 0.0, 0.5, 0.75, -2.0
    before = S[slow.PLACE : slow.PLACE + 5].copy()
    S[slow.TABLE :] = math.nan
    slow.write_slopes(S, 1)
    table = S[slow.TABLE : slow.TABLE + 15].reshape(3, 5)
    corner = [49.0 / 289.0, -2.0, 1.0, 0.0, -8.0 / 289.0]  # 1e-9 of 1 + |c| and of 1 + |z1| beside it: at (1, 4)
    np.testing.assert_allclose(table[0], corner, rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(table[1], [-2.0, 0.0, 0.0, 0.0, 0.0], rtol=1e-6, atol=1e-8)
    np.testing.assert_allclose(table[2], [0.125, 0.0, 0.0, -4.0, 0.0], rtol=1e-6, atol=1e-8)
    np.testing.assert_array_equal(S[slow.PLACE : slow.PLACE + 5], before)
    for s, expected in ((0.5, [-2.0, 0.0, 0.0, 0.25, 0.0]), (0.0, [-2.0, 5.0, 0.0, 0.25, 0.0])):
        S[slow.PLACE : slow.PLACE + 2] = 0.25, s
        S[slow.TABLE :] = math.nan
        slow.write_slopes(S, 1)
        table = S[slow.TABLE : slow.TABLE + 15].reshape(3, 5)
        np.testing.assert_allclose(table[1], expected, atol=1e-8 if s else 0.0)  # exact where all are defined
