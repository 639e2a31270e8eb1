"""The compiled return map, for Psi = 1 and f = 0: there x2' = A x2 in the time T, as e_Psi = p and dT = ebar dtau."""

import math

import numpy as np
import pytest

from codim2_core import psi
from codim2_core.cycles.return_map import INWARD, OUTWARD, RETURNED, UNDECIDED, reached, returns
from codim2_core.stepping.fields import field
from codim2_core.stepping.layout import LANES
from codim2_core.stepping.numbers import SHARED

SEVERAL = 2 * LANES + 1
FIELD = field(psi.constant())
RTOL = 1e-12


def parameters(a, b, d, f=(0.0, 0.0)):
    shared = np.zeros(SHARED)
    shared[:5] = a, b, d, *f
    return shared


def sphere(x2):
    """States (n, 3) of points (n, 2) of kappa_2."""
    w = 1.0 / np.hypot(1.0, np.hypot(*x2.T))
    return np.column_stack([x2 * w[:, None], w])


def plane(states):
    return states[:, :2] / states[:, 2:]


def turned(x2, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x2[..., 0] - s * x2[..., 1], s * x2[..., 0] + c * x2[..., 1]], axis=-1)


class Spiral:
    """``A = growth + b J``: orbits turn by b T and grow by exp(growth T). Where u.U = 0, and where they come to it."""

    def __init__(self, growth, b, u=(0.8, 0.6), f=(0.0, 0.0)):
        self.growth, self.b, self.u = growth, b, np.array(u)
        self.shared = parameters(growth, b, growth, f)
        self.sense = math.copysign(1.0, b)
        # U is x2 turned by arg A; on the section it is u turned by a quarter, in the sense of b
        self.ray = turned(self.u, self.sense * 0.5 * math.pi - math.atan2(b, growth))

    def at(self, x2, T):
        return turned(x2, self.b * T) * np.exp(self.growth * T)[..., None]

    def returns(
        self, x2, floor=1e-9, sunk=1e-9, t_max=1e3, rtol=RTOL, limit=500, record=0, centre=(0.0, 0.0), elsewhere=False
    ):
        return returns(
            sphere(x2), self.shared, FIELD.address, self.u, np.array(centre), self.sense, floor, sunk, t_max, rtol,
            limit, record, elsewhere,
        )  # fmt: skip


SPIRALS = pytest.mark.parametrize(("growth", "b"), [(-0.2, 1.0), (0.15, 1.3), (0.1, -0.8), (-0.1, -1.1)])


@SPIRALS
@pytest.mark.parametrize("u", [(0.8, 0.6), (1.0, 0.0), (0.0, -1.0)])
def test_a_turn_takes_its_time_and_grows_as_it_must(growth, b, u):
    own = Spiral(growth, b, u)
    x2 = np.geomspace(0.02, 20.0, SEVERAL)[:, None] * own.ray
    ends, times, codes, steps = own.returns(x2)
    period = 2.0 * math.pi / abs(b)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose(times, period, rtol=1e-11)
    np.testing.assert_allclose(plane(ends), math.exp(growth * period) * x2, rtol=1e-10, atol=1e-12)
    assert len(steps) == 0
    # on the section to a few roundings
    U = ends[:, :2] @ np.array([[growth, -b], [b, growth]]).T
    np.testing.assert_allclose(U @ own.u / np.hypot(*U.T), 0.0, atol=2e-15)


@SPIRALS
def test_from_elsewhere_it_is_the_first_crossing(growth, b):
    own = Spiral(growth, b)
    before = np.linspace(0.05, 0.99, SEVERAL)  # of a turn, until the section comes
    T = before * 2.0 * math.pi / abs(b)
    x2 = own.at(np.geomspace(0.1, 5.0, SEVERAL)[:, None] * own.ray, -T)
    ends, times, codes, _ = own.returns(x2, elsewhere=True)
    assert (codes == RETURNED).all()
    np.testing.assert_allclose(times, T, rtol=1e-10)
    np.testing.assert_allclose(plane(ends), own.at(x2, T), rtol=1e-10, atol=1e-12)


def test_the_steps_of_the_first_state_are_those_of_its_orbit():
    own = Spiral(-0.2, 1.0)
    x2 = np.linspace(0.7, 0.3, SEVERAL)[:, None] * own.ray
    ends, times, _, steps = own.returns(x2, record=200)
    np.testing.assert_array_equal(steps[0, :3], sphere(x2)[0])
    np.testing.assert_allclose(steps[:, 3].sum(), times[0], rtol=1e-14)
    after = reached(steps[:, :3].copy(), steps[:, 3].copy(), own.shared, FIELD.address)
    np.testing.assert_allclose(after, [*steps[1:, :3], ends[0]], rtol=0.0, atol=5e-16)
    clock = np.concatenate([[0.0], np.cumsum(steps[:, 3])])
    np.testing.assert_allclose(plane(steps[:, :3]), own.at(x2[0], clock[:-1]), rtol=0.0, atol=1e-11)
    short = own.returns(x2, record=3)[3]
    np.testing.assert_array_equal(short, steps[:3])
    middle = reached(np.repeat(steps[:1, :3], SEVERAL, axis=0), np.linspace(0, 0.2, SEVERAL), own.shared, FIELD.address)
    np.testing.assert_allclose(plane(middle), own.at(x2[0], np.linspace(0, 0.2, SEVERAL)), rtol=0.0, atol=1e-12)
    long = reached(np.repeat(steps[:1, :3], SEVERAL, axis=0), np.linspace(1, 2, SEVERAL), own.shared, FIELD.address)
    np.testing.assert_allclose(np.linalg.norm(long, axis=1), 1.0, rtol=0.0, atol=5e-16)  # whatever its error
    assert np.abs(plane(long) - own.at(x2[0], np.linspace(1, 2, SEVERAL))).max() > 1e-9


