"""Slides on followed sets and slips to Sigma, where both are known in closed form."""

import math
from functools import partial

import numpy as np
import pytest

import codim2_core as c2
from codim2_core.initial_value.compiled_phases import CompiledPhases
from codim2_core.initial_value.field import field
from codim2_core.initial_value.leaving import leave
from codim2_core.initial_value.line import InvariantLine
from codim2_core.initial_value.problem import plane_problem
from codim2_core.initial_value.safe_steps import _positive
from codim2_core.initial_value.sheet import Sheet, complement, determinant, trace
from codim2_core.motion.limit.slide import _first, _last_alive, _place, _whole, slide
from codim2_core.motion.limit.slide_on_cycle import _means
from codim2_core.motion.limit.slip import _straight, slip
from codim2_core.numerics.radau import Step

PSIS = [c2.psi.constant(), c2.psi.rational(), c2.psi.tanh(), c2.psi.hill(3)]
EVERY = pytest.mark.parametrize("psi", PSIS, ids=lambda p: p.text)
OPTIONS = {"rtol": 1e-10, "atol": 1e-12, "most": 2000}
BENT = c2.System(U=("c**2 + s/5 - z/2", "-2*s + c/3"), W=("c + 1/4",))
SLIDING = c2.ELinear(-1.0, 0.5, -2.0, ("z1", "z2/2"), B=((0.5, 0.0), (1.0, -1.0)), g=("1 - z2", "z1"))


@EVERY
def test_slopes_trace_and_determinant_of_a_sheet(psi):
    for z in (0.2, 0.6):
        for C in c2.critical_sets(BENT, psi, (z,)):
            sheet = Sheet(field(BENT), C.e, np.array([z]))
            radial, tangential = psi.jacobian_factors(float(np.hypot(*C.x2)))
            assert trace(sheet, psi, C.e, np.array([z])) * tangential == pytest.approx(C.trace, rel=1e-9)
            assert determinant(sheet, C.e, np.array([z])) * radial * tangential == pytest.approx(
                C.determinant, rel=1e-9
            )
            step = 1e-5
            both = [c2.critical_sets(BENT, psi, (z + h,)) for h in (-step, step)]
            nearby = [min(sets, key=lambda D: np.hypot(*(D.e - C.e))).e for sets in both]
            np.testing.assert_allclose(sheet.slope[:, 0], (nearby[1] - nearby[0]) / (2.0 * step), atol=1e-6)
            np.testing.assert_allclose(sheet.at(np.array([z + step])), nearby[1], rtol=0.0, atol=1e-13)
    at = SLIDING.at((0.0, 0.0))
    sheet = Sheet(field(SLIDING), np.zeros(2), np.zeros(2))
    assert trace(sheet, psi, np.zeros(2), np.zeros(2)) == pytest.approx(at.a + at.d)
    edge = np.array([1.0, 0.0])  # the radial eigenvalue of D e_Psi is lost there: only the angular one is left
    assert trace(sheet, psi, edge, np.zeros(2)) == pytest.approx(at.d)
    assert complement(np.array([0.6, 0.3])) == pytest.approx(1.0 - 0.45)


def test_the_slow_flow_as_a_problem():
    """-A^-1 f is linear in z, so z' = M z + k: the rate, and its slope M."""
    z = np.array([0.2, -0.3])
    A, F, B = np.array([[-1.0, -0.5], [0.5, -2.0]]), np.diag([1.0, 0.5]), np.array([[0.5, 0.0], [1.0, -1.0]])
    problem = Sheet(field(SLIDING), -np.linalg.solve(A, F @ z), z).problem(0.01)
    M = -B @ np.linalg.solve(A, F) + np.array([[0.0, -1.0], [1.0, 0.0]])
    for at in (z, z + 0.05):
        np.testing.assert_allclose(problem.F(at), M @ at + (1.0, 0.0), rtol=0.0, atol=1e-13)
        np.testing.assert_allclose(problem.J(at), M, rtol=0.0, atol=1e-12)
        np.testing.assert_allclose(problem.scale(at), np.abs(at) + 0.01)


def compiled_phases(formulas, line=None):
    problem = plane_problem(formulas, None, 0.0, OPTIONS["rtol"], OPTIONS["atol"])
    return CompiledPhases(problem, formulas, line, OPTIONS["rtol"], OPTIONS["atol"] / OPTIONS["rtol"])


