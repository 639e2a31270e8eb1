"""A search through what all visitors hold stops everybody: what lives is left out, what has ended is brought back."""

import gc
from types import SimpleNamespace
from weakref import ref

import panel as pn
import pytest
from codim2_app.server import page
from codim2_app.server.process import garbage
from codim2_app.server.process.garbage import BEHIND, MOST, QUIET, REST, SOME, STUCK, TRIES


class Root:
    """Something of a session."""


class Document(Root):
    def __init__(self, pending=()):
        self.session_callbacks = list(pending)


class Play:
    """A server that plays: its clock, what is done with all that lives, in its order, and what is brought back."""

    def __init__(self, monkeypatch):
        self.now, self.done, self.back, self.left, self.frozen = 100.0, [], [], 0, 1000
        self.searches, self.free = 0, True
        for name, value in {
            "_asked": 0.0, "_ended": 0.0, "_documents": [], "_left": [], "_stuck": 0, "_uncounted": 0, "_frozen": 1000,
            "_old": "old", "Old": lambda: self.done.append("old") or "new", "bring_back": self.bring_back,
            "give_back": lambda: self.done.append("give back"),
        }.items():  # fmt: skip
            monkeypatch.setattr(garbage, name, value)
        monkeypatch.setattr(garbage.time, "monotonic", lambda: self.now)
        monkeypatch.setattr(gc, "get_count", lambda: (5, 5, self.left))
        monkeypatch.setattr(gc, "get_freeze_count", lambda: self.frozen)
        monkeypatch.setattr(gc, "get_stats", lambda: [{}, {}, {"collections": self.searches}])
        monkeypatch.setattr(gc, "collect", self.collect)
        for name in ("freeze", "unfreeze"):
            monkeypatch.setattr(gc, name, lambda name=name: self.done.append(name))

    def collect(self):
        self.done.append("collect")
        self.searches += self.free

    def bring_back(self, roots, old):
        assert old == garbage._old
        self.back.append([type(root).__name__ for root in roots])

    def look(self, after=0.0):
        """Return what is done when it is looked once more, some seconds later."""
        self.now += after
        self.done.clear()
        garbage.look()
        return list(self.done)


@pytest.fixture
def play(monkeypatch):
    return Play(monkeypatch)


ALL = ["unfreeze", "collect", "give back", "old"]
ALL_BESIDE = ["unfreeze", "collect", "give back", "freeze"]
YOUNG = ["collect", "freeze"]
ENDED = [*YOUNG, "give back"]


@pytest.mark.parametrize(
    ("left", "quiet", "done"),
    [
        (SOME - 1, 60.0, []),
        (SOME, 60.0, YOUNG),
        (MOST - 1, QUIET - 0.01, []),
        (MOST - 1, QUIET, YOUNG),
        (MOST, 0.0, YOUNG),
    ],
)
def test_it_is_looked_for_when_there_is_some_and_nobody_waits_or_there_is_much(play, left, quiet, done):
    garbage.asked()
    play.left = left
    assert play.look(quiet) == done


def test_what_lives_is_frozen_unless_a_document_waits_for_a_callback(play):
    """Bokeh's callbacks are garbage as soon as they were called, and hold their document."""
    busy = Document(["a callback"])
    for document in (Document(), busy):
        garbage.begun(document)
    play.left = MOST
    assert play.look(60.0) == ["collect"]
    busy.session_callbacks.clear()
    assert play.look() == YOUNG


def test_from_the_start_python_looks_through_the_young_only_and_nobody_through_what_was_imported(play):
    before = gc.get_threshold()
    try:
        garbage.begin()
        assert gc.get_threshold() == (*before[:2], garbage.NEVER)
        assert play.done == ["old"]
        assert garbage._old == "new"
    finally:
        gc.set_threshold(*before)


def test_what_a_session_had_is_searched_after_a_while_when_nobody_waits_or_after_another(play):
    for quiet in (True, False):
        garbage.begun(Document())
        garbage.begun(document := Document())
        garbage.ended(document, Root())
        del document
        if not quiet:
            play.now += REST
            garbage.asked()
            play.now -= REST
        assert play.look(REST - 0.01) == []
        if not quiet:
            garbage.asked()
            assert play.look(0.01) == []
            play.now += REST - 0.01
            garbage.asked()
        assert play.look(0.01) == ENDED
        assert play.back.pop() == ["Document", "Root"]
        assert play.look(60.0) == []


def test_what_of_a_session_is_still_in_use_is_searched_again_each_time_after_twice_as_long(play):
    garbage.begun(Document())
    garbage.begun(document := Document())
    view = Root()
    garbage.ended(document, view)
    there = ref(document)
    del document
    found = []
    for tried in range(TRIES):
        after = REST * 2**tried
        assert play.look(after - 0.01) == []
        assert play.look(0.02) == ENDED
        found.append(play.back.pop())
    assert found == [["Document", "Root"], *[["Root"]] * (TRIES - 1)]
    assert there() is None
    assert garbage._stuck == 1
    assert play.look() == ALL_BESIDE  # nobody has asked for long
    assert play.look(1e4) == []


