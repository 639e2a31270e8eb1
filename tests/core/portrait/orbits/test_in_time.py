"""An orbit over time: closed forms, the motion of the regularised system, and the line that is drawn of it."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core import psi
from codim2_core.motion.simulate import simulate
from codim2_core.portrait.orbits.in_time import MAX_RADIUS, in_time
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.presets.presets import presets

FAMILIES = (psi.constant(), psi.rational(), psi.hill(3.0))
coordinates = st.floats(-2.0, 2.0)


@settings(max_examples=20)
@given(
    st.tuples(coordinates, coordinates),
    st.sampled_from([(0.3, -0.2), (0.0, 0.0), (-0.9, 0.1), (1.4, 0.3), (-1.0, -0.9)]),
)
@example((1.5625, 1.5625), (-0.9, 0.1))  # up to 10 eps from Sigma both ways
def test_where_the_force_is_constant_an_orbit_is_a_straight_line_run_through_evenly(f, seed):
    if math.hypot(*f) < 0.1:
        return
    found = in_time(ELinear(0.0, 0.0, 0.0, f), psi.constant(), seed, (-1.5, 2.5))
    start = found.xy[found.time == 0.0]
    r = np.hypot(*seed)
    assert found.fast == (r < 1.0)
    # x2 - f tau is linear in what is followed, and constant: each step of a linear method keeps it, to rounding
    off = 1e-12 if found.fast else 2e-5
    line = start + found.time[:, None] * np.array(f)
    np.testing.assert_allclose(found.xy, line, rtol=0.0, atol=off * np.abs(found.xy).max())
    assert (np.diff(found.time) >= 0.0).all()
    np.testing.assert_allclose(
        start[0], np.array(seed) * (1 / math.sqrt(1 - r * r) if r < 1.0 else (r - 1.0) / r), rtol=0.0, atol=1e-12
    )


@pytest.mark.parametrize("family", FAMILIES, ids=str)
def test_on_the_hemisphere_it_is_the_motion_of_the_regularised_system_in_units_of_eps(family):
    system = ELinear(-1.2, 0.7, -0.4, (-0.3, 0.2))
    seed, eps = np.array([0.5, -0.6]), 1e-3
    found = in_time(system, family, seed, (-3.0, 6.0))
    ahead = found.time >= 0.0
    x2 = found.xy[found.time == 0.0][0]
    run = simulate(system, family, eps * x2, (0.0, eps * found.time[-1]), eps=eps, rtol=1e-10)
    np.testing.assert_allclose(found.xy[ahead], run.dense(eps * found.time[ahead])[:, :2] / eps, atol=2e-5)
    first = found.time[0]
    again = simulate(system, family, eps * found.xy[0], (0.0, -eps * first), eps=eps, rtol=1e-10)
    np.testing.assert_allclose(again.states[-1, :2] / eps, x2, atol=1e-4)


@pytest.mark.parametrize("name", ["case1-cm4", "case2-saddle", "case3-n2", "ball-slip"])
def test_its_points_lie_on_the_line_that_is_drawn_and_its_times_are_those_told(name):
    preset = presets[name]
    seeds = [(0.5, 0.31), (-0.2, -0.7), (1.4, 0.5), (-0.7, -1.2)]
    scene = Scene(preset.system, preset.psi, preset.z, launch=seeds)
    launched = scene["launched"]
    for i, seed in enumerate(seeds):
        clock = launched.orbits.times[i]
        found = in_time(preset.system, preset.psi, seed, (clock[0], clock[-1]), preset.z)
        line = launched.orbits.points[i]
        within = np.hypot(*line.T) < 0.99 if found.fast else np.ones(len(line), bool)
        gaps = [np.hypot(*(found.points - point).T).min() for point in line[within]]
        assert max(gaps) < 0.05  # every drawn point is passed …
        for point, theta in zip(found.points, found.theta, strict=True):  # … and the angles are those of the points
            assert math.remainder(theta - math.atan2(point[1], point[0]), 2 * math.pi) == pytest.approx(0.0, abs=1e-12)
        lengths = np.hypot(*found.xy.T)
        expected = lengths / np.hypot(1.0, lengths) if found.fast else lengths
        np.testing.assert_allclose(found.radius, expected, rtol=1e-9, atol=1e-12)
        after = launched.goes[i].after
        if after is not None and not found.fast:
            assert found.time[-1] == pytest.approx(after, rel=1e-3)


def test_an_orbit_from_infinity_is_followed_ten_eps_out_and_a_far_seed_farther():
    away = ELinear(-1.0, 0.0, -1.0)
    near = in_time(away, psi.constant(), (0.5, 0.0), (-50.0, 1.0))
    assert 0.9 * MAX_RADIUS < np.hypot(*near.xy.T).max() <= MAX_RADIUS
    p = 50.0 / math.hypot(1.0, 50.0)
    far = in_time(away, psi.constant(), (p, 0.0), (-50.0, 1.0))
    assert 130.0 < far.xy[0, 0] <= 150.0
    assert len(near) <= 600
    assert not near.xy.flags.writeable


@pytest.mark.parametrize(
    ("seed", "span", "words"),
    [((1.0, 0.0), (0.0, 1.0), "equator"), ((0.2, 0.0), (1.0, 2.0), "span"), ((math.nan, 0.0), (0.0, 1.0), "seed")],
)
def test_what_has_no_time_is_refused(seed, span, words):
    with pytest.raises(ValueError, match=words):
        in_time(ELinear(-1.0, 0.0, -1.0), psi.constant(), seed, span)
