"""Have kernels compiled by another process, and load them here as they appear on disk; compile what is typed.

Until a kernel is there it runs as Python, so that a page is answered from the first second.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Hashable
from typing import Any

from codim2_core.jit import policy
from codim2_core.orbits.trajectories import is_warm, warm
from codim2_core.psi import constant
from codim2_core.psi.function import Psi
from codim2_core.scene import Scene
from codim2_core.systems.kinds import AnySystem

from .compiling import steps
from .compiling.once import alone
from .compiling.process import CompilerProcess

MOST_THREADS = 4  # compiling at once; the compiler takes one at a time anyway

MOST_REMEMBERED = 256  # texts that have been compiled, or could not be
GENERAL = "kernels of general systems"
#: Formulas that a process which answers visitors compiles in its life: Numba never gives back the machine code, about
#: 2.5 MB each. The core keeps all of these, so that no frame compiles one again. Later ones are for the workers.
MOST_COMPILED = 48
#: Formulas that one page has compiled so, and the settings of one that it asks for before: who types has one of each.
MAX_PAGE_FORMULAS, MIN_SETTINGS = 8, 4

#: Seconds for which a server's kernels wait for somebody to ask for the first page, and, if so, at most for it to be
#: sent: it needs none of them, and is half as fast beside them.
POLL_SECONDS, MAX_WAIT_SECONDS = 1.0, 20.0
#: Seconds between two looks for a kernel on the disk.
LOOK_SECONDS = 0.5

_lock = threading.Lock()
_threads: dict[Hashable, threading.Thread] = {}
_pictures = threading.Event()
_cold = threading.Event()  # kernels run as Python: they are not on disk yet
_page_asked, _page_sent = threading.Event(), threading.Event()
_formulas: set[Hashable] = set()  # that this process has begun to compile


#: What the warm thread came to: "" while it is at work, "ready", or why the first scene could not be computed.
outcome = ""
#: How many of the steps are done, and of how many; None before the first one is begun.
done: tuple[int, int] | None = None


def page_asked() -> None:
    """Say that a page has been asked for: for the first one, kernels that are not begun yet stand back."""
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


def _load_all(told: steps.Told, patience: float) -> None:
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
            told(what, time.perf_counter() - began, *done)
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


def start(told: steps.Told = steps.tell_nobody, patience: float = 0.0) -> None:
    """Begin loading kernels in a background thread; further calls do nothing.

    What is not on disk another process compiles meanwhile.

    Parameters
    ----------
    told : callable
        As in `warm_all`.
    patience : float
        Seconds for which it waits for `page_asked`, and then for `page_sent`.
    """
    with _lock:
        if constant() not in _threads:
            _start_thread(constant(), _load_all, told, patience)


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


def is_ready(psi: Psi | None = None, system: AnySystem | None = None, moving: bool = False) -> bool:
    """Say whether all layers can be drawn without waiting for the compiler; if not, see that it is at work.

    As long as another process compiles them, kernels run as Python, which is fast enough where no control is moving. If
    compiling failed, all layers are asked for all the same, so that their error is seen.
    """
    psi = constant() if psi is None else psi
    if _cold.is_set():  # as Python
        return not moving or (system is not None and system.typed is not None)
    if not outcome and constant() in _threads:
        return False
    typed = None if system is None else system.typed
    if typed is not None and not _is_compiled(GENERAL, _warm_general_alone):
        return False
    if is_warm(psi, system):
        return True
    key = _formulas_of(psi, system)
    if key is not None:
        return _is_compiled(key, warm, psi, system)
    with _lock:
        return not any(thread.is_alive() for thread in _threads.values())


def _formulas_of(psi: Psi, system: AnySystem | None) -> Hashable:
    """Return what is typed of both, and is compiled; None if nothing is."""
    typed = None if system is None else system.typed
    found = psi if psi.expression is not None else None, None if typed is None else typed.U
    return found if any(found) else None


def _is_here(psi: Psi, system: AnySystem) -> bool:
    """Whether nothing of both was typed, or this process has compiled it."""
    return _formulas_of(psi, system) is None or is_warm(psi, system)


def is_ready_for_all(psi: Psi, system: AnySystem, moving: bool = False) -> bool:
    """Say of a page whether all its layers can be drawn, here or by workers, who compile what is typed."""
    return is_ready(psi, system, moving) if _is_here(psi, system) else is_ready(moving=moving)


class FormulaQuota:
    """Quota of one page in the process that answers: what it moves is compiled there, and not all that it types."""

    def __init__(self) -> None:
        self._begun: set[Hashable] = set()
        self._last: tuple[Hashable, Hashable] = None, None  # formulas, and the setting
        self._settings = 0  # of these formulas, one after the other

    def elsewhere(self, scene: Scene) -> bool:
        """Whether a scene is for the workers; if its formulas are moved, see that it is not for long."""
        psi, system = scene.psi, scene.system
        if _is_here(psi, system):
            return False
        key, setting = _formulas_of(psi, system), scene.key("plane", "psi", "launch")
        if (key, setting) != self._last:
            self._settings = self._settings + 1 if key == self._last[0] else 1
            self._last = key, setting
        if self._settings > MIN_SETTINGS and (key in _formulas or self._may_begin()):
            self._begun.add(key)
            is_ready(psi, system)
        return True

    def _may_begin(self) -> bool:
        return len(self._begun) < MAX_PAGE_FORMULAS and len(_formulas) < MOST_COMPILED


def _is_compiled(key: Hashable, target: Callable[..., None], *arguments: Any) -> bool:
    """Whether a thread has compiled this; if there was none, begin one as soon as few others are at work."""
    with _lock:
        thread = _threads.get(key)
        if thread is not None:
            return not thread.is_alive()
        alive = {key: thread for key, thread in _threads.items() if thread.is_alive()}
        if len(_threads) > MOST_REMEMBERED:
            for old in _threads.keys() - alive.keys() - {constant(), GENERAL}:
                del _threads[old]
        if len(alive) < MOST_THREADS:
            _start_thread(key, target, *arguments)
            if key != GENERAL:
                _formulas.add(key)
    return False
