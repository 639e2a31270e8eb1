"""Results that are computed next to the frames: shared, replaced by newer wishes, and refused with a sentence."""

from concurrent.futures import Future

import pytest
from codim2_app.panels import registry
from codim2_app.panels.panel import Panel
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame import budget
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.budget import Budget
from codim2_app.picture.frame.work_queue import FailedResult
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames


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


def test_a_refused_computation_is_a_sentence():
    executor = Later()
    jobs, key = Jobs(executor), object()

    def refuse():
        raise ValueError("give something else.")

    jobs.ask("map", key, refuse)
    executor.run()
    assert jobs.ask("map", key, refuse) == FailedResult("give something else.")


def test_a_fault_of_one_panel_is_logged_and_leaves_the_picture(caplog):
    executor = Later()
    jobs, key = Jobs(executor), object()
    jobs.ask("map", key, lambda: [][0])
    executor.run()
    assert "fault of the program" in jobs.ask("map", key, lambda: None).sentence
    assert "IndexError" in caplog.text


@pytest.fixture
def typed():
    """What the page of a typed Psi is sent, where slow layers are computed when told to; and what computes them."""
    frames, executor = Frames(ExplorerState(psi="custom", psi_text="1/(1+s)**2"), budget=Budget()), Later()
    frames.jobs = Jobs(executor)
    return frames, executor


def at_rest(frames, executor=None, **request):
    """Return header and names of the layers of the frame at rest, after what was asked for has been computed."""
    if executor is not None:
        executor.run()
    header, blocks = unpack(frames.answer({"id": 1, "rest": True, **request}))
    return header, {name.split(".")[0] for name in blocks}


def test_the_map_of_a_typed_psi_comes_however_late_it_is(typed):
    frames, executor = typed
    first, _ = at_rest(frames, all=True, set={"panel": "atlas"})
    assert "map" not in first
    assert first["late"]
    sent = [header["map"]["name"] for header, _ in [at_rest(frames, executor) for _ in range(5)] if "map" in header]
    curves, regions = sent
    assert curves == []
    assert sorted(name.split(",")[0] for name in regions) == ["CM2", "CM2", "CM4", "NCM2"]


def test_a_panel_that_cannot_be_drawn_yet_is_asked_again(typed, monkeypatch):
    frames, executor = typed

    def add(draft):
        if draft.fresh("one", 1):
            draft.header["one"] = draft.scene["certificates"] is not None

    monkeypatch.setitem(registry.PANELS_BY_NAME, "psi", Panel("psi", "One", add))
    told = [at_rest(frames, executor, set={"panel": "psi"})[0].get("one") for _ in range(5)]
    assert told.count(True) == 1
    assert told[0] is None


def test_what_a_panel_lacks_of_a_wild_system_is_said_below_the_picture(typed, monkeypatch):
    frames, executor = typed

    def add(draft):
        draft.header["one"] = draft.scene["certificates"] is not None

    monkeypatch.setitem(registry.PANELS_BY_NAME, "psi", Panel("psi", "One", add))
    monkeypatch.setattr(budget, "wild", lambda scene: "it is wild")
    told = [at_rest(frames, executor, set={"panel": "psi"})[0].get("left_out", "") for _ in range(5)]
    assert "theorems" in told[-1]
    assert "it is wild" in told[-1]