@pytest.mark.parametrize("in_python", [True, False])
def test_a_slide_ends_at_the_time_the_equator_a_fold_or_a_hopf_point(in_python):
    """U = (z - c, -s), z' = 1: c = z reaches 1. U1 = z - c^2, z' = -1: a fold at 0. a + d = z: tr J = 0 at 0."""
    psi = PSIS[1]
    cases = [
        (c2.System(U=("z - c", "-s"), W=("1",)), 1.0, (0.2, 0.0), 0.2, 0.5, "time", 0.7),
        (c2.System(U=("z - c", "-s"), W=("1",)), 1.0, (0.2, 0.0), 0.2, 5.0, "equator", 1.0),
        (c2.System(U=("z - c**2", "-s"), W=("-1",)), -1.0, (0.5, 0.0), 0.25, 5.0, "fold", 0.0),
        (c2.System(U=("z*c - s", "c + z*s"), W=("2",)), 2.0, (0.0, 0.0), -0.5, 5.0, "hopf", 0.0),
        (c2.System(U=("z - c + abs(s)", "-s"), W=("1",)), 1.0, (0.2, 0.0), 0.2, 0.5, "time", 0.7),  # a kink all along
    ]
    for system, speed, e, z, t_end, end, last in cases:
        phases = None if in_python else compiled_phases(field(system))
        found = slide(field(system), psi, np.array(e), 1.0, np.array([z]), 1.0 + t_end, **OPTIONS, compiled=phases)
        assert found.end == end
        assert found.taken[-1].last == pytest.approx([0.0, 0.0, last], abs=1e-4)
        assert found.taken[-1].end == pytest.approx(1.0 + (last - z) / speed, abs=1e-4)
        assert found.taken[0].start == 1.0
        assert len(found.places) == len(found.taken) + 1
        assert found.places[0] == pytest.approx(np.array(e), abs=1e-12)
        if end in ("time", "equator"):
            assert found.places[-1] == pytest.approx([last, 0.0], abs=1e-4)
    still = slide(field(c2.ELinear(-1.0, 0.0, -1.0)), psi, np.zeros(2), 1.0, np.zeros(0), 3.0, **OPTIONS)
    assert (still.end, still.taken[0].end, len(still.places)) == ("time", 3.0, 2)
    assert (
        still.taken[0].at(0.3).tolist() == still.taken[0].first.tolist() == still.taken[0].last.tolist() == [0.0, 0.0]
    )
    few = slide(field(BENT), psi, np.array([0.2, 0.0]), 0.0, np.array([0.2]), 0.5, rtol=1e-10, atol=1e-12, most=1)
    assert few.end == "given up"
    assert few.stopped is not None


