"""Launched orbits: where they go and come from, against what is known exactly and against other ways to ask."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

import codim2_core as c2
from codim2_core.layer_problem.hemisphere import outside_flow
from codim2_core.orbits.result import Status
from codim2_core.portrait.endings import Ending
from codim2_core.scene import launched as module

PSI = c2.psi.constant()


def launch(system, psi, seeds, z=()):
    return c2.Scene(system, psi, z, launch=seeds)["launched"]


@settings(max_examples=20)
@given(st.floats(-3, -0.2), st.floats(-1, 1), st.floats(0, 6.28), st.floats(0.01, 0.9))
def test_without_force_the_time_to_sigma_is_known(a, b, theta, rho):
    """With f = 0 and a = d: rho' = a along every orbit, straight or spiralling."""
    assume(abs(b) > 1e-3)
    turns = abs(b / a) * 40  # how far it winds within the capture distance, in radians
    assume(turns * (1 + rho) < 30)
    (fate,) = launch(c2.ELinear(a, b, a), PSI, [[(1 + rho) * math.cos(theta), (1 + rho) * math.sin(theta)]]).goes
    assert fate.label == "equator"
    assert fate.onto == "C"
    assert fate.after == pytest.approx(rho / -a, rel=2e-3)
    assert "spiral" in fate.sentence


def test_the_ball_without_viscosity_stops_slipping_when_it_must():
    """2 v/(7 mu g) for a slip velocity v: here rho = 0.8, in the direction of the slip."""
    ball = c2.examples.ball_in_pool(mu=0.2, m=1.0, K=1.0, g=9.81)
    (fate,) = launch(ball, PSI, [[-1.8, 0.0]], z=(1e-9, 0.0)).goes
    assert fate.after == pytest.approx(2 * 0.8 / (7 * 0.2 * 9.81), rel=1e-3)
    assert fate.onto == "C"


def test_words_of_an_orbit_from_outside_that_slides():
    (fate,) = launch(c2.ELinear(-2, 0, -1, (-0.5, 0)), PSI, [[1.5, 0.3]]).goes
    assert fate.sentence == f"Reaches Σ along Q₂, θ = 2.094, after t = {fate.after:.3g}. It slides on C."
    moved = c2.simulate_nonsmooth(c2.ELinear(-2, 0, -1, (-0.5, 0)), _outside(1.5, 0.3), (0, 2), psi=PSI)
    slip = moved.phases[0]
    assert slip.kind == "slip"
    assert fate.after == pytest.approx(slip.t_end, rel=2e-3)


def _outside(x, y):
    """The state of a picture point outside the equator."""
    r = math.hypot(x, y)
    return ((r - 1) * x / r, (r - 1) * y / r)


def test_words_of_orbits_on_the_hemisphere_and_of_crossing():
    found = launch(c2.ELinear(-1, 0, -1, (1.1, 0)), PSI, [[0.2, 0.3], [-1.5, 0.1], [1.4, 0.2]])
    assert [fate.label for fate in found.goes] == ["Q1", "away", "away"]
    assert found.goes[0].sentence == "Comes down to Q₁ and leaves Σ along θ = 0."
    assert found.comes[0].sentence == "Comes up from Q₂, θ = 3.142."
    (exact,) = launch(c2.ELinear(-1, 0, -1, (1.1, 0)), PSI, [[-1.5, 0.0]]).goes
    assert (exact.label, exact.onto) == ("Q2", "Q1")
    assert "crosses" in exact.sentence


def test_an_orbit_that_winds_onto_a_limit_cycle_says_so():
    preset = c2.presets["case3-n3"]
    found = launch(preset.system, preset.psi, [preset_point(preset) + 0.01])
    assert found.goes[0].sentence == "Winds onto limit cycle 1."
    assert found.comes[0].label == "C"
    assert found.comes[0].sentence == "Comes from C, an unstable focus."


def preset_point(preset):
    return c2.critical_sets(preset.system, preset.psi)[0].p


coefficient = st.floats(-2, 2).map(lambda v: round(v, 3))


away = st.builds(lambda size, sign: sign * round(size, 3), st.floats(0.11, 2.0), st.sampled_from((-1.0, 1.0)))


