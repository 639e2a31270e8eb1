"""The panels beside the picture: what is sent while one is open, and nothing while it is closed."""

import threading
import time
from concurrent.futures import Future

import numpy as np
import pytest
from codim2_app.draw.packing import unpack
from codim2_app.draw.svg import draw
from codim2_app.draw.thumbnails import thumbnails
from codim2_app.frame.jobs import Jobs
from codim2_app.frame.turns import Failed
from codim2_app.panels import theorems
from codim2_app.panels.parameters import axes
from codim2_app.slow_layers import outcomes
from codim2_app.state.choices import AXES
from codim2_app.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2

CASE3 = {"a": 172.0, "b": 186.0, "d": -200.0, "f1": -86.0, "f2": -93.0, "psi": "hill", "n": 3.0}
OF_PANELS = {"regions", "atlas_size", "curves_of_psi", "thumbnails", "outcomes", "planes", "diagram", "theorems",
             "cycles_along", "map"}  # fmt: skip


def opened(panel, **values):
    frames = Frames(ExplorerState(panel=panel, **values))
    return frames, settled(frames, all=True)


def settled(frames, **request):
    """Ask as the browser does at rest, until nothing is late; return all headers merged."""
    merged, blocks = unpack(frames.answer(request))
    deadline = time.monotonic() + 60
    late = merged.pop("late", [])
    while late:
        assert time.monotonic() < deadline, late
        time.sleep(0.01)
        header, more = unpack(frames.answer({"rest": True}))
        late = header.pop("late", [])
        merged |= header
        blocks |= more
    return merged


def ask(frames, **values):
    return unpack(frames.answer({"set": values}))[0]


@pytest.mark.parametrize("panel", ["atlas", "numbers", "planes", "diagram", "theorems"])
def test_only_the_open_panel_is_sent(panel):
    _, header = opened(panel)
    expected = {
        "atlas": {"regions", "atlas_size", "curves_of_psi", "thumbnails"},
        "numbers": {"outcomes"},
        "diagram": {"diagram", "cycles_along"},
    }.get(panel, {panel})
    assert OF_PANELS & header.keys() == expected
    assert header.get("unable", {}) == {}


def test_a_closed_panel_costs_nothing():
    frames, _ = opened("planes")
    ask(frames, a=-1.3, f2=0.2)
    unpack(frames.answer({"rest": True}))
    assert not {"certificates", "outcomes", "atlas_curves", "regions"} & frames.scene.runs.keys()


def test_opening_a_panel_brings_what_it_shows_and_moving_keeps_it_right():
    frames, _ = opened("numbers")
    assert "atlas_size" in ask(frames, panel="atlas")
    assert ask(frames, panel="numbers").keys().isdisjoint(OF_PANELS)
    ask(frames, a=-1.4)
    header = ask(frames, panel="atlas")
    assert set(header["late"]) == {"regions", "curves of psi", "thumbnails"}
    assert settled(frames, rest=True).keys() >= {"regions", "curves_of_psi", "thumbnails"}


def test_slow_results_wait_for_rest_and_come_once():
    frames, _ = opened("diagram", along="f1")
    header = ask(frames, a=-1.7)
    assert header["late"] == ["diagram"]
    assert "diagram" in settled(frames, rest=True)
    header, _ = unpack(frames.answer({"rest": True}))
    assert "diagram" not in header
    assert "late" not in header


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


def test_diagram_over_n_has_the_papers_hopf_value():
    _, header = opened("diagram", along="n", **CASE3)
    hopf = [s["value"] for s in header["diagram"]["special"] if s["kind"] == "Hopf"]
    assert hopf == [pytest.approx(284 / 129, abs=1e-12)]
    kinds = [b["kind"] for b in header["diagram"]["critical"]]
    assert kinds == ["stable node", "stable focus", "unstable focus", "unstable node"]


