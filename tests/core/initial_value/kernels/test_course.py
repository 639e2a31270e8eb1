"""What a whole motion in the limit is put together from, part by part."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import ELinear, System
from codim2_core import psi as families
from codim2_core.initial_value import courses
from codim2_core.initial_value.field import field
from codim2_core.initial_value.kernels import course, ends, explicit, slow
from codim2_core.initial_value.kernels.course import LEAVE, SLIDE, SLIP, WHOLE
from codim2_core.initial_value.kernels.motion import CHUNK, CONTROL, FIRST, LEAST, NEXT
from codim2_core.initial_value.line import invariant_line

from .placing import MOVES, TANH, motion_of, placed

EDGE = math.sqrt(1.0 - 0.09)


def _followed(system, first, t_end, rtol=1e-3, most=10000, psi=TANH):
    first, own = np.atleast_2d(np.array(first, float)), field(system)
    lines = [invariant_line(own, state) for state in first]
    return courses.followed(own, psi, lines, first, (0.0, t_end), rtol, 0.01, most)


def test_a_slide_begins_with_a_small_part_of_the_time_in_which_z_changes_by_its_size():
    S = np.zeros(slow.EXTENT)
    y = np.array([0.9, -0.8, 2.0, -0.04])
    S[slow.RATES : slow.RATES + 4] = 100.0, 200.0, -3.0, 0.5  # of z1 3/2.01, of z2 0.5/0.05
    assert course._first_step(S, y, 0.01) == pytest.approx(FIRST / 10.0, rel=1e-14)
    S[slow.RATES + 3] = 0.05
    assert course._first_step(S, y, 0.01) == pytest.approx(FIRST / (3.0 / 2.01), rel=1e-14)
    S[slow.RATES + 2 : slow.RATES + 4] = 0.0
    assert course._first_step(S, y, 0.01) == math.inf


def test_a_step_cut_off_is_the_same_motion_up_to_there():
    polynomial = np.random.default_rng(3).normal(size=(3, 7))
    part, powers = polynomial.copy(), np.arange(1, 8)
    course._cut(part, 0.6)
    for u in (0.3, 1.0):
        np.testing.assert_allclose(part @ u**powers, polynomial @ (0.6 * u) ** powers, rtol=1e-13)


@pytest.mark.parametrize(
    ("ahead", "what", "count"),
    [
        ((0.3, 0.2, -0.4), ends.SAFE, 3),
        ((0.3, 0.5, 0.2), ends.EQUATOR, 2),  # z1 = 0.2, 0.5, and sqrt(0.91) within the second step
        ((0.3, 2.9, 0.2), ends.EQUATOR, 2),
    ],
)
def test_steps_of_a_slide_stay_on_sigma_and_keep_e_up_to_the_equator(ahead, what, count):
    S, values = placed(MOVES, (0.0, 0.0)), np.empty((ends.GAUGES, 5))
    z1 = 0.2 + np.cumsum(ahead)
    ways, lengths = np.zeros((3, 4, 7)), np.array([2.0, 3.0, 5.0])
    ways[:, 0, 0] = ways[:, 2, 0] = ahead
    ways[:, 3, 1] = -0.1  # z2 = 1 - 0.1 u^2
    stops = np.stack([z1, np.full(3, 0.3), z1, 1.0 - 0.1 * np.arange(1, 4)], axis=1)
    raw, sets = np.array([0.2, 0.3, 0.2, 1.0]), np.full((3, 2), math.nan)
    expected = stops.copy()
    found = course._on_sigma(S, 1.0, 0.0, 0.0, raw, values, lengths, stops, ways, sets)
    assert found == (what, count)
    np.testing.assert_array_equal(raw, expected[count - 1])
    np.testing.assert_array_equal(stops[:count, :2], 0.0)
    np.testing.assert_array_equal(ways[:count, :2], 0.0)
    whole = count if what == ends.SAFE else count - 1
    np.testing.assert_array_equal(stops[:whole, 2:], expected[:whole, 2:])
    np.testing.assert_allclose(sets[:whole], expected[:whole, :2], atol=1e-14)
    np.testing.assert_array_equal(lengths[:whole], [2.0, 3.0, 5.0][:whole])
    np.testing.assert_array_equal(ways[:whole, 2, 0], ahead[:whole])
    if what == ends.EQUATOR:
        part = (EDGE - 0.5) / ahead[1]
        assert lengths[1] == pytest.approx(3.0 * part, rel=1e-12)
        np.testing.assert_allclose(stops[1, 2:], [EDGE, 0.9 - 0.1 * part**2], atol=1e-12)
        np.testing.assert_allclose(sets[1], [EDGE, 0.3], atol=1e-12)
        np.testing.assert_allclose(ways[1, 2:, :2], [[EDGE - 0.5, 0.0], [0.0, -0.1 * part**2]], atol=1e-12)


def test_steps_of_a_slide_are_handed_over_where_they_are_not_sure():
    """A fold in the second of three."""
    S, values = placed(System(U=("z1 - c**2", "-s"), W=("-1",)), (0.0,)), np.empty((ends.GAUGES, 5))
    z1 = np.array([0.25, 0.16, -0.1, -0.2])
    ways = np.zeros((3, 3, 7))
    ways[:, 2, 0] = np.diff(z1)
    stops = np.stack([[0.4, 0.2, 0.1], np.zeros(3), z1[1:]], axis=1)
    raw, sets = np.array([0.5, 0.0, 0.25]), np.full((3, 2), math.nan)
    found = course._on_sigma(S, 1.0, 0.0, 0.0, raw, values, np.ones(3), stops, ways, sets)
    assert found == (ends.UNSURE, 1)
    np.testing.assert_array_equal(raw, [0.4, 0.0, 0.16])
    np.testing.assert_allclose(sets[0], [0.4, 0.0], atol=1e-14)


def test_a_step_is_kept_where_it_belongs():
    n, row = 3, 2
    y, linear, square = np.array([1.0, 2.0, 3.0]), np.array([0.1, 0.2, 0.3]), np.array([-0.01, 0.02, -0.03])
    states, polynomials = np.full(5 * n, math.nan), np.full(5 * n * explicit.DEGREE, math.nan)
    course._keep_step(y, linear, square, row, states, polynomials)
    np.testing.assert_allclose(y, [1.09, 2.22, 3.27], rtol=1e-15)
    states, polynomials = states.reshape(5, n), polynomials.reshape(5, n, explicit.DEGREE)
    np.testing.assert_array_equal(states[row + 1], y)
    assert np.isnan(states[[0, 1, 2, 4]]).all()
    np.testing.assert_array_equal(polynomials[row, :, :2], np.stack([linear, square], axis=1))
    np.testing.assert_array_equal(polynomials[row, :, 2:], 0.0)
    assert np.isnan(polynomials[[0, 1, 3, 4]]).all()


def test_the_rest_of_the_way_to_sigma_is_straight():
    """At the speed of rho, whatever turns: rho' = -0.4 at (0.6, 0.8) 1e-9."""
    system = System(U=("-0.6*0.4 - 0.8*0.3 + z1", "-0.8*0.4 + 0.6*0.3 + z2"), W=("3", "-0.5 + z2"))
    motion, S = motion_of(system, families.constant(), 0.0), np.zeros(slow.EXTENT)
    linear, square, rates = np.full(4, math.nan), np.full(4, math.nan), np.empty(4)
    y = np.array([6e-10, 8e-10, 0.0, 0.0])
    assert course._straight_on(motion, S, y, rates, linear, square) == pytest.approx(1e-9 / 0.4, rel=1e-12, abs=0.0)
    np.testing.assert_allclose(linear, [-6e-10, -8e-10, 7.5e-9, -1.25e-9], rtol=1e-12)
    np.testing.assert_array_equal(square, 0.0)
    for z in ((0.24 + 0.24 + 0.6, 0.32 - 0.18 + 0.8), (0.24 - 0.8, 0.32 + 0.6)):  # outward; about Sigma, and no more
        y[2:] = z
        assert course._straight_on(motion, S, y, rates, linear, square) > 1.0


