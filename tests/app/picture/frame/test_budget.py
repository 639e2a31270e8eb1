"""The thread that answers all visitors computes no layer of a typed system that is not known to be quick."""

import pickle
import time

import pytest
from codim2_app.picture.draw.layers import LAYERS
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.budget import (
    LAYER_BUDGET,
    MAX_EQUILIBRIA,
    WORDS,
    BackgroundLayers,
    Budget,
    PendingLayer,
    layers_of,
)
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.frame.work_queue import WorkQueue
from codim2_app.picture.state.controls import ExplorerState, preset_values
from codim2_app.view.refresh import Frames

from codim2_core.formulas.jit import policy

from .test_turns import Held

MILD = {"U1": "c - 1/2", "U2": "s"}
WILD = {"U1": "sin(k*c) - c", "U2": "s"}


def typed(texts=MILD, **more):
    return {**ExplorerState.from_values({"system": "own"}).values(), "texts": {**texts, "W": "0", "where": ""}, **more}


def budgeted(values):
    """Frames with a budget, and the executor that holds what they ask for."""
    executor = Held()
    frames = Frames(ExplorerState(**values), budget=Budget())
    frames.jobs = Jobs()
    frames.jobs._given = WorkQueue(executor)
    return frames, executor


def header(frames, **request):
    return unpack(frames.answer(request))[0]


def test_the_first_picture_of_a_formula_is_computed_next_to_the_frames():
    frames, executor = budgeted(typed(layers=["rho", "critical", "equator"]))
    first = header(frames, all=True)
    assert "picture" in first["late"]
    assert "portrait" not in first
    assert not frames.scene.runs  # nothing at all was computed here
    assert frames.pending is not None
    then = []
    while executor.given:
        executor.run()
        then.append(header(frames, rest=True))
    assert frames.pending is None
    assert "picture" not in then[-1].get("late", [])
    assert any(one.get("portrait", {}).get("name") for one in then)
    assert "left_out" not in then[-1]
    assert not frames.scene.runs


def test_what_was_quick_is_computed_with_the_frame_until_the_formula_is_wilder():
    values = typed(WILD, parameters={"k": 1.0}, layers=["critical", "equator"], panel="psi")
    scene, budget = make_scene(values), Budget()
    scene.ask_before(budget.check_cost)
    quick = dict.fromkeys(("equator", "equator_cycle", "critical", "location", "classification", "slow_flow"), 0.001)
    found = layers_of(pickle.loads(pickle.dumps(scene)), quick, {})
    budget.record_costs(scene, type(found)(found.results, quick, {}))
    assert len(scene.evolve(k=1.1)["equator"]) > 0  # computed here
    assert scene.runs["equator"] == 1
    with pytest.raises(PendingLayer):
        scene.evolve(k=1000.0)["equator"]
    budget.record_costs(scene, type(found)({}, dict.fromkeys(quick, 2 * LAYER_BUDGET), {}))
    with pytest.raises(PendingLayer):
        scene.evolve(k=1.2)["equator"]


def test_that_a_layer_has_become_quick_is_believed_by_halves():
    """A worker that has searched for one frame finds the same at once for the next, and this thread would search."""
    scene, budget = make_scene(typed()), Budget()
    scene.ask_before(budget.check_cost)
    for took in (8.0 * LAYER_BUDGET, 0.0, 0.0):
        budget.record_costs(scene, BackgroundLayers({}, {"location": 0.0, "equator": took}, {}))
        with pytest.raises(PendingLayer):
            scene["equator"]
    budget.record_costs(scene, BackgroundLayers({}, {"equator": 0.0}, {}))
    assert len(scene["equator"]) > 0


def test_a_formula_too_wild_to_draw_is_named_so():
    values = typed(WILD, parameters={"k": 400.0}, layers=["rho", "theta", "separatrices", "critical", "equator"])
    frames, executor = budgeted(values)
    header(frames, all=True)
    while executor.given:
        executor.run()
        last = header(frames, rest=True)
    assert "too complicated" in last["left_out"]
    assert f"at most {MAX_EQUILIBRIA}" in last["left_out"]
    assert "separatrices" in last["left_out"]
    assert last["left_out"].count("limit directions") == 1  # one reason, one sentence


def test_what_is_left_out_is_named_in_words():
    assert {part.scene for layer in LAYERS.values() for part in layer.parts} <= WORDS.keys()


@pytest.mark.parametrize("preset", ["case1-cm4", "case3-n3", "ball-slice"])
def test_frames_of_e_linear_systems_are_computed_at_once(preset):
    values = preset_values(preset) or preset_values("case1-cm4")
    frames, _ = budgeted({**values, "panel": "psi"})
    assert "picture" not in header(frames, all=True).get("late", [])


SPIRAL = {"a": -0.0489, "b": -28.19, "d": -0.0108, "f1": -0.9785, "f2": 0.2402, "psi": "hill", "n": 8.0}


