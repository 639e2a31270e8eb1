"""Threads that compile wait while a visitor is answered, for as long as they have compiled and no longer."""

from concurrent.futures import ThreadPoolExecutor

import pytest
from codim2_app.server.process import compile_throttle
from codim2_app.server.process.compile_throttle import LOOK, MAX_PAUSE_SECONDS, Answering, stand_back
from numba import njit
from numba.core import event


class Clock:
    """Time that passes while somebody sleeps, or is told to."""

    def __init__(self):
        self.now = 100.0
        self.when = []  # what happens, and when

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds
        while self.when and self.when[0][0] <= self.now:
            self.when.pop(0)[1]()


@pytest.fixture
def clock(monkeypatch):
    found = Clock()
    monkeypatch.setattr(compile_throttle, "time", found)
    return found


@pytest.fixture
def answering(monkeypatch):
    found = Answering()
    monkeypatch.setattr(compile_throttle, "answering", found)
    return found


def passes(clock, before, takes):
    """Let passes begin one after the other in another thread; return how long each was put off."""

    def compile_():
        waited = []
        for seconds in takes:
            began = clock.now
            before.on_start(None)
            waited.append(clock.now - began)
            clock.now += seconds
            before.on_end(None)
        return waited

    with ThreadPoolExecutor(1) as pool:
        return pool.submit(compile_).result()


def test_a_pass_waits_until_the_answer_has_gone(clock, answering):
    answering.__enter__()
    clock.when = [(100.01, lambda: answering.__exit__())]
    first, second = passes(clock, compile_throttle._Before(), [0.001, 0.001])
    assert first == pytest.approx(0.01, abs=2 * LOOK)
    assert second == 0.0


def test_it_waits_for_no_longer_than_it_has_compiled(clock, answering):
    """Or a process that always answers would never compile."""
    with answering:
        waited = passes(clock, compile_throttle._Before(), [0.004, 0.2, 0.004, 0.0])
    assert waited == pytest.approx([MAX_PAUSE_SECONDS, 0.004, MAX_PAUSE_SECONDS, 0.004], abs=2 * LOOK)


class Told(event.Listener):
    """Notes the passes that begin."""

    def __init__(self):
        self.passes = []

    def on_start(self, told):
        self.passes.append(told)

    def on_end(self, told):
        pass


def test_numba_tells_before_each_pass_and_only_once(monkeypatch):
    listener = Told()
    monkeypatch.setattr(compile_throttle, "_Before", lambda: listener)
    stand_back.cache_clear()
    stand_back()
    stand_back()
    try:
        njit(lambda x: x + 1)(1)
    finally:
        event.unregister("numba:run_pass", listener)
        stand_back.cache_clear()
    assert len(listener.passes) > 10
    assert len(set(map(id, listener.passes))) == len(listener.passes)