@pytest.mark.parametrize(("z", "sign"), [((0.3, 0.4), -1.0), ((-0.3, 5.0), 1.0)])
def test_a_slide_begins_on_its_set(z, sign):
    """det = 1 - 2 (3 - z2), of A = (1, 3 - z2; 2, 1) about C = (z1, -0.2)."""
    system = System(U=("c - z1 + (3 - z2)*(s + 0.2)", "2*(c - z1) + s + 0.2"), W=("0.5", "-2.5 + c"))
    S, control, y = placed(system, (9.0, 9.0)), np.zeros(CONTROL), np.array([z[0] + 0.1, -0.25, *z])
    there, found = course._begun_slide(S, y, 0.01, control, 20.0)
    assert there
    assert found == sign
    np.testing.assert_allclose(S[slow.PLACE : slow.PLACE + 6], [z[0], -0.2, 0.0, 0.0, *z], atol=1e-14)
    pace = 1.0 / max(0.5 / (abs(z[0]) + 0.01), (2.5 - z[0]) / (z[1] + 0.01))
    assert control[NEXT] == pytest.approx(FIRST * pace)
    assert control[LEAST] == pytest.approx(course.SHORTEST * pace, rel=1e-12, abs=0.0)
    y[:2] = 3.0
    assert not course._begun_slide(S, y, 0.01, control, 1e-3)[0]
    assert control[LEAST] == pytest.approx(course.SHORTEST * 1e-3, rel=1e-12, abs=0.0)


