"""Past a Hopf bifurcation the motion stays: way in = way out, and the buffer point, by closed forms and `simulate`."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.optimize import brentq

from codim2_core import Event, SimulationStatus, System, delays, simulate, simulate_nonsmooth
from codim2_core.systems.psi import constructors as families

PSI = families.constant()  # D e_Psi = 1 in the middle; at |e| = r, sqrt(1 - r^2) across and (1 - r^2)^1.5 along e


def turning(w, at="0", rate="1", more=""):
    """U = (z + i w)(e - e_C) with C at e = (at, 0): in the middle the eigenvalues of J are z ± i w."""
    return System(U=(f"z*(c - {at}) - {w}*s{more}", f"{w}*(c - {at}) + z*s"), W=(rate,))


def followed(system, z0, end=10.0, psi=PSI, **options):
    """Start on Sigma, slide on C."""
    return simulate_nonsmooth(system, (0.0, 0.0, z0), (0.0, end), psi, **options)


@settings(max_examples=2)
@given(st.floats(-1.2, -0.1), st.floats(0.05, 3.0), st.floats(0.05, 0.5), st.sampled_from([1, -1]))
def test_way_in_is_way_out_where_the_set_stays(z0, w, size, sign):
    """``G = int z dz/(1 + k z)`` has a closed form, and C in the middle is a motion for every eps."""
    k = sign * size
    run = followed(turning(w, rate=f"1 + ({k!r})*z"), z0)
    G = lambda z: z / k - math.log1p(k * z) / k**2
    slow = brentq(lambda z: G(z) - G(z0), 1e-3, 20.0 if k > 0.0 else -(1.0 - 1e-9) / k)
    assert [phase.kind for phase in run.phases[:2]] == ["slide", "slide"]
    assert run.dense(run.phases[0].t_end)[2] == pytest.approx(0.0, abs=1e-9)
    assert run.dense(run.phases[1].t_end)[2] == pytest.approx(slow, abs=1e-8)
    assert "way in = way out" in run.phases[1].reason


def test_its_phase_knows_where_the_motion_came_where_the_hopf_is_and_where_it_left():
    """z' = 1 from z = -0.7: Hopf at 0, way out at 0.7; on the way z' = 1 and e = 0."""
    phase = (run := followed(turning(0.5), -0.7)).phases[1]
    delay = phase.delay
    assert [other.delay for other in run.phases if other is not phase] == [None] * (len(run.phases) - 1)
    assert (delay.onto, delay.buffer) == ("C", None)
    assert (delay.t_in, delay.t_hopf, delay.t_out) == (0.0, phase.t_start, phase.t_end)
    np.testing.assert_allclose([*delay.z_in, *delay.z_hopf, *delay.z_out], [-0.7, 0.0, 0.7], atol=1e-9)
    np.testing.assert_allclose(delay.z[:, 0], np.linspace(0.0, 0.7, len(delay.z)), atol=1e-9)
    np.testing.assert_allclose(delay.flow, 1.0)
    np.testing.assert_allclose(delay.e, 0.0, atol=1e-15)
    assert delay.reason == phase.reason
    assert not delay.z.flags.writeable


def test_its_phase_names_the_buffer_point_and_what_ends_before_is_not_left():
    run = followed(turning(0.5, "0.3*z"), -1.3, 4.0)
    assert run.phases[1].delay.buffer.imag == pytest.approx(0.5, rel=1e-3)  # det J = 0 at z = ± i w; t = z + 1.3
    assert run.phases[1].delay.buffer.real == pytest.approx(1.3, abs=1e-3)
    events = (Event(lambda _t, y: y[2] - 0.4, terminal=True),)
    for cut in (followed(turning(0.5), -1.0, 1.4), followed(turning(0.5), -1.0, events=events)):
        delay = cut.phases[1].delay
        assert (delay.t_out, delay.z_out, delay.buffer) == (None, None, None)
        assert delay.z[-1] == pytest.approx(0.4, abs=1e-9)


def complex_growth(w, step):
    """Eigenvalues of J of the turning system with C at e = (step z, 0), for complex z, by hand."""

    def eigenvalue(z):
        gap = 1.0 - (step * z) ** 2
        along, across = gap**1.5, gap**0.5
        half, det = 0.5 * z * (along + across), (z**2 + w**2) * along * across
        return half, np.sqrt(det - half**2 + 0j)

    def rate(z):
        half, turn = eigenvalue(z)
        return float((half + np.abs(turn.imag)).real)

    return eigenvalue, rate


@settings(max_examples=2)
@given(st.floats(0.2, 0.7), st.floats(0.02, 0.3))
@example(0.5, 0.3)
def test_a_set_that_moves_is_left_at_the_buffer_point(w, step):
    """det J = 0 at z = ± i w: what is left behind there comes up before way in = way out."""
    z0 = -1.3
    run = followed(turning(w, f"{step!r}*z"), z0, 4.0)
    eigenvalue, rate = complex_growth(w, step)

    def falling(y):
        half, turn = eigenvalue(1j * y)
        return -(half - 1j * turn * math.copysign(1.0, turn.real)).imag

    height = quad(falling, 0.0, w)[0]
    slow = brentq(lambda z: quad(rate, 0.0, z)[0] - height, 1e-3, 2.5)
    assert height == pytest.approx(0.5 * w**2, rel=0.2)
    assert run.dense(run.phases[1].t_end)[2] == pytest.approx(slow, abs=1e-6)
    assert "buffer point" in run.phases[1].reason


def left_at(system, eps, start, far, end):
    """When |e - e_C| of the regularised motion passes `far` for the last time before the end."""
    x0, z0, place = start
    run = simulate(system, PSI, (eps * x0, 0.0, z0), (0.0, end), eps=eps, rtol=1e-11, atol=1e-14)
    t = np.linspace(0.0, run.times[-1], 8001)
    x = run.dense(t)
    e = x[:, :2] / np.hypot(np.hypot(x[:, 0], x[:, 1]), eps)[:, None]
    away = np.hypot(e[:, 0] - place * x[:, 2], e[:, 1])
    return float(t[np.flatnonzero((away < far) & (t > -z0))[-1]])


def test_the_regularised_motion_tends_to_the_buffer_point():
    """Down to where rounding, 1e-16, outgrows what the turning point left behind: exp(-0.125/0.0035)."""
    system = turning(0.5, "0.3*z")
    limit = followed(system, -1.2, 4.0).phases[1].t_end
    off = [left_at(system, eps, (0.0, -1.2, 0.3), 0.05, 2.4) - limit for eps in (0.02, 0.01, 0.005)]
    assert np.abs(off).max() < 0.03
    assert abs(off[2]) < 0.2 * abs(off[0])


def test_it_stays_to_the_end_where_it_is_attracted_more_than_repelled():
    """Re lambda = -0.4 - cos t: repelled from time to time, for ever attracted on the whole."""
    system = System(U=("(-0.4 - cos(z))*c - s", "c + (-0.4 - cos(z))*s"), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, 20.0), PSI)
    assert run.status is SimulationStatus.T_END
    assert [phase.kind for phase in run.phases] == ["slide", "slide"]
    assert run.phases[1].t_start == pytest.approx(math.acos(-0.4), abs=1e-8)
    # with less attraction it leaves where 0.1 t + sin t = 0 for the second time, and not in between
    system = System(U=("(-0.1 - cos(z))*c - s", "c + (-0.1 - cos(z))*s"), W=("1",))
    run = simulate_nonsmooth(system, (0.0, 0.0, 0.0), (0.0, 20.0), PSI)
    left = brentq(lambda t: -0.1 * t - math.sin(t), 3.2, 4.7)
    assert run.phases[1].t_end == pytest.approx(left, abs=1e-8)


def test_without_psi_and_with_a_kink_it_stops_and_says_so():
    bare = simulate_nonsmooth(turning(0.5), (0.0, 0.0, -1.0), (0.0, 2.0))
    assert bare.status is SimulationStatus.NOT_UNIQUE
    assert "depends on Ψ: give it" in bare.reason
    kink = followed(turning("(0.5 + abs(z + 0.3))", "0.3*z"), -1.0)
    assert kink.status is SimulationStatus.NOT_UNIQUE
    assert "not smooth in time" in kink.reason


def test_ahead_of_a_motion_that_comes_at_z_lies_the_delay_of_the_motion_itself():
    """Two slow variables, a set that moves; the motion from Sigma at z is another way to it."""
    system = System(U=("z*(c - 0.2*z2) - 0.4*s", "0.4*(c - 0.2*z2) + z*s"), W=("1 + 0.2*z2", "-0.3*z"))
    start = (-0.6, 0.5)
    [ahead] = delays(system, PSI, start, {"z1": (-1.0, 2.0), "z2": (-1.0, 1.0)})
    run = simulate_nonsmooth(system, (0.0, 0.0, *start), (0.0, 3.0), PSI)
    assert run.phases[0].kind == "slide"
    told = run.phases[1].delay
    assert (ahead.onto, ahead.reason) == (told.onto, told.reason)
    for name in ("z_in", "z_hopf", "z_out", "t_hopf", "t_out"):
        np.testing.assert_allclose(getattr(ahead, name), getattr(told, name), atol=1e-8)


@pytest.mark.parametrize(
    ("start", "span", "left"),
    [(-0.6, (-1, 1), 0.6), (-0.6, (-1, 0.4), None), (-0.6, (-1, -0.1), "none"), (0.3, (-1, 1), "none")],
)
def test_ahead_it_is_looked_as_far_as_the_ranges(start, span, left):
    """As far as z = 0.4 it is not left; before z = 0 there is no Hopf point, and after it no set that attracts."""
    found = delays(turning(0.5), PSI, (start,), {"z1": span})
    if left == "none":
        assert found == ()
        return
    [delay] = found
    if left is None:
        assert delay.z_out is None
        assert delay.z[-1, 0] == pytest.approx(0.4)
        assert "to the end of the range" in delay.reason
    else:
        assert delay.z_out[0] == pytest.approx(left, abs=1e-9)
