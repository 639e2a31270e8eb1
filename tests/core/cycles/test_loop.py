"""Loops through the equator: their arcs from what the limit directions are, their gaps from where separatrices go."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.cycles import loop as module
from codim2_core.cycles.loop import gap, loops
from codim2_core.cycles.return_map import INWARD, OUTWARD, RETURNED, UNDECIDED
from codim2_core.cycles.section import Section

# a, b, d, f1, f2 with one arc each, found at random
PLANES = [
    (1.45, -1.49, -1.38, 0.94, -0.85),
    (-1.18, -0.95, 0.27, -0.81, -0.81),
    (0.55, 0.67, -0.58, 0.67, 0.65),
]
EVERY = pytest.mark.parametrize("plane", PLANES)
PSI = c2.psi.rational()


def made(plane, time=1.0):
    a, b, d, f1, f2 = (time * v for v in plane)
    return c2.ELinear(a, b, d, (f1, f2)).at()


def turn(angle):
    return np.array([math.cos(angle), math.sin(angle)])


def mirrored(plane):
    """In y -> -y, which turns the other way."""
    a, b, d, f1, f2 = plane
    return a, -b, d, f1, -f2


@EVERY
@pytest.mark.parametrize("time", [1.0, -1.0])
def test_the_arc_leads_from_where_orbits_come_down_to_where_they_go_up(plane, time):
    for at in (made(plane, time), made(mirrored(plane), time)):
        (loop,) = loops(at)
        limits = c2.equator_equilibria(at)
        i, j = (int(np.argmin(np.abs(limits.theta - angle))) for angle in (loop.source, loop.sink))
        assert (limits.theta[i], limits.theta[j]) == (loop.source, loop.sink)
        assert (
            min(limits.lambda_rho[i], limits.lambda_theta[i]) > 0.0 > max(limits.lambda_rho[j], limits.lambda_theta[j])
        )
        sense = math.copysign(1.0, at.b)
        width = (sense * (loop.sink - loop.source)) % math.tau
        along = loop.source + sense * width * np.linspace(0.0, 1.0, 50)[1:-1]
        e = np.stack([np.cos(along), np.sin(along)], axis=-1)
        U = at.U(e)
        assert (sense * (e[:, 0] * U[:, 1] - e[:, 1] * U[:, 0]) > 0.0).all()
        ratios = limits.lambda_rho / limits.lambda_theta
        assert loop.ratio == pytest.approx(ratios[i] / ratios[j], rel=1e-12)


@pytest.mark.parametrize("time", [1e-4, 1.0])
def test_there_is_a_loop_for_each_half_saddle_from_which_the_next_one_is_reached(time):
    """In the sense of b: from one that repels along and across the equator to one that attracts both ways."""
    rng = np.random.default_rng(11)
    found = 0
    for _ in range(200):
        a, d = rng.uniform(0.3, 2.0, 2) * (1.0, -1.0)
        b = rng.choice([-1.0, 1.0]) * math.sqrt(-a * d) * rng.uniform(1.0, 1.4)
        e = rng.uniform(0.5, 1.0) * turn(rng.uniform(0.0, math.tau))
        at = made((a, b, d, *(-np.array([[a, -b], [b, d]]) @ e)), time)
        limits = c2.equator_equilibria(at)
        out = (np.sign(limits.lambda_rho) + np.sign(limits.lambda_theta)).tolist()[:: 1 if b > 0.0 else -1]
        assert len(loops(at)) == sum(pair == (2.0, -2.0) for pair in zip(out, out[1:] + out[:1], strict=True))
        found += len(loops(at))
    assert found > 30


@EVERY
@pytest.mark.parametrize("time", [1e-4, 1e4])
def test_loops_do_not_know_the_unit_of_time(plane, time):
    (one,), (other,) = loops(made(plane)), loops(made(plane, time))
    assert (other.source, other.sink, other.ratio) == pytest.approx((one.source, one.sink, one.ratio), rel=1e-12)
    assert other.ray == one.ray
    assert gap(made(plane, time), PSI, other) == pytest.approx(gap(made(plane), PSI, one), rel=1e-7)


@EVERY
def test_the_gap_is_exact_to_nine_digits(plane):
    at = made(plane)
    (loop,) = loops(at)
    assert gap(at, PSI, loop) == pytest.approx(gap(at, PSI, loop, rtol=1e-13), rel=1e-9)


@EVERY
def test_against_time_ends_change_places_and_the_gap_its_sign(plane):
    for one in (plane, mirrored(plane)):
        forward, backward = made(one), made(one, -1.0)
        (there,), (back,) = loops(forward), loops(backward)
        assert (there.source, there.sink) == pytest.approx((back.sink, back.source), abs=1e-12)
        assert there.ratio * back.ratio == pytest.approx(1.0, rel=1e-9)
        assert there.ray == back.ray
        assert gap(forward, PSI, there) == pytest.approx(-gap(backward, PSI, back), rel=1e-8)
    assert gap(made(plane), PSI, loops(made(plane))[0]) == pytest.approx(gap(forward, PSI, there), rel=1e-8)


@EVERY
@pytest.mark.parametrize("time", [1.0, -1.0])
def test_the_gap_tells_where_the_separatrix_goes(plane, time):
    at = made(plane, time)
    (loop,) = loops(at)
    up = next(
        s
        for s in c2.separatrices(at, PSI)
        if s.inside and s.direction == "unstable" and math.cos(s.departure_angle - loop.sink) > 1 - 1e-9
    )
    assert (gap(at, PSI, loop) < 0.0) == (not up.end.startswith("Q"))


def test_without_half_saddles_in_a_row_there_is_no_loop():
    for plane in ((-2.0, 0.5, 1.0, 0.1, 0.2), (1.0, 3.0, -2.0, 0.4, 0.1), (0.5, 1.0, -0.5, 9.0, 0.0)):
        at = c2.ELinear(*plane[:3], plane[3:]).at()
        limits = c2.equator_equilibria(at)
        up = (limits.lambda_rho < 0.0) & (limits.lambda_theta < 0.0)
        assert loops(at) == () or up.any()
    assert loops(c2.ELinear(1.0, 3.0, -2.0, (0.4, 0.1)).at()) == ()  # no limit direction at all


def test_a_turned_and_slowed_system_has_the_turned_cycle():
    angle, slower = 0.7, 1e-3
    R = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    A, f = np.array([[172.0, -186.0], [186.0, -200.0]]), np.array([-86.0, -93.0])
    p = c2.psi.hill(3)
    (one,) = c2.limit_cycles(c2.ELinear(172.0, 186.0, -200.0, tuple(f)), p)
    (a11, a12), (a21, a22) = (slower * R @ A @ R.T).tolist()
    f1, f2 = (slower * R @ f).tolist()
    typed = c2.System(U=(f"({a11!r})*c + ({a12!r})*s + ({f1!r})", f"({a21!r})*c + ({a22!r})*s + ({f2!r})"))
    (other,) = c2.limit_cycles(typed, p)
    assert (one.direction, other.direction) == (1, 1)
    assert other.mean_e == pytest.approx(R @ one.mean_e, abs=1e-9)
    assert other.period == pytest.approx(one.period / slower, rel=1e-9)
    assert other.period_T == pytest.approx(one.period_T / slower, rel=1e-7)
    gaps = np.abs(other.points[::40, None] - one.points @ R.T).max(axis=2).min(axis=1)
    assert gaps.max() < 0.01
    (mirror,) = c2.limit_cycles(c2.ELinear(172.0, -186.0, -200.0, (-86.0, 93.0)), p)
    assert mirror.direction == -1


@EVERY
def test_the_gap_is_measured_on_the_longest_ray_that_ends_outside_the_arc(plane):
    for at in (made(plane), made(mirrored(plane)), made(plane, -1.0)):
        (loop,) = loops(at)
        sense = math.copysign(1.0, at.b)
        rays = [Section(at, PSI, c2.critical_sets(at, PSI)[0], k) for k in range(4)]
        ends = [one.e + one.reach * one.u for one in rays]
        np.testing.assert_allclose(np.hypot(*np.transpose(ends)), 1.0, rtol=0.0, atol=1e-12)
        width = (sense * (loop.sink - loop.source)) % math.tau
        outside = [k for k in range(4) if (sense * (math.atan2(*ends[k][::-1]) - loop.source)) % math.tau > width]
        assert loop.ray == max(outside, key=lambda k: rays[k].reach)


@pytest.mark.parametrize(
    ("leaving", "entering", "expected"),
    [
        (INWARD, RETURNED, -math.inf),
        (OUTWARD, RETURNED, math.inf),
        (RETURNED, INWARD, math.inf),
        (RETURNED, OUTWARD, -math.inf),
        (INWARD, OUTWARD, math.nan),
        (OUTWARD, OUTWARD, math.nan),
        (UNDECIDED, RETURNED, math.nan),
        (RETURNED, RETURNED, 0.0),
    ],
)
def test_a_branch_that_does_not_reach_the_ray_is_infinitely_far(monkeypatch, leaving, entering, expected):
    at = made(PLANES[0])
    (loop,) = loops(at)
    state = np.array([[0.6, 0.0, 0.8]])
    monkeypatch.setattr(module, "departures", lambda *_: state)
    monkeypatch.setattr(
        Section,
        "turn",
        lambda _self, states, _rtol, backward, **_: (states, None, [entering if backward else leaving], None),
    )
    monkeypatch.setattr(module, "_turned", lambda _, starts, _r, back: (starts[0], [entering if back else leaving]))
    assert gap(at, PSI, loop) == pytest.approx(expected, nan_ok=True)
