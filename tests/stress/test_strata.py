"""Every degenerate stratum, and a relative 1e-1 ... 1e-16 on both sides of it, at every scale of the coefficients."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, classify, equator_equilibria, nullclines, psi, sliding_flow

from .checks import check_finite, check_index, check_plane, check_sides
from .strata import CASE3, STEPS, STRATA, system

FAMILIES = [psi.constant(), psi.rational(), psi.hill(4)]
by_name = pytest.mark.parametrize("stratum", STRATA, ids=lambda s: s.name)


def families(stratum):
    return FAMILIES if stratum.psi is None else [stratum.psi]


@by_name
def test_one_class_on_each_side_and_its_name_in_between(stratum):
    check_sides(stratum, families(stratum)[0])


@by_name
@pytest.mark.parametrize("scale", [2.0**-470, 2.0**470, 1e-147, 1e141])
def test_no_scale_changes_the_name(stratum, scale):
    """Powers of two are exact; 1e141 rounds every coefficient, which is what the names allow for."""
    for regularisation in families(stratum):
        plain = check_plane(stratum.plane, regularisation)
        scaled = check_plane(stratum.plane, regularisation, scale)
        if np.frexp(scale)[0] == 0.5:
            assert scaled == plain
        else:
            assert not stratum.degeneracy or stratum.degeneracy in scaled[2]


@by_name
def test_nullclines_and_slow_flow_are_finite(stratum):
    for path in stratum.paths.split()[:2]:
        for change in (0.0, 1e-16, -1e-16, 1e-12, -1e-8, 1e-4):
            at = system(stratum.moved(path, change))
            for regularisation in families(stratum):
                check_finite(nullclines(at, regularisation), "nullclines")
            flow = sliding_flow(at)
            assert flow is None or np.isfinite(flow).all()


@by_name
def test_index_theorem(stratum):
    for path in stratum.paths.split():
        for change in (0.05, -0.05, 1e-2, -1e-2):
            check_index(stratum.moved(path, change), families(stratum)[0])


@settings(max_examples=100)
@given(st.sampled_from(STRATA), st.lists(st.floats(-1, 1), min_size=5, max_size=5), st.integers(0, 17))
def test_any_direction_off_a_stratum(stratum, direction, power):
    """All five coefficients move at once."""
    size = max(map(abs, stratum.plane)) or 1.0
    plane = tuple(v + size * u * 10.0**-power for v, u in zip(stratum.plane, direction, strict=True))
    if max(map(abs, plane)) >= 1e-150 or not any(plane):
        check_plane(plane, families(stratum)[0])


@settings(max_examples=50)
@given(st.lists(st.tuples(st.floats(-1, 1), st.integers(-149, 149)), min_size=5, max_size=5), st.sampled_from(FAMILIES))
def test_coefficients_of_any_size(parts, regularisation):
    plane = tuple(m * 10.0**e for m, e in parts)
    if max(map(abs, plane)) >= 1e-150:
        check_plane(plane, regularisation)


@pytest.mark.parametrize("regularisation", [psi.constant(), psi.exponential(), psi.hill(30)], ids=lambda p: p.text)
def test_z_at_the_borders_of_sliding(regularisation):
    """The ball in the pool slides for |z| < 1: nothing slides at 1 and beyond, and z' has no jump on the way."""
    ball = ELinear(-1.0, 0.0, -1.0, ("z", 0.0), B=[[0.5, 0.0]], g=[-0.25])
    for border in (1.0, -1.0):
        for step in STEPS:
            inside, outside = border * (1.0 - step), border * (1.0 + step)
            flow = sliding_flow(ball, [inside])
            if step >= 1e-15:
                assert flow is not None
                assert abs(flow[0] - (0.5 * inside - 0.25)) < 1e-15
                assert classify(ball, regularisation, [inside]).name == "CM2"
                assert classify(ball, regularisation, [outside]).name == "NCM2"
            assert sliding_flow(ball, [outside]) is None
        assert sliding_flow(ball, [border]) is None
        assert [d.name for d in classify(ball, regularisation, [border]).degeneracies] == ["transcritical"]


def test_directions_move_little_as_a_reaches_d():
    for step in STEPS:
        for side in (step, -step):
            at = equator_equilibria(ELinear(-1.0, 0.25, -1.0 + side, (0.5, 0.0)))
            limit = equator_equilibria(ELinear(-1.0, 0.25, -1.0, (0.5, 0.0)))
            assert len(at) == len(limit) == 2
            assert np.abs(at.theta - limit.theta).max() < 2 * step + 2e-15
            assert np.abs(at.lambda_rho - limit.lambda_rho).max() < 4 * step + 2e-15


@pytest.mark.parametrize("step", STEPS[:15])
def test_the_hopf_value_of_n_divides_stable_from_unstable(step):
    """tr J = -71 + 32.25 n in Case III: its sign is right down to 3e-14 next to 284/129."""
    for side, name in ((-1.0, "stable"), (1.0, "unstable")):
        found = check_plane(CASE3, psi.hill(284.0 / 129.0 * (1.0 + side * step)))
        if step >= 3e-14:  # the trace is 0 within 16 roundings of its terms: 2e-14 of n
            assert found[3] == (name,)
        else:
            assert found[3][0] in (name, "centre")
