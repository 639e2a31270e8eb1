"""Samples of a displacement, on sections made up so that every answer is known."""

import math

import numpy as np
import pytest

from codim2_core.cycles import resolution
from codim2_core.cycles.resolution import (
    Samples,
    _doubtful,
    counted,
    cubics,
    differences,
    near_fold,
    unresolved,
    zeros,
)
from codim2_core.cycles.section import COARSE, FINE
from codim2_core.words import say

from .sections import UNEVEN, Line


def test_fourth_differences_are_the_leading_coefficient():
    for degree, expected in ((3, 0.0), (4, 2.5)):
        np.testing.assert_allclose(differences(UNEVEN, 2.5 * UNEVEN**degree - UNEVEN**2), expected, rtol=0.0, atol=1e-9)
    assert len(differences(UNEVEN, UNEVEN)) == len(UNEVEN) - 4


def test_a_cubic_is_itself_and_of_a_quartic_the_remainder_is_known():
    places = UNEVEN[:-1, None] + np.diff(UNEVEN)[:, None] * np.linspace(0.0, 1.0, 17)
    for f, far in ((lambda x: x**3 - 2.0 * x + 1.0, False), (lambda x: 3.0 * x**4 - x, True)):
        values, error = cubics(UNEVEN, f(UNEVEN))
        assert values.shape == error.shape == places.shape
        np.testing.assert_allclose(np.abs(f(places) - values), error, rtol=0.0, atol=1e-11)
        assert (error.max() > 0.1) == far
        assert not error[:, [0, -1]].any()  # both ends of an interval are among its samples
    # in the middle of the samples the four about an interval are used: the product of distances is smaller there
    assert error[3].max() < error[0].max()


def test_the_largest_of_the_differences_near_an_interval_counts():
    """Only the last sample is off: the error is large where it enters, and nothing far from it."""
    q = np.arange(12.0)
    shift = np.zeros(12)
    shift[-1] = 1.0
    _, error = cubics(q, shift)
    fourth = 1.0 / 24.0
    assert (error.max(axis=1) > 0.0).tolist() == [False] * 7 + [True] * 4
    assert error[9].max() == pytest.approx(
        fourth * max(abs(x * (x - 1) * (x - 2) * (x - 3)) for x in 1 + np.arange(17) / 16)
    )


@pytest.mark.parametrize(
    ("values", "doubtful"),
    [
        ([1.0, 1.0, 1.0], False),
        ([1.0, 0.05, 1.0], True),
        ([1.0, 0.09, 1.0], True),
        ([1.0, 0.11, 1.0], False),
        ([1.0, -0.5, 1.0], True),
        ([1.0, 0.2, -1.0], False),
        ([1.0, -0.5, 0.05, -1.0], True),
        ([1.0, 0.05, 0.05, -1.0], True),
        ([1.0, 0.5, 0.05, -1.0], False),
    ],
)
def test_other_zeros_than_the_signs_ask_for(values, doubtful):
    row = np.array([values])
    for sign in (1.0, -1.0):
        assert _doubtful(sign * row, np.full_like(row, 0.1)).tolist() == [doubtful]
        assert _doubtful(0.01 * sign * row, np.full_like(row, 0.001)).tolist() == [doubtful]  # in another unit


def test_what_samples_do_and_do_not_show():
    q = np.linspace(-3.0, 3.0, 26)
    none = np.zeros(26)
    assert unresolved(q, np.sin(q), none) == []
    assert unresolved(q, np.sin(q), none + 0.3) != []  # zero cannot be told apart any more
    assert unresolved(q, q**2 + 1.0, none) == []
    hidden = unresolved(
        q, (q - 0.12) ** 2 - 1e-4, none
    )  # two zeros between two samples, on none of which it is negative
    assert 12 in hidden
    assert set(hidden) <= {11, 12, 13}
    assert unresolved(q[:4], np.ones(4), none[:4]) == [0, 1, 2]  # too few to know
    gap = np.where(np.abs(q) < 0.3, np.inf, np.where(q > 0, 1.0, -1.0))
    assert unresolved(q, gap, none) == []
    few = np.where((q > -0.3) & (q < 0.4), 1.0, np.nan)
    assert unresolved(q, few, none) == [12, 13]


def test_five_samples_of_a_run_are_enough_and_four_show_nothing():
    q = np.linspace(0.0, 1.0, 5)
    assert unresolved(q, 1.0 + q, np.full(5, 1e-9)) == []
    assert unresolved(q[:4], 1.0 + q[:4], np.full(4, 1e-9)) == [0, 1, 2]


