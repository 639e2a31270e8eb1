"""Every preset shows what its figure in the paper shows."""

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import bifurcations


@pytest.mark.parametrize("name", c2.presets)
def test_portrait(name):
    preset = c2.presets[name]
    found = c2.classify(preset.system, preset.psi, preset.z)
    critical = c2.critical_sets(preset.system, preset.psi, preset.z)
    kind = critical[0].kind if critical else None
    assert (found.case, found.name) == preset.portrait[:2]
    if preset.portrait[2] is not None or not critical:
        assert kind == preset.portrait[2]
    assert tuple(d.name for d in found.degeneracies) == ((preset.degeneracy,) if preset.degeneracy else ())
    if found.case:
        assert found.sentence.startswith(f"Case {found.case}, {found.name}.")


def directions(name):
    return c2.equator_equilibria(c2.presets[name].system)


def test_cm0_the_equator_attracts_outside_and_repels_on_the_hemisphere():
    cycle = c2.equator_cycle(c2.presets["case1-cm0"].system)
    assert cycle is not None
    assert cycle.exponent == pytest.approx(-2 * np.pi)  # lambda_rho = -1, |Theta| = 1


@pytest.mark.parametrize("name", ["case1-cm2", "case1-cm4"])
def test_with_a_critical_set_every_direction_of_case_one_is_radially_attracting(name):
    found = directions(name)
    assert (found.lambda_rho < 0).all()
    assert (found.lambda_theta[::2] * found.lambda_theta[1::2] < 0).all()


def test_cm4_directions_are_those_of_d2_as_corrected():
    # sin θ ((d − a) cos θ − f1) = 0 (the paper prints a − d): θ = 0, π, ±arccos(f1/(d − a)).
    expected = np.sort([0.0, np.pi, np.arccos(-0.5), 2 * np.pi - np.arccos(-0.5)])
    np.testing.assert_allclose(directions("case1-cm4").theta, expected, rtol=1e-15)


def test_the_cycle_of_the_gallery_is_as_round_as_it_is_wide():
    preset = c2.presets["case3-cycle"]
    (cycle,) = c2.limit_cycles(preset.system, preset.psi)
    x, y = cycle.points.T
    area = 0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    around = np.hypot(*np.diff(cycle.points, axis=0).T).sum()
    assert cycle.stable
    assert area > 0.15 * np.pi  # of the disc's; that of case3-n3 is 0.03
    assert 4 * np.pi * area / around**2 > 0.85


def test_cm2_as_printed_sits_on_the_pitchfork():
    found = directions("case1-cm2-paper")
    np.testing.assert_allclose(found.theta, [0.0, np.pi], rtol=0.0, atol=1e-15)
    assert found.multiplicity.tolist() == [3, 1]
    assert found.lambda_theta[0] == 0.0


@pytest.mark.parametrize(("name", "arriving"), [("case1-ncm2", 1), ("case1-ncm4", 3)])
def test_without_a_critical_set_all_leaves_along_one_direction(name, arriving):
    found = directions(name)
    assert (found.lambda_rho < 0).sum() == arriving
    assert (found.lambda_rho > 0).sum() == 1


def test_the_saddle_has_four_directions_that_are_saddles_of_the_radial_and_angular_flow():
    found = directions("case2-saddle")  # thm:case2(a)
    assert len(found.theta) == 4
    assert (found.lambda_rho * found.lambda_theta < 0).all()


@pytest.mark.parametrize("name", c2.presets)
def test_index_of_the_critical_sets_is_the_degree_on_the_equator(name):
    preset = c2.presets[name]
    theta = np.linspace(0, 2 * np.pi, 20001)
    U = preset.system.at(preset.z).U(np.stack([np.cos(theta), np.sin(theta)], axis=-1))
    degree = round(np.diff(np.unwrap(np.arctan2(U[:, 1], U[:, 0]))).sum() / (2 * np.pi))
    index = sum(-1 if C.kind == "saddle" else 1 for C in c2.critical_sets(preset.system, preset.psi, preset.z))
    assert index == degree


@pytest.mark.parametrize("kind", ["pitchfork", "saddle-node", "transcritical"])
def test_a_walk_is_one_slider_across_the_curve(kind):
    before, at, after = (c2.presets[f"{kind}-{when}"] for when in ("before", "at", "after"))
    plane = lambda p: (p.a, p.b, p.d, p.f2, p.parameter)
    assert plane(before) == plane(at) == plane(after)
    assert (before.f1 - at.f1) * (after.f1 - at.f1) < 0
    a, b, d = at.a, at.b, at.d
    curve = (
        bifurcations.critical_boundary(c2.ELinear(a, b, d))
        if kind == "transcritical"
        else bifurcations.saddle_node(c2.ELinear(a, b, d))
    )
    distance = min(np.hypot(*(branch - (at.f1, at.f2)).T).min() for branch in curve.branches)
    assert distance < 1e-12
    if kind == "pitchfork":
        assert any(p.type == "pitchfork" and np.allclose(p.place, (at.f1, at.f2)) for p in curve.special)


@pytest.mark.parametrize("count", [0, 2, 4])
def test_conics_meet_as_often_as_their_name_says(count):
    preset = c2.presets[f"conics-{count}"]
    found = c2.equator_equilibria(preset.system)
    assert len(found) == count
    k = preset.d - preset.a
    x, y = np.cos(found.theta), np.sin(found.theta)
    hyperbola = k * x * y + preset.f2 * x - preset.f1 * y + preset.b
    np.testing.assert_allclose(hyperbola, 0.0, atol=1e-15)
    # branches of (x - x0)(y - y0) = const are told apart by the sign of x - x0, x0 = f1/(d - a)
    assert len(set(np.sign(x - preset.f1 / k))) == {0: 0, 2: 1, 4: 2}[count]
