"""What both compiled maps do in one lane, each held against what it is by definition."""

import math

import numpy as np
import pytest

from codim2_core.cycles import lane_steps
from codim2_core.stepping.layout import EACH, ERROR_3, ERROR_5, GAINS, LANES, NEW, SIGN, STATE, STEP
from codim2_core.stepping.numbers import PSI, SHARED

LANE = 2


def filled():
    """A workspace in which no two numbers are alike, and its parameters."""
    S, P = lane_steps.workspace(np.arange(1.0, SHARED + 1.0))
    S[:] = np.random.default_rng(1).uniform(0.5, 1.5, len(S))
    return S, P


def at(row, lane=LANE):
    """Where a lane's three components lie."""
    return row + lane + LANES * np.arange(3)


def changed(before, after):
    """Which numbers differ."""
    return set(np.flatnonzero(before != after).tolist())


def test_all_lanes_lie_on_the_hemisphere():
    S, P = lane_steps.workspace(np.arange(1.0, SHARED + 1.0))
    assert not S.any()
    np.testing.assert_array_equal(P[:SIGN], np.arange(1.0, SHARED + 1.0))
    np.testing.assert_array_equal(P[SIGN:GAINS], np.full(LANES, -1.0))


def test_a_lane_has_the_numbers_of_its_own_system():
    _, P = lane_steps.workspace(np.arange(1.0, SHARED + 1.0))
    before = P.copy()
    lane_steps.load_system(P, np.arange(11.0, 11.0 + SHARED), LANE)
    own = [EACH + c * LANES + LANE for c in range(PSI + 1)]
    np.testing.assert_array_equal(P[own], np.arange(11.0, 12.0 + PSI))
    assert changed(before, P) == set(own)


def test_states_go_into_lanes_and_what_is_left_over_repeats_the_first():
    S, _ = filled()
    before = S.copy()
    states = np.random.default_rng(2).uniform(-1.0, 1.0, (9, 3))
    lane_steps.load(S, states, 5, 3)
    for lane in range(LANES):
        np.testing.assert_array_equal(S[at(STATE, lane)], states[5 + lane if lane < 3 else 5])
    assert changed(before, S) == {i for lane in range(LANES) for i in at(STATE, lane).tolist()}


def test_each_lane_has_a_length_of_its_own():
    S, _ = filled()
    before, lengths = S.copy(), 2.0 + np.arange(float(LANES))
    lane_steps.set_lengths(S, lengths)
    for lane in range(LANES):
        assert (S[at(STEP, lane)] == lengths[lane]).all()
    assert changed(before, S) == {i for lane in range(LANES) for i in at(STEP, lane).tolist()}


def test_a_state_goes_back_to_the_sphere_along_its_ray():
    S, _ = filled()
    before = S.copy()
    lane_steps.to_sphere(S, LANE)
    np.testing.assert_allclose(S[at(NEW)], before[at(NEW)] / np.linalg.norm(before[at(NEW)]), rtol=1e-15)
    assert changed(before, S) == set(at(NEW).tolist())


@pytest.mark.parametrize("height", [1.0, -0.7, 1e-6])
def test_an_error_is_that_of_the_method_in_units_of_what_is_allowed(height):
    """Hairer, Norsett and Wanner's: |e5|^2/sqrt(n (|e5|^2 + 0.01 |e3|^2)); of w it is relative."""
    S, _ = filled()
    S[at(NEW)[2]] = height
    for rtol in (1e-3, 1e-9):
        T = S.copy()
        unit = rtol * np.array([1.0, 1.0, abs(height)])
        five, three = (float(np.sum((S[at(row)] / unit) ** 2)) for row in (ERROR_5, ERROR_3))
        assert lane_steps.judged(T, LANE, rtol) == pytest.approx(five / math.sqrt(3 * (five + 0.01 * three)), rel=1e-12)
        np.testing.assert_allclose(T[at(NEW)], S[at(NEW)] / np.linalg.norm(S[at(NEW)]), rtol=1e-15)
    S[at(ERROR_5)] = S[at(ERROR_3)] = 0.0
    assert lane_steps.judged(S, LANE, 1e-9) == 0.0  # and not 0/0


