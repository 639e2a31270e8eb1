"""How steps follow one another: their lengths, the clock, the change between both methods, and why a motion ends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from codim2_core import System
from codim2_core import psi as families
from codim2_core.initial_value.compiled import numbers_of_tableau
from codim2_core.initial_value.kernels import explicit, motion, rate
from codim2_core.initial_value.kernels.motion import (
    ARRIVED,
    BLOWN_UP,
    CONTROL,
    COUNT,
    EXTENT,
    FARTHEST,
    FINISHED,
    FULL,
    IMPLICIT,
    LEAST,
    LEFT,
    LIMIT,
    NEXT,
    REFINED,
    SHORT,
    TRIED,
    WARY,
    WORTH,
)
from codim2_core.initial_value.kernels.stages import tableau_of, workspace
from codim2_core.numerics.radau import CAREFUL, FAILED, GROW

from .placing import TANH, motion_of

TABLE = tableau_of(numbers_of_tableau())
RESTS = System(U=("0*c", "0*c"), W=("0*c", "0*c"))


@pytest.mark.parametrize(
    ("wanted", "bound", "remaining", "h"),
    [
        (0.3, 9.0, 1.0, 0.3),
        (0.3, 0.2, 1.0, 0.2),
        (0.5, 9.0, 1.0, 0.5),
        (0.51, 9.0, 1.0, 0.5),  # what would leave less than another as long
        (0.98, 9.0, 1.0, 0.5),
        (0.99, 9.0, 1.0, 1.0),
        (9.0, math.inf, 1.0, 1.0),
        (9.0, 0.7, 2.0, 0.7),
        (9.0, 1.1, 2.0, 1.0),
    ],
)
def test_steps_leave_no_sliver_at_the_end(wanted, bound, remaining, h):
    assert motion._length(wanted, bound, remaining) == h


def test_the_clock_loses_nothing():
    """A million steps of 1e-17 after 1 are 1e-11: none of them can be seen by itself."""
    clock, control, y = np.array([1.0, 0.0, 2.0, 0.0]), np.zeros(CONTROL), np.zeros(2)
    for _ in range(5000):
        motion._go_on(clock, control, 1e-17, y)
    assert (clock[0] - 1.0) + clock[1] == pytest.approx(5e-14, rel=1e-10)
    assert abs(clock[1]) <= 1.2e-16


def test_what_grows_in_no_time_has_blown_up():
    """Eight times the largest so far, at the same time; or 1e200."""
    for y, after, told in (
        ((7.9, -1.0), 0.0, False),
        ((-8.1, 1.0), 0.0, True),
        ((0.5, 8.1), 0.1, False),
        ((0.5, -1.1e200), 0.1, True),
        ((0.9e200, 0.0), 0.1, False),
    ):
        clock, control = np.array([1.0, 0.0, 2.0, 0.0]), np.zeros(CONTROL)
        control[EXTENT] = 1.0
        assert bool(motion._go_on(clock, control, after, np.array(y))) is told
        assert control[EXTENT] == (max(map(abs, y)) if after else 1.0)
        assert clock[0] == 1.0 + after


def _stiff(part):
    """A state of z' = -k z after an explicit step of `part` of 1/k, and that step."""
    decays, work = motion_of(System(U=("-5*x", "-5*y")), TANH, 1.0), workspace(2, 0.0)
    explicit.begin(decays, np.array([0.4, 0.3]), work)
    rate.sizes(decays, np.array([0.4, 0.3]), work.size)
    explicit.attempt(decays, part / 5.0, np.zeros(4), work)
    return decays, work, part / 5.0


def test_after_six_stiff_steps_it_goes_on_implicitly_if_enough_lie_ahead():
    one, work, h = _stiff(2.0)
    control = np.zeros(CONTROL)
    control[WORTH] = 40.0
    for k in range(6):
        assert control[IMPLICIT] == 0.0
        assert control[COUNT] == k
        motion._turned_implicit(one, control, work, h, 39.9 * h)  # not many enough: no sign
        motion._turned_implicit(one, control, work, h, 40.1 * h)
    assert (control[IMPLICIT], control[COUNT], control[WORTH]) == (1.0, 0.0, 80.0)
    control[IMPLICIT] = 0.0
    motion._turned_implicit(one, control, work, h, 79.0 * h)
    assert control[COUNT] == 0.0


