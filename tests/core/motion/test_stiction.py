"""Static friction above kinetic: closed forms of the block on a belt, and another integrator in the plane."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import codim2_core as c2
from codim2_core import psi
from codim2_core.systems.mechanics import Mechanism

from ...words.recognition import recognise

V, KINETIC = 0.3, 0.5


def block_on_belt(v=V, kinetic=KINETIC):
    """Mass and spring 1, on a belt: x is its slip, z1 the spring's length."""
    return c2.System(U=("-z1 - S*c", "-s"), W=("x + v",), parameters={"S": kinetic, "v": v})


def times_on_belt(v, kinetic, static):
    """It slips on a circle about z1 = kinetic until it moves with the belt, and sticks until the force is static."""
    rise = static - kinetic
    return 2.0 * (math.pi - math.atan(rise / v)), 2.0 * rise / v


@settings(max_examples=15)
@given(st.floats(0.1, 1.0), st.floats(0.2, 1.0), st.floats(1.05, 2.0))
def test_a_block_on_a_belt_sticks_and_slips_as_the_textbooks_say(v, kinetic, ratio):
    run = c2.simulate_nonsmooth(block_on_belt(v, kinetic), (0.0, 0.0, 0.0), (0.0, 40.0), stiction=ratio)
    first, *rest = run.phases
    assert first.t_end == pytest.approx(ratio * kinetic / v, rel=1e-9)
    assert np.hypot(*first.e(first.t_end)) == pytest.approx(ratio, rel=1e-9)
    expected = itertools.cycle(times_on_belt(v, kinetic, ratio * kinetic))
    for phase, time in zip(rest[:-1], expected, strict=False):
        assert phase.t_end - phase.t_start == pytest.approx(time, rel=1e-8)
    assert [phase.kind for phase in rest[:2]] == ["slip", "slide"]
    slip, again = rest[:2]
    (_, (key, told)) = recognise(first.reason)
    assert key == "static holds"
    assert float(told["share"]) == pytest.approx(0.0, abs=1e-12)
    ((key, told),) = recognise(slip.reason)
    assert (key, float(told["reach"])) == ("static gives way", pytest.approx(ratio, rel=1e-3))
    assert abs(math.remainder(float(told["theta"].replace("−", "-")) - math.pi, math.tau)) < 1e-3
    *_, (key, told) = recognise(again.reason)
    assert key == "static holds"
    assert float(told["share"]) == pytest.approx(abs(2.0 - ratio), rel=1e-3, abs=1e-9)
    longest = kinetic + math.hypot(v, (ratio - 1.0) * kinetic)
    t = np.linspace(slip.t_start, slip.t_end, 2001)
    assert run.dense(t)[:, 2].max() == pytest.approx(longest, rel=1e-5)


def test_without_it_the_block_sticks_once():
    """Kinetic friction alone: it leaves with no speed, and touches the belt once a swing; rounding decides how."""
    plain = c2.simulate_nonsmooth(block_on_belt(), (0.0, 0.0, 0.0), (0.0, 40.0))
    same = c2.simulate_nonsmooth(block_on_belt(), (0.0, 0.0, 0.0), (0.0, 40.0), stiction=1.0)
    assert plain == same
    assert plain.phases[0].t_end == pytest.approx(KINETIC / V)
    stuck = lambda run: sum(phase.t_end - phase.t_start for phase in run.phases[1:] if phase.kind == "slide")
    assert stuck(plain) < 1e-4
    held = c2.simulate_nonsmooth(block_on_belt(), (0.0, 0.0, 0.0), (0.0, 40.0), stiction=1.5)
    assert stuck(held) > 4.0 * (0.5 * KINETIC) / V


def test_it_holds_at_a_turn_where_kinetic_friction_alone_would_let_it_pass():
    """Den Hartog's mass turns where the force is 1.36 S: up to there it passes as if there were no static friction."""
    w, S = 1.5, 0.3
    mass = c2.System(U=("-z1 - S*c + cos(w*z2)", "-s"), W=("x", "1"), parameters={"S": S, "w": w})
    start = c2.periodic_motion(mass, (0.0, 0.0, 0.7, 0.3), 2.0 * math.pi / w).state0
    period = 2.0 * math.pi / w
    free = c2.simulate_nonsmooth(mass, start, (0.0, 3.0 * period))
    turns = [phase.t_start for phase in free.phases if phase.kind == "cross"]
    assert len(turns) >= 5
    forces = [abs(math.cos(w * free.dense(t)[3]) - free.dense(t)[2]) / S for t in turns]
    least = min(forces)
    passes = c2.simulate_nonsmooth(mass, start, (0.0, 3.0 * period), stiction=0.999 * least)
    assert [phase.kind for phase in passes.phases] == [phase.kind for phase in free.phases]
    assert passes.states[-1] == pytest.approx(free.states[-1], abs=1e-12)
    sticks = c2.simulate_nonsmooth(mass, start, (0.0, 3.0 * period), stiction=1.001 * max(forces))
    assert "slide" in [phase.kind for phase in sticks.phases]


