"""The panel of response curves: a driven mass, what it depends on, and what is said where there is no such motion."""

import math

import pytest
from codim2_app.picture.phrases import say
from codim2_app.picture.state.system_opening_values import opening_values

from ..opening import ask, opened

MASS = {
    "system": "own", "along": "own:w", "launch": "0, 0, 1, 0", "t_end": 40.0, "parameters": {"w": 2.0},
    "texts": {
        "U1": "-z1 - S*c - d*x + cos(w*t)", "U2": "-y - S*s", "W": "x",
        "where": "w = 2 in [1.9, 2.1]\nS = 0.2 in [0, 1]\nd = 0.1 in [0, 1]",
    },
}  # fmt: skip


def test_a_driven_mass_along_its_frequency():
    frames, header = opened("response", **MASS)
    found = header["response"]
    assert (found["control"], found["span"], found["of"], found["forced"]) == ("own:w", [1.9, 2.1], 0, True)
    assert (min(found["values"]), max(found["values"])) == (1.9, 2.1)
    assert all(found["stable"])
    assert {len(row) for row in found["multipliers"]} == {3}
    order = sorted(range(len(found["values"])), key=found["values"].__getitem__)
    amplitudes = [found["amplitude"][i] for i in order]
    assert amplitudes == sorted(amplitudes, reverse=True)  # beyond the resonance
    assert "late" not in ask(frames, parameters={"w": 2.05})  # moving along it
    assert ask(frames, t_end=39.0)["late"] == ["response"]


def test_an_example_that_is_forced_opens_with_its_response():
    values = opening_values("driven_mass")
    assert (values["panel"], values["along"]) == ("response", "own:omega")
    _, header = opened(values.pop("panel"), system="driven_mass", **values)
    found = header["response"]
    for omega, amplitude in zip(found["values"], found["amplitude"], strict=True):
        assert amplitude == pytest.approx(math.sqrt(0.75) / (omega**2 - 1.0), rel=1e-3)  # as it is sent
    panels = {name: opening_values(name)["panel"] for name in ("towed_wheel", "tilting_block")}
    assert panels == {"towed_wheel": "numbers", "tilting_block": "atlas"}  # sines of z, too


def test_where_there_is_none():
    _, header = opened("response", along="f1")
    assert header["unable"]["response"] == say("no periodic motion to follow")
    _, header = opened("response", along="z")
    assert header["unable"]["response"] == say("no parameter of the motion")