def test_a_step_that_is_not_stiff_takes_half_a_sign_back():
    one, work, h = _stiff(0.05)
    control = np.zeros(CONTROL)
    for before, after in ((3.0, 2.5), (0.5, 0.0), (0.25, 0.0), (0.0, 0.0)):
        control[COUNT] = before
        motion._turned_implicit(one, control, work, h, 1e9)
        assert (control[COUNT], control[IMPLICIT]) == (after, 0.0)


def test_after_three_cheap_steps_it_goes_on_explicitly():
    """For two numbers an implicit step costs as two explicit ones, of 4 times of growth each."""
    one, control = motion_of(System(U=("-c", "-s")), TANH, 1.0), np.zeros(CONTROL)
    control[IMPLICIT], control[NEXT] = 1.0, 0.7
    for bound, reach, count in ((9.0, 11.4, 1.0), (9.0, 11.5, 0.0), (9.0, 11.4, 1.0), (0.1, 79.0, 2.0)):
        assert not motion._turned_explicit(one, control, bound, reach)
        assert (control[IMPLICIT], control[COUNT], control[NEXT]) == (1.0, count, 0.7)
    assert motion._turned_explicit(one, control, 9.0, 10.0)
    assert (control[IMPLICIT], control[COUNT], control[REFINED], control[NEXT]) == (0.0, 0.0, 1.0, 0.4)
    control[IMPLICIT], control[COUNT], control[NEXT] = 1.0, 2.0, 0.3
    assert motion._turned_explicit(one, control, 9.0, 10.0)
    assert control[NEXT] == 0.3  # no longer than it was
    control[COUNT], control[NEXT] = 2.0, 5.0
    assert motion._turned_explicit(one, control, 9.0, 0.0)
    assert control[NEXT] == 5.0
    control[COUNT] = 2.0
    assert not motion._turned_explicit(one._replace(n=explicit.WIDTH + 1), control, 9.0, 0.0)
    assert control[COUNT] == 0.0


def test_a_motion_begins_with_a_hundredth_of_the_time_in_which_it_changes_by_its_size():
    """Of (x, y) by rho, of z by |z| + floor: here -6 of 2 + 0.01 is the fastest, then 0.5 of 0.51."""
    for W, speed in (("-6 + 0*c", 6.0 / 2.01), ("0*c", 0.5 / math.hypot(0.3, 0.4, 0.1))):
        system = System(U=("0.5 + 0*c", "-0.1"), W=(W,))
        one, work = motion_of(system, TANH, 0.1), workspace(3, 0.0)
        clock, control, y = np.full(4, math.nan), np.full(CONTROL, math.nan), np.array([0.3, -0.4, -2.0])
        assert motion.prepared(one, y, clock, control, 0.5, 2.5, 77.0, work)
        assert clock.tolist() == [0.5, 0.0, 2.5, 1.0]
        assert control[NEXT] == pytest.approx(0.01 / speed, rel=1e-13)
        assert [control[i] for i in (REFINED, WARY, LEFT, TRIED)] == [1.0, 0.0, 77.0, 0.0]
        assert [control[i] for i in (EXTENT, COUNT, IMPLICIT, FARTHEST)] == [2.0, 0.0, 0.0, 0.0]
        assert control[WORTH] == 20.0 * (1.0 + 0.25 * 9.0)
        assert 0.0 < control[LEAST] < 1e-280
    y[2] = 0.5
    assert motion.prepared(one, y, clock, control, 0.5, 2.5, 77.0, work)
    assert control[EXTENT] == 1.0


def test_a_motion_that_rests_begins_with_all_of_the_time():
    one, work, clock, control = motion_of(RESTS, TANH, 0.1), workspace(4, 0.0), np.zeros(4), np.zeros(CONTROL)
    assert motion.prepared(one, np.ones(4), clock, control, 0.0, 1.0, 9.0, work)
    assert control[NEXT] == math.inf


