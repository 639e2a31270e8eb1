"""A fault of the program: one sentence for the person, nothing of the server's insides, the traceback for the host."""

import logging
from dataclasses import replace

import pytest
from codim2_app.panels import registry
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame import faults
from codim2_app.picture.frame.faults import FAULT
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view import refresh
from codim2_app.view.refresh import Frames

SECRET = "/srv/secret/settings.py"


@pytest.fixture(autouse=True)
def nothing_logged_yet(monkeypatch):
    monkeypatch.setattr(faults, "_logged", set())


def broken(*_args, **_more):
    raise IndexError(SECRET)


def asked(frames, **values):
    answer = frames.answer({"set": values} if values else {"all": True})
    assert SECRET.encode() not in answer
    assert b"Traceback" not in answer
    assert b"IndexError" not in answer
    return unpack(answer)[0]


def told(caplog):
    (record,) = (r for r in caplog.records if r.levelno >= logging.ERROR)
    assert SECRET in caplog.text
    assert "Traceback" in caplog.text
    return record.getMessage()


def test_a_panel_that_fails_leaves_the_picture(monkeypatch, caplog):
    panel = registry.PANELS_BY_NAME["psi"]
    monkeypatch.setitem(registry.PANELS_BY_NAME, "psi", replace(panel, add=broken))
    header = asked(Frames(ExplorerState(panel="psi")))
    assert header["errors"] == {"": FAULT}
    assert header["portrait"]["name"]
    assert "the panel psi" in told(caplog)
    assert asked(Frames(ExplorerState(panel="atlas")))["errors"] == {}


def test_a_picture_that_fails_after_a_change_is_the_last_good_one(monkeypatch, caplog):
    frames = Frames(ExplorerState())
    asked(frames)
    whole = refresh.make_frame
    monkeypatch.setattr(refresh, "make_frame", lambda scene, values, *more: (
        broken() if values["f1"] == 0.25 else whole(scene, values, *more)))  # fmt: skip
    header = asked(frames, f1=0.25)
    assert header["errors"] == {"f1": FAULT}
    assert frames.values["f1"] != 0.25
    assert told(caplog)
    assert asked(frames, f1=0.5)["errors"] == {}
    assert frames.values["f1"] == 0.5


def test_a_picture_that_always_fails_is_a_sentence(monkeypatch, caplog):
    monkeypatch.setattr(refresh, "make_frame", broken)
    frames = Frames(ExplorerState())
    assert asked(frames)["errors"] == {"": FAULT}
    assert FAULT in asked(frames, f1=0.5)["errors"].values()
    assert told(caplog)  # once, however often the browser asks


def test_a_scene_that_cannot_be_made_opens_on_the_first_setting(monkeypatch, caplog):
    whole = refresh.make_scene
    monkeypatch.setattr(refresh, "make_scene", lambda values, system=None: (
        broken() if values["f1"] == 0.25 else whole(values, system)))  # fmt: skip
    frames = Frames(ExplorerState(f1=0.25))
    assert frames.values["f1"] != 0.25
    assert told(caplog)


def test_what_the_core_says_is_told_as_it_is(caplog):
    assert faults.sentence_of(ValueError("give a number."), "it") == "give a number."
    assert not caplog.records


def test_what_a_page_without_a_server_lacks_is_no_fault(caplog):
    error = ModuleNotFoundError("No module named 'scipy'", name="scipy.optimize")
    assert faults.sentence_of(error, "a panel") == "SciPy computes this; a page without a server does not have it."
    assert not caplog.records
