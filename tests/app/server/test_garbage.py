"""A search through all that lives stops everybody: it waits until nobody waits."""

import gc

import pytest
from codim2_app.server import garbage


@pytest.fixture
def done(monkeypatch):
    """What is done, at a time and with an amount of garbage that a test sets."""
    found = []
    monkeypatch.setattr(garbage, "_asked", 0.0)
    monkeypatch.setattr(gc, "collect", lambda: found.append("collect"))
    monkeypatch.setattr(gc, "freeze", lambda: found.append("freeze"))
    return found


def looked(monkeypatch, done, left, since, sessions):
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0)
    garbage.asked()
    monkeypatch.setattr(garbage.time, "monotonic", lambda: 100.0 + since)
    monkeypatch.setattr(gc, "get_count", lambda: (5, 5, left))
    garbage.look(lambda: sessions)
    return done


@pytest.mark.parametrize(
    ("left", "since", "sessions", "wanted"),
    [
        (garbage.SOME - 1, 60.0, 0, []),
        (garbage.SOME, 60.0, 0, ["collect", "freeze"]),
        (garbage.SOME, 60.0, 1, ["collect"]),  # what a visitor holds is not kept for good
        (garbage.MOST - 1, garbage.QUIET - 0.01, 1, []),
        (garbage.MOST - 1, garbage.QUIET, 1, ["collect"]),
        (garbage.MOST, 0.0, 1, ["collect"]),
    ],
)
def test_it_is_looked_for_when_there_is_some_and_nobody_waits_or_there_is_much(
    monkeypatch, done, left, since, sessions, wanted
):
    assert looked(monkeypatch, done, left, since, sessions) == wanted


def test_python_looks_through_the_young_only():
    before = gc.get_threshold()
    try:
        garbage.keep_to_the_young()
        assert gc.get_threshold() == (*before[:2], garbage.NEVER)
    finally:
        gc.set_threshold(*before)