def test_rows_keep_what_they_hold_and_have_room_for_more_than_twice_as_many():
    n, rows = 3, 11
    each = explicit.DEGREE * n
    rng = np.random.default_rng(1)
    before = tuple(rng.normal(size=rows * width) for width in (1, 1, n, each, 2))
    after = course._roomier(n, *before)
    assert [len(array) for array in after] == [(2 * rows + CHUNK) * width for width in (1, 1, n, each, 2)]
    for old, new in zip(before, after, strict=True):
        np.testing.assert_array_equal(new[: len(old)], old)


@pytest.mark.parametrize("m", [0, 2])
def test_steps_and_phases_are_counted_for_each_motion(m):
    """A straight fall: no step is refused, and the slide has one step without slow variables, a few with them."""
    falls = ELinear(-1.0, 0.0, -1.0, B=((0.0, 0.0),) * m, g=(2.0, -3.0)[:m])
    first = (0.6, -0.8, 0.5, 0.25)[: 2 + m]
    (whole,) = _followed(falls, first, 1.5)
    slip, slide = whole.legs
    assert (slip.kind, slide.kind, whole.onward) == (SLIP, SLIDE, WHOLE)
    assert slide.first == slip.last
    assert slide.last == len(whole.motion.lengths)
    if m == 0:
        assert slide.last == slip.last + 1
    # The last step of the slip, to Sigma, is none that is tried; the slip counts as one.
    enough = slip.last + 1 + max(slide.last - slide.first, 1)
    for one in _followed(falls, [first] * 3, 1.5, most=enough):
        assert one.onward == WHOLE
    for one in _followed(falls, [first] * 3, 1.5, most=enough - 1):
        assert one.onward == SLIDE
        assert [leg.kind for leg in one.legs] == [SLIP]
        assert one.theta == pytest.approx(math.atan2(-0.8, 0.6), abs=1e-6)
        assert len(one.motion.lengths) == slip.last


def test_without_slow_variables_a_slide_stays_to_the_end():
    """At C, for the time that is left; x and y fall into it along straight lines."""
    rests = ELinear(-1.0, 0.0, -1.0, f=(0.3, -0.2))
    for one in _followed(rests, [(0.6, -0.8), (1.2, 0.5)], 7.0):
        assert one.onward == WHOLE
        last = one.legs[-1]
        assert (last.kind, last.last - last.first) == (SLIDE, 1)
        times, lengths = one.motion.times, one.motion.lengths
        assert times[-1] == 7.0
        assert lengths[-1] == pytest.approx(7.0 - times[-2], abs=1e-14)
        np.testing.assert_array_equal(one.motion(np.linspace(times[-2] + 1e-9, 7.0, 5)), 0.0)
        np.testing.assert_allclose(one.sets[-2:], [[0.3, -0.2]] * 2, atol=1e-14)


