"""The panels next to the picture: what is sent while one is open, and nothing while it is closed."""

import numpy as np
import pytest
from codim2_app.picture.draw.packing import unpack

import codim2_core as c2

from .opening import CASE3, OF_PANELS, ask, opened, settled


@pytest.mark.parametrize("panel", ["atlas", "numbers", "planes", "diagram", "theorems"])
def test_only_the_open_panel_is_sent(panel):
    _, header = opened(panel)
    expected = {
        "atlas": {"map", "thumbnails"},
        "numbers": {"outcomes"},
        "diagram": {"diagram", "cycles_along", "film"},
    }.get(panel, {panel})
    assert OF_PANELS & header.keys() == expected
    assert header.get("unable", {}) == {}


def test_a_closed_panel_costs_nothing():
    frames, _ = opened("planes")
    ask(frames, a=-1.3, f2=0.2)
    unpack(frames.answer({"rest": True}))
    assert not {"certificates", "outcomes"} & frames.scene.runs.keys()


def test_opening_a_panel_brings_what_it_shows_and_moving_keeps_it_right():
    frames, _ = opened("numbers")
    assert "map" in ask(frames, panel="atlas")["late"]
    assert ask(frames, panel="numbers").keys().isdisjoint(OF_PANELS)
    ask(frames, a=-1.4)
    header = ask(frames, panel="atlas")
    assert header["late"] == ["map"]
    assert settled(frames, rest=True).keys() >= {"map", "thumbnails"}


def test_slow_results_wait_for_rest_and_come_once():
    frames, _ = opened("diagram", along="f1")
    header = ask(frames, a=-1.7)
    assert header["late"] == ["diagram"]
    assert "diagram" in settled(frames, rest=True)
    header, _ = unpack(frames.answer({"rest": True}))
    assert "diagram" not in header
    assert "late" not in header


def test_planes_over_n_pass_through_the_papers_points():
    frames, header = opened("planes", **CASE3)
    found = header["planes"]
    marked = {text: i for i, text in enumerate(found["text"]) if text}
    assert list(marked) == ["n = 1", "n = 2", "n = 3", "n = 4"]
    kinds = ["stable node", "stable focus", "unstable focus", "unstable node"]
    assert [found["kind"][i] for i in marked.values()] == kinds
    for n, i in enumerate(marked.values(), 1):
        assert found["trace"][i] == pytest.approx(-71 + 32.25 * n, rel=1e-7)
        assert found["determinant"][i] == pytest.approx(147 + 36.75 * n, rel=1e-7)
    assert "planes" not in ask(frames, n=2.5)  # the curve is the same for every n
    assert "planes" in ask(frames, f1=-86.1)


def test_planes_of_another_psi_have_the_families_next_to_it():
    _, header = opened("planes", psi="rational")
    found = header["planes"]
    assert found["text"] == ["Ψ = 1", "exp(−s)", "s/sinh²√s", "3/(3 + (4s)ⁿ), n = 2"]
    (C,) = c2.critical_sets(c2.ELinear(-2, 0, -1, (-0.5, 0)), c2.psi.exponential())
    assert found["trace"][1] == pytest.approx(C.trace, rel=1e-7)
    assert found["determinant"][1] == pytest.approx(C.determinant, rel=1e-7)


def test_the_panel_of_psi_says_what_each_engine_makes_of_the_system():
    """The same contact sticks under two laws and chatters under the third, whatever Psi is drawn."""
    frames, header = opened("psi", a=200.0, b=200.0, d=-172.0, f1=-100.0, f2=-100.0)
    system = c2.ELinear(200, 200, -172, (-100, -100))
    laws = {name: (c2.psi.engine(name), 1.0) for name in ("mujoco", "drake", "ipc")}
    found = c2.compare_laws(system, laws)
    assert [row[2:] for row in header["engines"]] == [[v.verdict, v.trace, v.creep, v.chatter] for v in found]
    assert [row[2] for row in header["engines"]] == ["chatters", "sticks", "sticks"]
    assert header["engines"][0][:2] == ["MuJoCo, Genesis, Drake SAP", "max(1 - s, 0)"]
    assert "engines" not in ask(frames, psi="rational")
    ask(frames, f1=-80.0)
    assert settled(frames, rest=True)["engines"]


def test_theorems_are_evaluated_with_their_numbers():
    frames, header = opened("theorems")
    rows = {row[0]: row for row in header["theorems"]}
    assert rows["Theorem 4.3(c)"][2:4] == ["holds", "This portrait is CM4."]
    assert ["limit directions", 4.0] in rows["Theorem 4.3(c)"][4]
    assert all(np.isfinite(value) for row in rows.values() for _, value in row[4])
    assert rows["Theorem 4.4(a)"][2] == "does not apply"
    assert "theorems" not in ask(frames, trajectories=32)
    assert {row[0]: row for row in ask(frames, f1=3.0)["theorems"]}["Theorem 4.3(c)"][3] == "This portrait is NCM2."
    ask(frames, panel="numbers")
    runs = frames.scene.runs["certificates"]
    ask(frames, a=-1.5)
    assert frames.scene.runs["certificates"] == runs