def test_the_next_step_would_have_the_error_that_is_allowed_but_for_a_margin():
    """An error grows like the eighth power of the length; nothing grows beyond five times or falls below a fifth."""
    for error in (2e-6, 1e-4, 0.1, 1.0, 100.0, 1e4, 8e4, 1.5e5):  # the last ones: by a factor of 0.22, of 0.203
        factor = lane_steps.growth(error)
        assert error * factor**8 == pytest.approx(0.43, rel=1e-2)  # 0.9^8
    assert lane_steps.growth(1.0) < 1.0
    assert lane_steps.growth(0.0) == 5.0
    for refused in (1e30, math.inf, math.nan):
        assert lane_steps.growth(refused) == 0.2


def searched(f, low, high):
    """Find the sign change of f in lane `LANE` as the maps do: where it is, and how often f was asked."""
    lows, at_low, highs, at_high, step = (np.full(LANES, 7.0) for _ in range(5))
    side = np.zeros(LANES, np.int64)
    lows[LANE], at_low[LANE], highs[LANE], at_high[LANE] = low, f(low), high, f(high)
    before = at_low[LANE] > 0.0
    asked = 0
    while highs[LANE] - lows[LANE] > 4e-16 * highs[LANE]:
        step[LANE] = lane_steps.next_length(LANE, lows, at_low, highs, at_high)
        assert lows[LANE] < step[LANE] < highs[LANE]
        g = f(step[LANE])
        asked += 1
        if g == 0.0 or asked == 100:
            break
        lane_steps.narrow(LANE, (g > 0.0) == before, g, step, lows, at_low, highs, at_high, side)
        assert f(lows[LANE]) * f(low) > 0.0 > f(highs[LANE]) * f(low)
    others = np.arange(LANES) != LANE
    for array in (lows, at_low, highs, at_high, step):
        assert (array[others] == 7.0).all()
    assert not side[others].any()
    return step[LANE], asked


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(
    ("f", "low", "high", "root", "most"),
    [
        (lambda t: 0.7 - t, 0.0, 1.0, 0.7, 2),
        (lambda t: math.exp(-9.0) - math.exp(-9.0 * t), 0.0, 3.0, 1.0, 30),  # the chord alone takes thousands
        (lambda t: t**7 - 0.1, 0.0, 1.0, 0.1 ** (1 / 7), 20),
        (lambda t: math.tanh(30.0 * (t - 0.9)), 0.0, 1.0, 0.9, 20),
    ],
)
def test_where_a_step_meets_the_section_is_found_fast(sign, f, low, high, root, most):
    found, asked = searched(lambda t: sign * f(t), low, high)
    assert found == pytest.approx(root, abs=4e-15)
    assert asked <= most


def test_an_end_that_is_kept_twice_counts_half():
    """The rule of the Illinois algorithm; an end kept once, and then moved, counts whole again."""
    low, at_low, high, at_high, step = (np.zeros(LANES) for _ in range(5))
    side = np.zeros(LANES, np.int64)
    at_low[LANE], high[LANE], at_high[LANE] = -1.0, 1.0, 8.0
    weights = []
    for before in (True, True, True, False, False, True):
        step[LANE] += 0.01
        lane_steps.narrow(LANE, before, -1.0 if before else 8.0, step, low, at_low, high, at_high, side)
        weights.append((at_low[LANE], at_high[LANE]))
        assert (low if before else high)[LANE] == step[LANE]
    assert weights == [(-1.0, 8.0), (-1.0, 4.0), (-1.0, 2.0), (-1.0, 8.0), (-0.5, 8.0), (-1.0, 8.0)]


def test_without_a_chord_the_middle_is_tried():
    low, high = np.full(LANES, 1.0), np.full(LANES, 2.0)
    for at_low, at_high in ((1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (math.nan, 1.0), (3.0, 1.0)):
        found = lane_steps.next_length(LANE, low, np.full(LANES, at_low), high, np.full(LANES, at_high))
        assert found == 1.5


def test_steps_are_written_down_while_there_is_room():
    S, _ = filled()
    log, written = np.zeros((2, 5)), 0
    for k, expected in ((LANE, 1), (0, 2), (1, 2)):
        written = lane_steps.noted(log, written, S, k, 0.25, 7)
        assert written == expected
    for row, k in zip(log, (LANE, 0), strict=True):
        np.testing.assert_array_equal(row, [*S[at(STATE, k)], 0.25, 7.0])