@pytest.mark.parametrize("psi", [PSIS[0], PSIS[3]], ids=lambda p: p.text)
def test_a_slide_compiled_is_that_in_python(psi):
    """Two slow variables, a set that wanders; n.D n and what is across it of two signs, so that Psi is asked."""
    system = c2.System(
        U=("-c - s/2 + z1", "3*c/2 + s/10 - z2/4 + c*s/3"), W=("cos(2*z2) - z1", "1 - c/5"), parameters={}
    )
    start = (field(system), psi, np.array([0.3, 0.1]), 0.0, np.array([0.3, 1.7]), 4.0)
    own, phases = slide(*start, **OPTIONS), compiled_phases(field(system))
    found = slide(*start, **OPTIONS, compiled=phases)
    assert phases.evaluations > 50
    assert found.end == own.end
    assert found.taken[-1].end == pytest.approx(own.taken[-1].end, rel=1e-8)
    np.testing.assert_allclose(found.taken[-1].last, own.taken[-1].last, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(found.places[-1], own.places[-1], rtol=0.0, atol=1e-8)
    for step in found.taken:
        assert step.at(0.4)[:2].tolist() == [0.0, 0.0]
        np.testing.assert_allclose(step.at(1.0), step.last, rtol=0.0, atol=1e-13)
    assert [len(part.places) for part in (found, own)] == [len(found.taken) + 1, len(own.taken) + 1]


@pytest.mark.parametrize("height", [1.01, 1.0000001])
def test_a_slide_compiled_ends_where_the_set_is_outside_for_part_of_a_step(height):
    system = c2.System(U=(f"-c + {height}*sin(z)", "-s"), W=("1",))
    start = (field(system), PSIS[0], np.zeros(2), 0.0, np.zeros(1), 3.0)
    found = slide(*start, **OPTIONS, compiled=compiled_phases(field(system)))
    assert found.end == "equator"
    assert found.taken[-1].end == pytest.approx(math.asin(1.0 / height), abs=1e-9)


@pytest.mark.parametrize("in_python", [True, False])
@pytest.mark.parametrize("gap", [0.006, 0.002, 2e-4])
def test_a_slide_does_not_step_over_a_gap_in_which_there_is_no_set(gap, in_python):
    """C at c = -sqrt(-z) folds at z = 0, and from about z = gap on there is another one, at c = 1 - sqrt(1 - z)."""
    system = c2.System(U=(f"z + c**2 - (1 + tanh({20 / gap}*(z - {gap})))*c", "-s"), W=("1",))
    phases = None if in_python else compiled_phases(field(system))
    start = (field(system), PSIS[0], np.array([-0.3, 0.0]), 0.0, np.array([-0.09]), 1.0)
    found = slide(*start, **OPTIONS, compiled=phases)
    assert found.end == "fold"
    assert found.taken[-1].end == pytest.approx(0.09, abs=1e-9)
    assert found.places[-1] == pytest.approx([0.0, 0.0], abs=1e-4)


def test_what_is_surely_positive_all_along_a_step_is():
    for values, safe in (([1.0] * 5, True), ([-1.0] * 5, False), ([1.0, 1.1, 1.2, 1.1, 1.0], True)):
        assert _positive(np.array([values])).tolist() == [safe]
    dips = 1.0 - 1.02 * np.sin(math.pi * np.linspace(0.0, 1.0, 5)) ** 2
    assert _positive(np.array([dips, [1.0, 1.0, math.nan, 1.0, 1.0]])).tolist() == [False, False]


def test_an_unstable_set_is_followed_around_a_cycle_until_that_is_gone():
    system = c2.System(U=("-z*c - s", "c - z*s"), W=("2",))  # tr J > 0 for z < 0
    start = (field(system), PSIS[1], np.zeros(2), 0.0, np.array([-0.5]))
    assert slide(*start, 5.0, **OPTIONS).end == "hopf"  # alone, it is unstable at once
    around = slide(*start, 5.0, **OPTIONS, lives=lambda z: True)
    assert (around.end, around.taken[-1].last[2]) == ("hopf", pytest.approx(0.0, abs=1e-9))
    gone = slide(*start, 5.0, **OPTIONS, lives=lambda z: bool(z[0] < -0.3))
    assert (gone.end, gone.taken[-1].last[2]) == ("cycle", pytest.approx(-0.3, abs=1e-4))


@pytest.mark.parametrize("height", [1.5, 1.01, 1.0001, 1.0000001])
@pytest.mark.parametrize("rate", [1.0, 10.0])
def test_a_slide_ends_where_the_set_is_outside_for_part_of_a_step(height, rate):
    """c = height sin(rate z), z' = 1: beyond the equator for a short while, which one step of z spans."""
    system = c2.System(U=(f"-c + {height}*sin({rate}*z)", "-s"), W=("1",))
    out = math.asin(1.0 / height) / rate
    found = slide(field(system), PSIS[0], np.zeros(2), 0.0, np.zeros(1), 3.0 / rate, **OPTIONS)
    assert found.end == "equator"
    assert found.taken[-1].end == pytest.approx(out, abs=1e-9)
    limit = c2.simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, 3.0 / rate), psi=PSIS[0])
    assert [phase.kind for phase in limit.phases][:2] == ["slide", "slip"]


def test_parts_of_a_step():
    polynomial = np.array([[1.0, -2.0, 0.5, 0.0, 0.0]])
    step = Step(2.0, 4.0, np.array([3.0]), np.array([2.5]), polynomial)
    whole, part = _whole(step, 1.0), _whole(step, 0.3)
    assert (whole.start, whole.h, part.start, part.h) == (2.0, 4.0, 2.0, pytest.approx(1.2))
    assert whole.last.tolist() == [0.0, 0.0, 2.5]
    for u in (0.0, 0.4, 1.0):
        assert part.at(u) == pytest.approx([0.0, 0.0, step.at(0.3 * u)[0]])
    assert part.last == pytest.approx(part.at(1.0))
    rising = Step(0.0, 1.0, np.array([0.0]), np.array([1.0]), np.array([[1.0, 0.0, 0.0, 0.0, 0.0]]))
    assert _last_alive(lambda z: bool(z[0] < 0.37), rising) == pytest.approx(0.37, abs=2e-6)
    sheet = Sheet(field(c2.System(U=("z - c", "-s"), W=("1",))), np.zeros(2), np.zeros(1))
    place = partial(_place, sheet, rising)
    assert _first(lambda e, z: 0.37 - float(e[0]), place, 0.37, -0.63) == pytest.approx(0.37, abs=1e-12)
    assert _first(lambda e, z: (0.37 - float(e[0])) * (0.4 - float(e[0])), place, 0.148, 0.378) == pytest.approx(0.37)
    assert _first(lambda e, z: -1.0, place, -1.0, -1.0) == 0.0
    assert _first(lambda e, z: float(e[0]), place, 0.0, 1.0) is None  # from the border inwards


