"""What is compiled beforehand: step by step, told, and by one process at a time."""

import subprocess
import sys
import threading

import pytest
from codim2_app.view import warmup
from codim2_app.view.compiling import once, process, steps
from codim2_app.view.compiling.once import alone, lock_path
from codim2_app.view.compiling.process import CompilerProcess

import codim2_core as c2
from codim2_core.formulas.jit import policy
from codim2_core.portrait.orbits import trajectories
from tests.core.formulas.jit.fresh import computed
from tests.work import wait_until

ASK = """import fcntl, sys
try:
    fcntl.flock(open(sys.argv[1], "w"), fcntl.LOCK_EX | fcntl.LOCK_NB)
    print("free")
except BlockingIOError:
    print("held")
"""


def asked():
    command = [sys.executable, "-S", "-c", ASK, str(lock_path())]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()


@pytest.fixture
def folder(monkeypatch, tmp_path):
    monkeypatch.setattr(once.tempfile, "tempdir", str(tmp_path))
    return tmp_path


def test_one_process_at_a_time_compiles(folder):
    with alone():
        assert asked() == "held"
    assert asked() == "free"
    with pytest.raises(ZeroDivisionError), alone():
        raise ZeroDivisionError
    assert asked() == "free"
    assert lock_path().parent == folder


def test_each_step_is_told_and_held_by_one_process(folder, monkeypatch):
    found, told = [], []
    step = lambda: found.append(asked())
    monkeypatch.setattr(steps, "kernel_steps", lambda: [("one", step), ("two", step)])
    steps.warm_all(lambda what, seconds, done, of: told.append((what, seconds >= 0.0, done, of)))
    assert found == ["held", "held"]
    assert told == [("one", True, 1, 2), ("two", True, 2, 2)]


def test_a_server_starts_without_what_its_first_picture_does_not_need():
    """SciPy's parts and what draws in notebooks take longer to import than all of this package."""
    late = "'scipy.integrate', 'scipy.optimize', 'scipy.special', 'holoviews', 'pandas', 'matplotlib', 'IPython'"
    code = f"import sys, codim2_app.server.page; found = {{{late}}} & set(sys.modules); assert not found, found"
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.fixture
def begun(monkeypatch):
    """A process that has begun nothing, with few steps; what becomes of them."""
    for name in ("_pictures", "_cold", "_page_asked", "_page_sent"):
        monkeypatch.setattr(warmup, name, threading.Event())
    monkeypatch.setattr(warmup, "_threads", {})
    monkeypatch.setattr(warmup, "outcome", "")
    monkeypatch.setattr(warmup, "done", None)
    monkeypatch.setattr(warmup, "LOOK_SECONDS", 0.01)
    monkeypatch.setattr(warmup, "_compiler", Compiler())
    monkeypatch.setattr(steps, "draw_first_scene", lambda: None)

    def begin(step, **options):
        monkeypatch.setattr(steps, "kernel_steps", lambda: [("step", step)] * 4)
        warmup.start(**options)

    yield begin
    warmup._threads[c2.psi.constant()].join()


class Compiler:
    """Stands for the process that compiles."""

    starts = 0
    ended = False

    def start(self):
        self.starts += 1

    def is_at_work(self):
        return self.starts > 0 and not self.ended

    def has_ended(self):
        return self.ended


def test_what_is_not_on_disk_is_loaded_once_another_process_has_compiled_it(begun):
    on_disk, ways = threading.Event(), []

    def step():
        ways.append(policy.current_way())
        if not on_disk.is_set():
            raise policy.NotCompiledError

    assert warmup.is_ready()
    begin_with = c2.Scene(c2.presets["case1-cm4"].system)
    begun(step)
    wait_until(lambda: len(ways) > 3)
    assert warmup._compiler.starts == 1
    assert policy.is_left()  # to it: kernels run as Python
    assert warmup.is_ready(begin_with.psi, begin_with.coefficients)
    assert not warmup.is_ready(begin_with.psi, begin_with.coefficients, moving=True)
    wait_until(lambda: warmup.outcome)
    assert warmup.outcome == "ready"  # the first scene is drawn, as Python
    assert warmup.done == (0, 4)
    assert not warmup.wait()  # what pictures need is known to be missing
    on_disk.set()
    wait_until(lambda: warmup.done == (4, 4))
    assert warmup.wait()
    assert set(ways) == {policy.LOAD}
    warmup._threads[c2.psi.constant()].join()
    assert not policy.is_left()


def test_who_waits_for_pictures_does_not_wait_for_what_cannot_be_compiled(begun):
    def fails():
        raise RuntimeError("no compiler")

    begun(fails)
    warmup.wait()
    wait_until(lambda: warmup.outcome)
    assert warmup.outcome == "the first scene cannot be computed: no compiler"


def test_kernels_stand_back_for_the_first_page(begun):
    order, loaded = [], threading.Event()
    begun(lambda: (order.append("kernels"), loaded.set()), patience=60.0)
    warmup.page_asked()
    assert not loaded.wait(0.05)
    assert not warmup.is_ready()
    order.append("page")
    warmup.page_sent()
    assert loaded.wait(60.0)
    assert order[:2] == ["page", "kernels"]


def test_one_process_compiles_for_all(folder, monkeypatch):
    """It ends with the one that has begun it; another one begins one only then."""
    monkeypatch.setattr(process, "CODE", "import os; os.read(0, 1)")
    first, second = CompilerProcess(), CompilerProcess()
    assert not first.is_at_work()
    first.start()
    second.start()
    assert second.process is None
    assert first.is_at_work()
    assert second.is_at_work()
    assert not first.has_ended()
    first.process.stdin.close()
    first.process.wait()
    assert first.has_ended()
    assert not second.is_at_work()
    second.start()
    assert second.process is not None
    second.process.stdin.close()
    second.process.wait()


FRAMES = """
import time
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.budget import Budget
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view import warmup
from codim2_app.view.refresh import Frames

warmup.start()
while not warmup._cold.is_set():
    time.sleep(0.01)
frames = Frames(ExplorerState(), None, warmup.is_ready, budget=Budget())
asked = {"all": True}, {"set": {"f1": 0.05}}, {"set": {"f1": 0.1}}, {"rest": True}
found = [unpack(frames.answer(one))[0]["ready"] for one in asked], len(frames.scene["inside"].points)
"""


def test_frames_are_answered_on_an_empty_disk_and_nothing_is_compiled_here(tmp_path):
    (ready, trajectories), compiled = computed(tmp_path, FRAMES)
    assert ready == [False, False, False, True]
    assert trajectories > 10
    assert compiled == []


def test_the_process_that_compiles_ends_with_its_parent():
    code = "import time; from codim2_app.view.compiling import process; process._end_with_parent(); time.sleep(3600)"
    child = subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE)
    child.stdin.close()
    assert child.wait() == 1


@pytest.mark.parametrize(("U", "general"), [(("-c", "-s"), False), (("-c + 2*s", "s"), True), (("-c**3", "-s"), True)])
def test_the_kernel_that_a_system_needs_is_the_one_that_is_asked_for(monkeypatch, U, general):
    """An affine field in other axes than those of its normal form is stepped by its formulas."""
    trajectories.warm(c2.psi.constant())
    monkeypatch.setattr(trajectories, "_warm", {trajectories.CREEPING, "constant"})
    assert trajectories.is_warm(c2.psi.constant(), c2.System(U=U).at(())) is not general
