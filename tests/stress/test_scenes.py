"""The whole scene, every layer of it, on and next to every stratum, for every kind of Psi, from every kind of seed."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, Scene, limit_cycles, psi
from codim2_core.portrait.orbits.trajectories import trajectories
from codim2_core.scene import layers

from .checks import MOST_CYCLES, check_finite, check_scene, check_seeds
from .strata import CASE3, STRATA

FAMILIES = (psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3), psi.hill(20))
by_name = pytest.mark.parametrize("stratum", STRATA, ids=lambda s: s.name)

# Psi at its extremes: the flattest and the steepest there are.
EXTREMES = [psi.hill(n) for n in (0.01, 0.1, 0.5, 1.5, 7, 60, 200, 1000)] + [
    psi.custom(text)
    for text in ("1/(1+(4*s)**40)", "exp(-s**8)", "1/(1+s/1e6)", "1/(1+1e6*s)", "(1+exp(-30))/(1+exp(30*(s-1)))")
]
PORTRAITS = [
    (-2.0, 0.3, -1.0, -0.5, 0.1),  # I, nodes
    (-0.01, 1.0, -0.02, 0.4, 0.3),  # I, slow focus
    (1.0, 0.3, -2.0, 0.2, 0.3),  # II
    CASE3,  # III
    (-1.0, 0.0, -1.0, 1.5, 0.0),  # no critical set
]
CHANGES = [0.0, 2.0**-52, -(2.0**-52), 1e-8, -1e-8]  # 1 + 1e-16 is 1

EVERY = tuple(layers)


@by_name
@pytest.mark.parametrize("change", CHANGES)
def test_every_layer_on_and_next_to_a_stratum(stratum, change):
    paths = stratum.paths.split()
    k = STRATA.index(stratum) + round(-np.log10(abs(change) or 1e-3))
    check_scene(stratum.moved(paths[k % len(paths)], change), stratum.psi or FAMILIES[k % len(FAMILIES)], EVERY)


@pytest.mark.parametrize("plane", PORTRAITS, ids=["I, nodes", "I, slow focus", "II", "III", "none"])
@pytest.mark.parametrize("regularisation", EXTREMES, ids=lambda p: p.text)
def test_every_layer_with_an_extreme_psi(regularisation, plane):
    check_scene(plane, regularisation, EVERY)


@pytest.mark.parametrize("regularisation", EXTREMES, ids=lambda p: p.text)
def test_an_extreme_psi_is_inverted(regularisation):
    for power in np.linspace(-12.0, 0.0, 25):
        for modulus in (10.0**power, 1.0 - 10.0**power):
            if not 0.0 < modulus < 1.0:
                continue
            zeta = regularisation.radius(modulus)
            assert np.isfinite(zeta)
            steep = 1.0 + regularisation.steepness(zeta)
            # one rounding of zeta changes |e| by (1 - |e|^2)(1 + steepness) of itself
            slack = 1e-15 * (4.0 + (1.0 - modulus**2) * steep)
            assert regularisation.modulus(zeta) == pytest.approx(modulus, rel=slack)
            assert all(np.isfinite(v) and v >= 0.0 for v in regularisation.jacobian_factors(zeta))


RADII = [0.0, 1e-300, 1e-12, 0.5, *(1.0 - 10.0**-k for k in range(1, 17)), 1.0]
OUTSIDE = [1.0 + 2.0**-52, *(1.0 + 10.0**-k for k in range(1, 16)), 1.99]


def seeds(radii):
    r, t = np.array(radii), 2.399963 * np.arange(len(radii))
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=-1)


@by_name
def test_seeds_from_the_centre_to_the_equator_and_outside(stratum):
    k = STRATA.index(stratum)
    check_seeds(stratum.plane, stratum.psi or FAMILIES[k % len(FAMILIES)], seeds(RADII + OUTSIDE))


def test_seeds_at_equilibria_stay_or_leave_without_noise():
    """Exactly on the critical set, on limit directions and just next to them."""
    for plane in PORTRAITS:
        at = ELinear(*plane[:3], plane[3:])
        scene = Scene(at, psi.rational())
        theta = scene["equator"].theta
        places = [[r * np.cos(t), r * np.sin(t)] for t in theta for r in (1.0, 1.0 - 1e-15, 1.0 + 1e-15)]
        places += [C.p + offset for C in scene["critical"] for offset in (0.0, 1e-16, -1e-15, 1e-9)]
        if places:
            check_seeds(plane, psi.rational(), np.array(places))


@settings(max_examples=40)
@example([-1.0, 4e-35, 0.0, 0.5, 0.0], 0, FAMILIES[0])
@given(
    st.lists(st.floats(-2, 2).map(lambda v: v if abs(v) > 1e-60 else 0.0), min_size=5, max_size=5),
    st.integers(-145, 145),
    st.sampled_from(FAMILIES),
)
def test_random_systems_at_any_scale(values, power, regularisation):
    plane = tuple(v * 10.0**power for v in values)
    if max(map(abs, plane)) >= 1e-150:
        check_scene(plane, regularisation, EVERY)


@pytest.mark.parametrize("tolerance", [1e-14, 1e-3, 0.1])
def test_tolerances_at_their_limits(tolerance):
    """The work is bounded also where rounding, not the tolerance, decides."""
    for plane in PORTRAITS:
        lines = trajectories(
            ELinear(*plane[:3], plane[3:]), psi.hill(7), seeds(RADII), t_max=40.0 / max(map(abs, plane)),
            rtol=tolerance, atol=max(0.1 * tolerance, 1e-15), length=9.0, step_limit=5000,
        )  # fmt: skip
        check_finite(lines, "")
        assert lines.evaluations <= 12 * 5000 * len(lines)


@pytest.mark.parametrize("plane", [(1e-9, 1.0, -2e-9, 0.3, 0.2), (1.0, 2.0, -1.0 - 1e-9, 0.5, -0.5)])
def test_weak_damping_is_no_band_of_cycles(plane):
    assert len(limit_cycles(ELinear(*plane[:3], plane[3:]), psi.rational())) <= MOST_CYCLES


@pytest.mark.parametrize("a", [0.9999, 0.99999])
def test_a_cycle_that_repels_beyond_doubles_is_no_error(a):
    check_scene((a, 1.0, -1.0, 0.5, 0.5), psi.constant())