def test_outcomes_of_a_slow_spiral_are_computed_next_to_the_frames_until_they_are_known_to_be_quick():
    values = {**preset_values("case2-saddle"), "layers": ["equator", "outcomes"], "panel": "planes"}
    frames, executor = budgeted(values)
    assert "picture" in header(frames, all=True)["late"]
    executor.run()
    header(frames, rest=True)
    frames.budget._timed[None][1]["outcomes"] = 0.001
    assert "picture" not in header(frames, set={"a": 2.1}).get("late", [])  # as quick as it was
    assert "picture" in header(frames, set=SPIRAL)["late"]  # winds for longer than any that was timed
    frames.budget.record_costs(frames.scene, BackgroundLayers({}, {"outcomes": 5 * LAYER_BUDGET}, {}))
    assert "picture" in header(frames, set={"a": -0.05})["late"]
    assert not frames.scene.runs["outcomes"] - 1


def test_orbits_that_are_launched_are_timed_before_they_are_computed_here():
    frames, executor = budgeted({**preset_values("case1-cm4"), "layers": ["launched"], "panel": "psi"})
    assert "picture" not in header(frames, all=True).get("late", [])  # there is none
    assert "picture" in header(frames, set={"orbits": "0.3,0.2"})["late"]
    executor.run()
    frames.budget._timed.clear()
    frames.budget.record_costs(frames.scene, BackgroundLayers({}, {"launched": 0.001}, {}))
    assert "picture" not in header(frames, set={"orbits": "0.31,0.2"}).get("late", [])


def test_each_layer_of_an_e_linear_system_is_timed_without_those_that_it_asks_for(monkeypatch):
    """What took long here is computed next to the next frame, and here again once it is quick: believed by halves."""
    clock = iter(range(1000))
    monkeypatch.setattr("codim2_app.picture.frame.budget.time.perf_counter", lambda: 0.01 * LAYER_BUDGET * next(clock))
    scene, budget = make_scene(preset_values("case1-cm4")), Budget()
    scene.ask_before(budget.check_cost)
    budget.begin()
    scene["classification"]
    _, took = budget._timed[None]
    assert took.keys() >= {"equator", "critical", "classification"}
    assert sum(took.values()) == pytest.approx(0.01 * LAYER_BUDGET * (next(clock) - 1))  # no second counted twice
    took["equator"] = 2 * LAYER_BUDGET
    with pytest.raises(PendingLayer):
        scene.evolve(f1=-0.6)["equator"]
    budget.record_costs(scene, BackgroundLayers({}, {"equator": 0.0}, {}))
    assert len(scene.evolve(f1=-0.7)["equator"]) > 0


def test_a_layer_is_slow_that_is_slow_twice_by_the_processors_time(monkeypatch):
    clocks = {"perf_counter": time.perf_counter, "thread_time": time.thread_time}
    scene, budget = make_scene(preset_values("case1-cm4")), Budget()
    scene.ask_before(budget.check_cost)

    def late(*names):
        for name, clock in clocks.items():
            monkeypatch.setattr(time, name, (lambda clock=clock: 1e4 * clock()) if name in names else clock)

    late("perf_counter")  # it waited for a processor
    for f1 in (-0.6, -0.61):
        scene.evolve(f1=f1)["equator"]
    assert budget._timed.get(None, (0, {}))[1].get("equator", 0.0) < LAYER_BUDGET
    late(*clocks)
    budget.begin()
    scene.evolve(f1=-0.62)["equator"]  # once: a kernel may have been loaded
    scene.evolve(f1=-0.63)["equator"]
    with pytest.raises(PendingLayer):
        scene.evolve(f1=-0.64)["equator"]


def test_while_kernels_run_as_python_no_layer_of_an_e_linear_system_is_taken_for_slow():
    """Each is computed here, though all are: a worker would wait for the compiled kernels."""
    scene, budget = make_scene(ExplorerState().values()), Budget()
    scene.ask_before(budget.check_cost)
    budget._timed[None] = 10**9, dict.fromkeys(("equator", "inside"), 2 * LAYER_BUDGET)
    policy.leave_to(lambda: True)
    try:
        assert len(scene["inside"].points)
        of_formulas = make_scene(typed())
        of_formulas.ask_before(budget.check_cost)
        with pytest.raises(PendingLayer):
            of_formulas["inside"]
    finally:
        policy.leave_to(None)
    with pytest.raises(PendingLayer):
        scene.evolve(f1=0.2)["inside"]
    assert budget._timed[None][1]["inside"] == 2 * LAYER_BUDGET


def test_all_that_panels_ask_of_other_processes_can_travel():
    """Each panel in turn, of a typed and of an e-linear system: calls and results are pickled and read again."""
    from codim2_app.panels.registry import PANELS_BY_NAME

    class Travels(Held):
        def submit(self, fn, /, *args, **kwargs):
            return super().submit(pickle.loads, pickle.dumps((fn, args)))

        def run(self):
            future, _, (data,) = self.given.pop(0)
            fn, args = pickle.loads(data)
            future.set_result(pickle.loads(pickle.dumps(fn(*args))))

    for start in (
        {"a": 172.0, "b": 186.0, "d": -200.0, "f1": -86.0, "f2": -93.0, "trajectories": 4},
        {"system": "own"},
    ):
        values = {**ExplorerState.from_values(start).values(), "layers": ["critical", "equator", "outcomes"]}
        frames, _ = budgeted(values)
        executor = Travels()
        frames.jobs._given = WorkQueue(executor)
        for key in PANELS_BY_NAME:
            said = header(frames, set={"panel": key}, rest=True)
            for _ in range(12):
                if not executor.given:
                    break
                executor.run()
                said = header(frames, rest=True)
            assert not any("fault" in str(why) for why in said.get("unable", {}).values())
