"""Slides on followed sets and slips to Sigma, where both are known in closed form."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

import codim2_core as c2

from ...words.recognition import recognise

CONSTANT = c2.psi.constant()
NODES = c2.System(U=("-c*(c - 1/2)*(c + 1/2)", "-s"))  # a saddle in the middle, between two nodes


def followed_both_ways(system, state0, t_end):
    """Follow a motion by itself, in Python unless it is compiled by now, and eight at once, compiled."""
    yield c2.simulate_nonsmooth(system, state0, (0.0, t_end), CONSTANT)
    yield c2.simulate_nonsmooth(system, [state0] * 8, (0.0, t_end), CONSTANT)[0]


@pytest.mark.parametrize("gap", [0.006, 0.002, 2e-4])
def test_a_slide_does_not_step_over_a_gap_in_which_there_is_no_set(gap):
    """C at c = -sqrt(-z) folds at z = 0, and from about z = gap on there is another one, at c = 1 - sqrt(1 - z)."""
    system = c2.System(U=(f"z + c**2 - (1 + tanh({20 / gap}*(z - {gap})))*c", "-s"), W=("1",))
    for run in followed_both_ways(system, (-1e-3, 0.0, -0.09), 1.0):
        slide = run.phases[1]
        assert slide.kind == "slide"
        assert slide.t_end == pytest.approx(0.09, abs=1e-9)
        assert slide.e(slide.t_end) == pytest.approx([0.0, 0.0], abs=1e-4)


@pytest.mark.parametrize("eps", [0.0, 1e-3, 1e-7])
def test_a_slip_does_not_step_over_sigma_where_the_field_is_the_same_on_both_sides(eps):
    """U = z - c^2, z' = -1, from z = 1/2 in a line: x' = -1/2 - t comes to Sigma, and C at c = sqrt(z) attracts."""
    system = c2.System(U=("z - c**2", "-s"), W=("-1",))
    for x in (0.3, 0.1):
        arrives = (math.sqrt(1.0 + 8.0 * x) - 1.0) / 2.0
        for count in (1, 8):
            states = [(x, 0.0, 0.5)] * count
            if eps:
                run = c2.simulate(system, CONSTANT, states, (0.0, 0.48), eps=eps)[0]
            else:
                run = c2.simulate_nonsmooth(system, states, (0.0, 0.48), CONSTANT)[0]
            assert [phase.kind for phase in run.phases] == ["slip", "slide"], (x, count)
            assert run.phases[1].t_start == pytest.approx(arrives, abs=20.0 * eps + 1e-9)


@pytest.mark.parametrize(("height", "rate"), [(1.5, 1.0), (1.01, 10.0), (1.0001, 1.0), (1.0000001, 1.0)])
def test_a_slide_ends_where_the_set_is_outside_for_part_of_a_step(height, rate):
    """c = height sin(rate z), z' = 1: beyond the equator for a short while, which one step of z spans."""
    system = c2.System(U=(f"-c + {height}*sin({rate}*z)", "-s"), W=("1",))
    for run in followed_both_ways(system, (0.0, 0.0, 0.0), 3.0 / rate):
        assert [phase.kind for phase in run.phases][:2] == ["slide", "slip"]
        assert run.phases[0].t_end == pytest.approx(math.asin(1.0 / height) / rate, abs=1e-9)


@pytest.mark.parametrize(("w", "q"), [(0.3, 1.3), (0.35, 0.9), (0.3, 0.9)])
def test_a_slide_ends_where_its_set_is_at_the_equator_however_long_its_steps_are(w, q):
    """q'' + q = cos(w t) - 0.1 q'/|q'|: it stands while |cos(w t) - q| < 0.1, and nothing limits a step meanwhile."""
    system = c2.System(U=("-z1 - mu*c + cos(w*z2)", "-mu*s"), W=("x", "1"), parameters={"mu": 0.1, "w": w})
    for motion in c2.simulate_nonsmooth(system, [(0.3, 0.0, q, 0.0)] * 8, (0.0, 4 * math.pi / w), rtol=1e-6):
        assert motion.status is c2.SimulationStatus.T_END
        ends = [phase.t_end for phase in motion.phases if phase.kind == "slide" and phase.t_end < motion.times[-1]]
        off = [abs(math.cos(w * t) - motion.states[np.searchsorted(motion.times, t)][2]) for t in ends]
        assert ends
        assert off == pytest.approx([0.1] * len(ends), abs=1e-9)