def test_a_dip_of_few_samples_is_looked_into_on_both_sides():
    q = np.arange(12.0)
    shift = np.ones(12)
    shift[6] = 0.4
    found = unresolved(q, shift, np.zeros(12))
    assert {5, 6} <= set(found)
    shift[6] = 0.999
    assert unresolved(q, shift, np.zeros(12)) == []
    for unit in (1e-3, -1e-3, -1.0, 50.0):  # in any unit, on either side
        shift[6] = 0.4
        assert {5, 6} <= set(unresolved(q, unit * shift, np.zeros(12)))
        shift[6] = 0.6  # not much of a dip, were it not for the cubic's error
        assert unresolved(q, unit * shift, np.zeros(12)) == unresolved(q, shift, np.zeros(12))


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("unit", [1.0, 1e-3])
@pytest.mark.parametrize(
    ("three", "dip"),
    [
        ((1.0, 0.4, 0.5), True),  # less than half of the higher beside it,
        ((0.5, 0.4, 1.0), True),
        ((1.0, 0.6, 0.7), False),  # or not,
        ((1.0, 0.3, 0.2), False),  # and no lower one beside it
        ((0.2, 0.3, 1.0), False),
        ((1.0, 0.1, -1.0), False),  # on its way through zero
        ((0.5, 0.5, 0.5), False),
    ],
)
def test_a_dip_is_one_between_two_that_are_higher(monkeypatch, three, dip, unit, sign):
    """Where the cubics show nothing, the heights alone tell."""
    straight = lambda q, shift: (np.linspace(shift[:-1], shift[1:], 17, axis=1), np.zeros((len(q) - 1, 17)))
    monkeypatch.setattr(resolution, "cubics", straight)
    slow = 1.1 ** np.arange(1, 4)  # beside the three nothing dips
    shift = sign * unit * np.concatenate([three[0] * slow[::-1], three, three[2] * slow])
    found = unresolved(np.arange(9.0), shift, np.zeros(9))
    assert found == ([3, 4] if dip else [])


def test_how_many_were_found_is_said():
    for count, key in ((0, "no cycle"), (1, "one cycle"), (2, "cycles"), (5, "cycles")):
        for way in ("section", "turn"):
            assert counted(count, way, about="C") == say(f"{key}, {way}", count=count, about="C")


@pytest.mark.parametrize(
    ("shift", "expected"),
    [
        ([1, 2, -1, -2], ([(1, 2)], [], False)),
        ([-1, 1, -np.inf, np.inf], ([(0, 1), (1, 2), (2, 3)], [], False)),
        ([1, 0, -1], ([(0, 2)], [], False)),
        ([1, 0, 1], ([], [1], False)),
        ([1, 0.05, 0.01, 0.08, 2], ([], [2], True)),
        ([1, 0, np.nan, 1], ([], [], False)),
        ([-1, -2, -3], ([], [], False)),
    ],
)
def test_signs_folds_and_bands(shift, expected):
    shift = np.array(shift, float)
    noise = np.full(len(shift), 0.1)
    near = 0.001 * np.arange(len(shift))
    changes, touching, band = zeros(near, shift, noise)
    if expected[2]:
        assert (changes, touching, band) == ([], expected[1], False)
        assert zeros(np.arange(len(shift)), shift, noise) == ([], [], True)
    else:
        assert (changes, touching, band) == expected


def test_samples_stay_in_order_and_know_which_are_fine():
    section = Line(lambda xi: xi**2)
    samples = Samples(section, np.array([-1.0, 0.0, 1.0, 2.0]))
    coarse = samples.noise
    np.testing.assert_allclose(coarse, 1e-8 * (1.0 + np.exp(-samples.q)))
    samples.refine(np.array([1.5, -0.5]), np.array([False, True, False, False]))
    assert samples.xi.tolist() == [-1.0, -0.5, 0.0, 1.0, 1.5, 2.0]
    assert samples.q.tolist() == (2.0 * samples.xi).tolist()
    assert samples.shift.tolist() == (samples.xi**2).tolist()
    assert samples.fine.tolist() == [False, True, True, False, True, False]
    assert [count for count, *_ in section.asked] == [4, 3]
    assert section.asked[0][1] > section.asked[1][1]
    np.testing.assert_allclose(samples.noise[[1, 2]], 1e-11 * (1.0 + np.exp(-samples.q[[1, 2]])))
    samples.refine(np.array([0.1]), np.ones(6, bool))
    assert section.asked[-1][0] == 4  # what is fine already is not asked for again


@pytest.mark.parametrize("apart", [1e-1, 1e-2, 1e-3])
@pytest.mark.parametrize("backward", [False, True])
def test_two_zeros_close_together_are_separated(apart, backward):
    at = (0.3123, 0.3123 + apart, -1.1)
    f = lambda xi: (xi - at[0]) * (xi - at[1]) * (xi - at[2])
    samples = Samples(Line(f), np.linspace(-3.0, 3.0, 24), backward)
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, band = zeros(samples.q, samples.shift, samples.noise)
    assert (len(changes), touching, band) == (3, [], False)
    for (i, j), root in zip(changes, sorted(at), strict=True):
        assert samples.xi[i] <= root <= samples.xi[j]
        if apart < 0.1 and root > 0.0:  # what is close together is judged by samples that are all fine
            assert samples.fine[i - 1 : j + 2].all()
    assert len(samples.xi) < 200
    assert np.sign(samples.shift[0]) == (1.0 if backward else -1.0)


