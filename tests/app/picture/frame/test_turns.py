"""Who is served next, what is shared, and what ends when nobody wants it any more."""

import gc
import threading
import weakref
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future

import pytest
from codim2_app.picture.frame.background_results import Jobs
from codim2_app.picture.frame.work_queue import MAX_KEPT_RESULTS, FailedResult, KeptResults, WorkQueue, result_size


class Held(Executor):
    """Runs nothing until told to; a future that is cancelled while it runs is noted."""

    def __init__(self):
        self.given, self.stopped = [], []

    def submit(self, fn, /, *args, **kwargs):
        assert not kwargs

        class Noted(Future):
            def cancel(inner):
                self.stopped.append(args)
                return super().cancel()

        future = Noted()
        future.set_running_or_notify_cancel()
        self.given.append((future, fn, args))
        return future

    def run(self):
        future, fn, args = self.given.pop(0)
        future.set_result(fn(*args))
        return args[1:] or args


def names(executor):
    done = []
    while executor.given:
        done.append(executor.run()[0])
    return done


def test_browsers_take_turns():
    executor = Held()
    turns = WorkQueue(executor, 1)
    for i in range(3):
        turns.want("greedy", ("g", i), str, f"greedy {i}")
    turns.want("modest", "m", str, "modest")
    assert names(executor) == ["greedy 0", "modest", "greedy 1", "greedy 2"]
    assert turns.pending == 0


def test_nobody_has_two_at_a_time():
    executor = Held()
    turns = WorkQueue(executor, 2)
    for i in range(3):
        turns.want("greedy", ("g", i), str, f"greedy {i}")
    assert len(executor.given) == 1
    turns.want("modest", "m", str, "modest")
    assert [args[1] for _, _, args in executor.given] == ["greedy 0", "modest"]


def test_what_several_want_is_computed_once_and_ends_with_the_last_of_them():
    executor = Held()
    turns = WorkQueue(executor, 1)
    first, second = turns.want("a", "key", str, "once"), turns.want("b", "key", str, "once")
    assert first is second
    assert len(executor.given) == 1
    turns.drop("a", "key")
    assert not executor.stopped
    turns.leave("b")
    assert len(executor.stopped) == 1
    assert turns.pending == 0


def test_what_a_newer_wish_replaces_goes_on_for_a_second_as_another_worker_would_have_to_begin(monkeypatch):
    executor, now = Held(), [100.0]
    monkeypatch.setattr("codim2_app.picture.frame.work_queue.time.monotonic", lambda: now[0])
    jobs = Jobs(executor)
    assert jobs.ask("picture", 1, str, "old") is None
    assert jobs.ask("picture", 2, str, "new") is None
    assert not executor.stopped
    assert names(executor) == ["old", "new"]
    assert jobs.ask("picture", 2, str, "new") == "new"
    jobs.ask("picture", 3, str, "long")
    jobs.ask("picture", 4, str, "newer")
    now[0] += 0.9
    jobs.ask("picture", 4, str, "newer")
    assert not executor.stopped
    now[0] += 0.2
    jobs.ask("picture", 4, str, "newer")
    assert [args[1] for args in executor.stopped] == ["long"]


def test_what_a_newer_wish_replaced_ends_with_its_page():
    executor = Held()
    jobs = Jobs(executor)
    for key in (1, 2):
        jobs.ask("picture", key, str, f"{key}")
    jobs.leave()
    assert [args[1] for args in executor.stopped] == ["1"]
    assert names(executor) == ["1"]


def test_what_waits_is_never_begun_for_those_who_left():
    executor = Held()
    turns = WorkQueue(executor, 1)
    turns.want("a", 1, str, "first")
    turns.want("b", 2, str, "second")
    turns.leave("b")
    assert names(executor) == ["first"]


class Fails(Executor):
    def __init__(self, *errors):
        self.errors = list(errors)

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        if self.errors:
            future.set_exception(self.errors.pop(0))
        else:
            future.set_result(fn(*args, **kwargs))
        return future


def test_a_lost_worker_is_tried_once_more():
    assert WorkQueue(Fails(BrokenExecutor()), 1).want("a", 1, str, "done").result(0) == "done"
    twice = WorkQueue(Fails(BrokenExecutor(), BrokenExecutor()), 1).want("a", 1, str, "done").result(0)
    assert isinstance(twice, FailedResult)
    assert "ended" in twice.sentence


@pytest.mark.parametrize("error", [TimeoutError("This takes longer than 60 s, and was stopped."), RuntimeError("?")])
def test_what_fails_is_a_sentence(error):
    found = WorkQueue(Fails(error), 1).want("a", 1, str, "done").result(0)
    assert isinstance(found, FailedResult)
    assert found.sentence.endswith(".")


@pytest.mark.parametrize("error", [None, CancelledError(), TimeoutError(), RuntimeError("?")])
@pytest.mark.parametrize("wanted", [True, False])
def test_what_is_done_holds_nobody_who_waited_for_it(error, wanted):
    """At once: a cycle would be left to a search for garbage, and hold a page's session till then."""

    class Page:
        def told(self, _):
            pass

    executor = Held()
    turns = WorkQueue(executor, 1)
    page = Page()
    turns.want(1, "key", str, "x").add_done_callback(page.told)
    if not wanted:
        turns.leave(1)
    for _ in range(2):  # what is lost is tried once more
        if executor.given and error is not None:
            future, _, _ = executor.given.pop(0)
            future.set_exception(error)
            del future
        elif executor.given:
            executor.run()
    held = weakref.ref(page)
    gc.disable()
    try:
        del page
        assert held() is None
    finally:
        gc.enable()


def test_results_are_bounded_in_number_and_in_size():
    kept = KeptResults(most_bytes=10_000)
    for i in range(3 * MAX_KEPT_RESULTS):
        kept.put(i, (one := "x"), result_size(one))
    assert len(kept) == MAX_KEPT_RESULTS
    for i in range(20):
        kept.put(("big", i), (one := b"x" * 3_000), result_size(one))
    assert len(kept) == 3
    assert 9_000 < kept.size <= 10_000
    kept.put("too big", (one := b"x" * 20_000), result_size(one))
    assert kept.get("too big") is None
    assert kept.get(("big", 19)) is not None
    kept.put("of unknown size", (one := lambda: 1), result_size(one))
    assert kept.get("of unknown size") is None


def test_when_what_computes_has_been_shut_down_what_waits_is_given_up_without_a_word(caplog):
    """As at the end of a process: the work under way ends, and others wait."""
    executor = Held()
    turns = WorkQueue(executor, 1)
    first = turns.want("one", 1, str, "first")
    second = turns.want("two", 2, str, "second")

    def refuse(*_):
        raise RuntimeError("cannot schedule new futures after interpreter shutdown")

    executor.submit = refuse
    executor.run()
    assert first.result(10) == "first"
    assert not second.done()
    assert not caplog.records
    turns.want("three", 3, str, "third")
    assert turns.result(1) == "first"


class Large:
    """A result that notes, while it is pickled, whether another thread can ask the queue for one."""

    def __init__(self, queue):
        self.queue, self.free = queue, []

    def __reduce__(self):
        asking = threading.Thread(target=lambda: self.free.append(self.queue.result("x")), daemon=True)
        asking.start()
        asking.join(0.5)
        self.free.append("pickled")
        return str, ()


def test_who_answers_visitors_waits_for_no_result_to_be_pickled():
    executor = Held()
    queue = WorkQueue(executor, 1)
    large = Large(queue)
    queue.want("a", 1, lambda: large)
    executor.run()
    assert large.free[:2] == [None, "pickled"]
