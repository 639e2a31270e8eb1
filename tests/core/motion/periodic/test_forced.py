"""Forced periodic motions: closed forms for eps > 0 and in the limit, and motions of SciPy and their differences."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from codim2_core import PeriodicStatus, System, periodic_motion, psi, simulate_nonsmooth
from codim2_core.motion.periodic.shooting import matching_distances

from ....words.recognition import recognise
from .closed_forms import CIRCLE, LINE, PLANE, DenHartog, Rotating


def keys(found):
    return [key for key, _ in recognise(found.reason)]


def close(found, expected):
    """Hold multipliers to closed forms, within their own errors."""
    apart = matching_distances(found.multipliers, np.asarray(expected, complex))
    assert (apart <= 10.0 * found.multiplier_errors + 1e-9).all(), (apart, found.multiplier_errors)
    assert found.multiplier_errors.max() < 1e-7


@pytest.mark.parametrize("eps", [0.0, 1e-9, 0.3])
def test_a_linear_oscillator_has_its_steady_state(eps):
    # q'' + 0.2 q' + q = cos(2t) and p'' + 0.4 p' + 2 p = sin(2t): e is nowhere in it
    system = System(U=("-0.2*x - z1 + cos(2*z3)", "-0.4*y - 2*z2 + sin(2*z3)"), W=("x", "y", "1"))
    found = periodic_motion(system, (0.3, -0.1, 0.2, 0.1, 0.0), math.pi, psi.constant(), eps)
    q, p = 1.0 / complex(-3.0, 0.4), -1j / complex(-2.0, 0.8)
    np.testing.assert_allclose(found.state0, [(2j * q).real, (2j * p).real, q.real, p.real, 0.0], atol=1e-9)
    rates = [*np.roots([1.0, 0.2, 1.0]), *np.roots([1.0, 0.4, 2.0])]
    close(found, np.exp(np.array(rates) * math.pi))
    assert (found.stability, keys(found)) == ("stable", ["repeats", "periodic stable"])
    assert found.forced
    assert found.period == math.pi
    assert found.residual < 1e-9


@settings(max_examples=8, deadline=None)
@given(
    st.floats(0.05, 0.6), st.floats(-0.5, 0.5), st.floats(0.7, 2.0), st.floats(0.3, 3.0), st.sampled_from([0.0, 0.2])
)
def test_it_goes_round_with_a_push_that_goes_round(mu, d, F, w, eps):
    assume(abs(1.0 - w) > 0.05)
    exact = Rotating(mu, d, F, w, eps)
    assume(exact.speed > 0.05)
    system = CIRCLE.evolve(mu=mu, d=d, F=F, w=w)
    start = np.array(exact.start)
    start[[0, 3]] += [0.01 * exact.speed, -0.01 * exact.speed]
    found = periodic_motion(system, start, math.tau / w, psi.constant(), eps)
    assert found.found
    np.testing.assert_allclose(found.state0, exact.start, rtol=0.0, atol=1e-7 + 10.0 * found.error.max())
    close(found, exact.multipliers)
    size = np.abs(exact.multipliers).max()
    if abs(size - 1.0) > 1e-6:
        assert found.stability == ("stable" if size < 1.0 else "unstable")


@pytest.mark.parametrize(("w", "eps"), [(0.3, 0.1), (0.2, 1e-3)])
def test_what_a_period_multiplies_by_1e10_is_shot_in_segments(w, eps):
    """On a hilltop: multipliers from 1e-21 to 1e10, each to its own digits."""
    exact = Rotating(0.3, 0.2, 2.0, w, eps, -1.0)
    start = np.add(exact.start, (0.01, 0.0, 0.0, 0.0, 0.0))
    found = periodic_motion(CIRCLE.evolve(d=0.2, F=2.0, w=w, k=-1.0), start, math.tau / w, psi.constant(), eps)
    assert (found.status, found.stability) == (PeriodicStatus.FOUND, "unstable")
    np.testing.assert_allclose(found.state0, exact.start, rtol=0.0, atol=1e-9)
    ours, theirs = (np.sort(np.log(np.abs(values))) for values in (found.multipliers, exact.multipliers))
    np.testing.assert_allclose(ours, theirs, atol=1e-5)
    np.testing.assert_allclose(np.abs(found.multipliers[:2]), np.abs(exact.multipliers).max(), rtol=1e-8)


@pytest.mark.parametrize(("mu", "F", "w"), [(0.1, 1.0, 0.6), (0.3, 1.2, 0.75)])
def test_den_hartogs_motion_in_its_line_and_in_the_plane(mu, F, w):
    exact = DenHartog(mu, F, w)
    speed, q = exact.at_clock(0.0)
    change = {"mu": mu, "F": F, "w": w}
    line = periodic_motion(LINE.evolve(**change), (speed + 0.01, 0.0, q, 0.0), math.tau / w)
    np.testing.assert_allclose(line.state0, [speed, 0.0, q, 0.0], atol=1e-9)
    # The line repels as the motion arrives, and yet of what is across nothing is left once it has passed.
    close(line, [*exact.multipliers, 0.0])
    assert (line.stability, keys(line)) == ("stable", ["repeats", "start is lost", "periodic stable"])
    plane = periodic_motion(PLANE.evolve(**change), (speed, 0.0, q - 0.01, 0.0, 0.0), math.tau / w)
    np.testing.assert_allclose(plane.state0, [speed, 0.0, q, 0.0, 0.0], atol=1e-9)
    assert plane.state0[[1, 3]].tolist() == [0.0, 0.0]  # it stays in the line y = z2 = 0
    # z2 across is not lost: its multiplier is the limit of quotients of differences, y between passes being forgotten
    system, period = PLANE.evolve(**change), math.tau / w
    first = next(phase.t_start for phase in plane.run.phases if phase.kind == "cross")
    start = plane.run.dense(first + 0.2)
    ends = [
        simulate_nonsmooth(system, start + h * np.eye(5)[3], (0.0, period), rtol=1e-12, atol=1e-18).states[-1, 3] / h
        for h in (1e-4, 1e-5, 1e-6)
    ]
    across = ends[2] - (ends[2] - ends[1]) ** 2 / (ends[2] - 2.0 * ends[1] + ends[0])  # Aitken: they come as a power
    last = plane.run.variation().last
    (lost,) = (one for one in plane.multipliers.tolist() if one == 0.0)
    (kept,) = (one for one in plane.multipliers.tolist() if one.imag == 0.0 and one != 0.0)
    close(plane, [*exact.multipliers, kept, lost])
    shifted = periodic_motion(system.evolve(), start, period).run.variation().last
    assert shifted[3, 3] == pytest.approx(across, abs=1e-4)
    assert kept.real == pytest.approx(np.trace(last[np.ix_([1, 3], [1, 3])]), abs=1e-9)  # the other is 0


def test_friction_that_drives_across_leaves_it_undecided():
    """Then a small angle next to the line grows faster than any multiple, and no derivative exists."""
    exact, system = DenHartog(0.1, 1.0, 0.6), System(
        U=("-z1 - mu*c + F*cos(w*z2)", "mu*s"), W=("x", "1"), parameters={"mu": 0.1, "F": 1.0, "w": 0.6}
    )  # fmt: skip
    speed, q = exact.at_clock(0.0)
    found = periodic_motion(system, (speed + 0.01, 0.0, q, 0.0), math.tau / 0.6)
    close(found, exact.multipliers)
    assert (found.stability, keys(found)) == ("undecided", ["repeats", "periodic next to a line"])


def test_a_start_that_begins_with_no_speed_has_no_derivative():
    """Leine's block at the end of its stick: told, and no warning of a division by zero."""
    block = System(U=("-z1 - c/(1 + 3*abs(x))", "-s"), W=("x + 0.2",))
    assert periodic_motion(block, (0.0, 0.0, 1.0), 12.0).status is PeriodicStatus.NO_DERIVATIVE