MASS, SPRINGS, BELT, FRICTION = np.array([[1.0, 0.3], [0.3, 2.0]]), np.array([1.0, 1.7]), np.array([0.2, 0.1]), 0.4


def plate_on_belt():
    """Two springs and a mass that depends on direction, on a belt that runs askew to both."""
    return Mechanism(
        M=MASS, J=((1, 0), (0, 1)), force=("-px", "-1.7*py"), mu=FRICTION, normal=1, velocities=("vx", "vy"),
        slow=("px", "py"), rates={"px": "vx", "py": "vy"}, surface=BELT,
    )  # fmt: skip


#: Times at which the plate begins to slip and comes to rest, with its place then: once by SciPy's DOP853 and brentq.
FOLLOWED = np.array(
    [
        (2.400672378, 0.580134476, 0.090067238), (8.345596693, 0.287164236, 0.051125651),
        (9.537405359, 0.525525969, 0.170306518), (15.327928693, 0.244812615, 0.016517951),
        (16.773306022, 0.533888081, 0.161055684), (22.567648313, 0.247112324, 0.019322700),
        (23.996487438, 0.532880149, 0.162206612), (29.790194153, 0.246795554, 0.018959184),
        (31.221243527, 0.533005429, 0.162064121), (37.015026433, 0.246834297, 0.019003965),
        (38.445804529, 0.532989916, 0.162081774), (44.239577958, 0.246829490, 0.018998413),
    ]
)  # fmt: skip


def test_a_plate_on_a_belt_as_another_integrator_follows_it():
    ratio, t_end = 1.5, 40.0
    plate = plate_on_belt()
    start = plate.state(vx=BELT[0], vy=BELT[1], px=0.1, py=-0.15)
    run = c2.simulate_nonsmooth(plate.system, start, (0.0, t_end), psi.tanh(), stiction=ratio)
    assert {phase.kind for phase in run.phases} == {"slip", "slide"}
    ends = [phase.t_end for phase in run.phases[:-1]]
    expected = FOLLOWED[: len(ends)]
    assert len(ends) >= 4
    assert ends == pytest.approx(expected[:, 0], abs=2e-6)
    assert run.dense(ends)[:, 2:] == pytest.approx(expected[:, 1:], abs=2e-6)


@settings(max_examples=15)
@given(st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4), st.floats(0.0, 6.28), st.floats(1.05, 3.0))
def test_what_lets_go_has_one_direction(entries, angle, ratio):
    """Where A + A^T is negative definite, one limit direction leads away from rest at |e| = ratio, and it attracts."""
    A = np.array(entries).reshape(2, 2)
    A = A - (max(0.0, np.linalg.eigvalsh(A + A.T)[-1] / 2.0) + 0.1) * np.eye(2)
    f = -ratio * A @ [math.cos(angle), math.sin(angle)]
    found = c2.equator_equilibria(c2.ELinear.from_matrix(A, tuple(f)))
    away = found.lambda_rho > 0.0
    assert away.sum() == 1
    assert found.lambda_theta[away] < 0.0


def test_friction_that_feeds_a_slip_is_left_unknown():
    """With A + A^T indefinite it is not known whether static friction holds."""
    A = ((-0.2, -2.0), (0.1, -0.2))
    system = c2.System(U=("-0.2*c - 2*s + 0.2*z1", "0.1*c - 0.2*s - 0.1*z1"), W=("1",))
    assert np.linalg.eigvalsh(np.array(A) + np.array(A).T)[-1] > 0.0
    run = c2.simulate_nonsmooth(system, (0.0, 0.0, 0.5), (0.0, 2.0), psi.constant(), stiction=1.5)
    assert run.status is c2.SimulationStatus.NOT_UNIQUE
    assert [key for key, _ in recognise(run.reason)] == ["not unique", "static unknown"]


