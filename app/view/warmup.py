"""Compile the integrator in the background, once for each process and each new regularisation function."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

import numpy as np

from codim2_core.cycles.limit_cycles import limit_cycles
from codim2_core.figures.presets import presets
from codim2_core.orbits.trajectories import is_warm, warm
from codim2_core.portrait.approach_outcomes import approach_outcomes
from codim2_core.psi import FAMILIES, constant, hill, make
from codim2_core.psi.function import Psi
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.kinds import AnySystem

from ..draw.gallery import draw_all
from ..draw.lines.arrowheads import arrowheads
from ..draw.lines.spacing import evenly
from ..frame.scenes import make_scene
from ..state.controls import first_values
from .compiled_once import alone

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

#: Is told what has been compiled, in how many seconds, and how many steps are done of how many.
Told = Callable[[str, float, int, int], None]

_lock = threading.Lock()
_threads: dict[Hashable, threading.Thread] = {}
_pictures = threading.Event()
_page_asked, _page_sent = threading.Event(), threading.Event()
_formulas: set[Hashable] = set()  # that this process has begun to compile


def _steps() -> list[tuple[str, Callable[[], object]]]:
    """Return what is compiled beforehand, by what it is called, in the order in which it is asked for."""
    families = [family for family in FAMILIES.values() if not family.typed]
    first, *others = ((f"trajectories for Ψ = {family.title}", partial(warm, make(family.name))) for family in families)
    last = [
        ("approach outcomes", _warm_outcomes),
        (GENERAL, warm_general),
        ("branches of cycles", _warm_branches),
        ("names of many systems", _warm_names),
        ("motions in time", _warm_motions),
        ("the gallery", draw_all),
    ]
    return [("arrowheads", _warm_arrowheads), first, ("limit cycles", _warm_cycles), *others, *last]


#: Of `_steps`, those after which the first scene is drawn, and those that pictures need: all but the last.
FIRST_PRIORITY, PICTURES = 3, -2


def _nobody(*_: object) -> None:
    pass


def warm_all(told: Told = _nobody, after: Callable[[int], None] = _nobody) -> None:
    """Compile, or load from the disk cache, what all built-in families and the kernels of general systems need.

    Parameters
    ----------
    told : callable
        Called with what has been compiled, the seconds that it took, how many steps are done, and of how many.
    after : callable
        Called with the number of steps that are done.
    """
    global done
    steps = _steps()
    done = 0, len(steps)
    for number, (what, make_) in enumerate(steps, 1):
        with alone():
            began = time.perf_counter()
            make_()
            took = time.perf_counter() - began
        done = number, len(steps)
        told(what, took, *done)
        after(number)


#: What the warm thread came to: "" while it is at work, "ready", or why the first scene could not be computed.
outcome = ""
#: How many of the steps are done, and of how many; None before the first one is begun.
done: tuple[int, int] | None = None


def progress() -> tuple[int, int] | None:
    """Return how many steps are done, and of how many; None before the first one is begun, and when all are."""
    return done if done is not None and done[0] < done[1] else None


def page_asked() -> None:
    """Say that a page has been asked for: for the first one, kernels that are not begun yet stand back."""
    _page_asked.set()


def page_sent() -> None:
    """Say that a page has been sent: nothing stands back for it any longer."""
    _page_sent.set()


def _first_scene(told: Told, patience: float) -> None:
    """Compile what the scene needs that the explorer opens with, and compute it; then compile the rest."""
    global outcome
    if patience and _page_asked.wait(patience):
        _page_sent.wait(MAX_WAIT_SECONDS)

    def draw(number: int) -> None:
        global outcome
        if number == len(_steps()) + PICTURES:
            _pictures.set()
        if number != FIRST_PRIORITY:
            return
        scene = make_scene(first_values())
        for layer in ("equator", "critical", "inside", "outside", "nullclines_inside"):
            scene[layer]
        outcome = "ready"

    try:
        warm_all(told, draw)
    except Exception as error:  # in a thread of its own: /ready says why, and the server answers
        logging.getLogger(__name__).exception("the kernels cannot all be compiled")
        if not outcome:
            outcome = f"the first scene cannot be computed: {error}"
    finally:
        _pictures.set()  # nobody waits for what does not come


def _warm_cycles() -> None:
    """Compile, or load, the return map of e-linear systems."""
    three = presets["case3-n3"]
    limit_cycles(three.system, three.psi)


def _warm_outcomes() -> None:
    """Compile, or load, what follows orbits under all Psi side by side."""
    three = presets["case3-n3"]
    approach_outcomes(three.system, three.psi)


def _warm_branches() -> None:
    """Compile, or load, what follows limit cycles along a parameter, f1 or n."""
    from codim2_core.continuation.branches import continue_cycles

    system = ELinear(1.0, 1.3, -1.2, (0.33, 0.07))
    for name, span in (("f1", (0.32, 0.34)), ("n", (3.0, 3.1))):
        continue_cycles(system, hill(3.0), name, span)


def _warm_names() -> None:
    """Compile, or load, what names many e-linear systems at once."""
    from codim2_core.counting.names import names

    names(np.eye(1, 5))


def _warm_arrowheads() -> None:
    """Compile, or load, what places arrowheads on curves and spaces orbits."""
    one = np.array([0, 2]), np.eye(2), 0.01, (-1.0, 1.0, -1.0, 1.0)
    arrowheads(*one)
    evenly(*one)


def warm_general() -> None:
    """Compile, or load, what searches a general system: once for all of them."""
    example = presets["nonunique-sliding"]
    scene = Scene(example.system, example.psi, example.z)
    for layer in ("equator", "critical", "nullclines_inside", "nullclines_outside", "cycles", "separatrices"):
        scene[layer]


def _warm_motions() -> None:
    """Compile, or load, what follows motions, also in the limit: once for all systems, but for their formulas."""
    from codim2_core.initial_value.events import Event
    from codim2_core.motion.nonsmooth import simulate_nonsmooth  # late: both bring SciPy along
    from codim2_core.motion.regularised import simulate

    pushed = ELinear(-1.0, 0.3, -2.0, f=("1.3*sin(z1)", "0.4*cos(2*z1)"), B=((0.0, 0.0),), g=(1.0,))
    several = [(0.3, 0.2, 0.0)] * 8  # so many are compiled at once
    never = Event(lambda t, state: 1.0)  # noqa: ARG005 (an event is of both)
    for events in ((never,), ()):  # step by step, and whole: it slips, slides and leaves
        simulate_nonsmooth(pushed, several, (0.0, 3.0), hill(3.0), events=events)
        simulate(pushed, hill(3.0), 0.01, several, (0.0, 0.2), events=events)


def _warm_general_alone() -> None:
    with alone():
        warm_general()


def start(told: Told = _nobody, patience: float = 0.0) -> None:
    """Begin compiling (or loading from the cache) in a background thread, see `warm_all`; further calls do nothing.

    Parameters
    ----------
    told : callable
        As in `warm_all`.
    patience : float
        Seconds for which it waits for `page_asked`, and then for `page_sent`.
    """
    with _lock:
        if constant() not in _threads:
            _start_thread(constant(), _first_scene, told, patience)


def wait() -> None:
    """Wait until the kernels that pictures need are there: whoever loads them then finds them in the cache."""
    with _lock:
        thread = _threads.get(constant())
    if thread is not None:
        _pictures.wait()


def _start_thread(key: Hashable, target: Callable[..., None], *arguments: Any) -> None:
    _threads[key] = threading.Thread(target=target, args=arguments, name="codim2-compile", daemon=True)
    _threads[key].start()


def is_ready(psi: Psi | None = None, system: AnySystem | None = None) -> bool:
    """Say whether all layers can be drawn without waiting for the compiler; if not, see that it is at work.

    If compiling failed, they are asked for all the same, so that their error is seen.
    """
    psi = constant() if psi is None else psi
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


def is_ready_for_all(psi: Psi, system: AnySystem) -> bool:
    """Say of a page whether all its layers can be drawn, here or by workers, who compile what is typed."""
    return is_ready(psi, system) if _is_here(psi, system) else is_ready()


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
