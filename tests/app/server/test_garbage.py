"""A search through all that lives stops everybody: it waits until nobody waits."""

import gc

import pytest
from codim2_app.server.process import garbage


@pytest.mark.parametrize(
    ("left", "since", "looked"),
    [
        (garbage.SOME - 1, 60.0, 0),
        (garbage.SOME, 60.0, 1),
        (garbage.MOST - 1, garbage.QUIET - 0.01, 0),
        (garbage.MOST - 1, garbage.QUIET, 1),
        (garbage.MOST, 0.0, 1),
    ],
)
def test_it_is_looked_for_when_there_is_some_and_nobody_waits_or_there_is_much(monkeypatch, left, since, looked):
    done = []
    monkeypatch.setattr(garbage, "_asked", 0.0)
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0)
    garbage.asked()
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0 + since)
    monkeypatch.setattr(gc, "get_count", lambda: (5, 5, left))
    monkeypatch.setattr(gc, "collect", lambda: done.append(1))
    garbage.look()
    assert len(done) == looked


def test_python_looks_through_the_young_only():
    before = gc.get_threshold()
    try:
        garbage.keep_to_the_young()
        assert gc.get_threshold() == (*before[:2], garbage.NEVER)
    finally:
        gc.set_threshold(*before)


@pytest.mark.parametrize(("since", "looked"), [(garbage.REST - 0.01, 0), (garbage.REST, 1)])
def test_what_a_session_leaves_is_looked_for_once_at_rest(monkeypatch, since, looked):
    done = []
    monkeypatch.setattr(garbage, "_asked", 90.0)
    monkeypatch.setattr(garbage, "_ended", 0.0)
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0)
    monkeypatch.setattr(gc, "get_count", lambda: (5, 5, 0))
    monkeypatch.setattr(gc, "collect", lambda: done.append(1))
    garbage.look()
    assert not done
    garbage.ended()
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0 + since)
    garbage.look()
    garbage.look()
    assert len(done) == looked
