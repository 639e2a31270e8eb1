"""Launched orbits: where they go and come from, against what is known exactly and against other ways to ask."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import codim2_core as c2

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


@pytest.mark.parametrize("beside", [1e-3, 1e-9, 1e-20, 1e-40, 3e-63, 1e-200, 0.0])
@pytest.mark.parametrize("backward", [False, True])
def test_next_to_the_ray_of_a_saddle_it_takes_the_time_of_the_ray(beside, backward):
    """Q1 is a saddle with lambda_rho = -2.5: it is reached after rho/2.5, and Sigma is not left for long."""
    sign = -1.0 if backward else 1.0
    system = c2.ELinear(-2.0 * sign, 0.0, -1.0 * sign, (-0.5 * sign, 0.0))
    found = launch(system, PSI, [[1.625, beside]])
    (fate,) = found.comes if backward else found.goes
    assert fate.after == pytest.approx(0.25, abs=max(5.0 * beside, 1e-9))
    assert fate.label == ("Q2" if beside else "Q1")


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
