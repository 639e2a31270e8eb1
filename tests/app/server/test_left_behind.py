"""What was left out of searches for garbage is met again, once its session has ended."""

import gc
import weakref
from itertools import pairwise
from threading import Thread
from types import FunctionType

import pytest
from codim2_app.server.process.left_behind import MOST, Old, bring_back, reached


class Thing:
    pass


def ring(size):
    """Return one of some things that hold each other in a cycle, through attributes, dictionaries, lists and calls."""
    things = [Thing() for _ in range(size)]
    for i, thing in enumerate(things):
        before = things[i - 1]
        thing.held = ({"before": [before]}, (lambda before=before: before), {before})
    return things[0]


@pytest.fixture
def frozen():
    """A cycle that is frozen: what leads to it, and a weak reference; what is older."""
    shared = ring(3)
    gc.collect()
    old = Old()
    root = ring(20)
    root.shared = shared
    gc.collect()
    gc.freeze()
    roots, there = [root], weakref.ref(root)
    del root
    yield roots, there, old, shared
    gc.freeze()  # as it was: what the tests import


def test_what_is_frozen_is_not_met_by_a_search(frozen):
    roots, there, _, _ = frozen
    roots.clear()
    gc.collect()
    assert there() is not None


def test_what_was_brought_back_is_garbage_once_nobody_holds_it(frozen):
    roots, there, old, shared = frozen
    bring_back(roots, old)
    gc.collect()
    assert there() is not None
    gc.freeze()
    bring_back(roots, old)
    roots.clear()
    assert gc.collect() >= 20
    assert there() is None
    assert shared.held[1]()  # what was there before stays as it is


def test_what_somebody_else_holds_stays(frozen):
    roots, there, old, _ = frozen
    mine = roots[0].held
    bring_back(roots, old)
    roots.clear()
    gc.collect()
    assert mine[1]() is not None
    assert there() is not None  # the cycle leads back to it


def test_nothing_old_no_module_no_class_and_nothing_of_the_compiler_is_followed(frozen):
    roots, _, old, shared = frozen
    roots[0].module, roots[0].kind = gc, Thing
    roots[0].compiled = type("Compiled", (), {"__module__": "numba.core.x"})()
    roots[0].text, roots[0].number = "text", 3.0
    found = reached(roots, old)
    kinds = {type(thing) for thing in found}
    assert kinds >= {Thing, dict, tuple, list, set, FunctionType}
    assert len({id(thing) for thing in found}) == len(found)
    places = {id(thing) for thing in found}
    assert not places & {id(each) for each in (shared, gc, Thing, roots[0].compiled)}
    assert sum(type(thing) is Thing for thing in found) == 20


def test_so_many_things_are_followed_at_most():
    old = Old()
    try:
        far = [[i] for i in range(2 * MOST)]
        long = [[] for _ in range(2 * MOST)]
        for one, other in pairwise(long):
            one.append(other)
        assert len(reached([long[0]], old)) == MOST
        assert len(reached([far], old)) == 1 + 2 * MOST  # to the end of those that are as near
    finally:
        gc.freeze()


def test_another_thread_may_write_to_what_is_brought_back():
    """Between leaving a search and joining the next, a dictionary would join it twice: Python ends with that."""
    old = Old()
    try:
        kept = [{i: None} for i in range(2000)]
        over = []

        def write():
            while not over:
                for one in kept:
                    one[0] = []
                    one[0] = None

        thread = Thread(target=write)
        thread.start()
        for _ in range(30):
            bring_back([kept], old)
        over.append(True)
        thread.join()
        assert all(gc.is_tracked(one) for one in kept)
    finally:
        gc.freeze()


@pytest.mark.parametrize("searching", [True, False])
def test_pythons_own_search_is_left_as_it_was(frozen, searching):
    roots, _, old, _ = frozen
    was = gc.isenabled()
    try:
        (gc.enable if searching else gc.disable)()
        bring_back(roots, old)
        assert gc.isenabled() == searching
    finally:
        (gc.enable if was else gc.disable)()