@pytest.mark.parametrize("ratio", [0.99, math.inf, math.nan, "much", None])
def test_what_is_no_ratio_is_refused(ratio):
    with pytest.raises(ValueError, match="stiction is"):
        c2.simulate_nonsmooth(block_on_belt(), (0.0, 0.0, 0.0), (0.0, 1.0), stiction=ratio)


def test_what_is_not_affine_in_e_is_refused():
    system = c2.System(U=("-c**3 - c", "-s"))
    with pytest.raises(ValueError, match="affine in e"):
        c2.simulate_nonsmooth(system, (0.0, 0.0), (0.0, 1.0), stiction=1.5)


def test_many_motions_at_once_are_those_one_by_one():
    starts = [(0.0, 0.0, 0.1), (-0.2, 0.0, 0.3), (0.4, 0.1, 0.0)]
    many = c2.simulate_nonsmooth(block_on_belt(), starts, (0.0, 15.0), stiction=1.4)
    for start, run in zip(starts, many, strict=True):
        one = c2.simulate_nonsmooth(block_on_belt(), start, (0.0, 15.0), stiction=1.4)
        assert run == one


@pytest.mark.parametrize("in_a_line", [True, False])
def test_derivatives_are_those_of_differences(in_a_line):
    """Past several rests, by the start and by numbers of the system: a change of the start changes when it lets go."""
    if in_a_line:
        start, t_end, ratio = np.array([-0.4, 0.0, 0.2]), 12.0, 1.5
        system, names = block_on_belt(), ("S", "v")
    else:
        start, t_end, ratio = np.array([0.05, 0.1, 0.1, -0.15]), 12.0, 1.5
        system, names = plate_on_belt().system, ()
    axes = [0, 2] if in_a_line else range(len(start))

    def follow(state, system=system):
        return c2.simulate_nonsmooth(
            system, state, (0.0, t_end), psi.constant(), stiction=ratio, rtol=1e-12, atol=1e-14
        )

    run = follow(start)
    assert [phase.kind for phase in run.phases].count("slide") >= 2
    assert run.phases[-1].kind == "slip"
    found = run.variation(*names)
    assert not found.reason
    for i in axes:
        step = 1e-6 * np.eye(len(start))[i]
        by_differences = (follow(start + step).states[-1] - follow(start - step).states[-1]) / 2e-6
        assert found.last[:, i] == pytest.approx(by_differences, abs=2e-6), i
    for k, name in enumerate(names, len(start)):
        own, h = {"S": KINETIC, "v": V}, 1e-6
        other = []
        for sign in (1, -1):
            varied = own | {name: own[name] + sign * h}
            other.append(follow(start, block_on_belt(varied["v"], varied["S"])).states[-1])
        assert found.last[:, k] == pytest.approx((other[0] - other[1]) / (2.0 * h), abs=2e-6), name


def test_a_periodic_motion_sticks_and_slips():
    """It forgets its start as it sticks: no multiplier is left."""
    ratio = 1.5
    period = sum(times_on_belt(V, KINETIC, ratio * KINETIC))
    found = c2.periodic_motion(block_on_belt(), (-0.05, 0.0, 0.8), 1.02 * period, stiction=ratio)
    assert found.period == pytest.approx(period, rel=1e-9)
    assert np.abs(found.multipliers).max(initial=0.0) < 1e-6
    with pytest.raises(ValueError, match="known in the limit alone"):
        c2.periodic_motion(block_on_belt(), (0.0, 0.0, 0.0), period, psi.constant(), 1e-3, stiction=ratio)


def test_a_response_curve_along_the_speed_of_the_belt():
    ratio = 1.5
    period = sum(times_on_belt(V, KINETIC, ratio * KINETIC))
    found = c2.response_curve(block_on_belt(), (-0.05, 0.0, 0.8), period, "v", (0.2, 0.5), stiction=ratio)
    assert (found.values.min(), found.values.max()) == pytest.approx((0.2, 0.5))
    expected = [sum(times_on_belt(v, KINETIC, ratio * KINETIC)) for v in found.values]
    assert found.period == pytest.approx(expected, rel=1e-9)
    swings = [math.hypot(v, (ratio - 1.0) * KINETIC) for v in found.values]
    assert found.amplitude[:, 0] == pytest.approx(swings, rel=1e-6)


def test_exponents_of_a_block_that_forgets_as_it_sticks():
    found = c2.lyapunov_exponents(block_on_belt(), (-0.05, 0.0, 0.8), 10.0, stiction=1.5, count=16, transient=2)
    assert found.values[0] == pytest.approx(0.0, abs=1e-6)
    assert (found.values[1:] == -np.inf).all()
