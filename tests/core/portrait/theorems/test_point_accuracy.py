"""Accuracy of special points: against closed forms, and against what a small change of U does to them."""

import math

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import ELinear, System, psi

FOLD = System(U=("k - c**2 + p", "-s + q"), parameters={"k": 0.1, "p": 0.0, "q": 0.0})


def accuracies(system, family, along, span):
    return {one.kind: one for one in c2.branches(system, family, along, span).accuracy}


def test_a_fold_in_closed_form():
    """U = (k - c^2, -s): v = w = (1, 0), so that the coefficient is -1, and k moves by what U1 is changed by."""
    found = accuracies(FOLD, psi.constant(), "k", (-0.2, 0.3))["fold of critical sets"]
    size = FOLD.evolve(k=0.0).at().size
    assert found.coefficient * size == pytest.approx(-1.0, abs=1e-6)
    assert found.condition == pytest.approx(size, rel=1e-5)
    assert abs(found.value) <= found.error * (1.0 + 1e-3)  # the exact value is 0


@pytest.mark.parametrize(("p", "q"), [(1e-4, 0.0), (0.0, 1e-4), (-1e-4, 1e-4)])
def test_the_value_of_a_fold_moves_by_no_more_than_the_condition_says(p, q):
    before = accuracies(FOLD, psi.constant(), "k", (-0.2, 0.3))["fold of critical sets"]
    after = accuracies(FOLD.evolve(p=p, q=q), psi.constant(), "k", (-0.2, 0.3))["fold of critical sets"]
    size = FOLD.evolve(k=0.0).at().size
    assert abs(after.value - before.value) <= before.condition * max(abs(p), abs(q)) / size * 1.001
    assert after.value == pytest.approx(-p, abs=1e-8)


def test_limit_directions_that_meet_in_closed_form():
    """Theta = (d - a) sin cos + f2 cos - f1 sin is double on the astroid |f1|^(2/3) + |f2|^(2/3) = |d - a|^(2/3)."""
    system, f2 = ELinear(-2, 0, -1, (0.0, 0.1)), 0.1
    found = [one for one in c2.branches(system, psi.constant(), "f1", (-3, 3)).accuracy if one.kind == "saddle-node"]
    exact = (1.0 - f2 ** (2 / 3)) ** 1.5
    assert [one.value for one in found] == pytest.approx([-exact, exact], abs=1e-14)
    for one in found:
        c = math.copysign(exact ** (1 / 3), one.value)
        c, s = c, -(f2 ** (1 / 3))
        bend = -4.0 * s * c - f2 * c + one.value * s
        size = ELinear(-2, 0, -1, (one.value, f2)).at().size
        assert abs(one.coefficient) == pytest.approx(abs(bend) / 2.0 / size, rel=1e-5)
        # (Theta, Theta') by (theta, f1): only Theta'' in the first column, so f1 moves by Theta/s, and by nothing else
        assert one.condition == pytest.approx(size / abs(s), rel=1e-5)
        assert one.residual < 1e-15


def test_a_hopf_point_has_its_lyapunov_coefficient_and_a_pitchfork_no_condition():
    case3 = c2.presets["case3-n3"].system
    branches = c2.branches(case3, psi.hill(3), "f1", (-120.0, -20.0))
    hopf = [one for one in branches.standing if one.kind == "Hopf"]
    assert [one.coefficient for one in branches.accuracy if one.kind == "Hopf"] == [one.number for one in hopf]
    for one in branches.accuracy:
        assert one.residual < 1e-13
        assert 0.0 < one.condition < 1e3
    symmetric = accuracies(ELinear(-2, 0, -1, (-0.5, 0.0)), psi.constant(), "f1", (-3, 3))["pitchfork"]
    assert symmetric.condition == math.inf
    assert symmetric.error == 0.0
    assert symmetric.coefficient != 0.0


@pytest.mark.parametrize("seed", range(6))
def test_values_move_as_the_condition_says(seed):
    """Random systems of Case III, and f2 changed a little, which is a change of U2 alone."""
    rng = np.random.default_rng(seed)
    a, b, d, f2 = rng.uniform(0.5, 2), rng.uniform(2, 4), -rng.uniform(0.5, 2), rng.uniform(-1, 1)
    step, span = 1e-6, (-4.0, 4.0)
    before = c2.branches(ELinear(a, b, d, (0.0, f2)), psi.rational(), "f1", span)
    after = c2.branches(ELinear(a, b, d, (0.0, f2 + step)), psi.rational(), "f1", span)
    assert [one.kind for one in before.standing] == [one.kind for one in after.standing]
    moved = [abs(p.value - q.value) for p, q in zip(before.accuracy, after.accuracy, strict=True)]
    for far, one in zip(moved, before.accuracy, strict=True):
        size = ELinear(a, b, d, (one.value, f2)).at().size
        rates = 1.0 if one.kind in {"Hopf", "node-focus", "transcritical"} else 2.0  # Theta' moves too
        assert far <= rates * one.condition * step / size * 1.01
    assert before.accuracy