@pytest.mark.parametrize("rho", [0.3, 2.0])
def test_a_slip_along_a_limit_direction_arrives_when_it_must(rho):
    """theta = 0 of a = -1, f1 = -1/2: rho' = -3/2, and z' = 2 c."""
    system = c2.System(U=("-c - 1/2", "-3*s"), W=("2*c",))
    problem, state = plane_problem(field(system), PSIS[0], 0.0, 1e-10, 1e-12), np.array([rho, 0.0, 0.1])
    found = slip(problem, 1.0, state, 9.0, 1e-10, 500, 0.0)
    assert found.theta == pytest.approx(0.0, abs=1e-12)
    assert found.taken[-1].end == pytest.approx(1.0 + rho / 1.5, rel=1e-9)
    assert found.taken[-1].last == pytest.approx([0.0, 0.0, 0.1 + 2.0 * rho / 1.5], abs=1e-9)
    short = slip(problem, 1.0, state, 1.0 + 0.5 * rho, 1e-10, 500, 0.0)
    assert short.theta is None
    assert short.taken[-1].last == pytest.approx([0.25 * rho, 0.0, 0.1 + rho], abs=1e-9)


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_the_first_step_away_along_a_limit_direction(turn):
    """U = (2 + z, -s + k z), z' = 3: near theta = 0: rho' = 2, lambda_theta = -3, and z turns the direction."""
    system = c2.System(U=("2 + z", f"-s + {turn}*z"), W=("3",))
    step = leave(field(system), 0.02, 5.0, np.array([0.0]), 6.0)
    assert isinstance(step, Step)
    assert step.start == 5.0
    x, y, z = step.last
    assert math.hypot(x, y) == pytest.approx(2.0 * step.h, rel=1e-5)
    assert z == pytest.approx(3.0 * step.h, rel=1e-12)
    # theta = kappa t on the way out: kappa rho = rho' theta' ... (lambda_rho - lambda_theta) kappa = forced
    assert y / x == pytest.approx(turn * 3.0 * step.h / (2.0 + 3.0), rel=1e-4, abs=1e-18)
    assert step.first.tolist() == [0.0, 0.0, 0.0]
    assert step.at(1.0) == pytest.approx(step.last)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_in_a_line_the_first_step_stays_in_it_though_what_lies_beside_turns(side):
    """U = (2 side + z, -s + z): without the line z turns the direction; in it the step is as long as it may be."""
    system = c2.System(U=(f"{2 * side} + 0*z", "-s + z"), W=("3",))
    line = InvariantLine(field(system), np.array([1.0, 0.0]))
    theta = 0.0 if side > 0 else math.pi
    free, kept = (leave(field(system), theta, 5.0, np.array([0.0]), 6.0, one) for one in (None, line))
    assert isinstance(kept, Step)
    assert kept.last == pytest.approx([2.0 * side * kept.h, 0.0, 3.0 * kept.h], rel=1e-12)
    assert kept.last[1] == 0.0
    assert kept.h == pytest.approx(free.h) == pytest.approx(1e-9)
    assert abs(free.last[1]) > 0.0
    long = leave(field(system), theta, 5.0, np.array([0.0]), 1e7, line)
    assert long.h == pytest.approx(1e-2, rel=1e-5)  # nothing turns, that would have to be resolved
    quadratic = c2.System(U=(f"c - {side} + {side}*z", "-s + z"), W=("2",))
    kept = leave(
        field(quadratic), theta, 0.0, np.array([0.0]), 1.0, InvariantLine(field(quadratic), np.array([1.0, 0.0]))
    )
    assert kept.last == pytest.approx([side * kept.h**2, 0.0, 2.0 * kept.h], rel=1e-6)
    assert kept.last[1] == 0.0