def test_a_motion_whose_rate_is_not_finite_does_not_begin():
    one, work = motion_of(System(U=("0*c", "0*c"), W=("(1e200*z1)**2",)), TANH, 0.1), workspace(3, 0.0)
    assert not motion.prepared(one, np.ones(3), np.zeros(4), np.zeros(CONTROL), 0.0, 1.0, 9.0, work)
    assert motion.prepared(one, np.array([1.0, 1.0, 0.0]), np.zeros(4), np.zeros(CONTROL), 0.0, 1.0, 9.0, work)


def test_a_state_of_more_numbers_than_there_is_room_for_is_followed_implicitly():
    m = explicit.WIDTH - 1
    wide = System(U=("0*c", "0*c"), W=("-z1",) + ("0*c",) * (m - 1))
    for n, implicit in ((m + 2, 1.0), (m + 1, 0.0)):
        one, work, control = motion_of(wide, TANH, 0.1)._replace(n=n), workspace(n, 0.0), np.zeros(CONTROL)
        assert motion.prepared(one, np.ones(n), np.zeros(4), control, 0.0, 1.0, 9.0, work)
        assert control[IMPLICIT] == implicit


def _follow(system, y, t_end, eps=0.5, rows=60, rtol=1e-6, most=1000.0, psi=TANH, **changed):
    """What `follow` returns and leaves, from the time 0."""
    y, n = np.array(y, float), len(y)
    one, work, clock, control = (
        motion_of(system, psi, eps, rtol),
        workspace(n, psi.parameter),
        np.zeros(4),
        np.zeros(CONTROL),
    )
    assert motion.prepared(one, y, clock, control, 0.0, t_end, most, work)
    for name, value in changed.items():
        control[getattr(motion, name)] = value
    starts, lengths, ends = np.empty(rows), np.empty(rows), np.empty((rows, n))
    ways = np.empty((rows, n, explicit.DEGREE))
    code, filled = motion.follow(one, TABLE, work, y, clock, control, starts, lengths, ends, ways)
    return code, starts[:filled], lengths[:filled], ends[:filled], clock, control, y


@pytest.mark.parametrize("implicit", [0.0, 1.0])
def test_steps_grow_as_their_error_allows_and_end_just_at_the_end(implicit):
    """z' = 1: there is no error, so that each step is eight times the last one."""
    drifts = System(U=("0*c", "0*c"), W=("1",))
    code, starts, lengths, ends, clock, control, y = _follow(
        drifts, (0.3, 0.4, 0.0), 7.0, NEXT=0.01, IMPLICIT=implicit, COUNT=-99.0
    )
    assert code == FINISHED
    np.testing.assert_allclose(lengths[:3], 0.01 * GROW ** np.arange(3), rtol=1e-12)
    np.testing.assert_allclose(starts[1:], np.cumsum(lengths)[:-1], rtol=1e-14)
    np.testing.assert_allclose(ends[:, 2], np.cumsum(lengths), rtol=1e-13)
    assert clock[0] == 7.0
    assert y[2] == pytest.approx(7.0, rel=1e-14)
    count = len(lengths)
    assert (control[TRIED], control[LEFT], control[REFINED]) == (count, 1000.0 - count, 0.0)
    # Two iterations of five stages; one in the last step, which begins where the one before leads.
    assert clock[3] == 1.0 + (15.0 * count + 1.0 if not implicit else 11.0 * count - 5.0)


def test_steps_that_fill_their_rows_are_gone_on_with():
    """In two calls as in one."""
    turns = System(U=("-y", "x"), W=("cos(z1)",))
    code, starts, *_ = _follow(turns, (0.3, 0.4, 0.0), 3.0)
    assert code == FINISHED
    code, begun, *_ = _follow(turns, (0.3, 0.4, 0.0), 3.0, rows=5)
    assert (code, len(begun)) == (FULL, 5)
    np.testing.assert_array_equal(begun, starts[:5])
    assert _follow(turns, (0.3, 0.4, 0.0), 3.0, rows=len(starts))[0] == FINISHED


