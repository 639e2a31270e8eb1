"""A budget of processor time is kept, whatever the interpreter is doing when the alarm comes."""

import signal
import sys
import threading
import time
import weakref

import numba
import pytest
from codim2_app.picture.frame.time_limit import CompileClock, at_most
from numba.core.compiler_lock import global_compiler_lock


def spin(first=bool):
    with at_most(0.05):
        first()
        until = time.process_time() + 5.0
        while time.process_time() < until:
            pass


def test_a_budget_of_processor_time_ends_between_kernels():
    hook, handler = sys.unraisablehook, signal.getsignal(signal.SIGPROF)
    with pytest.raises(TimeoutError):
        spin()
    with at_most(5.0):
        pass
    assert signal.getitimer(signal.ITIMER_PROF)[0] == 0.0
    assert (sys.unraisablehook, signal.getsignal(signal.SIGPROF)) == (hook, handler)


class Held:
    """What dies while others look."""


def busy(_):
    until = time.process_time() + 0.15
    while time.process_time() < until:
        pass


def die(then=busy):
    held = Held()
    reference = weakref.ref(held, then)  # while it is referred to, it is called
    del held
    return reference


def test_an_alarm_that_falls_into_a_callback_of_the_garbage_collector_comes_again():
    """The interpreter drops what is raised there: the limit was lost, and the formula ran on."""
    with pytest.raises(TimeoutError):
        spin(die)


def test_what_else_is_dropped_there_is_told():
    heard = []
    before, sys.unraisablehook = sys.unraisablehook, heard.append
    try:
        with at_most(5.0):
            die(lambda _: 1 / 0)
    finally:
        sys.unraisablehook = before
    assert [type(one.exc_value) for one in heard] == [ZeroDivisionError]


def test_compiling_is_not_counted():
    @numba.njit(cache=False)
    def kernel(x):
        for one in range(10):
            x = x * one + one**x
        return x

    began = time.process_time()
    compiling = CompileClock()
    with at_most(0.02, compiling):
        kernel(2.0)
    took = time.process_time() - began
    assert took > 0.02  # it did take longer
    assert 0.0 < compiling.seconds < took
    with pytest.raises(TimeoutError):
        spin(lambda: kernel(3))


def test_an_alarm_waits_until_the_compiler_is_left():
    """What is raised while its lock is being taken leaves it taken: all other threads that compile wait for ever."""
    left = []

    def compiles():
        with global_compiler_lock:
            busy(None)
            left.append(time.process_time())

    with pytest.raises(TimeoutError):
        spin(compiles)
    assert left
    assert not global_compiler_lock.is_locked()


def test_what_other_threads_take_is_not_counted():
    stop = threading.Event()

    def other():
        while not stop.is_set():
            pass

    thread = threading.Thread(target=other)
    thread.start()
    try:
        with at_most(0.1):
            began = time.process_time()
            while time.process_time() - began < 0.3:
                time.sleep(0.01)
    finally:
        stop.set()
        thread.join()