@settings(max_examples=2, deadline=None)
@given(st.floats(0.2, 0.45), st.floats(0.5, 0.9), st.floats(0.1, 0.8), st.floats(0.0, 1.5))
def test_through_stops_it_returns_and_its_multipliers_are_those_of_differences(mu, F, G, phase):
    system = System(
        U=("-z1 - mu*c - 0.05*x + F*cos(z3)", "-2*z2 - mu*s - 0.05*y + G*cos(z3 + phase)"), W=("x", "y", "0.5"),
        parameters={"mu": mu, "F": F, "G": G, "phase": phase},
    )  # fmt: skip
    period = 2.0 * math.tau
    found = periodic_motion(system, (0.1, 0.1, 0.3, 0.1, 0.0), period)
    assume(found.found)
    np.testing.assert_allclose(found.run.states[-1][:4], found.state0[:4], rtol=0.0, atol=1e-8)
    kinds = {phase.kind for phase in found.run.phases}
    assert ("start is lost" in keys(found)) == (kinds != {"slip"})
    if "slide" not in kinds:
        return
    assert np.count_nonzero(found.multipliers == 0.0) >= 2
    slide = next(phase for phase in found.run.phases if phase.kind == "slide")
    assume(slide.t_end - slide.t_start > 0.05)
    # From the middle of the slide on: z by z.
    first = found.run.dense(0.5 * (slide.t_start + slide.t_end))
    end = lambda h: simulate_nonsmooth(system, first + h, (0.0, period), rtol=1e-12, atol=1e-13).states[-1][2:4]
    by = [(end(h) - end(-h)) / 2e-6 for h in 1e-6 * np.eye(5)[2:4]]
    expected = [*np.linalg.eigvals(np.transpose(by)), 0.0, 0.0]
    assert matching_distances(found.multipliers, np.array(expected, complex)).max() < 1e-4


