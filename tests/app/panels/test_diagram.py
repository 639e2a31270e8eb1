"""The panel of diagrams along one parameter: what is sent, when, and along what."""

import numpy as np
import pytest
from codim2_app.panels.parameters import axes, diagram
from codim2_app.picture.state.choices import SLIDER_AXES
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2

from .opening import CASE3, ask, opened, settled


def test_moving_along_the_diagram_asks_for_no_new_one():
    frames, _ = opened("diagram", along="f1")
    for change in ({"f1": 0.75}, {"B1": 2.0}, {"g0": 1.0}, {"trajectories": 8}):
        assert "late" not in ask(frames, **change), change
    assert ask(frames, f2=0.1)["late"] == ["diagram"]
    assert ask(frames, f2=0.0).get("late") is None  # back to what the browser has


@pytest.mark.parametrize(("name", "expected"), [
    ("f1", [("transcritical", -2.0), ("pitchfork", -1.0), ("pitchfork", 1.0), ("transcritical", 2.0)]),
    ("z", [("transcritical", -3.0), ("pitchfork", -1.0), ("pitchfork", 3.0)]),
])  # fmt: skip
def test_special_values_of_the_diagram(name, expected):
    _, header = opened("diagram", along=name)
    found = header["diagram"]
    assert found["control"] == name
    assert [(s["kind"], pytest.approx(s["value"], abs=1e-12)) for s in found["special"]] == expected


def test_cycles_along_n_are_born_at_the_papers_hopf_value():
    _, header = opened("diagram", along="n", **CASE3)
    hopf = [s["value"] for s in header["diagram"]["special"] if s["kind"] == "Hopf"]
    assert hopf == [pytest.approx(284 / 129, abs=1e-12)]
    kinds = [b["kind"] for b in header["diagram"]["critical"]]
    assert kinds == ["stable node", "stable focus", "unstable focus", "unstable node"]
    (piece,) = header["cycles_along"]["pieces"]
    assert piece["stable"] is True
    assert piece["x"][0] == pytest.approx(284 / 129, abs=1e-6)
    assert piece["y"][0] == 0.0
    assert piece["x"][-1] == 6.0
    (cycle,) = c2.limit_cycles(c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3))
    assert np.interp(3.0, piece["x"], piece["period"]) == pytest.approx(cycle.period, rel=3e-3)
    assert header["cycles_along"]["special"] == []


def test_film_strip_has_a_portrait_at_each_special_value_and_between_each_two():
    """Also at those of cycles, and each is of the system there."""
    _, header = opened("diagram", along="f1")
    assert [(value, name) for value, name, _ in header["film"]] == [
        (-2.5, "NCM2"), (-2.0, "NCM2"), (-1.5, "CM2"), (-1.0, "CM2"), (0.0, "CM4"), (1.0, "CM2"),
        (1.5, "CM2"), (2.0, "NCM2"), (2.5, "NCM2"),
    ]  # fmt: skip
    drawn = [svg for _, _, svg in header["film"]]
    assert all(svg.startswith("<svg ") for svg in drawn)
    assert len(set(drawn)) == len(drawn)
    frames, header = opened("diagram", along="f2", **CASE3)
    events = [s["value"] for s in (*header["diagram"]["special"], *header["cycles_along"]["special"])]
    assert header["cycles_along"]["special"]
    assert set(events) <= {value for value, _, _ in header["film"]}
    assert ask(frames, f1=-80.0)["late"] == ["diagram"]


def test_special_values_are_decimals_where_they_are_up_to_rounding():
    found = [diagram.tidy(v) for v in (0.1 + 0.2, -1.0000000000000002, 284 / 129, 1e-17, 0.0)]
    assert found == [0.3, -1.0, 284 / 129, 1e-17, 0.0]