@settings(max_examples=20)
@given(away, away, st.tuples(*[coefficient] * 3), st.floats(1.06, 1.8), st.floats(0.0, 2.0 * math.pi))
def test_where_an_orbit_goes_agrees_with_the_approach_outcomes(a, d, others, radius, angle):
    b, f1, f2 = others
    system = c2.ELinear(a, b, d, (f1, f2))
    rays = c2.equator_equilibria(system).theta
    if c2.classify(system, PSI).degeneracies or (len(rays) and np.abs(np.exp(1j * (rays - angle)) - 1.0).min() < 1e-12):
        return  # on a saddle's own ray, within rounding, an orbit goes nowhere for sure
    seed = radius * math.cos(angle), radius * math.sin(angle)
    (fate,) = launch(system, PSI, [seed]).goes
    if not fate.label.startswith("Q"):
        return
    outcomes = c2.approach_outcomes(system, PSI)
    assert fate.label == f"Q{outcomes.destination(angle) + 1}"
    k = int(fate.label[1:]) - 1
    assert c2.equator_equilibria(system).lambda_rho[k] < 0
    assert fate.onto == outcomes.directions[k].onto


def test_lines_run_through_their_seeds():
    seeds = np.array([[0.3, 0.2], [1.3, -0.4]])
    found = launch(c2.ELinear(-2, 0, -1, (-0.5, 0)), PSI, seeds)
    for line, times, seed in zip(found.orbits.points, found.orbits.times, seeds, strict=True):
        assert np.hypot(*(line[times == 0][0] - seed)) < 1e-12
        assert (np.diff(times) > 0).all()
    assert len(found) == 2


@pytest.mark.parametrize(
    ("verdict", "leaving", "onto", "words"),
    [
        ("slide", None, "C", "It slides on C."),
        ("cycle", None, "cycle 2", "It slides on limit cycle 2."),
        ("cross", 1.25, "Q2", "It crosses: leaves along θ = 1.25."),
        ("cross", None, "equator", "It crosses: leaves in a spiral."),
        ("undecided", None, None, "What follows is not decided."),
        ("misses", None, "C", "What follows is not decided."),
    ],
)
def test_what_follows_an_arrival(verdict, leaving, onto, words):
    said, on = module._then(SimpleNamespace(verdict=verdict, leaving=leaving, onto=onto))
    assert (said, on) == (words, None if "not decided" in words else onto)
    assert module._then(None) == ("What follows is not decided.", None)


@pytest.mark.parametrize(
    ("label", "ahead", "behind"),
    [
        ("C1", "Tends to C1, a saddle: sliding.", "Comes from C1, a saddle."),
        ("C2", "Tends to C2, an unstable node: sliding.", "Comes from C2, an unstable node."),
        ("cycle 3", "Winds onto limit cycle 3.", "Unwinds from limit cycle 3."),
        ("Q4", "Comes down to Q4 and leaves Σ along θ = 0.5.", "Comes up from Q4, θ = 0.5."),
        ("equator", "Spirals down to the equator and leaves Σ.", "Spirals up from the closed equator."),
        ("undecided", "Not followed to an end: why", "Not followed to an end: why"),
    ],
)
def test_what_is_said_of_an_orbit_on_the_hemisphere(label, ahead, behind):
    sets = (SimpleNamespace(kind="saddle"), SimpleNamespace(kind="unstable node"))
    for backward, words in ((False, ahead), (True, behind)):
        fate = module._on_hemisphere(Ending(label, 0.5, "why"), sets, backward)
        said = fate.sentence
        for i in range(1, 5):  # labels are written with lowered digits
            said = said.replace("₀₁₂₃₄"[i], str(i))
        assert (fate.label, fate.onto, fate.after, said) == (label, None, None, words)


