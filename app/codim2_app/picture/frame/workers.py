"""Processes that work in the background: none holds up another by its interpreter lock, and each can be stopped."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.forkserver import ensure_running
from pathlib import Path
from queue import SimpleQueue
from typing import Any

from ..phrases import say

#: Seconds of its own time after which a worker is stopped, whatever it is doing; and how many times that by the clock,
#: where it gets little of a busy machine.
MAX_WORK_SECONDS, MAX_CLOCK_RATIO = 60.0, 5.0
#: How many times as long a worker may take that runs kernels as Python.
EARLY_RATIO = 3.0
#: Processes that answer visitors go first: they have three times the share of a worker where processors are short. At
#: 10 it was ten times, and work of two seconds was stopped after 60 on a busy machine.
NICE = 5
#: Bytes by which a worker may grow: each formula that is typed leaves about 2.5 MB, which Numba never gives back.
MAX_GROWTH_BYTES = 400_000_000
#: Bytes that a worker may ask for next to what it begins with: a work that needs more fails, alone.
MAX_WORK_BYTES = 2_000_000_000
#: What is added to a worker's share of the machine's memory, in thousandths, where the system looks for one to end:
#: it takes a worker, and not what answers visitors.
ENDED_FIRST = 500


class Stopped(BrokenExecutor):
    """A worker ended before its work was done, though nobody had requested it."""


class Stoppable(Future[Any]):
    """A future whose `cancel` also stops work that has begun: its process is ended, within a kernel or not."""

    def __init__(self) -> None:
        super().__init__()
        self._guard = threading.Lock()
        self._process: Any = None
        self.stopped = False

    def cancel(self) -> bool:
        """Stop the work; False if it was done."""
        if super().cancel():
            return True
        with self._guard:
            if self.done():
                return False
            self.stopped = True
            if self._process is not None:
                self._process.kill()
        return True

    def in_process(self, process: Any) -> bool:
        """Note which process works on this, None when it no longer does; say whether the work is still wanted."""
        with self._guard:
            self._process = process
            return not self.stopped


@contextmanager
def _safe_imports() -> Iterator[None]:
    """Let a process that is begun now import from where this one does.

    Of its own it would look in the working folder first, and import what lies there: a copy of the sources, whose
    kernels nobody has compiled, or anybody's numpy.py.
    """
    wanted = {"PYTHONSAFEPATH": "1", "PYTHONPATH": os.pathsep.join(path or os.getcwd() for path in sys.path)}
    kept = {name: os.environ.get(name) for name in wanted}
    os.environ.update(wanted)
    try:
        yield
    finally:
        for name, value in kept.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@dataclass
class _Worker:
    """A process and the pipe to it, or none yet."""

    process: Any = None
    pipe: Connection | None = None

    def end(self) -> None:
        """End it, which is idle: it does when nobody can speak to it."""
        if self.process is not None:
            assert self.pipe is not None
            self.pipe.close()
            self.process.join(1.0)


class Workers(Executor):
    """An executor of processes; what it runs must be picklable.

    Parameters
    ----------
    count : int
        At most so many processes.
    seconds : float
        After so much time of its own, or `MAX_CLOCK_RATIO` times that by the clock, a work is stopped: its future has
        TimeoutError.
    preload : sequence of str
        Modules that a worker finds imported. They are imported once, in a process of its own from which the workers
        are forked (where there is no fork, by none).
    is_ready : callable, optional
        Whether that process can be begun, asked by a thread that may wait. Until then another one does all work.
    begin : callable, optional
        Called in that other process; it must be picklable.
    most_grown : int
        Bytes by which a process may have grown when it is done with a work, or another one takes its place.
    most_asked : int
        Bytes that a process may ask for while it works; the work that needs more has MemoryError (on Linux).
    """

    def __init__(
        self,
        count: int,
        seconds: float = MAX_WORK_SECONDS,
        preload: Sequence[str] = (),
        is_ready: Callable[[], bool] = lambda: True,
        begin: Callable[[], None] | None = None,
        most_grown: int = MAX_GROWTH_BYTES,
        most_asked: int = MAX_WORK_BYTES,
    ) -> None:
        known = multiprocessing.get_all_start_methods()
        self._context: Any = multiprocessing.get_context("forkserver" if "forkserver" in known else "spawn")
        if "forkserver" in known:
            self._context.set_forkserver_preload(list(preload))
        self.seconds, self._bounds = seconds, (most_grown, most_asked)
        self._is_ready, self._begin = is_ready, begin
        self._once = threading.Lock()
        self._early, self._early_work = _Worker(), threading.Lock()
        self._tasks: SimpleQueue[tuple[Stoppable, bytes] | None] = SimpleQueue()
        self._count = count
        self._threads: list[threading.Thread] = []
        self._closed = False

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Stoppable:
        """Let a worker compute ``fn(*args, **kwargs)``."""
        future = Stoppable()
        try:
            call = pickle.dumps((fn, args, kwargs))
        except Exception as error:  # as an executor of processes does: the future has it
            future.set_exception(error)
            return future
        with self._once:
            if self._closed:
                raise RuntimeError("the workers have been shut down; nothing can be submitted.")
            self._tasks.put((future, call))
            if len(self._threads) < self._count:
                thread = threading.Thread(target=self._serve, name=f"codim2-worker-{len(self._threads)}", daemon=True)
                self._threads.append(thread)
                thread.start()
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """End the processes; what is under way is finished first, unless it is cancelled."""
        with self._once:
            self._closed = True
            if cancel_futures:
                while not self._tasks.empty():
                    task = self._tasks.get()
                    if task is not None:
                        task[0].cancel()
            for _ in self._threads:
                self._tasks.put(None)
        if wait:
            for thread in self._threads:
                thread.join()

    def _serve(self) -> None:
        """Hand one work after the other to a process of this thread's own, or at first to the one of all."""
        own = _Worker()
        while (task := self._tasks.get()) is not None:
            if self._is_ready():
                self._end_early()
                own = self._serve_one(*task, own)
            else:
                with self._early_work:
                    self._early = self._serve_one(*task, self._early, early=True)
            del task  # while it waits for the next, it holds nobody who waited for this one
        own.end()
        self._end_early()

    def _end_early(self) -> None:
        """End the process that works at first, unless it is at work: who waits for it ends it then."""
        if self._early.process is not None and self._early_work.acquire(blocking=False):
            self._early.end()
            self._early = _Worker()
            self._early_work.release()

    def _serve_one(self, future: Stoppable, call: bytes, worker: _Worker, early: bool = False) -> _Worker:
        """Hand one work to a process, a new one if there is none; return it."""
        if future.set_running_or_notify_cancel():
            try:
                if worker.process is None or not worker.process.is_alive():
                    worker = self._start(early)
                result = self._run(future, call, worker, self.seconds * (EARLY_RATIO if early else 1.0))
            except BaseException as error:
                future.set_exception(error.with_traceback(None))  # which would hold the future
            else:
                future.set_result(result)
        return worker

    def _start(self, early: bool) -> _Worker:
        context = multiprocessing.get_context("spawn") if early else self._context
        with self._once, _safe_imports():
            if context.get_start_method() == "forkserver":
                ensure_running()
            ours, theirs = context.Pipe()
            given = theirs, *self._bounds, self._begin if early else None
            process = context.Process(target=_work, args=given, daemon=True, name="codim2-worker")
            process.start()
        theirs.close()
        return _Worker(process, ours)

    def _run(self, future: Stoppable, call: bytes, worker: _Worker, seconds: float) -> Any:
        process, pipe = worker.process, worker.pipe
        assert pipe is not None
        if not future.in_process(process):
            raise CancelledError
        try:
            pipe.send_bytes(call)
            there = _await_answer(pipe, process, seconds)
            answer = pipe.recv_bytes() if pipe in there else None
        except (OSError, EOFError):  # it died in mid-sentence
            there, answer = [process.sentinel], None
        wanted = future.in_process(None)
        if not wanted or answer is None:
            process.kill()
            process.join()
            pipe.close()
            if not wanted:
                raise CancelledError
            if there:
                raise Stopped(f"a worker ended with status {process.exitcode} before its work was done.")
            raise TimeoutError(say("stopped after", seconds=seconds))
        good, result, last = pickle.loads(answer)
        if last:
            process.join()
            pipe.close()
        if not good:
            raise result
        return result