@pytest.mark.parametrize("psi", [CONSTANT, c2.psi.rational(), c2.psi.tanh()], ids=str)
def test_on_a_cycle_it_slides_with_the_mean_in_time(psi):
    """On |e|^2 = 1/5 + z2, turning at the rate 2 + c, the mean of c is sqrt(4 - |e|^2) - 2, whatever Psi."""
    radial = "(1/5 + z2 - c^2 - s^2)"
    system = c2.System(U=(f"c*{radial} - s*(2 + c)", f"s*{radial} + c*(2 + c)"), W=("c", "0.2"))
    run = c2.simulate_nonsmooth(system, (0.1, 0.0, 0.0, 0.1), (0.0, 1.0), psi)
    slide = run.phases[-1]
    assert slide.onto == "cycle 1"
    z0 = run.dense(slide.t_start)
    mean = lambda z2: math.sqrt(3.8 - z2) - 2.0
    moved = quad(lambda t: mean(z0[3] + 0.2 * t), 0.0, 1.0 - slide.t_start)[0]
    assert run.states[-1] == pytest.approx([0.0, 0.0, z0[2] + moved, z0[3] + 0.2 * (1.0 - slide.t_start)], abs=1e-5)
    assert slide.e(1.0) == pytest.approx([mean(run.states[-1, 3]), 0.0], abs=1e-4)
    q = math.sqrt(0.2 + run.states[-1, 3])
    zeta = float(psi.radius(q))
    assert slide.p(1.0) == pytest.approx([mean(run.states[-1, 3]) / q * zeta / math.hypot(1.0, zeta), 0.0], abs=1e-4)


@pytest.mark.slow
def test_a_slide_on_a_cycle_ends_where_the_cycle_does():
    """Circles |e|^2 = q with z + 4q/5 - 2q^2 = 0: two meet at z = -2/25, about C, which attracts; z = q leaves at 1."""
    r2 = "(c**2 + s**2)"
    folds = [f"({n}*({r2}*4/5 - 2*{r2}**2 + z))" for n in "cs"]
    system = c2.System(U=(f"{folds[0]} - s", f"{folds[1]} + c"), W=("-1",))
    run = c2.simulate_nonsmooth(system, (0.1, 0.0, 0.05), (0.0, 0.5), CONSTANT)
    assert [phase.onto for phase in run.phases] == [None, "cycle 2", "C"]
    assert run.phases[1].t_end == pytest.approx(0.13, abs=1e-6)
    assert [key for key, _ in recognise(run.phases[2].reason)] == ["cycle ends", "slides"]
    leaves = c2.System(U=(f"c*(z - {r2}) - s", f"s*(z - {r2}) + c"), W=("1",))
    run = c2.simulate_nonsmooth(leaves, (0.1, 0.0, 0.2), (0.0, 1.5), CONSTANT)
    assert run.times[-1] == pytest.approx(0.8, abs=1e-5)
    assert "cycle ends" in [key for key, _ in recognise(run.reason)]


def on_the_equator(theta):
    return c2.System(U=(f"({math.cos(theta)!r}) - c", f"({math.sin(theta)!r}) - s"))


@pytest.mark.parametrize(
    ("system", "psi", "phases", "told"),
    [
        (NODES, CONSTANT, [("slide", "C2")], "does not attract"),
        (NODES, None, [], "2 stable"),
        (
            c2.System(U=("c - s - 2*c*(c**2 + s**2)", "c + s - 2*s*(c**2 + s**2)"), W=("1",)),
            CONSTANT,
            [("slide", "C")],
            "does not attract",
        ),
        (c2.ELinear(-1.0, 0.0, -2.0, (0.3, 0.2)), CONSTANT, [("slide", "C")], ""),
        (c2.ELinear(-1.0, 0.0, -2.0, (0.3, 0.2)), None, [("slide", "C")], ""),
        (c2.ELinear(-1.0, 0.0, -2.0, (3.0, 0.0)), CONSTANT, [("slip", None)], ""),
        (c2.ELinear(-1.0, 0.1, -2.0, (3.0, 0.2)), None, [("slip", None)], "Q₁"),
        (c2.ELinear(1.0, 0.0, -1.0), None, [], "2 directions lead"),
        (c2.System(U=("c**2 - 1/8 + s/9", "-2*s + c/9")), None, [("slide", "C1")], "Q₁ leads away"),
        (c2.System(U=("c*(c - 1/2)*(c + 1/2)", "-s")), CONSTANT, [("slide", "C2")], ""),
        *((on_the_equator(theta), psi, [("slide", "C")], "") for theta in (0.0, 2.0) for psi in (None, CONSTANT)),
    ],
)
def test_what_follows_a_start_on_sigma(system, psi, phases, told):
    run = c2.simulate_nonsmooth(system, np.zeros(2 + system.m), (0.0, 0.1), psi)
    assert [(phase.kind, phase.onto) for phase in run.phases] == phases
    assert told in (run.phases[0].reason if phases else run.reason)