def test_cycles_along_n_are_born_at_the_hopf_point():
    _, header = opened("diagram", along="n", **CASE3)
    (piece,) = header["cycles_along"]["pieces"]
    assert piece["stable"] is True
    assert piece["x"][0] == pytest.approx(284 / 129, abs=1e-6)
    assert piece["y"][0] == 0.0
    assert piece["x"][-1] == 6.0
    (cycle,) = c2.limit_cycles(c2.ELinear(172, 186, -200, (-86, -93)), c2.psi.hill(3))
    assert np.interp(3.0, piece["x"], piece["period"]) == pytest.approx(cycle.period, rel=3e-3)
    assert header["cycles_along"]["special"] == []


def test_where_there_can_be_no_cycle_the_reason_is_said():
    _, header = opened("diagram", along="f1")
    assert header["cycles_along"]["pieces"] == []
    assert "Bendixson" in header["cycles_along"]["sentence"]


def test_what_cannot_be_varied_is_said():
    _, header = opened("diagram", along="n")
    assert "Ψ = 3/(3 + (4s)ⁿ)" in header["unable"]["diagram"]
    frames = Frames(ExplorerState(panel="diagram", along="a"), c2.ELinear("-1 + z", 0, -2, (0.2, 0.3), g=("z1",)))
    assert "given by your system" in settled(frames, all=True)["unable"]["diagram"]


@pytest.mark.parametrize("name", AXES)
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


def test_the_atlas_of_two_slow_variables_has_the_disc_in_which_the_ball_sticks():
    frames = Frames(ExplorerState.of({"system": "ball_in_pool", "panel": "atlas"}))
    header = settled(frames, all=True, rest=True)
    assert header["atlas_of"] == ["z", "z2", False]
    assert set(header["map"]["name"]) == {"CM2, stable node", "NCM2"}


def test_an_axis_that_is_no_name_is_refused():
    frames = Frames(ExplorerState())
    for bad in ("own:", "own:1/0", "q", 3, None):
        assert list(ask(frames, along=bad)["errors"]) == ["along"]


def test_planes_over_n_pass_through_the_papers_points():
    frames, header = opened("planes", **CASE3)
    found = header["planes"]
    marked = {text: i for i, text in enumerate(found["text"]) if text}
    assert list(marked) == ["n = 1", "n = 2", "n = 3", "n = 4"]
    assert [found["kind"][i] for i in marked.values()] == [
        "stable node",
        "stable focus",
        "unstable focus",
        "unstable node",
    ]
    for n, i in enumerate(marked.values(), 1):
        assert found["trace"][i] == pytest.approx(-71 + 32.25 * n, rel=1e-7)
        assert found["determinant"][i] == pytest.approx(147 + 36.75 * n, rel=1e-7)
    assert "planes" not in ask(frames, n=2.5)  # the curve is the same for every n
    assert "planes" in ask(frames, f1=-86.1)


def test_planes_of_another_psi_have_the_families_beside_it():
    _, header = opened("planes", psi="rational")
    found = header["planes"]
    assert found["text"] == ["Ψ = 1", "exp(−s)", "s/sinh²√s", "3/(3 + (4s)ⁿ), n = 2"]
    (C,) = c2.critical_sets(c2.ELinear(-2, 0, -1, (-0.5, 0)), c2.psi.exponential())
    assert found["trace"][1] == pytest.approx(C.trace, rel=1e-7)
    assert found["determinant"][1] == pytest.approx(C.determinant, rel=1e-7)


def test_outcomes_are_live_where_a_theorem_answers_and_at_rest_otherwise():
    frames, header = opened("numbers")
    assert header["outcomes"]["kind"] == ["slide"] * 4
    header = ask(frames, f1=3.0)
    assert "late" not in header
    assert set(header["outcomes"]["kind"]) == {"misses"}
    header = ask(frames, **CASE3)
    assert header["late"] == ["outcomes"]
    header = settled(frames, rest=True)
    assert header["outcomes"]["kind"] == ["slide", "misses", "misses", "slide"]
    label, kind, _, sentence, families = header["outcomes"]["rows"][0]
    assert (label, kind) == ("Q₁", "slide")
    assert sentence.endswith("the slow flow is the same.")
    assert [words for words, _ in families] == ["slides on C", "slides around cycle 1"]


