"""Laws of friction next to each other: who sticks, who chatters, who slides."""

import math

import pytest

import codim2_core as c2

LAWS = {name: (c2.psi.engine(name), 1e-3) for name in ("drake", "ipc", "mujoco")}


def test_the_same_mechanism_sticks_in_two_engines_and_chatters_in_one():
    found = c2.compare_laws(c2.ELinear(200.0, 200.0, -172.0, (-100.0, -100.0)), LAWS)
    assert [(one.law, one.verdict) for one in found] == [
        ("drake", "sticks"), ("ipc", "sticks"), ("mujoco", "chatters"),
    ]  # fmt: skip
    assert [one.trace for one in found] == pytest.approx([-19.0526, -10.7797, 28.0], abs=1e-4)
    assert found[0].creep == pytest.approx(1e-3 / math.sqrt(3.0))
    assert found[2].creep is None
    assert found[2].chatter == pytest.approx(
        1.79055e-3, rel=1e-5
    )  # of the cycle in tests/core/systems/psi/test_engines.py
    assert found.to_frame()["verdict"].tolist() == ["sticks", "sticks", "chatters"]
    assert "chatters" in found._repr_html_()


def test_the_other_verdicts():
    verdict = lambda system: c2.compare_laws(system, {"sap": LAWS["mujoco"]})[0].verdict
    assert verdict(c2.ELinear(200.0, 190.0, -172.0, (-100.0, -95.0))) == "slides"
    assert verdict(c2.ELinear(1.0, 1.5, -1.0, (-0.4, -0.1))) == "undecided"
    assert verdict(c2.ELinear(-1.0, 0.0, -1.0, (2.0, 0.0))) == "slides"  # pulled more than friction carries
