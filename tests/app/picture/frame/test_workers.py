"""Processes next to the frames: what they compute, and that they stop."""

import gc
import os
import signal
import subprocess
import sys
import time
import weakref
from concurrent.futures import CancelledError, wait
from pathlib import Path

import pytest
from codim2_app.picture.frame import workers as module
from codim2_app.picture.frame.workers import Stopped, Workers

from tests.work import PATIENCE, wait_until


@pytest.fixture(scope="module")
def workers():
    with Workers(1, seconds=300.0) as made:
        yield made


def endless(folder):
    (folder / "begun").write_text(str(os.getpid()))
    while True:
        (folder / "alive").write_text(str(time.monotonic()))


def begun(folder):
    assert wait_until(lambda: (folder / "alive").exists() and (folder / "begun").exists())
    return int((folder / "begun").read_text())


def gone(pid):
    def is_gone():
        try:
            os.kill(pid, 0)
        except ProcessLookupError:
            return True
        return False

    return wait_until(is_gone)


def test_work_is_done_elsewhere(workers):
    assert workers.submit(pow, 2, 10).result() == 1024
    assert workers.submit(os.getpid).result() != os.getpid()


_held = []


def grow(size):
    _held.append(bytearray(b"x") * size)
    return os.getpid(), len(_held)


def test_a_worker_that_has_grown_too_large_is_replaced():
    with Workers(1, seconds=300.0, most_grown=30_000_000) as some:
        (one, first), (two, second), (three, third) = (some.submit(grow, size).result() for size in (10, 10**8, 10))
    assert (one, first) == (two, second - 1)  # what is small stays, and what is large is answered
    assert three != two
    assert third == 1


def ask(size):
    return len(bytearray(size)), os.getpid()


@pytest.mark.skipif(sys.platform != "linux", reason="the system bounds no memory of a process")
def test_a_work_that_asks_for_too_much_memory_fails_alone():
    with Workers(1, seconds=300.0, most_asked=200_000_000) as some:
        before, first = some.submit(ask, 100_000_000).result()
        with pytest.raises(MemoryError):
            some.submit(ask, 300_000_000).result()
        assert some.submit(ask, 100_000_000).result() == (before, first)  # the same process goes on


@pytest.mark.skipif(sys.platform != "linux", reason="the system tells no such thing")
def test_where_memory_is_short_a_worker_is_ended_before_its_server(workers):
    def likely(pid):
        return int(Path(f"/proc/{pid}/oom_score").read_text())

    assert likely(workers.submit(os.getpid).result()) > likely(os.getpid()) + 100


def test_errors_come_back(workers):
    with pytest.raises(ZeroDivisionError):
        workers.submit(divmod, 1, 0).result()
    with pytest.raises(Exception, match=r"pickle|local object"):
        workers.submit(lambda: 1).result()
    with pytest.raises(RuntimeError, match="cannot be sent"):
        workers.submit(open, os.devnull).result()


def test_cancelling_ends_what_is_under_way(workers, tmp_path):
    future = workers.submit(endless, tmp_path)
    pid = begun(tmp_path)
    assert future.cancel()
    with pytest.raises(CancelledError):
        future.result(PATIENCE)
    assert gone(pid)
    assert workers.submit(pow, 2, 3).result() == 8  # another process


def test_what_is_queued_is_cancelled_without_a_process(workers, tmp_path):
    busy, later = workers.submit(endless, tmp_path), workers.submit(pow, 2, 3)
    begun(tmp_path)
    assert later.cancel()
    assert later.cancelled()
    busy.cancel()
    wait([busy], 20)


def test_a_worker_that_is_killed_is_replaced(workers, tmp_path):
    future = workers.submit(endless, tmp_path)
    os.kill(begun(tmp_path), signal.SIGKILL)
    with pytest.raises(Stopped):
        future.result(PATIENCE)
    assert workers.submit(pow, 2, 3).result() == 8


def test_time_in_which_a_worker_gets_no_processor_is_not_its_own(monkeypatch):
    with Workers(1, seconds=0.2) as workers:
        monkeypatch.setattr(module, "MAX_CLOCK_RATIO", 1000.0)  # however busy the machine is
        assert workers.submit(time.sleep, 0.5).result() is None
        monkeypatch.setattr(module, "MAX_CLOCK_RATIO", 1.0)
        with pytest.raises(TimeoutError):  # but nobody waits for ever
            workers.submit(time.sleep, 60.0).result()


def test_nothing_runs_for_ever(tmp_path):
    with Workers(1, seconds=0.2) as workers:
        future = workers.submit(endless, tmp_path)
        with pytest.raises(TimeoutError, match=r"longer than 0\.2 s"):
            future.result(PATIENCE)


def remember():
    sys.set_int_max_str_digits(5000)


def test_until_workers_can_be_forked_one_process_does_the_work_of_all():
    ready = []
    with Workers(2, seconds=300.0, is_ready=lambda: bool(ready), begin=remember) as workers:
        early = [workers.submit(os.getpid) for _ in range(4)]
        digits = workers.submit(sys.get_int_max_str_digits)
        assert len({one.result(PATIENCE) for one in early}) == 1
        assert digits.result(PATIENCE) == 5000
        ready.append(1)
        assert workers.submit(sys.get_int_max_str_digits).result(PATIENCE) != 5000
        assert wait_until(lambda: not Path(f"/proc/{early[0].result()}").exists())


SHADOWED = """
import os, sys
sys.path.insert(0, {repository!r})
from codim2_app.picture.frame.workers import Workers

if __name__ == "__main__":
    for ready in (True, False):
        workers = Workers(1, preload=("colorsys", "codim2_core"), is_ready=lambda: ready)
        print(workers.submit(os.getpid).result(300) != os.getpid())
        workers.shutdown()
"""


def test_what_lies_in_the_folder_of_the_server_is_not_imported_by_its_workers(tmp_path):
    """A copy of the sources in the working folder, as in a container, or anybody's colorsys.py."""
    script = tmp_path / "elsewhere" / "script.py"
    script.parent.mkdir()
    script.write_text(SHADOWED.format(repository=str(Path(__file__).parents[4])))
    here = tmp_path / "here"
    (here / "codim2_core").mkdir(parents=True)
    for name in ("colorsys.py", "codim2_core/__init__.py"):
        (here / name).write_text(f"open({str(here / 'imported')!r}, 'a').write('{name} ')\n")
    done = subprocess.run([sys.executable, str(script)], cwd=here, capture_output=True, text=True, check=True)
    assert done.stdout == "True\nTrue\n"
    assert not (here / "imported").exists()


@pytest.mark.parametrize("fails", [False, True])
def test_an_idle_worker_holds_nobody_who_waited_for_its_last_work(workers, fails):
    class Page:
        def told(self, _):
            pass

    page = Page()
    future = workers.submit(int, "x" if fails else "1")
    future.add_done_callback(page.told)
    assert isinstance(future.exception(PATIENCE), ValueError if fails else type(None))
    held = weakref.ref(page)
    del page, future

    gc.disable()  # no search for garbage is needed
    try:
        assert wait_until(lambda: held() is None)
    finally:
        gc.enable()