def test_a_session_that_is_in_use_keeps_none_of_the_others_waiting(play):
    garbage.begun(Document())
    garbage.begun(held := Document())
    garbage.ended(held)
    play.look(REST)
    garbage.begun(other := Document())
    garbage.ended(other)
    del other
    assert play.look(REST) == ENDED
    assert garbage._left[0].roots == [held]


def test_while_another_thread_searches_nothing_is_frozen_and_what_a_session_had_is_searched_once_it_is_done(play):
    """What is garbage would be frozen: a compiler's thread gives way in mid-search, and no other one begins then."""
    garbage.begun(Document())
    garbage.begun(document := Document())
    garbage.ended(document)
    play.free = False
    assert play.look(REST) == ["collect", "give back"]
    play.free = True
    assert play.look() == ENDED
    assert play.back == [["Document"]] * 2
    assert garbage._left[0].tried == 1


def test_of_many_sessions_that_are_due_two_are_searched_at_once_and_what_was_freed_is_given_back(play):
    """Where more ended than there are looks, they would pile up."""
    garbage.begun(Document())
    for _ in range(BEHIND + 2):
        garbage.begun(document := Document())
        garbage.ended(document, Root())
    del document
    play.now += REST
    for left in (BEHIND, BEHIND - 1):
        assert play.look() == ENDED
        assert len(garbage._left) == left
    assert [len(roots) for roots in play.back] == [4, 2]
    assert garbage._uncounted == 3


def test_all_that_lives_is_searched_once_nobody_is_there(play):
    garbage.begun(document := Document())
    garbage.ended(document)
    assert play.look(REST - 0.01) == []
    assert play.look(0.01) == ALL
    assert (garbage._left, garbage._old) == ([], "new")
    assert play.look(60.0) == []


@pytest.mark.parametrize("stuck", [STUCK - 1, STUCK])
def test_all_that_lives_is_searched_when_much_of_what_has_ended_is_in_use_for_ever(play, stuck):
    """So memory has a bound whatever holds a session, and though somebody always asks."""
    garbage.begun(there := Document())
    for _ in range(stuck):
        garbage.begun(document := Document())
        garbage.ended(document)
        garbage._left[-1].tried = TRIES - 1
        play.now += 2 * REST
        garbage.asked()
        done = play.look()
    assert there in garbage._documents
    assert done == [*ENDED, *(ALL_BESIDE if stuck == STUCK else ())]
    assert garbage._old == "old"  # what visitors hold is none of it
    assert garbage._stuck == stuck % STUCK


@pytest.mark.parametrize("quiet", [True, False])
@pytest.mark.parametrize("more", [0, 1])
def test_all_that_lives_is_searched_when_much_is_frozen(play, more, quiet):
    there = [Document(), Document()]
    for each in there:
        garbage.begun(each)
    play.frozen += garbage.FROZEN + 2 * garbage.OBJECTS + more

    def looked():
        play.now += 0.0 if quiet else 2 * REST
        if not quiet:
            garbage.asked()
        return play.look(REST if quiet else 0.0)

    for _ in range(garbage.COUNTED if quiet else 2 * garbage.COUNTED):
        assert looked() == []
        garbage.begun(document := Document())
        garbage.ended(document)
        del document
        assert looked() == ENDED
    assert looked() == (ALL_BESIDE if more else [])
    if more:
        assert garbage._frozen == play.frozen - 2 * garbage.OBJECTS
    play.frozen += 1
    assert looked() == []  # it was counted


def test_all_that_lives_is_searched_when_nobody_asks_if_something_of_one_session_is_in_use_for_ever(play):
    """A cycle that became garbage while it was frozen holds a session for ever, whatever is brought back of it."""
    garbage.begun(Document())
    garbage.begun(document := Document())
    garbage.ended(document)
    garbage._left[-1].tried = TRIES - 1
    assert play.look(REST) == ENDED
    garbage.asked()
    assert play.look(REST - 0.01) == []
    assert play.look(0.01) == ALL_BESIDE
    assert play.look(60.0) == []


def test_nothing_of_a_session_that_is_being_opened_counts_as_old(play):
    """What is old is held, until nobody is there the next time."""
    garbage.begun(document := Document())
    garbage.ended(document)
    garbage.begun(opening := Document())
    assert play.look(60.0) == ENDED
    garbage.begun(opening)
    garbage.ended(opening)
    assert play.look(60.0) == ALL


def test_panels_own_search_through_all_is_called_off(play):
    garbage.begun(document := Document())
    pn.state.schedule_task(garbage.PANELS, gc.collect, at=SimpleNamespace(timestamp=lambda: 1e12))
    garbage.ended(document)
    with pytest.raises(KeyError):
        pn.state.cancel_task(garbage.PANELS)


def test_kernels_are_no_garbage_once_all_are_there(play):
    said = []
    for told in (None, lambda *what: said.append(what)):
        page._told(told, "motions", 0.1, 7, 8)
        assert play.done == []
        page._told(told, "motions", 0.1, 8, 8)
        assert play.done.pop() == "freeze"
    assert said == [("motions", 0.1, 7, 8), ("motions", 0.1, 8, 8)]