def test_a_motion_that_does_not_arrive_in_time_is_a_slip():
    """It falls from 1 to 0 in the time 1."""
    falls = ELinear(-1.0, 0.0, -1.0, B=((0.0, 0.0),), g=(2.0,))
    for t_end, kinds in ((1.0 - 1e-9, [SLIP]), (1.0 + 1e-9, [SLIP, SLIDE])):
        (one,) = _followed(falls, (0.6, -0.8, 0.5), t_end)
        assert one.onward == WHOLE
        assert [leg.kind for leg in one.legs] == kinds
        assert one.motion.times[-1] == pytest.approx(t_end, abs=1e-15)
        assert math.hypot(*one.motion.states[-1, :2]) == pytest.approx(max(0.0, 1.0 - t_end), abs=1e-12)
        assert one.motion.states[-1, 2] == pytest.approx(0.5 + 2.0 * t_end, abs=1e-12)


def test_a_motion_of_more_phases_than_there_is_room_for_is_whole():
    """C = (1.1 sin z, 0), z' = 6: in each half turn it leaves where C is at the equator, and is soon back."""
    to_and_fro = System(U=("-(c - 1.1*sin(z1))", "-s"), W=("6",))
    (one,) = _followed(to_and_fro, (1e-3, 0.0, 0.0), 4.0, rtol=1e-2)
    kinds = [leg.kind for leg in one.legs]
    assert one.onward == WHOLE
    assert len(kinds) > 12
    assert kinds[:4] == [SLIP, SLIDE, LEAVE, SLIDE]
    times = one.motion.times
    left = [(leg.theta, one.motion.states[leg.first, 2]) for leg in one.legs if leg.kind == LEAVE]
    for theta, z in left:
        assert 1.1 * math.sin(z) == pytest.approx(math.cos(theta), abs=1e-6)
        assert abs(math.sin(theta)) < 1e-9
    np.testing.assert_allclose(one.motion.states[:, 2], 6.0 * times, atol=1e-6)
    assert [leg.first for leg in one.legs[1:]] == [leg.last for leg in one.legs[:-1]]


def test_which_of_two_sets_it_slides_on_is_told_with_a_psi_alone():
    two = System(U=("3*c*(0.25 - c**2)", "-4*s + 0*z1"), W=("1",))
    for x, c in ((0.3, 0.5), (-0.3, -0.5)):
        (one,) = _followed(two, (x, 0.05, 0.0), 1.0)
        assert one.onward == WHOLE
        assert [leg.kind for leg in one.legs] == [SLIP, SLIDE]
        np.testing.assert_allclose(one.sets[-1], [c, 0.0], atol=1e-12)
        (one,) = _followed(two, (x, 0.05, 0.0), 1.0, psi=None)
        assert one.onward == SLIP
        assert one.legs == ()


def test_a_slide_ends_at_the_equator_whatever_its_set_does_beyond():
    """C = (2 - sqrt(2 - z), 0) leaves the disc at z = 1, and has a fold at z = 2."""
    system = System(U=("(c - 2)**2 - 2 + z1", "-s"), W=("1",))
    (one,) = _followed(system, (-0.05, 0.0, 0.0), 3.0)
    assert one.onward == WHOLE
    assert [leg.kind for leg in one.legs] == [SLIP, SLIDE, LEAVE]
    assert one.motion.times[one.legs[1].last] == pytest.approx(1.0, abs=1e-9)
    assert one.legs[2].theta == pytest.approx(0.0, abs=1e-9)
    assert one.motion.states[-1, 0] == pytest.approx(2.0, rel=1e-3)  # x' = z - 1