def test_steps_are_as_long_as_the_tolerance_lets_them_be():
    """A method of order 8: errors and tolerance go together, and a hundredth of it costs 78 % more steps."""
    own = Spiral(-0.2, 1.0)
    x2, period = 0.7 * own.ray[None, :], 2.0 * math.pi
    counts, errors = [], []
    for rtol in (1e-6, 1e-8, 1e-10):
        ends, _, _, steps = own.returns(x2, record=200, rtol=rtol)
        counts.append(len(steps))
        errors.append(float(np.abs(plane(ends) - math.exp(-0.2 * period) * x2).max()))
        np.testing.assert_allclose(np.linalg.norm([*steps[:, :3], *ends], axis=1), 1.0, rtol=0.0, atol=5e-16)
        assert errors[-1] < 3.0 * rtol
        assert len(steps) < 13 * (1e-6 / rtol) ** 0.125
    assert errors[0] > 1e-9
    first = [own.returns(x2, record=1, rtol=rtol)[3][0, 3] for rtol in (1e-4, 1e-12)]
    assert first[0] == pytest.approx(10.0 * first[1], rel=1e-12)
    assert 0.1 < first[0] < 0.2


def test_onto_the_centre_and_onto_the_equator_it_does_not_return():
    for growth, expected in ((-5.0, INWARD), (5.0, OUTWARD)):
        own = Spiral(growth, 1.0)
        x2 = np.array([0.3, 0.8, 0.5])[:, None] * own.ray
        ends, times, codes, steps = own.returns(x2, floor=1e-3, sunk=1e-3, record=100)
        assert (codes == expected).all()
        np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-9)
        if expected == INWARD:
            gone = np.hypot(*plane(ends).T) < 1e-3
            still = np.hypot(*plane(steps).T) >= 1e-3
        else:
            gone = ends[:, 2] < 1e-3 * sphere(x2)[:, 2]
            still = steps[:, 2] >= 1e-3 * steps[0, 2]
        assert gone.all()
        assert still.all()
        assert steps[:, 3].sum() == pytest.approx(times[0], rel=1e-14)


def test_it_is_the_distance_from_the_centre_that_counts():
    e = np.array([0.3, -0.2])
    A = np.array([[-3.0, -1.0], [1.0, -3.0]])
    own = Spiral(-3.0, 1.0, f=tuple(-A @ e))
    centre = e / math.sqrt(1.0 - e @ e)  # Psi = 1: e = p
    near = centre + 0.03 * own.ray
    ends, _, codes, steps = own.returns(near[None, :], floor=1e-4, record=100, centre=centre)
    assert codes[0] == INWARD
    assert np.hypot(*(plane(ends)[0] - centre)) < 1e-4
    assert (np.hypot(*(plane(steps) - centre).T) >= 1e-4).all()


def test_what_does_not_end_in_time_is_undecided():
    own = Spiral(0.0, 0.1)
    x2 = 0.5 * own.ray[None, :]
    ends, times, codes, steps = own.returns(x2, t_max=20.0, record=100)
    assert codes[0] == UNDECIDED
    assert times[0] >= 20.0
    assert times[0] - steps[-1, 3] < 20.0
    np.testing.assert_allclose(plane(ends), own.at(x2, times), rtol=1e-10)
    assert own.returns(x2, t_max=63.0)[2][0] == RETURNED  # 2 pi/0.1
    _, _, codes, steps = own.returns(x2, limit=4, record=100)
    assert (codes[0], len(steps)) == (UNDECIDED, 4)
    _, _, codes, steps = own.returns(x2, t_max=1e3, limit=500, record=500)
    enough = own.returns(x2, limit=len(steps) + 40)  # as many again as finding the end may take
    assert enough[2][0] == RETURNED


def test_lanes_do_not_disturb_each_other():
    own = Spiral(-0.2, 1.0)
    x2 = np.linspace(0.1, 3.0, SEVERAL)[:, None] * own.ray
    together = own.returns(x2, rtol=1e-8)
    for i in (0, 1, LANES, SEVERAL - 1):
        alone = own.returns(x2[i : i + 1], rtol=1e-8)
        np.testing.assert_array_equal(alone[0][0], together[0][i])
        assert alone[1][0] == together[1][i]