def test_steps_are_tried_as_often_as_is_allowed():
    turns = System(U=("-y", "x"), W=("cos(z1)",))
    _, starts, *_, control, _ = _follow(turns, (0.3, 0.4, 0.0), 3.0)
    tried = control[TRIED]
    assert _follow(turns, (0.3, 0.4, 0.0), 3.0, most=tried)[0] == FINISHED
    code, fewer, *_ = _follow(turns, (0.3, 0.4, 0.0), 3.0, most=tried - 1.0)
    assert (code, len(fewer)) == (LIMIT, len(starts) - 1)


def test_steps_too_short_end_it():
    turns = System(U=("-y", "x"), W=("cos(z1)",))
    for least, code in ((0.5, SHORT), (0.49, FINISHED)):
        assert _follow(turns, (0.3, 0.4, 0.0), 1.0, rtol=1e-2, NEXT=0.5, LEAST=least)[0] == code


@pytest.mark.parametrize("implicit", [0.0, 1.0])
def test_a_refused_step_is_made_shorter_and_the_next_does_not_grow(implicit):
    """Fast turns: a first step of ten of them is refused."""
    turns = System(U=("-30*y", "30*x"), W=("cos(30*z1)",))
    _, _, lengths, *_, control, _ = _follow(
        turns, (0.3, 0.4, 0.0), 0.6, NEXT=0.2, IMPLICIT=implicit, COUNT=-99.0, rtol=1e-4
    )
    assert control[TRIED] > len(lengths)
    assert lengths[0] <= 0.2 * 0.8
    assert lengths[1] <= lengths[0] * (1.0 + 1e-12)


def test_after_newtons_method_fails_steps_grow_little():
    """CAREFUL of them by a fifth at most, after the first, which does not grow at all."""
    drifts = System(U=("0*c", "0*c"), W=("1",))
    _, _, lengths, *_ = _follow(
        drifts, (0.3, 0.4, 0.0), 1e3, NEXT=0.01, IMPLICIT=1.0, COUNT=-99.0, WARY=CAREFUL, TRIED=1.0
    )
    growth = lengths[1:] / lengths[:-1]
    np.testing.assert_allclose(growth[:8], [1.0, *[1.2] * (CAREFUL - 1), GROW, GROW], rtol=1e-9)
    assert FAILED < 1.0


def test_a_slip_has_arrived_where_rho_is_a_small_part_of_the_largest():
    """U = -e from (0.6, 0.8): by steps of 0.9 of the way each, to 5e-5 of rtol."""
    falls = System(U=("-c", "-s"), W=("1",))
    for farthest, part in ((0.0, 1.0), (40.0, 40.0)):
        code, _, lengths, ends, clock, control, y = _follow(
            falls, (0.6, 0.8, 0.0), 2.0, eps=0.0, psi=families.constant(), FARTHEST=farthest, rtol=1e-4
        )
        rho = np.hypot(*ends[:, :2].T)
        assert code == ARRIVED
        assert rho[-1] <= 5e-9 * part < rho[-2]
        assert control[FARTHEST] == pytest.approx(max(farthest, rho[0]), rel=1e-12)
        assert (lengths[1:] <= 0.9001 * rho[:-1]).all()
        assert clock[0] == pytest.approx(1.0 - rho[-1], abs=1e-14)
        assert y[2] == pytest.approx(clock[0], rel=1e-12)


def test_what_blows_up_ends_before_it_does():
    """z' = z^2 from 1."""
    grows = System(U=("0*c", "0*c"), W=("z1**2",))
    code, starts, lengths, _, clock, *_ = _follow(grows, (0.3, 0.4, 1.0), 3.0, rows=500)
    assert code in (BLOWN_UP, SHORT)
    assert clock[0] == pytest.approx(1.0, abs=1e-7)
    assert starts[-1] + lengths[-1] <= clock[0]


def test_a_longer_array_begins_as_the_other():
    found = motion.longer(np.arange(3.0), 7)
    assert found.shape == (7,)
    np.testing.assert_array_equal(found[:3], [0.0, 1.0, 2.0])