@pytest.mark.parametrize("spiral", [False, True])
@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize(("rate", "first"), [(2.0, 0.8), (0.3, 0.1)])
def test_the_time_outside_of_an_exponential_approach_is_exact(rate, first, sign, spiral):
    """rho = first exp(-rate T): the integral over all T is first/rate, however few points are drawn."""
    at = c2.ELinear(-sign * rate, 0.0, -sign * rate).at()  # lambda_rho = -sign rate at all angles
    T = np.array([0.0, 0.3, 0.5, 1.7, 1.8])
    rho = first * np.exp(-rate * T)
    line = np.stack([1.0 + rho, 0.0 * rho], axis=-1)
    before = np.array([[9.0, 9.0]])  # another line stands before it
    drawn = SimpleNamespace(
        offsets=np.array([0, 1, 6]),
        buffer=np.concatenate([before, line]),
        clock=np.concatenate([[7.0], sign * T]),
        ends=np.array([[0.0, 0.0, 5.0], [1.0, 0.0, rho[-1]]]),
        status=(Status.ARRIVED, Status.SPIRALLED if spiral else Status.ARRIVED),
    )
    assert module._time(at, drawn, 1) == pytest.approx(first / rate, rel=1e-12)
    assert module._time(at, drawn, 0) == pytest.approx(5.0 / rate, rel=1e-12)  # nothing drawn: all of it is left
    # a point drawn where rho has lost its digits tells nothing, and none after it
    drawn.buffer[4:], drawn.ends[1, 2] = (1.0 + 3e-16, 0.0), 1e-200
    assert module._time(at, drawn, 1) == pytest.approx(first / rate, rel=1e-12)


def test_the_time_at_rest_outside_is_rho_T():
    drawn = SimpleNamespace(
        offsets=np.array([0, 3]), buffer=np.full((3, 2), (1.25, 0.0)), clock=np.array([0.0, 0.3, 1.8]),
        ends=np.array([[1.0, 0.0, 0.25]]), status=(Status.ARRIVED,),
    )  # fmt: skip
    assert module._time(c2.ELinear(0.0, 1.0, 0.0).at(), drawn, 0) == pytest.approx(0.25 * 1.8, rel=1e-12)


@pytest.mark.parametrize("beside", [1e-3, 1e-9, 1e-20, 1e-40, 3e-63, 1e-200, 0.0])
@pytest.mark.parametrize("backward", [False, True])
def test_beside_the_ray_of_a_saddle_it_takes_the_time_of_the_ray(beside, backward):
    """Q1 is a saddle with lambda_rho = -2.5: it is reached after rho/2.5, and Sigma is not left for long."""
    sign = -1.0 if backward else 1.0
    system = c2.ELinear(-2.0 * sign, 0.0, -1.0 * sign, (-0.5 * sign, 0.0))
    found = launch(system, PSI, [[1.625, beside]])
    (fate,) = found.comes if backward else found.goes
    assert fate.after == pytest.approx(0.25, abs=max(5.0 * beside, 1e-9))
    assert fate.label == ("Q2" if beside else "Q1")


@settings(max_examples=20)
@given(st.floats(-3, -0.5), st.floats(-3, -0.5), st.floats(-2, 2), st.floats(-2, 2), st.integers(1, 16))
@example(-1.9375, -2.625, -1.40625, 1.75, 1)  # ends at a node with lambda_rho = -0.009
@example(-0.515625, -3.0, 1.0, 0.0, 16)  # beside the ray one rounding decides whether it comes to Sigma at all
def test_the_time_beside_any_saddle_is_that_of_another_solver(a, d, f1, f2, digits):
    system = c2.ELinear(a, 0.4, d, (f1, f2))
    equator = c2.equator_equilibria(system)
    saddles = np.flatnonzero((equator.lambda_rho < -0.2) & (equator.lambda_theta > 0.2))
    assume(len(saddles))
    theta = float(equator.theta[saddles[0]]) + 10.0**-digits
    seed = 1.6 * np.array([math.cos(theta), math.sin(theta)])
    (fate,) = launch(system, PSI, [seed]).goes
    assume(fate.after is not None)

    def rate(_, y):
        radial, turning = outside_flow(system.at(), y[1])
        return [radial, turning, math.exp(y[0])]

    def arrived(_, y):  # what is left then is rho/lambda_rho, some 1e-13/lambda_rho
        return y[0] + 30.0

    arrived.terminal = True

    def time_from(angle):
        start = [math.log(math.hypot(*seed) - 1.0), angle, 0.0]
        return solve_ivp(rate, (0.0, 1e7), start, method="LSODA", rtol=1e-10, atol=1e-12, events=arrived).y[2, -1]

    # the angle of a seed is known to the rounding of its coordinates: about 2^-53 of it
    roundings = [0.0] if digits < 15 else [0.0, -1e-15, 1e-15]
    angle = math.atan2(seed[1], seed[0])
    assert any(fate.after == pytest.approx(time_from(angle + turn), rel=2e-3) for turn in roundings)