def _await_answer(pipe: Connection, process: Any, seconds: float) -> list[Any]:
    """Wait until a worker answers or ends; nothing is returned once it has worked for so long."""
    begun, end = _own_time(process.pid), time.monotonic() + MAX_CLOCK_RATIO * seconds
    left = seconds
    while left > 0.0:
        there = wait([pipe, process.sentinel], max(left, 0.01))
        if there:
            return there
        left = min(seconds - (_own_time(process.pid) - begun), end - time.monotonic())
    return wait([pipe, process.sentinel], 0.0)


def _own_time(pid: int) -> float:
    """Seconds that a process has worked; those of the clock where the system does not tell."""
    try:
        return time.clock_gettime(~pid << 3 | 2)  # how Linux numbers the clock of another process's work
    except (AttributeError, OSError):
        return time.monotonic()


def _work(pipe: Connection, most_grown: int, most_asked: int, begin: Callable[[], None] | None) -> None:
    """Do one work after the other, as a worker, until nobody can speak to it or it has grown too large."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C in a terminal reaches all; the server ends its workers
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(os, "nice"):
        os.nice(max(0, NICE - os.nice(0)))
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _bound_memory(most_asked)
    if begin is not None:
        begin()
    before, last = memory_in_use(), False
    while not last:
        try:
            function, args, named = pickle.loads(pipe.recv_bytes())
        except (EOFError, OSError):
            return
        try:
            answer = True, function(*args, **named)
        except Exception as error:  # whoever asked has it as the future's; the worker goes on
            answer = False, error
        last = memory_in_use() - before > most_grown
        try:
            data = pickle.dumps((*answer, last))
        except Exception as error:  # of any kind: a result's own __reduce__ may raise whatever it likes
            data = pickle.dumps((False, RuntimeError(f"the result cannot be sent: {error}"), last))
        pipe.send_bytes(data)


def _bound_memory(most_asked: int) -> None:
    """Let this process ask for so much more, and be ended before others where the machine has none left."""
    if sys.platform != "linux":
        return
    import resource

    with suppress(OSError):  # where /proc cannot be written
        Path("/proc/self/oom_score_adj").write_text(str(ENDED_FIRST))
    with suppress(OSError, ValueError):  # where it cannot be read, or the host's own bound is lower
        lines = Path("/proc/self/status").read_text().splitlines()
        data = next(int(line.split()[1]) for line in lines if line.startswith("VmData:"))
        resource.setrlimit(
            resource.RLIMIT_DATA, (1024 * data + most_asked, resource.getrlimit(resource.RLIMIT_DATA)[1])
        )


def memory_in_use() -> int:
    """Return how many bytes this process holds; 0 where the system does not tell."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")
    except (OSError, ValueError):
        return 0


def _end_with_parent() -> None:
    """End in mid-work if the server has ended: nobody would have the result."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        wait([parent.sentinel])
        os._exit(0)


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
