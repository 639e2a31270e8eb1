"""Connections of saddles over two parameters: against closed forms, a normal form, and e-linear systems."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.bifurcations.atlases.atlas import curves_over, with_connections
from tests.core.polylines import away

# e' is a positive multiple of J grad H + m (H - k) grad H in the disc: the level H = k is made of orbits, and between
# levels H rises or falls along every other one. So a saddle has a loop where its own level is k, and nowhere else.
H = "(1-c**2-s**2)*(0.3+c**2+q*c)"
HC, HS = "(-2*c*(0.3+c**2+q*c)+(1-c**2-s**2)*(2*c+q))", "(-2*s*(0.3+c**2+q*c))"
RISING = c2.System(
    U=(
        f"{HS} - c*s*(2*c+q) + m*({H}-k)*((1-c**2-s**2)*{HC} + c*(c*{HC}+s*{HS}))",
        f"-{HC} - s*s*(2*c+q) + m*({H}-k)*((1-c**2-s**2)*{HS} + s*(c*{HC}+s*{HS}))",
    ),
    parameters={"q": 0.05, "k": 0.3, "m": 0.5},
)
LEVELS = "q", "k", ((-0.15, 0.15), (0.2, 0.4))


def level_of_the_saddle(q):
    c = sorted(np.roots([-4.0, -3.0 * q, 1.4, q]).real)[1]  # where H_c = 0 = s
    return (1 - c**2) * (0.3 + c**2 + q * c)


def connections(system, psi, *names_and_ranges):
    found = with_connections(system, psi, curves_over(system, psi, *names_and_ranges))
    return found, [one for one in found.curves if one.kind in ("homoclinic loop", "heteroclinic cycle")]


@pytest.mark.slow
def test_a_system_with_a_level_of_orbits_has_its_loops_where_the_saddle_is_on_it():
    found, loops = connections(RISING, c2.psi.constant(), *LEVELS)
    assert [one.kind for one in loops] == ["homoclinic loop"] * 2
    for one in loops:
        q, k = one.points.T
        assert np.abs(k - [level_of_the_saddle(v) for v in q]).max() < 1e-11
        assert (q.min(), q.max()) == pytest.approx((-0.15, 0.15), abs=1e-9)
        assert one.numbers == pytest.approx(np.ones(len(q)), abs=1e-9)
        assert not one.points.flags.writeable
    assert not [point for point in found.points if point.kind in ("neutral loop", "undecided")]
    assert found.unfinished == ()


def normal_form(sign):
    """Return x' = y, y' = p + q x + x^2 + sign x y about e = 0, and an equator that turns."""
    first, second = "s", f"(p + q*c + c**2 + {sign}*c*s)"
    inward, turning = f"(c*{first} + s*{second})", "(c**2 + s**2)**4/2"
    return c2.System(
        U=(f"(1-c**2-s**2)*{first} + c*{inward} - {turning}*s", f"(1-c**2-s**2)*{second} + s*{inward} + {turning}*c"),
        parameters={"p": 0.0, "q": 0.0},
    )


@pytest.mark.slow
@pytest.mark.parametrize("sign", [-1, 1])
def test_a_loop_begins_at_a_bogdanov_takens_point_with_the_slope_of_its_normal_form(sign):
    """p = -6 q^2/25 to first order, and the cycle born of it attracts where it does in the normal form."""
    _, loops = connections(normal_form(sign), c2.psi.constant(), "q", "p", ((-0.06, 0.01), (-2e-3, 1e-3)))
    (loop,) = [one for one in loops if np.abs(one.points[[0, -1]]).sum(axis=1).min() < 1e-12]
    q, p = loop.points[np.abs(loop.points[:, 0]) > 1e-3].T
    slope = p / q**2
    near, far = np.abs(q).argmin(), np.abs(q).argmax()
    assert abs(slope[near] + 6 / 25) < 1e-3
    assert abs(slope[near] + 6 / 25) < 0.3 * abs(slope[far] + 6 / 25)
    assert ((loop.numbers[np.abs(loop.points[:, 0]) > 1e-3] - 1.0) * -sign > 0.0).all()


@pytest.mark.slow
def test_heteroclinic_cycles_of_an_e_linear_system_are_those_of_its_own_method():
    """From where two borders touch to where a half-saddle meets its neighbour; the ratio is 1 at the same place."""
    values = {"a": 1, "b": 1.3, "d": -1.2, "f1": 0, "f2": 0}
    typed = c2.System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=values)
    psi = c2.psi.hill(3)
    known = c2.bifurcations.heteroclinic(c2.ELinear(1, 1.3, -1.2), psi)
    found, curves = connections(typed, psi, "f1", "f2", ((-1.5, 1.5), (-1.5, 1.5)))
    assert [curve.kind for curve in curves] == ["heteroclinic cycle"] * 2
    for curve in curves:
        (branch,) = [line for line in known.branches if line[0][1] * curve.points[0, 1] > 0.0]
        gap = away(curve.points, branch)
        assert gap[np.abs(curve.points[:, 0]) > 0.95].max() < 2e-4  # of its chords
        assert np.abs(curve.points).max() == pytest.approx(1.5, abs=1e-9)  # it leaves the plane
    neutral = [point.place for point in found.points if point.kind == "neutral loop"]
    assert len(neutral) == 2
    for place in neutral:
        assert min(np.hypot(*(np.array(place) - one.place)) for one in known.special) < 1e-7
