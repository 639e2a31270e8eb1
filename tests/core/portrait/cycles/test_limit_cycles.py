"""Limit cycles: Case III to high accuracy, folds and Hopf bifurcations, and the theorems that forbid them."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core import ELinear, critical_sets, equator_cycle, equator_equilibria, psi, sliding_flow
from codim2_core.portrait.cycles.limit_cycles import limit_cycles, reason_for_none
from codim2_core.portrait.layer_problem.hemisphere import e_psi

CASE_III = ELinear(172, 186, -200, (-86, -93), B=[[1.0, -2.0], [0.5, 3.0]], g=[0.25, -1.0])


def fold(t):
    """Two cycles, stable outside, for t a little below 1.08, and none below 0.97."""
    return ELinear(
        1.6215774162507035, -2.4647033090719974, -2.095840045086004, (t * 1.285569647504226, -t * 0.9857275228103224)
    )


# Period, exponent and mean e by an extrapolation method (Gragg, Bulirsch, Stoer) of order 22 in 30 digits, run once.
@pytest.mark.parametrize(
    ("system", "n", "period", "exponent", "mean_e"),
    [
        (CASE_III, 3, 0.50447514100923193, -12.485880173526391, (0.5, 0.0)),
        (CASE_III, 4, 0.60669574936832021, -30.555860545459768, (0.5, 0.0)),
        (ELinear(1.0, 1.5, -1.2, (-0.45, -0.78)), 4, 5.2009106168136676, -1.4322281150540896, (0.6, 0.1)),
    ],
)
def test_cycles_known_to_many_digits(system, n, period, exponent, mean_e):
    (cycle,) = limit_cycles(system, psi.hill(n))
    assert cycle.period == pytest.approx(period, rel=1e-13)
    slack = 1e-12 * max(1.0, abs(exponent))  # an exponent of -30 is as accurate as its size allows
    assert math.log(cycle.multiplier) == pytest.approx(exponent, abs=slack)
    assert math.log(cycle.divergence_multiplier) == pytest.approx(exponent, abs=slack)
    assert cycle.mean_e == pytest.approx(mean_e, abs=1e-12)  # prop:LC
    assert cycle.stable
    assert cycle.direction == 1
    assert cycle.closure < 1e-13
    assert cycle.slow_flow == pytest.approx(sliding_flow(system), abs=1e-11)
    assert np.array_equal(cycle.points[0], cycle.points[-1])
    assert not cycle.points.flags.writeable
    assert np.hypot(*np.diff(cycle.points, axis=0).T).max() < 0.02


def test_cycles_leave_through_the_equator():
    """Towards t = 1.09 the stable cycle grows to the equator, which is closed and then changes its stability."""
    p = psi.hill(3)
    for t in (1.0, 1.05, 1.1, 1.2):
        exponent = equator_cycle(fold(t)).exponent
        found = limit_cycles(fold(t), p)
        assert found[-1].stable == (exponent < 0.0)
        assert (len(found) == 2) == (t < 1.08)


def test_reasons():
    def reason(*coefficients, p=None):
        a, b, d, f1, f2 = coefficients
        found = limit_cycles(ELinear(a, b, d, (f1, f2)), p or psi.rational())
        assert list(found) == []
        return found.reason

    assert "Bendixson" in reason(-1, 1, -2, 0.1, 0.2)
    assert "divergence is positive" in reason(1, 1, 2, 0.1, 0.2)
    assert "divergence is negative" in reason(0, 1, -2, 0.1, 0.2)
    assert "divergence is positive" in reason(0.2, 1, 0.3, 0.1, 0.2)
    assert "divergence is negative" in reason(-0.2, 1, -0.3, 0.1, 0.2)
    assert "divergence is positive" in reason(0.2, 1, 0, 0.01, 0.02)
    assert "saddle" in reason(1, 0.3, -1, 0.2, 0.1)
    assert "there is none" in reason(-1, 0, -1, 1.1, 0.0)
    assert "preserves area" in reason(0, 1, 0, 0.1, 0.2)
    assert "f = 0" in reason(1, 3, -2, 0, 0)
    assert "reversible" in reason(1, 3, -1, 0.5, -0.5)
    assert "isolated" in reason(1, 1, -1, 1, 1)


@pytest.mark.parametrize(
    ("a", "b", "d", "f1", "f2"),
    [
        (1, 3, -2, 0.5, 0.5),  # |f1| = |f2| alone is not reversible
        (1, 3, -1, 0.5, 0.3),  # nor is a = -d
        (1, 3, -2, 0.5, 0),  # f2 = 0 alone is not linear
        (1, 3, -2, 0, 0.5),
        (-2, -3, 1, 0.1, 0.2),
        (0.1, 3, -0.1, 0.2, -0.3),
    ],
)
def test_no_theorem_is_read_into_what_it_does_not_say(a, b, d, f1, f2):
    system = ELinear(a, b, d, (f1, f2))
    assert reason_for_none(system.at(), critical_sets(system, psi.rational())) is None


unit = st.floats(0.0, 1.0)


@st.composite
def case_III(draw):
    a, d = draw(st.floats(0.1, 3.0)), -draw(st.floats(0.1, 3.0))
    if draw(st.booleans()):
        a, d = d, a
    b = math.sqrt(-a * d) * (1.01 + 1.5 * draw(unit) ** 2) * draw(st.sampled_from([-1, 1]))
    r, t = 0.03 + 0.92 * draw(unit), 2 * math.pi * draw(unit)
    e = np.array([r * math.cos(t), r * math.sin(t)])
    f = -np.array([[a, -b], [b, d]]) @ e
    n = draw(st.sampled_from([0, 1, 2, 3, 4, 6, 10]))
    return ELinear(a, b, d, (float(f[0]), float(f[1]))), psi.hill(n) if n else psi.tanh(), e


@pytest.mark.parametrize(
    ("system", "lowest"),
    [
        (ELinear(-0.85546875, 1.0100829276286984, 0.55078125, (-0.922539607009262, 0.9247749793209779)), -23.4252),
        (ELinear(-0.8515625, 1.011341516959763, 0.5546875, (-0.9334535569832111, 0.9306731018691708)), -32.9978),
    ],
)
def test_a_cycle_that_passes_close_to_an_equator_on_which_nothing_attracts(system, lowest):
    """C and the equator repel, so there is one; LSODA on (theta, ln ebar) closes it."""
    [cycle] = limit_cycles(system, psi.tanh())
    [C] = critical_sets(system, psi.tanh())
    assert cycle.stable
    assert cycle.mean_e == pytest.approx(C.e, abs=1e-9)  # prop:LC
    assert cycle.multiplier == pytest.approx(cycle.divergence_multiplier, rel=1e-8)

    def rate(_, state):
        theta, height = state[0], math.exp(state[1])
        n, r = np.array([math.cos(theta), math.sin(theta)]), math.sqrt((1.0 - height) * (1.0 + height))
        U = system.at().U(e_psi(psi.tanh(), r * n))
        return [(n[0] * U[1] - n[1] * U[0]) / r, -r * (n @ U)]

    x, y = cycle.points[0]
    start = [math.atan2(y, x), 0.5 * math.log1p(-x * x - y * y)]
    run = solve_ivp(rate, (0.0, cycle.period_T), start, method="DOP853", rtol=1e-13, atol=1e-14)
    assert math.remainder(run.y[0, -1] - start[0], 2.0 * math.pi) == pytest.approx(0.0, abs=1e-7)
    assert run.y[1, -1] == pytest.approx(start[1], abs=1e-7)
    assert run.y[1].min() == pytest.approx(lowest, abs=0.1)
    backward = ELinear(-system.a, -system.b, -system.d, (-system.f[0], -system.f[1]))
    assert [one.stable for one in limit_cycles(backward, psi.tanh())] == [False]


@settings(max_examples=20)  # many more: tests/stress
@given(case_III())
def test_random_case_III(found):
    system, p, e = found
    cycles = limit_cycles(system, p)
    C = critical_sets(system, p)[0]
    for cycle in cycles:
        assert cycle.mean_e == pytest.approx(e, abs=1e-9)  # prop:LC
        assert cycle.closure < 1e-10
        if cycle.divergence_multiplier > 1e-280 and cycle.divergence_multiplier < 1e280:
            assert cycle.multiplier == pytest.approx(cycle.divergence_multiplier, rel=1e-8)
        turn = np.unwrap(np.arctan2(*(cycle.points - C.p).T[::-1]))
        assert turn[-1] - turn[0] == pytest.approx(2 * math.pi * cycle.direction, abs=1e-6)
    if cycles.notes or any(cycle.kind == "semistable" for cycle in cycles):
        return
    # Neighbours differ in stability, from C outwards to the equator.
    kinds = [cycle.stable for cycle in cycles]
    assume(abs(C.trace) > 1e-6 * math.hypot(*C.jacobian.ravel()))
    kinds.insert(0, C.trace < 0.0)
    closed = equator_cycle(system)
    if closed is not None and abs(closed.exponent) > 1e-3:
        kinds.append(closed.exponent > 0.0)
    equator = equator_equilibria(system)
    inside_sinks = ((equator.lambda_rho > 0.0) & (equator.lambda_theta < 0.0)).any()
    inside_sources = ((equator.lambda_rho < 0.0) & (equator.lambda_theta > 0.0)).any()
    assert all(one != other for one, other in itertools.pairwise(kinds))
    if closed is None and len(equator) and not inside_sinks:
        assert kinds[-1]  # what does not end on the equator ends on the outermost attractor
    if closed is None and len(equator) and not inside_sources:
        assert not kinds[-1]


def test_one_cycle_about_several_sets_is_counted_once():
    """Level curves of F are invariant, so the cycles are F = 0.0255, about one set each, and 0.0257, about all."""
    F, Fc, Fs = "((c**2-.16)**2+.16*s**2)", "(4*c*(c**2-.16))", "(.32*s)"
    E, p = f"(c*{Fc}+s*{Fs})", f"(({F}-.0257)*({F}-.0255))"
    U = f"-({Fs}-s*{E})-.5*{p}*{Fc}", f"({Fc}-c*{E})-.5*{p}*{Fs}"
    assert len(c2.limit_cycles(c2.System(U=U), c2.psi.constant())) == 3


# a, b, d, f1, f2, Psi, how many cycles: found about the one critical set of systems within 1e-8 of a special value
NEAR_SPECIAL_VALUES = [
    (
        (-1.986879347446464, -2.1204428882401025, 1.4718292840540894, -2.159035208380967, -2.046364883841078),
        c2.psi.hill(4),
        1,
    ),
    (
        (1.4090554423755608, -1.8975247399965562, -1.3069815388073591, -1.798896337430398, 1.7885469264654532),
        c2.psi.hill(3),
        2,
    ),
    (
        (0.5801042375220418, 1.1519700106600874, -1.1833898616294931, 0.9469438081905298, 0.9183789581261839),
        c2.psi.exponential(),
        2,
    ),
    (
        (-0.8499367526055885, 1.3711366273541952, 1.8631606513704286, -0.9018514082046241, 1.1626532904213651),
        c2.psi.tanh(),
        1,
    ),
    (
        (-1.48291317496723, 1.2928125193017264, 0.8417970647268962, -1.0057763205216663, 0.9387963043954538),
        c2.psi.hill(7),
        1,
    ),
]


@pytest.mark.parametrize(("plane", "family", "count"), NEAR_SPECIAL_VALUES)
def test_cycles_next_to_special_values(plane, family, count):
    found = c2.limit_cycles(c2.ELinear(*plane[:3], plane[3:]), family)
    assert len(found) == count


def test_nothing_is_in_doubt_in_the_case_of_the_paper():
    """Backward in time orbits fall onto C within a turn: where they do, samples were looked at ever closer, in vain."""
    found = c2.limit_cycles(c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3))
    assert len(found) == 1
    assert found.notes == ()


@pytest.mark.parametrize(("U", "law"), [
    (("-s", "c - c**3"), c2.psi.constant()),
    (("-s + s**3", "c - c**3"), c2.psi.constant()),
    (("s*(-1.46 - 0.404*c + 0.248*c*c + 2.068*s*s)", "0.4*c - 0.174*c*c - 0.202*s*s"), c2.psi.rational()),
    (("s*(-0.428 - 1.375*c - 0.296*c*c + 0.639*s*s)", "0.4*c - 0.057 + 1.282*c*c - 0.651*c**3 - 0.6875*s*s"),
     c2.psi.tanh()),
])  # fmt: skip
def test_closed_orbits_of_a_reversible_system_are_no_limit_cycles_however_near_a_loop_they_pass(U, law):
    """With U1 odd in s and U2 even in it, (c, s, t) -> (c, -s, -t): what closes about a set on s = 0 fills a band."""
    found = c2.limit_cycles(c2.System(U=U), law)
    assert len(found) == 0
    assert found.notes  # it is undecided
