"""Compile the integrator in the background, once for each process and each new regularisation function."""

from __future__ import annotations

import threading
from collections.abc import Hashable

from codim2_core.cycles import limit_cycles
from codim2_core.general import System
from codim2_core.presets import presets
from codim2_core.regularisation import FAMILIES, Psi, constant, make
from codim2_core.trajectories import is_warm, warm

from .chosen import System_

MOST_THREADS = 4  # compiling at once; the compiler takes one at a time anyway
BUILT_IN = tuple(make(family) for family in FAMILIES if family != "custom")

_lock = threading.Lock()
_threads: dict[Hashable, threading.Thread] = {}


def warm_all() -> None:
    """Compile, or load from the disk cache, what all built-in families need."""
    for psi in BUILT_IN:
        warm(psi)
    three = presets["case3-n3"]
    limit_cycles(three.system, three.psi)


def start() -> None:
    """Begin compiling (or loading from the cache) in a background thread; further calls do nothing."""
    with _lock:
        if constant() not in _threads:
            _threads[constant()] = threading.Thread(target=warm_all, name="codim2-warm-up", daemon=True)
            _threads[constant()].start()


def is_ready(psi: Psi | None = None, system: System_ | None = None) -> bool:
    """Say whether trajectories can be drawn without waiting for the compiler; if not, see that it is at work.

    If compiling failed, trajectories are asked for all the same, so that their error is seen.
    """
    psi = constant() if psi is None else psi
    if is_warm(psi, system):
        return True
    typed = isinstance(system, System)
    key: Hashable = (psi, system.U) if typed else psi
    with _lock:
        thread = _threads.get(key)
        if thread is not None:
            if thread.is_alive():
                return False
            del _threads[key]
            return True
        if (typed or psi.family == "custom") and sum(t.is_alive() for t in _threads.values()) < MOST_THREADS:
            _threads[key] = threading.Thread(target=warm, args=(psi, system), name="codim2-compile", daemon=True)
            _threads[key].start()
    return not any(t.is_alive() for t in _threads.values())