def test_the_ring_is_the_circle_cut_at_the_limit_directions():
    for values in ({}, {"f1": 3.0}, {"b": 3.0}, {"a": 1.0, "b": 0.0, "d": -1.0}):
        frames = Frames(ExplorerState(panel="numbers", **values))
        arcs = settled(frames, all=True)["outcomes"]
        assert sum(np.subtract(arcs["end"], arcs["start"])) == pytest.approx(2 * np.pi)
        assert set(arcs["kind"]) <= outcomes.WORDS.keys()


def test_the_ring_is_sent_when_its_layer_is_on_whatever_is_open():
    frames, header = opened("theorems")
    assert "outcomes" not in header
    assert "outcomes" in ask(frames, layers=["outcomes", "inside"])


def test_the_first_picture_has_the_ring():
    layers = ["outcomes", "inside"]
    hidden = draw(Frames(ExplorerState()).answer({"all": True}), layers)
    shown = draw(Frames(ExplorerState(layers=layers)).answer({"all": True}), layers)
    assert "var(--slide)" not in hidden
    assert shown.count("var(--slide)") == 4


def test_theorems_are_evaluated_with_their_numbers():
    frames, header = opened("theorems")
    rows = {row[0]: row for row in header["theorems"]}
    assert rows["Theorem 4.3(c)"][2:4] == ["holds", "This one is CM4."]
    assert ["limit directions", 4.0] in rows["Theorem 4.3(c)"][4]
    assert rows["Theorem 4.4(a)"][2] == "does not apply"
    assert "theorems" not in ask(frames, trajectories=32)
    assert {row[0]: row for row in ask(frames, f1=3.0)["theorems"]}["Theorem 4.3(c)"][3] == "This one is NCM2."
    ask(frames, panel="numbers")
    runs = frames.scene.runs["certificates"]
    ask(frames, a=-1.5)
    assert frames.scene.runs["certificates"] == runs


def test_numbers_of_certificates_are_finite():
    for name in ("case1-cm4", "case2-saddle", "case3-n3"):
        preset = c2.presets[name]
        system = c2.ELinear(preset.a, preset.b, preset.d, (preset.f1, preset.f2))
        for *_, numbers in theorems.rows(c2.certificates(system, c2.psi.rational())):
            assert all(np.isfinite(value) for _, value in numbers)


def test_each_region_has_a_small_portrait_of_its_own():
    _, header = opened("atlas")
    tiles = header["thumbnails"]
    assert [tile[1] for tile in tiles] == header["regions"]["name"]
    assert [tile[0] for tile in tiles] == list(range(len(tiles)))
    for _, name, (f1, f2), svg in tiles:
        assert c2.classify(c2.ELinear(-2, 0, -1, (f1, f2)), c2.psi.constant()).name == name
        assert svg.startswith("<svg")
        assert len(svg) < 8000
        assert "NaN" not in svg


MAPS = [("a", "d", {}), ("z", "b", {}), ("n", "f1", CASE3), ("f2", "f1", {})]


@pytest.mark.parametrize(("across", "up", "values"), MAPS)
def test_any_two_parameters_make_a_map(across, up, values):
    frames, header = opened("atlas", across=across, up=up, **values)
    found = header["map"]
    assert header["atlas_of"] == [across, up, False]
    for axis, (low, high) in zip((across, up), found["spans"], strict=True):
        assert low <= frames.values[axis] <= high
    assert sum(found["loops"]) >= len(found["name"]) > 1
    own = {"a": -2.0, "b": 0.0, "d": -1.0, "f1": -0.5, "f2": 0.0, **values}
    for name, place in zip(found["name"], found["inside"], strict=True):
        at = {**own, "k1": 0.5, "z": 0.0, **dict(zip((across, up), place, strict=True))}
        system = c2.ELinear(at["a"], at["b"], at["d"], (at["f1"] + at["k1"] * at["z"], at["f2"]))
        portrait = c2.classify(system, c2.psi.hill(at["n"]) if "n" in at else c2.psi.constant())
        assert name.split(",")[0] == portrait.name
    assert {tile[0] for tile in header["thumbnails"]} <= set(range(len(found["name"])))
    for region, name, place, _ in header["thumbnails"]:
        assert (name, place) == (found["name"][region], found["inside"][region])


