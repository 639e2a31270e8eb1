"""A search through all that lives stops everybody: it waits until nobody waits."""

import gc

import pytest
from codim2_app.server import page
from codim2_app.server.process import garbage


@pytest.fixture
def searched(monkeypatch):
    """What is done with all that lives, in its order, with nobody there and nothing left at the time 100."""
    done = []
    for name in ("_asked", "_ended", "_there"):
        monkeypatch.setattr(garbage, name, 0)
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0)
    monkeypatch.setattr(gc, "get_count", lambda: (5, 5, 0))
    for name in ("collect", "freeze", "unfreeze"):
        monkeypatch.setattr(gc, name, lambda name=name: done.append(name))
    return done


@pytest.mark.parametrize(
    ("left", "since", "looked"),
    [
        (garbage.SOME - 1, 60.0, []),
        (garbage.SOME, 60.0, ["collect"]),
        (garbage.MOST - 1, garbage.QUIET - 0.01, []),
        (garbage.MOST - 1, garbage.QUIET, ["collect"]),
        (garbage.MOST, 0.0, ["collect"]),
    ],
)
def test_it_is_looked_for_when_there_is_some_and_nobody_waits_or_there_is_much(
    monkeypatch, searched, left, since, looked
):
    garbage.asked()
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0 + since)
    monkeypatch.setattr(gc, "get_count", lambda: (5, 5, left))
    garbage.look()
    assert searched == looked


def test_from_the_start_python_looks_through_the_young_only_and_nobody_through_what_was_imported(searched):
    before = gc.get_threshold()
    try:
        garbage.begin()
        assert gc.get_threshold() == (*before[:2], garbage.NEVER)
        assert searched == ["freeze"]
    finally:
        gc.set_threshold(*before)


@pytest.mark.parametrize("others", [0, 1])
@pytest.mark.parametrize("since", [garbage.REST - 0.01, garbage.REST])
def test_what_a_session_leaves_is_looked_for_once_at_rest(monkeypatch, searched, others, since):
    """Through all that lives only if nobody is there: what is frozen of a session that goes on would stay for good."""
    for _ in range(1 + others):
        garbage.begun()
    garbage.look()
    assert not searched
    garbage.ended()
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0 + since)
    garbage.look()
    garbage.look()
    all_of_it = ["collect"] if others else ["unfreeze", "collect", "freeze"]
    assert searched == (all_of_it if since >= garbage.REST else [])


def test_kernels_are_no_garbage_once_all_are_there(searched):
    said = []
    for told in (None, lambda *what: said.append(what)):
        page._told(told, "motions", 0.1, 7, 8)
        assert searched == []
        page._told(told, "motions", 0.1, 8, 8)
        assert searched.pop() == "freeze"
    assert said == [("motions", 0.1, 7, 8), ("motions", 0.1, 8, 8)]
