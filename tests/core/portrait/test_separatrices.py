"""Separatrices: the theorems, the index, and saddle connections."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from codim2_core import ELinear, critical_sets, equator_cycle, equator_equilibria, presets, psi
from codim2_core.portrait.separatrices import separatrices
from tests.core.strategies import regularisations

FAMILIES = [psi.constant(), psi.rational(), psi.exponential(), psi.tanh(), psi.hill(3)]


def robust(system, p):
    """Away from every bifurcation, so that nothing is slow."""
    plane = np.array(system.at(()).plane)
    size = np.abs(plane).max()
    equator = equator_equilibria(system)
    assume(size > 0.1)
    assume(not equator.all_directions and (equator.multiplicity == 1).all() and not equator.radially_degenerate.any())
    assume((np.abs(equator.lambda_rho) > 0.02 * size).all() and (np.abs(equator.lambda_theta) > 0.02 * size).all())
    closed = equator_cycle(system)
    assume(closed is None or abs(closed.exponent) > 0.05)
    critical = critical_sets(system, p)
    for C in critical:
        assume(np.abs(C.eigenvalues.real).min() > 0.01 * size)
        assume(np.hypot(*C.p) < 0.999)
    return equator, critical


@pytest.mark.parametrize("p", FAMILIES, ids=lambda p: p.text)
def test_separatrices_are_rays_for_f_0(p):
    system = ELinear(1.0, 0.3, -1.0)
    for branch in separatrices(system, p):
        angle = np.arctan2(branch.points[:, 1], branch.points[:, 0])[np.hypot(*branch.points.T) > 1e-6]
        miss = np.abs(np.angle(np.exp(1j * (angle - branch.departure_angle))))
        assert miss.max() < 1e-8


coefficient = st.floats(0.1, 3.0)


@settings(max_examples=20)
@given(coefficient, coefficient, st.floats(-3, 3), st.floats(0, 0.95), st.floats(0, 6.28), regularisations)
def test_case_II_saddle_joins_all_four(a, d, b, r, t, p):
    """thm:case2(a): the four branches of C end at the four Q, the unstable ones where orbits leave."""
    assume(b * b < 0.9 * a * d)
    f = -np.array([[a, -b], [b, -d]]) @ [r * math.cos(t), r * math.sin(t)]
    system = ELinear(a, b, -d, (float(f[0]), float(f[1])))
    equator, critical = robust(system, p)
    assert [C.kind for C in critical] == ["saddle"]
    found = separatrices(system, p)
    inside = [branch for branch in found if branch.inside]
    assert {branch.origin for branch in inside} == {"C"}
    assert {branch.end for branch in inside} == {"Q1", "Q2", "Q3", "Q4"}
    for branch in inside:
        outwards = equator.lambda_rho[int(branch.end[1]) - 1] > 0.0
        assert outwards == (branch.direction == "unstable")
        assert not branch.connection
    assert len(found) == 8  # and every Q is a half-saddle outside


def test_case_III_winds_onto_the_cycle():
    found = separatrices(presets["case3-n3"].system, psi.hill(3))
    assert ("Q1", "cycle 1") in found.graph
    assert ("Q2", "Q4") in found.graph


def test_saddle_connection_is_found_and_named():
    """Bisect between two portraits whose branch from a half-saddle ends at different places."""
    a, b, d = 1.4670492107996933, 1.9395381950388753, -2.429203677317721
    low, high = 1.0, 1.005

    def skeleton(t):
        return separatrices(ELinear(a, b, d, (t * 1.4613588858914937, t * 1.8156491036456746)), psi.hill(2))

    def ends(found):
        return [branch.end for branch in found if branch.inside and branch.direction == "unstable"]

    first = ends(skeleton(low))
    assert first != ends(skeleton(high))
    for _ in range(40):
        middle = 0.5 * (low + high)
        found = skeleton(middle)
        if any(branch.connection for branch in found):
            break
        if ends(found) == first:
            low = middle
        else:
            high = middle
    joined = [branch for branch in found if branch.connection]
    assert len(joined) == 2
    leaving, entering = sorted(joined, key=lambda branch: branch.direction == "stable")
    assert (leaving.end, entering.end) == (entering.origin, leaving.origin)
    assert leaving.gap <= 1e-6
    assert any("connection" in note for note in found.notes)


def test_branches_outside_are_drawn_to_the_edge_of_a_picture_of_half_width_two():
    for system in (ELinear(-2, 0, -1, (-0.5, 0)), ELinear(-2, 0, -1, (-0.5, "z/8"), g=(1.0,)).at((0.3,))):
        for view, options in ((2.0, {}), (3.0, {"view": 3.0})):
            outside = [one for one in separatrices(system, psi.constant(), **options) if not one.inside]
            assert outside
            for one in outside:
                reach = np.abs(one.points).max(axis=1)
                assert reach.max() == pytest.approx(view, abs=1e-9)
                assert np.hypot(*one.points.T).min() == pytest.approx(1.0, abs=1e-12)