def test_special_values_at_one_place_or_too_many_have_no_portrait_between():
    assert [place for _, _, place in diagram.frames_of((0.0, 4.0), [1.0, 1.00390625, 1.0])] == [
        (0.5,), (1.0,), (1.00390625,), (2.501953125,),
    ]  # fmt: skip
    assert [place for _, _, place in diagram.frames_of((0.0, 4.0), [])] == [(2.0,)]
    assert len(diagram.frames_of((0.0, 1.0), np.linspace(0.1, 0.9, 13))) == 13


def test_cycles_of_a_general_system_are_followed_too():
    system = c2.System(
        U=("m*c - s + 0.3*c**2 - 2*c*(c**2 + s**2)", "c + m*s - 0.2*c*s - 2*s*(c**2 + s**2)"), parameters={"m": 0.1}
    )
    frames = Frames(ExplorerState(panel="diagram", along="own:m"), system)
    header = settled(frames, all=True)
    (piece,) = header["cycles_along"]["pieces"]
    assert piece["stable"] is True
    assert piece["x"][0] == pytest.approx(0.0, abs=1e-9)
    assert piece["x"][-1] == pytest.approx(2.0, abs=1e-3)  # where the equator is neutral


def test_what_stands_still_is_found_once_for_both_steps(monkeypatch):
    """Cycles are followed from what the first step has found: also in a system that was left and come back to."""
    asked, real = [], diagram.branches
    monkeypatch.setattr(diagram, "branches", lambda *given, **options: asked.append(given) or real(*given, **options))
    frames, header = opened("diagram", along="n", **{**CASE3, "f2": -93.01})  # which no other test has asked for
    assert header["cycles_along"]["pieces"]
    assert len(asked) == 1
    assert ask(frames, f1=CASE3["f1"] + 1.0)["late"] == ["diagram"]
    assert "late" not in ask(frames, f1=CASE3["f1"])
    assert len(asked) == 1


def test_where_there_can_be_no_cycle_the_reason_is_said():
    _, header = opened("diagram", along="f1")
    assert header["cycles_along"]["pieces"] == []
    assert "Bendixson" in header["cycles_along"]["sentence"]


def test_what_cannot_be_varied_is_said():
    _, header = opened("diagram", along="n")
    assert "Ψ = 3/(3 + (4s)ⁿ)" in header["unable"]["diagram"]
    frames = Frames(ExplorerState(panel="diagram", along="a"), c2.ELinear("-1 + z", 0, -2, (0.2, 0.3), g=("z1",)))
    assert "Your system fixes a" in settled(frames, all=True)["unable"]["diagram"]


@pytest.mark.parametrize("name", SLIDER_AXES)
def test_span_of_the_diagram_holds_the_value_and_rests_while_it_moves_a_little(name):
    low, high = ExplorerState.param[name].softbounds

    def span(value, zoom):
        return axes.Axis(name, name, name, low, high, float(value)).span(zoom)

    for zoom in range(7):
        for value in np.linspace(low, high, 41):
            left, right = span(value, zoom)
            assert left <= value <= right
            assert right - left == pytest.approx((high - low) / 4**zoom)
            assert low <= left
            assert right <= high + 1e-12
    middle, width = (low + high) / 2, (high - low) / 16
    assert span(middle, 2) == span(middle + 0.1 * width, 2)
    assert span(10 * high, 0)[1] > 10 * high


def test_parameters_of_a_chosen_system_are_axes():
    frames = Frames(ExplorerState(panel="diagram"))
    frames.answer({"all": True})
    frames.answer({"set": {"system": "ball_in_pool"}})
    assert settled(frames, rest=True)["diagram"]["control"] == "z"  # it opens with what it has
    frames.answer({"set": {"along": "f1"}})
    assert "not in this system" in settled(frames, all=True)["unable"]["diagram"]
    frames.answer({"set": {"along": "own:K"}})
    header = settled(frames, rest=True)
    assert header["diagram"]["control"] == "own:K"
    low, high = header["diagram"]["span"]
    assert low < dict(frames.scene.system.parameters)["K"] < high
    frames.answer({"set": {"panel": "atlas", "across": "own:K", "up": "z"}})
    assert len(settled(frames, rest=True)["map"]["name"]) > 1
