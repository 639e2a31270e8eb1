"""Have kernels compiled by another process, and load them here as they appear on disk.

Until a kernel is there it runs as Python, so that a page is answered from the first second.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Hashable
from typing import Any

from codim2_core.formulas.jit import policy
from codim2_core.portrait.orbits.trajectories import is_warm
from codim2_core.systems.frozen import FrozenSystem
from codim2_core.systems.psi import constant
from codim2_core.systems.psi.function import Psi

from .compiling import steps
from .compiling.once import alone
from .compiling.process import CompilerProcess

GENERAL = "kernels of general systems"

#: Seconds for which a server's kernels wait for somebody to ask for the first page, and, if so, at most for it to be
#: sent: it needs none of them, and is half as fast next to them.
POLL_SECONDS, MAX_WAIT_SECONDS = 1.0, 20.0
#: Seconds between two looks for a kernel on the disk.
LOOK_SECONDS = 0.5

_lock = threading.Lock()
_threads: dict[Hashable, threading.Thread] = {}
_pictures = threading.Event()
_cold = threading.Event()  # kernels run as Python: they are not on disk yet
_page_asked, _page_sent = threading.Event(), threading.Event()


#: What the warm thread came to: "" while it is at work, "ready", or why the first scene could not be computed.
outcome = ""
#: How many of the steps are done, and of how many; None before the first one is begun.
done: tuple[int, int] | None = None


def page_asked() -> None:
    """Say that a page has been requested: for the first one, kernels that are not begun yet stand back."""
    _page_asked.set()


def page_sent() -> None:
    """Say that a page has been sent: nothing stands back for it any longer."""
    _page_sent.set()


_compiler = CompilerProcess()


def _take_step(make_: Callable[[], object]) -> None:
    """Load what a step needs as soon as it is on disk; what nobody can keep there is compiled here."""
    while True:
        ended = _compiler.has_ended()
        try:
            with policy.in_thread(policy.LOAD):
                make_()
                return
        except policy.NotCompiledError:
            if ended:
                break
            if not _compiler.is_at_work():
                _compiler.start()
            _draw_as_python()
            time.sleep(LOOK_SECONDS)
    with policy.in_thread(policy.COMPILE), alone():
        make_()


def _draw_as_python() -> None:
    """Compute the first scene as Python, once, if its kernels are among those that are missing."""
    global outcome
    if not outcome:
        _cold.set()
        steps.draw_first_scene()
        outcome = "ready"


def _load_all(report: steps.Report, patience: float) -> None:
    """Load what the scene needs that the explorer opens with, and compute it; then load the rest."""
    global outcome, done
    everything = steps.kernel_steps()
    policy.leave_to(_compiler.is_at_work)
    if patience and _page_asked.wait(patience):
        _page_sent.wait(MAX_WAIT_SECONDS)
    done = 0, len(everything)
    try:
        for number, (what, make_) in enumerate(everything, 1):
            began = time.perf_counter()
            _take_step(make_)
            done = number, len(everything)
            if number == steps.FIRST_PRIORITY:
                _take_step(steps.draw_first_scene)
                outcome = "ready"
                _cold.clear()
            if number == len(everything) + steps.PICTURES:
                _pictures.set()
            report(what, time.perf_counter() - began, *done)
    except Exception as error:  # in a thread of its own: /ready says why, and the server answers
        logging.getLogger(__name__).exception("the kernels cannot all be compiled")
        if not outcome:
            _cold.clear()
            outcome = f"the first scene cannot be computed: {error}"
    finally:
        policy.leave_to(None)
        _pictures.set()  # nobody waits for what does not come


def _warm_general_alone() -> None:
    with alone():
        steps.warm_general()


def start(report: steps.Report = steps.report_nothing, patience: float = 0.0) -> None:
    """Begin loading kernels in a background thread; further calls do nothing.

    What is not on disk another process compiles meanwhile.

    Parameters
    ----------
    report : callable
        As in `warm_all`.
    patience : float
        Seconds for which it waits for `page_asked`, and then for `page_sent`.
    """
    with _lock:
        if constant() not in _threads:
            _start_thread(constant(), _load_all, report, patience)


def wait() -> bool:
    """Wait until the kernels that pictures need are there, or are known to be missing; say whether they are there.

    Whoever loads them then finds them in the cache.
    """
    while not _pictures.wait(LOOK_SECONDS):
        if _compiler.is_at_work():
            return False
    return True


def _start_thread(key: Hashable, target: Callable[..., None], *arguments: Any) -> None:
    _threads[key] = threading.Thread(target=target, args=arguments, name="codim2-compile", daemon=True)
    _threads[key].start()


def is_ready(psi: Psi | None = None, at: FrozenSystem | None = None, moving: bool = False) -> bool:
    """Say whether all layers can be drawn without waiting for the compiler; if not, see that it is at work.

    As long as another process compiles them, kernels run as Python, which is fast enough where no control is moving. If
    compiling failed, all layers are requested all the same, so that their error is seen.
    """
    psi = constant() if psi is None else psi
    general = at is not None and at.as_given is None
    if _cold.is_set():  # as Python
        return not moving or general
    if not outcome and constant() in _threads:
        return False
    if is_warm(psi, at):
        return True
    with _lock:
        if general and GENERAL not in _threads:
            _start_thread(GENERAL, _warm_general_alone)
        return not any(thread.is_alive() for thread in _threads.values())
