"""Trajectories of typed systems: the compiled field, what compiles and what does not, and what it does outside."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from codim2_core import examples, hemisphere, psi
from codim2_core.portrait.orbits.trajectories import Status, trajectories
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

from .seeds import ring, sunflower

FAMILIES = [
    psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(4.0), psi.hill(3.7),
    psi.custom("1/(1+s)**2"),
]  # fmt: skip
NAMES = [p.text for p in FAMILIES]
AR, NU = examples.attracting_repelling(), examples.nonunique_sliding()
ODD = System(
    U=("sin(3*c) - k*exp(s) + x*y", "tanh(c) - s + c**3*sqrt(2 + c*s) - x/(1 + y**2)"), W=("-z",), parameters={"k": 0.5}
)


def as_text(system):
    """The same e-linear system as typed formulas."""
    a, b, d, f1, f2 = system.at(()).plane
    values = {"a": a, "b": b, "d": d, "f1": f1, "f2": f2}
    return System(U=("a*c - b*s + f1", "b*c + d*s + f2"), parameters=values)


@pytest.mark.parametrize("p", FAMILIES, ids=NAMES)
@pytest.mark.parametrize("backward", [False, True])
def test_text_and_built_in_are_the_same_system(p, backward):
    built_in = ELinear(-2.0, 0.5, -1.0, (-0.5, 0.2))
    seeds = np.concatenate([sunflower(24), ring(12, 1.4), ring(4, 1.0)])
    options = {"rtol": 1e-12, "atol": 1e-13, "capture": 1e-14, "t_max": 3.0, "view": 1e9, "backward": backward}
    one = trajectories(built_in, p, seeds, samples="ends", **options)
    other = trajectories(as_text(built_in), p, seeds, samples="ends", **options)
    # Rounding off the sphere counts against Psi = 1 too: nothing here grows by more than e^9.
    assert np.abs(one.ends - other.ends).max() < 1e-9
    assert one.status == other.status


@pytest.mark.parametrize("system", [AR, NU, ODD], ids=["attracting-repelling", "nonunique", "odd"])
def test_against_an_independent_integrator(system):
    at, p, seeds = system.at(0.3), psi.exponential(), sunflower(5, 0.9)
    options = {"t_max": 3.0, "rtol": 1e-11, "atol": 1e-12, "capture": 1e-15, "samples": "ends"}
    result = trajectories(system, p, seeds, 0.3, **options)
    for seed, end in zip(seeds, result.ends, strict=True):
        other = solve_ivp(lambda t, q: hemisphere.flow(at, p, q), (0, 3), seed, method="DOP853", rtol=1e-12, atol=1e-13)
        assert np.abs(other.y[:, -1] - end[:2]).max() < 1e-9


def test_exact_spiral_outside():
    """(x, y)' = k (x, y) + w (-y, x): rho = rho0/(1 - k rho0 T), theta = theta0 - w/k ln(1 - k rho0 T)."""
    k, w = -0.7, 1.9
    system = System(U=("k*x - w*y", "w*x + k*y"), parameters={"k": k, "w": w})
    seeds, T = ring(8, 2.5), 4.0
    with pytest.raises(ValueError, match="only rescales time"):
        System(U=("1e-200*c", "1e-200*s")).at()
    result = trajectories(system, psi.constant(), seeds, t_max=T, rtol=1e-12, atol=1e-13, view=10.0, capture=1e-15)
    growth = 1.0 - k * 1.5 * T
    angle = np.arctan2(seeds[:, 1], seeds[:, 0]) - w / k * math.log(growth)
    assert np.abs(result.ends[:, :2] - np.stack([np.cos(angle), np.sin(angle)], axis=-1)).max() < 1e-10
    assert np.abs(result.ends[:, 2] / (1.5 / growth) - 1.0).max() < 1e-10


def test_a_formula_that_ends_at_the_sphere_is_never_left():
    """Steps stray off |p|^2 + w^2 = 1 by their own error; e must not stray beyond |e| = 1 with them."""
    system = System(U=("-c + 0.3*sqrt(1 + 1e-13 - c**2 - s**2)", "-s + 0.4*c"))
    for p in (psi.constant(), psi.tanh()):
        result = trajectories(system, p, np.concatenate([sunflower(30), ring(10, 1.0)]), rtol=1e-3, atol=1e-3)
        assert np.isfinite(result.buffer).all()
        assert Status.STEP_LIMIT not in result.status