def test_a_multiple_of_the_period_is_told():
    exact = Rotating(0.3, 0.0, 0.5, 2.0)
    found = periodic_motion(CIRCLE, exact.start, math.tau)
    assert keys(found) == ["repeats", "repeats sooner", "periodic stable"]
    assert dict(recognise(found.reason))["repeats sooner"]["count"] == "2"
    close(found, exact.multipliers**2)


@pytest.mark.parametrize(
    ("w", "where", "status"), [(2.0, "−1", "FOUND"), (3.0, "on the unit circle", "FOUND"), (0.5, "+1", "NOT_ISOLATED")]
)
def test_without_friction_nothing_is_decided(w, where, status):
    # q'' + q = cos(wt): multipliers exp(+-2 pi i/w), and for w = 1/2 every motion is periodic
    system = System(U=("-z1 + cos(w*z3)", "-z2 + 2*sin(w*z3)"), W=("x", "y", "1"), parameters={"w": w})
    q = 1.0 / (1.0 - w * w)
    found = periodic_motion(system, (0.1, 2.0 * w * q, q + 0.1, 0.0, 0.0), math.tau / w)
    assert found.status is PeriodicStatus[status]
    assert found.stability == "undecided"
    assert dict(recognise(found.reason))["periodic undecided"]["where"] == where
    assert ("not isolated" in keys(found)) == (status == "NOT_ISOLATED")
    np.testing.assert_allclose(np.abs(found.multipliers), 1.0, atol=1e-7)


def test_what_sticks_all_the_time_is_one_of_a_family():
    found = periodic_motion(CIRCLE.evolve(F=0.1), (0.0, 0.0, 0.0, -0.1, 0.0), math.pi)
    assert found.status is PeriodicStatus.NOT_ISOLATED
    assert keys(found) == ["repeats", "start is lost", "periodic undecided", "not isolated"]
    assert found.multipliers.tolist() == [1.0, 1.0, 0.0, 0.0]


@pytest.mark.parametrize("z", [0.0, 0.1, 0.15])
def test_a_slide_of_several_phases_that_ends_the_period(z):
    """A load that is switched off at 1.3 ends one slide and begins another: the block rests where it is held."""
    system = System(U=("-c - 0.2*x + 1.616*(mod(t, 2*pi) < 1.3) - 5.966*z1", "-s"), W=("x",))
    found = periodic_motion(system, (0.0, 0.0, z), 2.0 * math.pi, psi.constant(), None)
    assert found.found
    assert (1.616 - 1.0) / 5.966 - 1e-9 <= found.state0[2] <= 1.0 / 5.966 + 1e-9