def test_moving_along_the_axes_of_a_map_asks_for_no_new_one():
    frames, _ = opened("atlas", across="a", up="d")
    for change in ({"a": 1.0}, {"d": 2.0}, {"a": -3.9, "d": 3.9}, {"B1": 2.0}):
        assert "late" not in ask(frames, **change), change
    assert set(ask(frames, b=0.1)["late"]) == {"map"}


def test_a_part_of_the_plane_of_f_is_mapped():
    frames, header = opened("atlas", atlas_zoom=2)
    assert header["atlas_of"] == ["f1", "f2", False]
    (left, right), (low, high) = header["map"]["spans"]
    assert right - left == high - low == pytest.approx(6 / 16)
    assert left < -0.5 < right
    assert "late" not in ask(frames, f1=-0.45)  # well inside still
    assert "map" in ask(frames, f1=1.0)["late"]
    assert "regions" in ask(frames, atlas_zoom=0)["late"]


def test_axes_that_make_no_map_are_said():
    assert "two different" in opened("atlas", across="a", up="a")[1]["unable"]["map"]
    assert "3/(3 + (4s)ⁿ)" in opened("atlas", across="n", up="a")[1]["unable"]["map"]


def test_thumbnails_are_marked_as_the_portrait():
    system = c2.ELinear(-2, 0, -1).at()
    ((_, _, _, svg),) = thumbnails(system, c2.psi.constant(), (), ("f1", "f2"), [(0, "CM4", (0.0, 0.0))])
    assert svg.count('stroke="var(--attr)"') == 4
    assert svg.count('stroke="var(--crit)" stroke-width="4" fill="var(--crit)"') == 1


class Later:
    """An executor that runs what it was given when told to."""

    def __init__(self):
        self.given = []

    def submit(self, function, *arguments):
        future = Future()
        self.given.append((future, function, arguments))
        return future

    def run(self):
        for future, function, arguments in self.given:
            if future.set_running_or_notify_cancel():
                future.set_result(function(*arguments))
        self.given = []


def test_a_newer_wish_replaces_one_that_has_not_begun():
    executor, ran = Later(), []
    jobs = Jobs(executor)
    key = object()
    assert jobs.ask("map", (key, 1), lambda: ran.append(1) or "one") is None
    assert jobs.ask("map", (key, 2), lambda: ran.append(2) or "two") is None
    executor.run()
    assert ran == [2]
    assert jobs.ask("map", (key, 2), lambda: "never") == "two"


def test_what_is_found_is_shared_between_browsers():
    executor, ran = Later(), []
    first, second, key = Jobs(executor), Jobs(executor), object()
    assert first.ask("map", key, lambda: ran.append(1) or "found") is None
    assert second.ask("map", key, lambda: ran.append(2) or "found again") is None
    executor.run()
    assert first.ask("map", key, lambda: None) == second.ask("map", key, lambda: None) == "found"
    assert ran == [1]


def test_a_refused_computation_is_a_sentence():
    executor = Later()
    jobs, key = Jobs(executor), object()

    def refuse():
        raise ValueError("give something else.")

    jobs.ask("map", key, refuse)
    executor.run()
    assert jobs.ask("map", key, refuse) == Failed("give something else.")


def test_a_fault_of_one_panel_is_logged_and_leaves_the_picture(caplog):
    executor = Later()
    jobs, key = Jobs(executor), object()
    jobs.ask("map", key, lambda: [][0])
    executor.run()
    assert "fault of the program" in jobs.ask("map", key, lambda: None).sentence
    assert "IndexError" in caplog.text


def test_jobs_run_beside_the_thread_that_answers():
    jobs, key, names = Jobs(), object(), []
    jobs.ask("map", key, lambda: names.append(threading.current_thread().name) or "done")
    deadline = time.monotonic() + 10
    while jobs.ask("map", key, lambda: "done") is None:
        assert time.monotonic() < deadline
        time.sleep(0.005)
    assert names[0].startswith("codim2-panels")
