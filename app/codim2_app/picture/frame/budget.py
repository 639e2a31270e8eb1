"""The budget of the thread that answers all visitors: which layers it computes itself, and which go to a worker.

Each layer is timed, here or in the background, and the frames that follow compute those that turned out to be quick.
Of typed formulas nobody knows beforehand: their first picture is computed in the background, and so is what has become
wilder meanwhile. Most layers of an e-linear system take milliseconds, whatever the sliders say, and are computed here
at first; those that follow what winds or creeps for long are as a formula's.
"""

from __future__ import annotations

import math
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from codim2_core.formulas.jit.policy import is_left
from codim2_core.scene import Scene
from codim2_core.systems.coefficients import Coefficients

from ..phrases import say
from .faults import FAILURES

#: Seconds of processor time that one layer, and all layers of one frame, may take of the thread that answers.
LAYER_BUDGET, FRAME_BUDGET = 0.008, 0.02
#: Seconds for one layer computed in the background: a wilder one is left out, and said to be.
MAX_LAYER_SECONDS = 6.0
#: Limit directions and critical sets together, beyond which the layers that follow each of them are not drawn.
MAX_EQUILIBRIA = 100
#: Layers that start at each limit direction or critical set, or look for what is between them.
PER_EQUILIBRIUM_LAYERS = frozenset(
    {"nullclines_inside", "nullclines_outside", "continuations", "closed_orbits", "cycles", "separatrices", "outcomes",
     "certificates", "eigendirections", "classification"}
)  # fmt: skip
#: Layers of e-linear systems that search for cycles, which there may be in Case III; and all that may take long.
CYCLE_SEARCH_LAYERS = frozenset({"outcomes", "certificates"})
POSSIBLY_LONG_LAYERS = CYCLE_SEARCH_LAYERS | {"launched"}
#: Directions on which a formula is looked at to see how wild it is.
COST_NET = 512
#: Formulas whose layers have been timed, of one browser; all e-linear systems are one.
REMEMBERED_SCENES = 4

WORDS = {
    "nullclines_inside": "nullclines",
    "nullclines_outside": "nullclines outside",
    "inside": "trajectories",
    "outside": "trajectories outside",
    "conics": "the hyperbola",
    "continuations": "continuations",
    "closed_orbits": "limit cycles",
    "cycles": "limit cycles",
    "separatrices": "separatrices",
    "launched": "launched orbits",
    "equator": "limit directions",
    "equator_cycle": "the closed equator",
    "critical": "critical sets",
    "name": "the name of the portrait",
    "classification": "what the portrait is",
    "slow_flow": "the slow flow",
    "outcomes": "outcomes",
    "eigendirections": "eigenvectors",
    "certificates": "theorems",
}

_theta = np.arange(COST_NET) * (2.0 * np.pi / COST_NET)
_DIRECTIONS = np.stack([np.cos(_theta), np.sin(_theta)], axis=-1)


class PendingLayer(Exception):
    """A layer is to be computed in the background."""


class OmittedLayer(Exception):
    """A layer is not drawn of this system: what it is called, and why."""

    @staticmethod
    def sentence(left_out: Iterable[OmittedLayer]) -> str:
        """Say in one sentence for each reason what is left out."""
        reasons: dict[str, list[str]] = {}
        for each in left_out:
            words, why = each.args
            if words not in reasons.setdefault(why, []):
                reasons[why].append(words)
        return " ".join(say("left out", names=", ".join(words), why=why) for why, words in reasons.items())


@dataclass(frozen=True)
class BackgroundLayers:
    """Layers computed in the background."""

    results: Mapping[str, Any]
    seconds: Mapping[str, float]  # processor time of each
    left_out: Mapping[str, str]  # why others are not there


def layers_of(
    scene: Scene, names: Iterable[str], known: Mapping[str, Any], seconds: float = MAX_LAYER_SECONDS
) -> BackgroundLayers:
    """Compute layers, one after the other, each for at most so long; equilibria come first."""
    from .time_limit import CompileClock, at_most  # late: it asks Numba, which a page without a server does not have

    scene.give(known)
    took: dict[str, float] = {}
    left_out: dict[str, str] = {}
    first = ("equator", "critical")
    for name in dict.fromkeys([*first, *names]):
        if name in PER_EQUILIBRIUM_LAYERS and (why := wild(scene)):
            left_out[name] = why
            continue
        began, compiling = time.thread_time(), CompileClock()
        try:
            with at_most(seconds, compiling):
                scene[name]
        except TimeoutError:
            left_out[name] = say("too long a layer", seconds=seconds)
            if name in first:
                others = dict.fromkeys((one for one in (*first, *names) if one not in took), left_out[name])
                return BackgroundLayers(scene.results(), took, {**others, **left_out})
        except FAILURES as error:
            left_out[name] = str(error)
        took[name] = time.thread_time() - began - compiling.seconds
    return BackgroundLayers(scene.results(), took, left_out)


def wild(scene: Scene) -> str:
    """Say why the layers that follow each limit direction and critical set are not drawn; "" if they are."""
    directions, sets = len(scene["equator"]), len(scene["critical"])
    if directions + sets <= MAX_EQUILIBRIA:
        return ""
    return say("too wild", directions=directions, sets=sets, most=MAX_EQUILIBRIA)


