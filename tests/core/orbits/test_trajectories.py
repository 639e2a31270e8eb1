"""Trajectories against exact solutions, at every tolerance; why they end; how well they are drawn."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from codim2_core import hemisphere, psi
from codim2_core.orbits.trajectories import Status, continuation, is_warm, joined, trajectories, warm
from codim2_core.stepping.layout import K0, LANES, PARAMETERS, SIGN, STATE, WIDTH, WORKSPACE, call_field
from codim2_core.systems.elinear import ELinear

FAMILIES = [
    psi.constant(),
    psi.rational(),
    psi.exponential(),
    psi.tanh(),
    psi.hill(4.0),
    psi.hill(3.7),
    psi.hill(200.0),
    psi.custom("1/(1+s)**2"),
]
NAMES = [p.text for p in FAMILIES]
CASE_I = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))
TOLERANCES = [10.0**-k for k in range(3, 14)]
PIXEL = 1.0 / 180.0


def sunflower(count, radius=0.97):
    k = np.arange(count)
    r, t = radius * np.sqrt((k + 0.5) / count), 2.399963 * k + 0.4
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


def ring(count, radius):
    t = 2 * np.pi * (np.arange(count) + 0.38) / count
    return radius * np.stack([np.cos(t), np.sin(t)], axis=-1)


def ends(system, p, seeds, tolerance=1e-12, **options):
    """Final states at t_max, with no early end."""
    options = {"t_max": 8.0, "capture": 1e-15, "view": 1e12} | options
    return trajectories(system, p, seeds, rtol=tolerance, atol=max(tolerance, 1e-15), samples="ends", **options)


def lorentz(b, f, T):
    """Flow of (x2, y2, sqrt(1 + |x2|^2)) for Psi = 1, a = d = 0: an element of SO(2, 1)."""
    return expm(T * np.array([[0.0, -b, f[0]], [b, 0.0, f[1]], [f[0], f[1], 0.0]]))


# ---- the field ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
def test_compiled_field_is_the_flow_on_the_disc(p):
    from codim2_core.stepping.fields import field

    rng = np.random.default_rng(1)
    points = np.concatenate([sunflower(LANES - 2), [[0.0, 0.0], [0.6, -0.8]]])
    a, b, d, f1, f2 = rng.normal(size=5)
    S, P = np.zeros(WORKSPACE), np.zeros(PARAMETERS)
    P[:6] = a, b, d, f1, f2, p.parameter
    P[SIGN:] = -1.0
    w = hemisphere.height(points)
    S[STATE : STATE + WIDTH] = np.concatenate([points.T.ravel(), w])
    from numba import njit

    @njit
    def evaluate(address, S, P):
        call_field(address, S, STATE, K0, P)

    evaluate(field(p).address, S, P)
    coefficients = ELinear(a, b, d, (f1, f2)).at(())
    expected = hemisphere.flow(coefficients, p, points)
    slack = 1e-14 * (50.0 if p.parameter > 100.0 else 1.0)
    assert np.abs(S[: 2 * LANES].reshape(2, LANES).T - expected).max() < slack
    radial = (points * coefficients.U(hemisphere.e_psi(p, points))).sum(axis=1)
    assert np.abs(S[2 * LANES : WIDTH] + w * radial).max() < slack


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
def test_finite_at_the_bottom_and_at_the_rim(p):
    seeds = [(0.0, 0.0), (1.0, 0.0), (0.0, -1.0), (math.nextafter(1.0, 0.0), 0.0), (1e-300, 0.0), (1.0 + 1e-15, 0.0)]
    for system in (CASE_I, ELinear(0.0, 0.0, 0.0), ELinear(1.0, 1.0, 1.0)):
        result = ends(system, p, seeds, 1e-9)
        assert np.isfinite(result.ends).all()


# ---- exact solutions ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_matrix_exponential_of_so21_at_every_tolerance(tolerance):
    b, f = 1.3, (0.4, -0.7)
    seeds = sunflower(40)
    w = hemisphere.height(seeds)
    X = np.column_stack([seeds / w[:, None], 1.0 / w]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(0.0, b, 0.0, f), psi.constant(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    assert np.abs(result.ends[:, 2] * X[:, 2] - 1.0).max() <= 10 * tolerance + 1e-13


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_riccati_equation_outside_at_every_tolerance(tolerance):
    a, b, f = -0.3, 1.3, np.array([0.4, -0.7])
    seeds = ring(40, 1.7)
    X = np.column_stack([seeds / 1.7, np.ones(40)]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(a, b, a, tuple(f)), psi.rational(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    rho = 0.7 * math.exp(8.0 * a) * X[:, 2]
    assert np.abs(result.ends[:, 2] / rho - 1.0).max() <= 10 * tolerance + 1e-13


@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_equator_is_followed_exactly_in_theta(tolerance):
    b, f = 1.3, (0.4, -0.7)
    seeds = ring(16, 1.0)
    X = np.column_stack([seeds, np.ones(16)]) @ lorentz(b, f, 8.0).T
    result = ends(ELinear(0.5, b, 0.5, f), psi.tanh(), seeds, tolerance)
    assert np.abs(result.ends[:, :2] - X[:, :2] / X[:, 2:]).max() <= 10 * tolerance
    assert (result.ends[:, 2] == 0.0).all()
    assert set(result.status) == {Status.ON_EQUATOR}


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-7, 1e-10])
def test_orbits_without_f_are_those_of_the_linear_system_for_any_psi(p, tolerance):
    # A node: d ln|x2| - a ln|y2| is constant along x2' = A x2; a focus: theta - (b/a) ln|x2| is.
    seeds = sunflower(48)
    start = seeds / hemisphere.height(seeds)[:, None]
    a, d = -1.0, 0.6
    result = ends(ELinear(a, 0.0, d), p, seeds, tolerance, t_max=4.0)
    x = result.ends[:, :2] / result.ends[:, 2:]
    drift = d * np.log(np.abs(x[:, 0] / start[:, 0])) - a * np.log(np.abs(x[:, 1] / start[:, 1]))
    # Relative errors of small p grow by |p|^-1: the tolerance on p is absolute there.
    least = np.minimum(np.abs(result.ends[:, :2]).min(axis=1), np.abs(seeds).min(axis=1))
    assert (np.abs(drift) <= 10 * tolerance * (1.0 + 1.0 / least)).all()
    a, b = 0.4, 1.1
    result = ends(ELinear(a, b, a), p, seeds, tolerance, t_max=4.0)
    x = result.ends[:, :2] / result.ends[:, 2:]
    turn = np.arctan2(x[:, 1], x[:, 0]) - np.arctan2(start[:, 1], start[:, 0])
    turn -= b / a * np.log(np.hypot(*x.T) / np.hypot(*start.T))
    r = np.hypot(*seeds.T)
    assert (np.abs(np.exp(1j * turn) - 1.0) <= 10 * tolerance * (1.0 + 3.0 / r)).all()


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
def test_against_an_independent_integrator(p):
    seeds, coefficients = sunflower(6, 0.9), CASE_I.at(())
    result = ends(CASE_I, p, seeds, 1e-11, t_max=3.0)
    for seed, end in zip(seeds, result.ends, strict=True):
        other = solve_ivp(
            lambda t, q: hemisphere.flow(coefficients, p, q), (0, 3), seed, method="DOP853", rtol=1e-12, atol=1e-13
        )
        assert np.abs(other.y[:, -1] - end[:2]).max() < 1e-9


def test_tiny_heights_keep_their_relative_accuracy():
    # 1 - |p| is out of reach of |p| itself: continue from a state with ebar = 1e-160.
    from codim2_core.orbits.options import Stepping
    from codim2_core.orbits.trajectories import _integrate

    state = np.array([[1.0, 0.0, 1e-160]])
    options = {"t_max": 300.0, "rtol": 1e-12, "atol": 1e-12, "backward": False, "view": 2.0, "pixel": PIXEL}
    options |= {"capture": 1e-15, "samples": "ends", "length": math.inf, "step_limit": 10**5}
    system = ELinear(-1.0, 0.0, -1.0)  # x2' = -x2/|.| : |x2| = sinh-like, exactly ebar/|p| e^T
    result = _integrate(system.at(), psi.constant(), state, np.array([-1.0]), Stepping(**options))
    ratio = 1e-160 * math.exp(300.0)
    r, w = result.ends[0, 0], result.ends[0, 2]
    assert abs(w / r / ratio - 1.0) < 1e-9


# ---- invariants ---------------------------------------------------------------------------------------------------

coefficient = st.floats(-3.0, 3.0).map(lambda v: round(v, 3))


@settings(max_examples=40, deadline=None)
@given(st.tuples(*[coefficient] * 5), st.sampled_from(FAMILIES), st.booleans())
def test_states_stay_on_the_sphere_and_lines_in_the_picture(values, p, backward):
    a, b, d, f1, f2 = values
    seeds = np.concatenate([sunflower(10), ring(10, 1.5), ring(4, 1.0)])
    result = trajectories(ELinear(a, b, d, (f1, f2)), p, seeds, backward=backward)
    inside = result.ends[:10]
    assert np.abs((inside**2).sum(axis=1) - 1.0).max() < 1e-14
    assert np.abs(np.hypot(*result.ends[10:, :2].T) - 1.0).max() < 1e-14
    assert np.isfinite(result.buffer).all()
    for k, (line, time, seed) in enumerate(zip(result.points, result.times, seeds, strict=True)):
        assert np.abs(line[0] - seed).max() < 1e-15 * 4
        assert time[0] == 0.0
        assert (np.diff(time) < 0.0).all() if backward else (np.diff(time) > 0.0).all()
        r = np.hypot(*line.T)
        assert (r < 1.0 + 1e-5).all() if k < 10 else (r > 1.0 - 1e-9).all()
        if result.status[k] is Status.LEFT_VIEW:
            assert abs(np.abs(line[-1]).max() - 2.0) <= 0.25 * PIXEL
    assert result.evaluations < len(seeds) * 15 * 2000


@settings(max_examples=25, deadline=None)
@given(st.tuples(*[coefficient] * 5), st.sampled_from([p for p in FAMILIES if p.parameter < 100.0]))
def test_going_back_returns_to_the_seed(values, p):
    a, b, d, f1, f2 = values
    system, seeds = ELinear(a, b, d, (f1, f2)), sunflower(10, 0.9)
    there = ends(system, p, seeds, 1e-12, t_max=1.0)
    back = ends(system, p, there.ends[:, :2], 1e-12, t_max=1.0, backward=True)
    # Going back amplifies by at most exp(T |D flow|); the clock of p alone loses ebar near the equator.
    gap = np.abs(back.ends[:, :2] - seeds).max(axis=1)
    keeps = there.ends[:, 2] > 1e-2
    assert (gap[keeps] <= 1e-7).all()


def test_forward_backward_and_a_minus_sign():
    seeds = np.concatenate([sunflower(20), ring(12, 1.4)])
    one = ends(CASE_I, psi.rational(), seeds, 1e-9, backward=True, t_max=2.0)
    other = ends(ELinear(2.0, -0.5, 1.0, (0.5, -0.2)), psi.rational(), seeds, 1e-9, t_max=2.0)
    assert np.array_equal(one.ends, other.ends)


def test_each_trajectory_is_its_own_whatever_runs_beside_it():
    seeds = np.concatenate([sunflower(70), ring(30, 1.4)])
    together = trajectories(CASE_I, psi.tanh(), seeds)
    for k in (0, 31, 32, 69, 70, 99):
        alone = trajectories(CASE_I, psi.tanh(), seeds[k : k + 1])
        assert np.array_equal(alone.points[0], together.points[k])
        assert alone.status[0] is together.status[k]


# ---- why they end -------------------------------------------------------------------------------------------------


def only(result):
    assert len(set(result.status)) == 1, result.status
    return result.status[0]


def test_status_of_each_kind():
    one = psi.constant()
    node = ELinear(-2.0, 0.0, -1.0, (-0.5, 0.2))
    result = trajectories(node, one, sunflower(20), t_max=100.0)
    assert only(result) is Status.EQUILIBRIUM
    assert np.abs(result.ends[:, :2] - (-0.25, 0.2)).max() < 2e-6
    assert only(trajectories(node, one, sunflower(20, 0.9), t_max=0.01)) is Status.T_MAX
    outside = trajectories(ELinear(1.0, 0.3, 1.0), one, ring(20, 1.2), t_max=100.0)
    assert only(outside) is Status.LEFT_VIEW
    edge = np.array([np.abs(line[-1]).max() for line in outside.points])
    assert np.abs(edge - 2.0).max() < 1e-9
    assert only(trajectories(node, one, ring(20, 1.4), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(2.0, 0.0, 1.0), one, sunflower(20, 0.9), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(1.0, 2.0, 1.0), one, sunflower(20, 0.9), t_max=100.0)) is Status.SPIRALLED
    assert only(trajectories(ELinear(-1.0, 2.0, -1.0), one, ring(20, 1.4), t_max=100.0)) is Status.SPIRALLED
    assert only(trajectories(ELinear(-1.0, 0.0, -1.0), one, ring(20, 1.4), t_max=100.0)) is Status.ARRIVED
    assert only(trajectories(ELinear(0.0, 1.0, 0.0), one, sunflower(5), t_max=1e6)) is Status.STEP_LIMIT
    assert only(trajectories(node, one, ring(20, 1.0), t_max=100.0)) is Status.ON_EQUATOR
    assert all(isinstance(s.value, str) and s.value.endswith(".") for s in Status)


def test_a_slow_passage_ends_nothing():
    # Past the ghost of a saddle-node on the equator, past a saddle, and round a centre.
    one = psi.constant()
    ghost = ELinear(0.0, 1.0, 0.0, (0.9999999, 0.0))
    assert only(trajectories(ghost, one, [(0.0, 1.3)], capture=1e-3, view=100.0)) is Status.T_MAX
    saddle = ELinear(-1.0, 0.0, 1.0)
    result = trajectories(saddle, one, [(0.5, 1e-5), (0.5, -1e-5)], capture=1e-3, t_max=40.0)
    assert only(result) is Status.ARRIVED
    assert result.ends[0, 1] > 0.99
    assert result.ends[1, 1] < -0.99
    centre = trajectories(ELinear(0.0, 1.0, 0.0), one, [(1e-4, 0.0)], capture=1e-3)
    assert only(centre) is Status.T_MAX


@pytest.mark.parametrize("scale", [1e-149, 1e-20, 1.0, 1e20, 1e149])
def test_any_scale_of_the_coefficients_ends_soon(scale):
    system = ELinear(*(scale * v for v in (-2.0, 0.5, -1.0)), (-0.5 * scale, 0.2 * scale))
    seeds = np.concatenate([sunflower(20), ring(20, 1.5)])
    for p in FAMILIES:
        result = trajectories(system, p, seeds, t_max=8.0)
        assert result.evaluations < 40 * 15 * 500
        assert np.isfinite(result.buffer).all()
    same = trajectories(system, psi.constant(), seeds, t_max=8.0 / scale)
    assert np.abs(same.ends - trajectories(CASE_I, psi.constant(), seeds).ends).max() < 1e-7


def test_nothing_moves_without_a_field():
    result = trajectories(ELinear(0.0, 0.0, 0.0), psi.constant(), sunflower(5))
    assert only(result) is Status.EQUILIBRIUM
    assert np.abs(result.ends[:, :2] - sunflower(5)).max() < 1e-15


# ---- what is drawn ------------------------------------------------------------------------------------------------


def distance(points, line):
    """Greatest distance of points from a polyline whose parts they follow in order."""
    a, ab = line[:-1], np.diff(line, axis=0)
    best = np.full(len(points), np.inf)
    for p, v in zip(a, ab, strict=True):
        t = np.clip((points - p) @ v / max(v @ v, 1e-300), 0.0, 1.0)
        best = np.minimum(best, np.hypot(*(points - p - t[:, None] * v).T))
    return best.max()


def fewest(fine, tolerance):
    """Points that greedy simplification keeps of a fine curve."""
    kept, i = 1, 0
    while i < len(fine) - 1:
        low, high = i + 1, len(fine) - 1
        while low < high:
            j = (low + high + 1) // 2
            low, high = (j, high) if distance(fine[i : j + 1], fine[[i, j]]) <= tolerance else (low, j - 1)
        i, kept = low, kept + 1
    return kept


@pytest.mark.parametrize("p", [psi.constant(), psi.tanh(), psi.hill(20.0)], ids=str)
@pytest.mark.parametrize("system", [CASE_I, ELinear(0.3, 2.0, -0.1, (0.3, 0.4)), ELinear(-2.0, 4.0, 1.0, (1.0, 0.0))])
@pytest.mark.parametrize("rtol", [1e-6, 1e-9])
def test_lines_are_within_a_quarter_pixel_with_few_points(system, p, rtol):
    seeds = np.concatenate([sunflower(8), ring(4, 1.6)])
    drawn = trajectories(system, p, seeds, rtol=rtol, atol=rtol, capture=1e-6, t_max=5.0)
    fine = trajectories(system, p, seeds, rtol=1e-12, atol=1e-12, capture=1e-6, t_max=5.0, pixel=PIXEL / 400)
    needed = 0
    for line, curve in zip(drawn.points, fine.points, strict=True):
        assert distance(curve, line) <= 0.25 * PIXEL
        needed += fewest(curve, 0.25 * PIXEL)
    assert len(drawn.buffer) <= 1.5 * needed


def test_a_straight_leg_has_few_points():
    result = trajectories(ELinear(-1.0, 0.0, -1.0, (0.3, 0.0)), psi.constant(), [(0.9, 0.0), (1.9, 0.0)], rtol=1e-12)
    assert max(map(len, result.points)) <= 12


# ---- up the hemisphere --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("p", [psi.constant(), psi.rational(), psi.custom("2/(2+sqrt(1+s))")], ids=str)
def test_continuation_starts_on_the_invariant_manifold(p):
    from codim2_core.layer_problem.equator import equator_equilibria
    from codim2_core.orbits.departures import departures

    equator = equator_equilibria(CASE_I)
    theta = equator.theta[(equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)]
    assert len(theta)
    coefficients = CASE_I.at(())
    high = departures(coefficients, p, theta, 1e-6, False)
    low = departures(coefficients, p, theta, 1e-12, False)
    assert high[0, 2] > 1.7 * low[0, 2]
    for above, below in zip(high, low, strict=True):

        def event(t, q, level=math.sqrt(1.0 - above[2] ** 2)):  # noqa: B008
            return np.hypot(*q) - level

        curve = solve_ivp(
            lambda t, q: hemisphere.flow(coefficients, p, q),
            (0, 20),
            below[:2],
            rtol=1e-12,
            atol=1e-14,
            events=event,
        )
        assert event(0, below[:2]) > 0.0
        reached = curve.y_events[0][0]
        angle = math.atan2(reached[1], reached[0]) - math.atan2(above[1], above[0])
        assert abs(angle) < 1e-9


def test_continuation_ends_on_the_critical_set():
    from codim2_core.layer_problem.equator import equator_equilibria

    equator = equator_equilibria(CASE_I)
    theta = equator.theta[equator.lambda_rho < 0.0]
    result = continuation(CASE_I, psi.rational(), theta, t_max=60.0)
    assert len(result) == len(theta)
    assert only(result) is Status.EQUILIBRIUM
    first = np.array([line[0] for line in result.points])
    assert np.abs(first - np.stack([np.cos(theta), np.sin(theta)], axis=-1)).max() < 1e-5
    with pytest.raises(ValueError, match="no limit direction"):
        continuation(CASE_I, psi.constant(), [theta[0] + 0.1])
    with pytest.raises(ValueError, match="lambda_rho"):
        continuation(CASE_I, psi.constant(), theta, backward=True)
    with pytest.raises(ValueError, match="finite"):
        continuation(CASE_I, psi.constant(), [math.nan])


# ---- the door -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("seeds", "options", "message"),
    [
        ([(math.nan, 0.0)], {}, "finite"),
        ([(math.inf, 0.0)], {}, "finite"),
        ([1.0, 2.0, 3.0], {}, "shape"),
        ([[1.0, 2.0, 3.0]], {}, "shape"),
        ([(0.5, 0.0)], {"t_max": 0.0}, "t_max"),
        ([(0.5, 0.0)], {"t_max": -1.0}, "t_max"),
        ([(0.5, 0.0)], {"t_max": math.inf}, "t_max"),
        ([(0.5, 0.0)], {"rtol": 1e-15}, "rtol"),
        ([(0.5, 0.0)], {"rtol": 0.5}, "rtol"),
        ([(0.5, 0.0)], {"rtol": math.nan}, "rtol"),
        ([(0.5, 0.0)], {"atol": 0.0}, "atol"),
        ([(0.5, 0.0)], {"view": 0.5}, "view"),
        ([(0.5, 0.0)], {"pixel": 0.0}, "pixel"),
        ([(0.5, 0.0)], {"capture": -1.0}, "capture"),
        ([(0.5, 0.0)], {"samples": "all"}, "samples"),
        ([(0.5, 0.0)], {"step_limit": 0}, "step_limit"),
    ],
)
def test_what_is_invalid_is_named(seeds, options, message):
    with pytest.raises(ValueError, match=message):
        trajectories(CASE_I, psi.constant(), seeds, **options)


def test_results_are_read_only_views_and_join():
    result = trajectories(CASE_I, psi.constant(), sunflower(64))
    assert len(result) == 64
    for array in (result.buffer, result.clock, result.offsets, result.ends, result.codes, result.points[3]):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    assert all(line.base is result.buffer for line in result.points)
    both = joined([result, trajectories(CASE_I, psi.constant(), [], backward=True), result])
    assert len(both) == 128
    assert np.array_equal(both.points[70], result.points[6])
    assert both.status == result.status * 2
    assert len(joined([])) == 0
    assert trajectories(CASE_I, psi.constant(), []).points == []


def test_warm():
    warm()
    assert is_warm()
    assert is_warm(psi.constant())
    fresh = psi.custom("1/(1+s/3)**3")
    assert not is_warm(fresh)
    warm(fresh)
    assert is_warm(fresh)


def test_a_cycle_is_drawn_to_its_length_and_not_for_ever():
    around = ELinear(0.0, 1.0, 0.0)  # the equator's neighbours turn for ever
    (line,) = trajectories(around, psi.constant(), [(0.5, 0.0)], t_max=1e3, length=10.0).points
    drawn = np.hypot(*np.diff(line, axis=0).T).sum()
    result = trajectories(around, psi.constant(), [(0.5, 0.0)], t_max=1e3, length=10.0)
    assert result.status == (Status.LENGTH,)
    assert 10.0 <= drawn < 12.0
    with pytest.raises(ValueError, match="positive length"):
        trajectories(around, psi.constant(), [(0.5, 0.0)], length=0.0)


def test_a_seed_too_far_to_draw_from_is_refused_and_its_end_is_not():
    """To a quarter of a pixel the arc had 1e50 points: the call did not come back."""
    for far in (1e7, 1e99):
        with pytest.raises(ValueError, match="at most 1e\\+06 away"):
            trajectories(CASE_I, psi.constant(), [[0.1, 0.2], [far, 0.5 * far]], t_max=1.0)
    assert len(trajectories(CASE_I, psi.constant(), [[1e7, 5e6]], t_max=1.0, samples="ends")) == 1
    assert len(trajectories(CASE_I, psi.constant(), [[9e5, 5e5]], t_max=1.0).buffer) < 300_000