def test_a_fold_is_touched_and_a_map_too_wild_is_said_to_be():
    samples = Samples(Line(lambda xi: (xi - 0.4) ** 2), np.linspace(-3.0, 3.0, 24))
    assert samples.resolve(lambda xi, shift: [])
    changes, touching, _ = zeros(samples.q, samples.shift, samples.noise)
    assert changes == []
    assert [samples.xi[i] for i in touching] == [pytest.approx(0.4, abs=1e-4)]
    assert np.diff(samples.xi).min() > 2e-6 / 33  # narrower than `NARROWEST` nothing is divided
    wild = Samples(Line(lambda xi: np.sin(3e4 * xi) + 0.5), np.linspace(-3.0, 3.0, 24))
    assert not wild.resolve(lambda xi, shift: [])
    assert 900 < len(wild.xi) <= 4 * 900
    lost = Samples(Line(lambda xi: np.where(xi < 1.0, np.nan, 1.0)), np.linspace(-3.0, 3.0, 24))
    assert not lost.resolve(lambda xi, shift: [0])
    assert len(lost.xi) == 24
    looked = Samples(Line(lambda xi: 1.0 + 0.0 * xi), np.linspace(-3.0, 3.0, 24))
    assert looked.resolve(lambda xi, shift: [i for i in (3, 9) if xi[i + 1] - xi[i] > 0.1])
    assert len(looked.xi) == 24 + 2 * 16
    # where nothing is doubtful, only signs are looked for
    assert {rtol for _, rtol, _ in looked.section.asked} == {COARSE}
    assert not looked.fine.any()
    doubtful = Samples(Line(lambda xi: (xi - 0.4) ** 2 + 1e-3), np.linspace(-3.0, 3.0, 24))
    assert doubtful.resolve(lambda xi, shift: [i for i in (3, 9) if xi[i + 1] - xi[i] > 0.1])
    assert {rtol for _, rtol, _ in doubtful.section.asked[1:2]} == {FINE}


def test_a_jump_is_told_from_a_steep_slope_down_to_rounding():
    samples = Samples(Line(lambda xi: np.where(xi < 0.4321, -1.0, 1.0) + 0.0 * xi), np.linspace(-3.0, 3.0, 24))
    assert samples.resolve(lambda xi, shift: [], 1e-5)
    ((i, j),), touching, _ = zeros(samples.q, samples.shift, samples.noise)
    assert touching == []
    assert 0.0 < samples.xi[j] - samples.xi[i] < 1e-4


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("centre", "height", "bend"), [(0.37, 3e-4, 2.0), (1.62, -0.2, 0.3), (2.11, 5.0, 70.0)])
def test_how_near_a_fold_is_the_height_of_a_parabola(centre, height, bend, sign):
    """Wherever its vertex lies between uneven samples."""
    shift = sign * (height + bend * (UNEVEN - centre) ** 2)
    assert near_fold(UNEVEN, shift, np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    assert near_fold(-UNEVEN[::-1], shift[::-1], np.zeros(8)) == pytest.approx(abs(height), rel=1e-9, abs=1e-12)
    broken = np.where(np.abs(UNEVEN - centre) < 0.45, np.nan, shift)
    assert near_fold(UNEVEN, broken, np.zeros(8)) == math.inf  # its vertex is not seen


@pytest.mark.parametrize("bend", [1.0, -1.0, 2.0])
def test_how_near_a_fold_is_whatever_its_bend(bend):
    q = np.arange(-3.0, 4.0) + 0.25
    shift = bend * (q**2 + 0.125)
    assert near_fold(q, shift, np.full(len(q), 1e-9)) == pytest.approx(0.125 * abs(bend), rel=1e-12)
    jagged = np.array([4.0, 1.0, 2.0, 2.0, 3.0, 5.0, 8.0])  # a level piece beside a rise is none
    assert near_fold(q, jagged, np.full(len(q), 1e-9)) == pytest.approx(0.875)


def test_without_an_extremum_there_is_no_fold_near():
    assert near_fold(UNEVEN, UNEVEN**3 - 2.0, np.zeros(8)) == math.inf
    assert near_fold(UNEVEN, np.full(8, 0.3), np.zeros(8)) == math.inf
    small = 1e-3 * np.array([5.0, 4.0, 3.0, 3.1, 3.0, 4.0, 5.0, 6.0])
    assert near_fold(UNEVEN, small, np.full(8, 1e-3)) == math.inf  # it falls and rises by no more than noise


def test_a_row_that_is_zero_within_noise_is_as_near_a_fold_as_its_largest():
    row = np.array([1.0, 1e-4, -2e-4, 5e-5, 1.0, 2.0, 3.0, 4.0])
    noise = np.full(8, 1e-4)
    assert near_fold(UNEVEN, row, noise) == pytest.approx(2e-4, rel=1.0)
    assert near_fold(UNEVEN, row, noise) <= 2e-4
    for beyond in (row[1:], row[3::-1]):  # at an end, where it may go either way
        assert near_fold(UNEVEN[: len(beyond)], beyond, noise[: len(beyond)]) > 0.1
    crossing = np.where(np.arange(8) > 3, -row, row)  # of one sign before, of the other behind
    assert near_fold(UNEVEN, crossing, noise) > 0.1