def wildness(scene: Scene) -> int:
    """Return what computing a layer costs more with: how often U1 and U2 turn along a net of directions.

    Of e-linear systems: how many times slower than all else the slowest approach is.
    """
    if isinstance(scene.coefficients, Coefficients):
        a, b, d, *f = scene.coefficients.plane
        fast = max(map(abs, (a, b, d, *f)))
        if not fast:
            return 0
        mean, half, b = 0.5 * (a / fast + d / fast), 0.5 * (a / fast - d / fast), b / fast
        root = math.sqrt(max(0.0, (half - b) * (half + b)))
        return int(1.0 / max(min(abs(mean - root), abs(mean + root)), 1e-9))
    U = scene.coefficients.U(_DIRECTIONS)
    steps = np.diff(U, axis=0, append=U[:1])
    return int(np.count_nonzero(np.diff(np.sign(steps), axis=0)) + np.count_nonzero(np.diff(np.sign(U), axis=0)))


class Budget:
    """The part of one browser's scenes that the answering thread may compute."""

    def __init__(self) -> None:
        self._timed: OrderedDict[Hashable, tuple[int, dict[str, float]]] = OrderedDict()
        self._left_out: OrderedDict[Hashable, Mapping[str, str]] = OrderedDict()
        self._slow_once: set[str] = set()
        self._wildness_of: tuple[Any, int] = (None, 0)  # of the system requested last: each layer of a frame asks
        self.begin()

    def begin(self) -> None:
        """Begin a frame."""
        self._spent = self._timed_so_far = 0.0  # by what layers cost before; by the clock
        self._worked_before = time.thread_time()

    def check_cost(self, scene: Scene, name: str) -> Callable[[], None] | None:
        """Let a layer be computed here and now, or raise; return what is to be called when it is.

        Raises
        ------
        PendingLayer
            It is to be computed in the background.
        OmittedLayer
            It is not drawn of this system.
        """
        why = self._left_out.get(self.key(scene), {}).get(name) if self._left_out else None
        if why is not None:
            raise OmittedLayer(WORDS.get(name, name), why)
        bounded, formula = self.is_bounded(scene), self._formula(scene)
        if bounded and name == "launched" and not len(scene.launch):
            return None  # nothing says how long an orbit would take
        if bounded and name in CYCLE_SEARCH_LAYERS and scene["name"].case == "III":
            raise PendingLayer(name)
        if bounded and is_left():  # kernels run as Python: that says nothing of later, and workers have not begun
            return None
        wildest, took = self._timed.get(formula, (0, {}))
        if bounded and name not in POSSIBLY_LONG_LAYERS:
            cost = took.get(name, 0.0)
        else:
            cost = took.get(name, math.inf) if self._wildness(scene) <= wildest else math.inf
        if cost > LAYER_BUDGET or self._spent + cost > FRAME_BUDGET:
            raise PendingLayer(name)
        self._spent += cost
        return partial(self._computed, formula, name, time.perf_counter(), self._timed_so_far)

    def _wildness(self, scene: Scene) -> int:
        """Return the wildness of a scene, computed once for all layers of a frame."""
        if self._wildness_of[0] is not scene.coefficients:
            self._wildness_of = scene.coefficients, wildness(scene)
        return self._wildness_of[1]

    def _computed(self, formula: Hashable, name: str, began: float, before_it: float) -> None:
        """Note what a layer took here, without the layers that it requested."""
        took = time.perf_counter() - began
        own, self._timed_so_far = took - (self._timed_so_far - before_it), before_it + took
        if own > LAYER_BUDGET:  # or this thread waited: asking how long it has worked takes longer than many a layer
            own = min(own, time.thread_time() - self._worked_before)
        if own > LAYER_BUDGET and name not in self._slow_once:
            self._slow_once.add(name)  # a kernel was loaded, or garbage looked for: what is slow twice is slow
            return
        self._slow_once.discard(name)
        _, before = self._timed.setdefault(formula, (0, {}))
        before[name] = max(own, 0.5 * before.get(name, 0.0))

    @staticmethod
    def is_bounded(scene: Scene) -> bool:
        """Whether nothing in this scene was typed, so that all sizes are known beforehand."""
        return scene.coefficients.typed is None and scene.psi.expression is None

    def record_costs(self, scene: Scene, found: BackgroundLayers) -> None:
        """Remember what layers of a scene took in the background, and keep them.

        A shorter time than before is believed by halves: a worker that has found something for one frame has it for
        the next, where this thread would search for it.
        """
        scene.give(found.results)
        formula = self._formula(scene)
        _, before = self._timed.get(formula, (0, {}))
        now = {name: max(took, 0.5 * before.get(name, 0.0)) for name, took in found.seconds.items()}
        self._timed[formula] = (3 * wildness(scene) // 2 + 8, {**before, **now})
        if found.left_out:
            self._left_out[self.key(scene)] = found.left_out
        for kept in (self._timed, self._left_out):
            while len(kept) > REMEMBERED_SCENES:
                kept.popitem(last=False)

    @staticmethod
    def key(scene: Scene) -> Hashable:
        """Return what all layers depend on."""
        return scene.key("plane", "slow", "psi", "inner seeds", "outer seeds", "launch", "view", "pixel", "place")

    @staticmethod
    def _formula(scene: Scene) -> Hashable:
        if Budget.is_bounded(scene):
            return None
        typed = scene.coefficients.typed
        return (None if typed is None else typed.U), scene.psi
