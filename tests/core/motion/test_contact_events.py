"""Contacts that open or jam: a rod in three dimensions by its equations of motion, Painlevé's paradox by a formula."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core import psi
from codim2_core.systems.mechanics import Mechanism

from ...words.recognition import recognise

G = 9.81


def rod(mu):
    """A rod of mass 1 and half length 1, its end on the ground, at height th of its angle and azimuth ps."""
    return Mechanism(
        M=((1, 0, 0, 0, 0), (0, 1, 0, 0, 0), (0, 0, 1, 0, 0), (0, 0, 0, "1/3", 0), (0, 0, 0, 0, "cos(th)**2/3")),
        J=((1, 0, 0, "sin(th)*cos(ps)", "cos(th)*sin(ps)"), (0, 1, 0, "sin(th)*sin(ps)", "-cos(th)*cos(ps)")),
        normal=(0, 0, 1, "-cos(th)", 0), mu=mu,
        force=(0, 0, -G, "-cos(th)*sin(th)*wp**2/3", "2*cos(th)*sin(th)*wt*wp/3"),
        velocities=("vx", "vy", "vz", "wt", "wp"), slow=("wt", "wp", "th", "ps"), rates={"th": "wt", "ps": "wp"},
    )  # fmt: skip


@settings(max_examples=20)
@given(st.floats(0.1, 1.5), st.floats(0.0, 6.28), st.floats(0.0, 6.28), st.floats(0.1, 3.0), st.floats(-6.0, 6.0))
def test_painleves_paradox_is_told_by_its_formula(th, ps, direction, mu, wt):
    """p = 1 + 3 cos th (cos th + mu sin th cos(direction - ps)), b = g - sin th wt^2: four kinds by their signs."""
    b = G - math.sin(th) * wt**2
    p = 1.0 + 3.0 * math.cos(th) * (math.cos(th) + mu * math.sin(th) * math.cos(direction - ps))
    found = rod(mu).contact_force((math.cos(direction), math.sin(direction), wt, 0.0, th, ps))
    assert (found.approach, found.gain) == pytest.approx((b, p), rel=1e-9, abs=1e-9)
    expected = {(True, True): "presses", (False, True): "opens", (True, False): "jams", (False, False): "not unique"}
    assert found.kind == expected[b > 0.0, p > 0.0]
    assert [key for key, _ in recognise(found.sentence)] == [f"contact {found.kind}"]
    if p > 0.0:
        assert found.normal == pytest.approx(max(b / p, 0.0))
    else:
        assert math.isnan(found.normal)


@pytest.mark.parametrize(("th", "key"), [(1.1, "contact jams")])
def test_a_start_where_the_contact_does_not_press_is_refused(th, key):
    mechanism = rod(3.0)
    start = (-1.0, 0.0, 0.0, 0.0, th, 0.0)
    assert [one for one, _ in recognise(mechanism.contact_force(start).sentence)] == [key]
    with pytest.raises(ValueError, match="does not press"):
        c2.contact_events(mechanism, start)


def block(normal, mu=0.2, **more):
    return Mechanism(
        M=np.eye(2), J=np.eye(2), force=("-q", 0), mu=mu, normal=normal, velocities=("vx", "vy"), slow=("q",),
        rates={"q": "vx"}, **more,
    )  # fmt: skip


def test_a_block_that_sticks_slips_and_opens():
    """On a belt of speed 0.6 it slips where q = 3 (1 - q), then q = 0.75 + 0.3 sin 2t, until nothing presses: q = 1."""
    mechanism = block("1 - q", mu=3.0, surface=(0.6, 0.0))
    start = mechanism.state(vx=0.6, vy=0.0, q=0.0)
    run = c2.simulate_nonsmooth(mechanism.system, start, (0.0, 9.0), events=c2.contact_events(mechanism, start))
    assert [phase.kind for phase in run.phases] == ["slide", "slip"]
    assert run.phases[0].t_end == pytest.approx(0.75 / 0.6, abs=1e-9)
    assert run.times[-1] == pytest.approx(0.75 / 0.6 + math.asin(0.25 / 0.3) / 2.0, abs=1e-7)
    assert [key for key, _ in recognise(run.reason)] == ["at an event", "contact opens"]


def test_a_state_of_another_length_is_refused():
    with pytest.raises(ValueError, match=r"shape \(2,\); give \(x, y, z1, ..., zm\) with m = 1"):
        block(1).contact_force((1.0, 2.0))


def leaning_rod(inertia, length, mu, stiffness, angle):
    """A rod whose end slides on the ground, turned by a spring about an axis along the second direction."""
    return Mechanism(
        M=np.diag((1, 1, 1, inertia)).tolist(), J=((1, 0, 0, f"-{length}*cos(phi)"), (0, 1, 0, 0)),
        force=(0, 0, -G, f"-{stiffness}*(phi - {angle})"), mu=mu, normal=(0, 0, 1, f"{length}*sin(phi)"),
        velocities=("vx", "vy", "vz", "w"), slow=("w", "phi"), rates={"phi": "w"},
    )  # fmt: skip


JAMMED = leaning_rod(0.031, 0.4646, 1.2537, 18.2639, 0.2959), (-4.8354, -8.495, -0.8737, 0.283)


@pytest.mark.parametrize("watched", [False, True])
@pytest.mark.parametrize("rounding", range(-3, 4))
def test_a_pole_that_no_orbit_meets_is_no_limit_direction(rounding, watched):
    """Along 2.5 to 3.8 friction presses the bodies together: Theta changes its sign at poles, there and back.

    Whether a pole was taken for a neutral direction, and the motion ended there, depended on rounding. By SciPy's
    Radau, run once, the rod slides for eps = 1e-5, with the same turn.
    """
    mechanism, start = JAMMED
    start = tuple(v * (1.0 + 1e-13 * rounding) for v in start)
    events = c2.contact_events(mechanism, start) if watched else ()
    run = c2.simulate_nonsmooth(mechanism.system, start, (0.0, 3.0), events=events)
    assert run.status is c2.SimulationStatus.T_END
    assert [phase.kind for phase in run.phases] == ["slip", "slide"]
    assert run.phases[0].t_end == pytest.approx(0.82269, abs=1e-5)
    assert run.states[-1, 2:] == pytest.approx([-1.0799016, 0.5480462], abs=1e-4)


@pytest.mark.parametrize("seed", range(12))
def test_a_rod_ends_as_its_equations_of_motion_say_or_the_jam_is_named(seed):
    """Friction ``-N mu x/sqrt(x^2 + eps^2)`` by SciPy: where it opens or goes on to the end, and where p is 0."""
    rng, eps = np.random.default_rng(seed), 1e-5
    inertia, length, mu, k, angle, phi = np.round(rng.uniform(*np.transpose(
        [(0.01, 0.06), (0.3, 0.6), (0.5, 1.8), (2.0, 30.0), (0.1, 1.2), (0.1, 1.2)]
    )), 3).tolist()  # fmt: skip
    mechanism = leaning_rod(inertia, length, mu, k, angle)
    start = (*np.round(rng.normal(size=3) * (4.0, 4.0, 0.7), 3).tolist(), phi)
    if mechanism.contact_force(start).kind != "presses":
        return

    def parts(s):
        x, y, w, now = s
        J = np.array([[1.0, 0.0, 0.0, -length * math.cos(now)], [0.0, 1.0, 0.0, 0.0]])
        across = np.array([0.0, 0.0, 1.0, length * math.sin(now)])
        push = across - mu * np.array([x, y]) / math.sqrt(x * x + y * y + eps * eps) @ J
        free = np.array([0.0, 0.0, -G, -k * (now - angle) / inertia])
        bent = push / np.array([1.0, 1.0, 1.0, inertia])
        return J, free, bent, across @ bent, -(across @ free + length * math.cos(now) * w * w)

    def rate(_, s):
        J, free, bent, p, b = parts(s)
        v = free + b / p * bent
        return [J[0] @ v + length * math.sin(s[3]) * s[2] ** 2, v[1], v[3], s[2]]

    opens, jams = (lambda _, s: parts(s)[4]), (lambda _, s: parts(s)[3] - 1e-3)
    opens.terminal = jams.terminal = True
    own = solve_ivp(rate, (0.0, 2.0), start, "Radau", rtol=1e-9, atol=1e-12, events=(opens, jams))
    run = c2.simulate_nonsmooth(mechanism.system, start, (0.0, 2.0), events=c2.contact_events(mechanism, start))
    named = [key for key, _ in recognise(run.reason)]
    if "pole on the hemisphere" in named:
        return
    assert run.times[-1] == pytest.approx(own.t[-1], abs=1e-3)
    assert (named == ["end of span"]) == (own.status == 0)
    events = c2.contact_events(mechanism, start, psi.constant(), eps)
    creeping = c2.simulate(mechanism.system, psi.constant(), start, (0.0, 2.0), eps=eps, events=events)
    assert creeping.times[-1] == pytest.approx(own.t[-1], abs=1e-3)
    assert creeping.status is run.status


def test_events_of_a_regularised_contact_have_the_friction_of_a_regularised_contact():
    """A slip of eps at rest has e_Psi inside the circle: the rod sticks, and its normal force presses to the end."""
    mechanism, start = JAMMED
    events = c2.contact_events(mechanism, start, psi.constant(), 1e-4)
    run = c2.simulate(mechanism.system, psi.constant(), start, (0.0, 3.0), eps=1e-4, events=events)
    assert run.status is c2.SimulationStatus.T_END
    with pytest.raises(ValueError, match="give both"):
        c2.contact_events(mechanism, start, psi.constant())