def test_where_lambda_rho_only_begins_to_grow_the_way_out_is_quadratic():
    """U = (c - 1 + z, -s), z' = 2, from theta = 0: rho' = 2 t, so rho = t^2."""
    system = c2.System(U=("c - 1 + z", "-s"), W=("2",))
    step = leave(field(system), 0.0, 0.0, np.array([0.0]), 1.0)
    assert isinstance(step, Step)
    assert step.last == pytest.approx([step.h**2, 0.0, 2.0 * step.h], rel=1e-6)
    for U2, W, z in (("-s", "2 + 3*z", lambda h: 2.0 / 3.0 * math.expm1(3.0 * h)), ("z/2 - s", "2 + s", None)):
        step = leave(field(c2.System(U=("c - 1 + z", U2), W=(W,))), 0.0, 0.0, np.array([0.0]), 1.0)
        assert isinstance(step, Step)
        # to second order: of s = theta = t, as Q moves with z, z is 2 t + t^2/2
        expected = 2.0 * step.h + step.h**2 / 2.0 if z is None else z(step.h)
        assert step.last[2] == pytest.approx(expected, rel=1e-9)
        assert step.at(0.5)[2] == pytest.approx(step.h + step.h**2 / 8.0 if z is None else z(0.5 * step.h), rel=1e-9)
    assert "radial eigenvalue is not positive" in leave(
        field(c2.System(U=("c - 1 - z", "-s"), W=("2",))), 0.0, 0.0, np.array([0.0]), 1.0
    )
    assert "repels angularly" in leave(field(c2.System(U=("1", "3*s"), W=("2",))), 0.0, 0.0, np.array([0.0]), 1.0)


@EVERY
def test_means_over_a_round_cycle(psi):
    """A circle about 0 at constant speed: both means vanish; moved to uneven points they still do."""
    angle = math.tau * np.linspace(0.0, 1.0, 201)[:-1]
    angle = angle + 0.3 * np.sin(angle)  # uneven
    cycle = type("Cycle", (), {"points": 0.6 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)})
    e, p = _means(c2.System(U=("-s", "c"), W=("1",)), psi, np.array([0.0]), cycle)
    np.testing.assert_allclose(e, 0.0, atol=1e-3)
    np.testing.assert_allclose(p, 0.0, atol=1e-3)


def test_the_rest_of_the_way_to_sigma_ends_where_its_polynomial_does():
    problem = plane_problem(field(SLIDING), None, 0.0, OPTIONS["rtol"], OPTIONS["atol"])
    before = Step(1.0, 0.5, np.ones(4), np.array([3e-3, -4e-3, 0.2, -0.1]), np.zeros((4, 5)))
    rest = _straight(problem, before, 0.01)
    np.testing.assert_allclose(rest.last, rest.at(1.0), rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(rest.last[2:], before.last[2:] + 0.01 * problem.F(before.last)[2:], rtol=0.0, atol=1e-15)
    assert (rest.start, rest.h, *rest.last[:2]) == (1.5, 0.01, 0.0, 0.0)


@pytest.mark.parametrize(("w", "q"), [(0.3, 1.3), (0.35, 0.9), (0.3, 0.9)])
def test_a_slide_ends_where_its_set_is_at_the_equator_however_long_its_steps_are(w, q):
    """q'' + q = cos(w t) - 0.1 q'/|q'|: it stands while |cos(w t) - q| < 0.1, and nothing limits a step meanwhile."""
    system = c2.System(U=("-z1 - mu*c + cos(w*z2)", "-mu*s"), W=("x", "1"), parameters={"mu": 0.1, "w": w})
    for motion in c2.simulate_nonsmooth(
        system, [(0.3, 0.0, q, 0.0)] * 8, (0.0, 4 * math.pi / w), rtol=1e-6
    ):  # compiled
        assert motion.status is c2.SimulationStatus.T_END
        ends = [phase.t_end for phase in motion.phases if phase.kind == "slide" and phase.t_end < motion.times[-1]]
        states = [motion.states[np.searchsorted(motion.times, t)] for t in ends]
        assert [abs(math.cos(w * t) - at[2]) for t, at in zip(ends, states, strict=True)] == pytest.approx(
            [0.1] * len(ends), abs=1e-9
        )
        assert ends
