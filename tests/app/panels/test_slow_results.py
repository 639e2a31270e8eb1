"""Results that are computed beside the frames: shared, replaced by newer wishes, and refused with a sentence."""

import threading
import time
from concurrent.futures import Future

from codim2_app.frame.jobs import Jobs
from codim2_app.frame.turns import Failed


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


def test_a_newer_wish_replaces_one_that_has_not_begun():
    executor, ran = Later(), []
    jobs = Jobs(executor)
    key = object()
    assert jobs.ask("map", (key, 1), lambda: ran.append(1) or "one") is None
    assert jobs.ask("map", (key, 2), lambda: ran.append(2) or "two") is None
    executor.run()
    assert ran == [2]
    assert jobs.ask("map", (key, 2), lambda: "never") == "two"


def test_what_is_found_is_shared_between_browsers():
    executor, ran = Later(), []
    first, second, key = Jobs(executor), Jobs(executor), object()
    assert first.ask("map", key, lambda: ran.append(1) or "found") is None
    assert second.ask("map", key, lambda: ran.append(2) or "found again") is None
    executor.run()
    assert first.ask("map", key, lambda: None) == second.ask("map", key, lambda: None) == "found"
    assert ran == [1]


def test_a_refused_computation_is_a_sentence():
    executor = Later()
    jobs, key = Jobs(executor), object()

    def refuse():
        raise ValueError("give something else.")

    jobs.ask("map", key, refuse)
    executor.run()
    assert jobs.ask("map", key, refuse) == Failed("give something else.")


def test_a_fault_of_one_panel_is_logged_and_leaves_the_picture(caplog):
    executor = Later()
    jobs, key = Jobs(executor), object()
    jobs.ask("map", key, lambda: [][0])
    executor.run()
    assert "fault of the program" in jobs.ask("map", key, lambda: None).sentence
    assert "IndexError" in caplog.text


def test_jobs_run_beside_the_thread_that_answers():
    jobs, key, names = Jobs(), object(), []
    jobs.ask("map", key, lambda: names.append(threading.current_thread().name) or "done")
    deadline = time.monotonic() + 10
    while jobs.ask("map", key, lambda: "done") is None:
        assert time.monotonic() < deadline
        time.sleep(0.005)
    assert names[0].startswith("codim2-panels")
