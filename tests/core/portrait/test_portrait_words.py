"""What the portrait's sentences say of the directions, of the critical set, and of what is degenerate."""

import pytest

from codim2_core import ELinear, approach_outcomes, classify, equator_equilibria, psi


def said(a, b, d, f1, f2, family=None):
    return classify(ELinear(a, b, d, (f1, f2)), family or psi.constant())


def test_a_triple_zero_is_a_pitchfork_only_where_the_system_is_symmetric():
    for f1, f2, d in ((-0.5, 0.0, -1.5), (0.0, 2.0, 1.0)):
        found = equator_equilibria(ELinear(-1.0, 0.0, d, (f1, f2)))
        assert found.symmetric
        assert any("pitchfork" in found.kind(i) for i in range(len(found)))
    for plane in ((225, -180, 100, -171, 172), (225, -180, 100, -171.0, 172.0)):
        assert not equator_equilibria(ELinear(*plane[:3], plane[3:])).symmetric
    assert not equator_equilibria(ELinear(1, 0, 2, (0.1, 0.1))).symmetric
    assert not equator_equilibria(ELinear(1, 0.5, 2, (0.1, 0.0))).symmetric
    assert not equator_equilibria(ELinear(1, 0.5, 2, (0.0, 0.1))).symmetric
    assert equator_equilibria(ELinear(1, 0.0, 2, (0.0, 0.1))).symmetric
    fourfold = equator_equilibria(ELinear(0, 1.5, 1, (2**0.5, -(2**0.5))))
    assert fourfold.kind(0).endswith("fourfold zero")
    weakly = equator_equilibria(ELinear(1.0, 0.0, 1.5, (0.5, 0.0)))  # the paper's pitchfork, backward
    assert [weakly.kind(i).endswith("weakly attracting") for i in range(2)].count(True) == 1


@pytest.mark.parametrize("plane", [(1, 2, -1, 0, 0), (0, 1, 0, 0, 0), (0, 1, 0, 0.3, 0)])
def test_a_true_centre_is_called_no_bifurcation(plane):
    (degeneracy,) = [d for d in said(*plane).degeneracies if d.name == "tr J = 0"]
    assert "a centre of the layer problem" in degeneracy.sentence
    assert "stable is decided" not in degeneracy.sentence


def test_at_the_saddle_node_every_angle_arrives():
    (outcome,) = approach_outcomes(ELinear(-1, 1, -1, (1, 0)), psi.constant())
    assert outcome.arrives == "one side"
    assert "from every angle" in outcome.reason
