"""Derivatives of motions: the flow carries its own rate along, differences of motions, closed forms, and eps to 0."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, Event, System, examples, psi, simulate, simulate_nonsmooth

POOL = examples.ball_in_pool(mu=0.2, K=1.5, m=1.2)
CROSSING = (
    System(
        U=("-1.2 + 0.7*c + 0.6*s + 0.2*c*s - k*z", "-0.5 - 0.4*c - 1.9*s + 0.7*(c**2 - s**2)"),
        W=("1 - 1.1*c",),
        parameters={"k": 0.3},
    ),
    (0.7, 0.1, 0.0),
    2.0,
    ("k",),
)
LEAVING = (ELinear(-1.0, 0.5, -1.5, ("z", 0.3), g=(1.0,)), (0.3, 0.2, 0.0), 4.0, ("a", "d", "f2"))
SLIDING = (POOL, (1.0, 0.3, 1.0, 0.5), 2.0, ("mu", "K"))
ALONG = (POOL, (1.0, 0.0, 1.0, 0.0), 2.0, ("mu",))  # lines; the second repels as the motion passes Sigma
IN_A_LINE = (examples.ball_in_pool(K=2.0), (1.0, 0.0, 12.0, 0.0), 2.0, ("mu", "K"))
READING = (
    System(U=("-2*c + 0.3*s + z1*x", "-s - 0.2*c + 0.4*sin(z2)"), W=("s - z1*z2 + x", "1 + 0.3*c*z1"), parameters={}),
    (0.5, 0.4, 0.3, 0.2),
    1.5,
    (),
)
MOTIONS = {"slide": SLIDING, "cross": CROSSING, "leave": LEAVING, "along": ALONG, "line": IN_A_LINE, "reads": READING}


def first_rate(run):
    return run.motion.polynomials[0, :, 0] / run.motion.lengths[0]


def difference(end, value, h):
    return (end(value + h) - end(value - h)) / (2.0 * h)


def limit(system, state0, t_end):
    return simulate_nonsmooth(system, state0, (0.0, t_end), psi.constant(), rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("name", MOTIONS)
def test_the_limit_is_differentiated_through_all_phases(name):
    system, state0, t_end, names = MOTIONS[name]
    start = np.array(state0)
    run = limit(system, start, t_end)
    found = run.variation(*names)
    assert found.reason == ""
    assert found.times.tolist() == run.times.tolist()
    assert found.error.max() < 1e-9
    aside = np.array([0.7, -0.5, 0.4, 0.3])[: len(start)]
    if name == "along":
        assert not found.last[:2, [1, 3]].any()  # across the line
        aside[[1, 3]] = 0.0

    def end(h):
        given = system
        for k, one in enumerate(names):
            given = given.varied(one, system.value_of(one) + (k + 1) * h)
        return limit(given, start + h * aside, t_end).states[-1]

    expected = found.last[:, : len(start)] @ aside + sum((k + 1) * found.by(one)[-1] for k, one in enumerate(names))
    np.testing.assert_allclose(difference(end, 0.0, 1e-6), expected, rtol=0.0, atol=1e-7)


@settings(max_examples=12, deadline=None)
@given(
    st.sampled_from(["slide", "reads", "leave"]),
    st.sampled_from([psi.constant(), psi.hill(2), psi.tanh()]),
    st.sampled_from([1.0, 1e-1, 1e-2, 1e-4, 1e-7]),
)
def test_regularised_it_carries_its_own_rate_along(name, family, eps):
    system, state0, t_end, _ = MOTIONS[name]
    run = simulate(system, family, state0, (0.0, t_end), eps=eps, rtol=1e-10, atol=1e-11)
    found = run.variation()
    assert found.reason == ""
    np.testing.assert_allclose(found.last @ first_rate(run), found.rate, rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("eps", [1.0, 1e-2, 1e-4])
def test_regularised_motions_are_differentiated(eps):
    system, state0, t_end, names = SLIDING
    start, family = np.array(state0), psi.hill(2)

    def end(first, given=system):
        return simulate(given, family, first, (0.0, t_end), eps=eps, rtol=1e-13, atol=1e-13).states[-1]

    found = simulate(system, family, start, (0.0, t_end), eps=eps, rtol=1e-12, atol=1e-12).variation(*names)
    aside = np.array([0.7, -0.5, 0.4, 0.3])
    by = difference(lambda h: end(start + h * aside), 0.0, 1e-5)
    np.testing.assert_allclose(found.last[:, :4] @ aside, by, rtol=0.0, atol=1e-8)
    for name in names:
        by = difference(lambda v, name=name: end(start, system.varied(name, v)), system.value_of(name), 1e-5)
        np.testing.assert_allclose(found.by(name)[-1], by, rtol=0.0, atol=1e-8)


def test_derivatives_of_the_limit_are_the_limit_of_derivatives():
    system, state0, t_end, names = SLIDING
    last = limit(system, state0, t_end).variation(*names).last
    off = [
        np.abs(
            simulate(system, psi.constant(), state0, (0.0, t_end), eps=eps, rtol=1e-11, atol=1e-12)
            .variation(*names)
            .last
            - last
        ).max()
        for eps in (1e-2, 1e-4, 1e-6, 1e-8)
    ]
    np.testing.assert_allclose(np.array(off[1:]) / off[:-1], 1e-2, rtol=0.01)  # O(eps)


def test_exponents_of_a_linear_motion_are_its_eigenvalues():
    # Far inside e is (x, y)/eps: x' = -2 x/eps and so on, with Psi = 1 and |x| << eps.
    system = ELinear(-2.0, 0.0, -1.0, (0.0, 0.0))
    run = simulate(system, psi.constant(), (1e-9, 1e-9), (0.0, 2.0), eps=1.0, rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(run.variation().exponents, [-1.0, -2.0], rtol=1e-9)
    limit_run = simulate_nonsmooth(POOL, SLIDING[1], (0.0, 2.0))
    exponents = limit_run.variation().exponents
    assert np.isneginf(exponents[2:]).all()
    assert np.isfinite(exponents[:2]).all()


def test_a_section_is_passed_sooner_or_later():
    system, state0, _, _ = SLIDING
    start = np.array(state0)
    falling = Event(lambda _, state: state[2] - 0.8, terminal=True)

    def end(first):
        run = simulate_nonsmooth(system, first, (0.0, 2.0), rtol=1e-13, atol=1e-13, events=[falling])
        return np.array([run.times[-1], *run.states[-1]])

    run = simulate_nonsmooth(system, start, (0.0, 2.0), rtol=1e-13, atol=1e-13, events=[falling])
    when, where = run.variation().through((0.0, 0.0, 1.0, 0.0))
    # some of these motions may be run in Python and others compiled, 1e-13 apart: h is far above that
    by = np.stack([difference(lambda h, axis=axis: end(start + h * axis), 0.0, 1e-4) for axis in np.eye(4)], axis=-1)
    np.testing.assert_allclose(when, by[0], rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(where, by[1:], rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(where[2], 0.0, atol=1e-12)
    with pytest.raises(ValueError, match="one for each of x, y, z"):
        run.variation().through((1.0, 0.0))
    still = limit(examples.ball_in_pool(K=0.0), (1.0, 0.0, 1.0, 0.0), 1.0).variation()
    with pytest.raises(ValueError, match="touches the section"):
        still.through((0.0, 0.0, 1.0, 0.0))


BELT = System(  # a mass on springs, on a belt; the friction falls with speed
    U=("-z1 - c + 0.1*x", "-z2 - s + 0.1*y"), W=("x + 1", "y")
)


@pytest.mark.parametrize("t_end", [3.0, 6.0, 8.0])
def test_a_motion_that_comes_back_is_differentiated_by_its_start_in_a_slide(t_end):
    start = np.array([0.0, 0.0, 0.9, 0.05])
    found = limit(BELT, start, t_end).variation()
    assert found.error.max() < 1e-8
    assert not found.last[:, :2].any()  # (x, y) of a start on Sigma
    for i in (2, 3):
        axis = np.eye(4)[i]
        by = difference(lambda h, axis=axis: limit(BELT, start + h * axis, t_end).states[-1], 0.0, 1e-5)
        np.testing.assert_allclose(found.last[:, i], by, rtol=0.0, atol=1e-7)


def test_what_leads_out_of_a_line_that_repels_is_left_out():
    # z2 pulls across the line y = 0 where it is not 0; "side" does too, "along" does not. Across, friction drives.
    system = System(
        U=("-z1 - 0.1*c + along*cos(0.6*z3)", "-z2 + 0.1*s + side*z1"), W=("x", "y", "1"),
        parameters={"along": 1.0, "side": 0.0},
    )  # fmt: skip
    start = np.array([0.5, 0.0, 1.0, 0.0, 0.0])
    run = limit(system, start, 8.0)
    assert "cross" in [phase.kind for phase in run.phases]
    found = run.variation("along", "side")
    assert not found.last[:, [1, 3, 6]].any()
    assert found.within is not None
    np.testing.assert_array_equal(found.within, np.eye(5)[:, [0, 2, 4]])
    by = difference(lambda v: limit(system.varied("along", v), start, 8.0).states[-1], 1.0, 1e-6)
    np.testing.assert_allclose(found.by("along")[-1], by, rtol=0.0, atol=1e-7)


def test_where_it_is_not_known_is_said():
    # Proposition 4.2 does not hold
    case_3 = System(U=("172*c - 186*s - 172*z", "186*c - 200*s - 186*z"), W=("c/2 + c**3/1000",))
    run = simulate_nonsmooth(case_3, (8.5e-4, 5.2e-4, 0.45), (0.0, 0.2), psi.hill(3))
    found = run.variation()
    assert found.reason.startswith("The derivatives are unknown after t = 0.0")
    assert "limit cycle" in found.reason
    assert found.times[-1] == run.phases[1].t_start
    fold = System(U=("-(c**2) + z", "-s"), W=("-1",))  # C at c = sqrt(z) is gone at z = 0
    run = simulate_nonsmooth(fold, (0.3, 0.0, 0.5), (0.0, 3.0), psi.constant())
    ended = next(phase for phase in run.phases if phase.kind == "slide").t_end
    found = run.variation()
    assert "ends away from the equator" in found.reason
    assert found.times[-1] == pytest.approx(ended, abs=1e-9)


def test_a_slope_that_is_not_finite_ends_what_is_known():
    system = System(U=("-1 + 0*c", "-s"), W=("sqrt(z)",))  # its derivative at z = 0 is infinite
    run = simulate(system, psi.constant(), (1.0, 0.2, 0.0), (0.0, 0.5), eps=0.1)
    found = run.variation()
    assert found.reason == "The derivatives are unknown after t = 0, where those of a formula are not finite."
    assert found.times.tolist() == [0.0]
    np.testing.assert_array_equal(found.last, np.eye(3))
    assert np.isnan(found.rate).all()


@pytest.mark.parametrize("name", ["nothing", "z", "f1"])
def test_a_name_that_is_none_of_the_system_is_refused(name):
    run = limit(*SLIDING[:3])
    with pytest.raises(ValueError, match=f"'{name}' is no number of this system; it has "):
        run.variation(name)
    with pytest.raises(ValueError, match="ask for variation"):
        run.variation("mu").by(name)