def test_an_orbit_on_the_equator_and_one_that_leaves_are_told():
    system = c2.ELinear(-1, 2, -1)
    (fate,) = launch(system, PSI, [[1.0, 0.0]]).goes
    assert (fate.label, fate.sentence) == ("equator", "Stays on the equator, where it starts.")
    found = launch(c2.ELinear(1, 2, 1), PSI, [[1.5, 0.0]])
    assert (found.goes[0].label, found.goes[0].sentence) == ("away", "Leaves the picture.")
    assert found.comes[0].label == "equator"
    assert found.comes[0].onto is None
    assert found.comes[0].sentence == f"Left Σ in a spiral, t = {found.comes[0].after:.3g} ago."
    assert found.comes[0].after == pytest.approx(0.5, rel=1e-3)  # rho' = 1
    away = launch(c2.ELinear(1, 0, 1.5, (0.2, 0.1)), PSI, [[1.4, 0.3]]).comes[0]
    assert away.label.startswith("Q")
    assert away.sentence.startswith("Left Σ along Q")
    back = launch(c2.ELinear(-2, 0, -1, (-0.5, 0)), PSI, [[1.5, 0.3]]).comes[0]
    assert (back.label, back.sentence) == ("away", "Comes from outside the picture.")
    assert len(launch(system, PSI, [])) == 0


def outside(status, whole=None, ends=(0.0, 1.0, 0.3), after=0.25, backward=False):
    """What is said of an orbit that came to these `ends` outside, where there are directions at 1 and 4 radians."""

    class Equator:
        theta = np.array([1.0, 4.0])

        def __len__(self):
            return 2

    first, second = (SimpleNamespace(verdict="slide", leaving=None, onto=f"C{i}") for i in (1, 2))
    outcomes = SimpleNamespace(whole=whole, directions=(first, second))
    problem = SimpleNamespace(equator=Equator(), keep=lambda _: outcomes)
    half = SimpleNamespace(status=[status], ends=np.array([ends]))
    return module._outside(problem, half, 0, after, backward)


def test_what_an_orbit_outside_came_to():
    fate = outside(Status.ARRIVED)
    assert (fate.label, fate.onto, fate.after) == ("Q1", "C1", 0.25)
    assert fate.sentence == "Reaches Σ along Q₁, θ = 1, after t = 0.25. It slides on C₁."
    assert outside(Status.ARRIVED, ends=(-0.6, -0.8, 0.0)).label == "Q2"
    assert outside(Status.ARRIVED, after=None).sentence == "Reaches Σ along Q₁, θ = 1. It slides on C₁."
    whole = SimpleNamespace(verdict="cross", leaving=None, onto="equator")
    assert outside(Status.ARRIVED, whole).onto == "equator"  # all approaches are one
    spiral = outside(Status.SPIRALLED, whole)
    assert (spiral.label, spiral.sentence) == (
        "equator",
        "Reaches Σ in a spiral, after t = 0.25. It crosses: leaves in a spiral.",
    )
    for backward in (False, True):
        lost = outside(Status.T_MAX, backward=backward)
        assert (lost.label, lost.onto, lost.after) == ("undecided", None, None)
        assert lost.sentence.startswith("Not followed to an end")
    u = (math.cos(4.0), math.sin(4.0))
    assert outside(Status.T_MAX, ends=(*u, 1e-6)).label == "Q2"  # at a saddle, which captures nothing
    assert outside(Status.T_MAX, ends=(*u, 1e-3)).label == "undecided"
    assert outside(Status.T_MAX, ends=(math.cos(4.01), math.sin(4.01), 1e-6)).label == "undecided"
    back = outside(Status.ARRIVED, backward=True)
    assert (back.onto, back.after, back.sentence) == (None, 0.25, "Left Σ along Q₁, θ = 1, t = 0.25 ago.")
