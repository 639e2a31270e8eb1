"""A scene: everything that is drawn at one setting, computed when it is first requested.

Each layer names the inputs that it reads. `Scene.evolve` makes a new scene which shares the results of all layers
whose inputs keep their values, so that a slider recomputes exactly what it reaches, a hidden layer costs nothing,
and going back to a setting just seen is free.
"""

from __future__ import annotations

import math
from collections import Counter, OrderedDict, defaultdict
from collections.abc import Callable, Hashable, Iterator, Mapping
from dataclasses import dataclass, field
from threading import Lock
from types import MappingProxyType
from typing import Any
from weakref import ref

import numpy as np
from numpy.typing import ArrayLike

from ..portrait.layer_problem.problem import CachedFunction, LayerProblem, Result
from ..portrait.orbits.seeds import LEAST_PIXEL, checked_seeds, stepping
from ..results import drawing
from ..results.result import Written, equal_values
from ..systems.arguments import number, whole_number
from ..systems.arguments import psi as checked_psi
from ..systems.frozen import FrozenSystem
from ..systems.kinds import SYSTEM_KINDS, AnySystem
from ..systems.presets.presets import named_setting
from ..systems.psi import constructors
from ..systems.psi.function import Psi
from ..systems.reading import slow_values
from .layer_table import INPUTS, LAYER_OF_FUNCTION, layers

ABSENT = object()  # in place of a result that is not kept
KEPT_RESULTS = 8  # results kept for each layer: a few settings back and forth


@dataclass
class Memory:
    """Results by layer and by the values that they were computed from."""

    # of each layer the last `KEPT_RESULTS`
    results: defaultdict[str, OrderedDict[Hashable, Any]] = field(default_factory=lambda: defaultdict(OrderedDict))
    # how often each layer has been computed, for tests and benchmarks
    runs: Counter[str] = field(default_factory=Counter)
    # ``before(scene, layer)`` is called before a layer is computed; it may raise, or return what is called after
    before: Callable[[Any, str], Callable[[], None] | None] | None = None
    lock: Lock = field(default_factory=Lock)  # the jobs in the background read the same memory

    def find(self, layer: str, key: Hashable) -> Any:
        """Return what is kept for these values, or `ABSENT`."""
        with self.lock:
            kept = self.results[layer]
            if key not in kept:
                return ABSENT
            kept.move_to_end(key)
            return kept[key]

    def keep(self, layer: str, key: Hashable, result: Any) -> None:
        """Keep a result, and forget the oldest of more than `KEPT_RESULTS`."""
        with self.lock:
            kept = self.results[layer]
            kept[key] = result
            if len(kept) > KEPT_RESULTS:
                kept.popitem(last=False)


MOST_SEEDS = 20_000

_PARAMETERS = (
    "system", "psi", "z", "seeds", "count", "launch", "t_max", "length", "rtol", "atol", "view", "pixel", "window",
    "cut",
)  # fmt: skip


def _again(inputs: dict[str, Any]) -> Scene:
    return Scene(inputs.pop("system"), inputs.pop("psi"), inputs.pop("z"), **inputs)


class _Problem(LayerProblem):
    """The layer problem of a scene: what it keeps is kept in the scene's memory, for the scenes to come.

    It does not hold its scene, so that a scene that nobody holds is gone at once, without a search for garbage.
    """

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene.coefficients, scene.psi, scene.cut)
        self._scene = ref(scene)

    def keep(self, finding: CachedFunction[Result]) -> Result:
        """Return what was found, once for all scenes that agree in what it reads."""
        scene = self._scene()
        if scene is None or not finding.layer:
            return super().keep(finding)
        result = self.found[finding] = scene[finding.layer]
        return result


class Scene(Written, Mapping[str, Any]):
    """Everything drawn for one system at one z, by name; layers are computed when first requested.

    ``scene["critical_sets"]`` is what ``critical_sets`` returns, and so for the other public functions.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z; or the name of a preset or an example
    psi : Psi, optional
        Default Psi = 1.
    z : (m,) floats
    seeds : (k, 2) points of the picture, optional
        Where trajectories start; default `structured_seeds(count)`.
    count : int
        Number of seeds when they are not given.
    launch : (k, 2) points of the picture, optional
        Where orbits of the layer "launched" start: the result says where they go and where they come from.
    t_max : float, optional
        Longest time T (dT = dt/rho) of each half of a trajectory. By default so long that it ends at the slowest
        attractor (`orbits.duration`); most halves end earlier, at an equilibrium or at `length`.
    length : float
        Length of each half at which it ends, in picture units.
    rtol, atol : float
        Tolerances of the trajectories. The default keeps errors far below a pixel.
    view : float
        Radius of the picture.
    pixel : float
        Size of one pixel in picture units: polylines stay within a quarter of it.
    window : (left, right, bottom, top), optional
        A rectangle of the picture that is looked at: half as many trajectories again start in it.
    cut : float
        Angle from which limit directions are counted: Q1 is the first at or after it. While a value moves,
        `direction_names.cut_that_keeps_names` keeps their names.

    Examples
    --------
    >>> from codim2_core import ELinear
    >>> scene = Scene(ELinear(-2, 0, -1, (-0.5, 0)))
    >>> scene["classification"].name
    'CM4'
    >>> scene.evolve(f1=-1.5)["classification"].name
    'CM2'
    """

    _internal_ = frozenset({"ask_before", "give", "key", "problem", "results", "runs"})

    def __init__(
        self,
        system: AnySystem | str,
        psi: Psi | str | None = None,
        z: ArrayLike | None = None,
        *,
        seeds: ArrayLike | None = None,
        count: int = 64,
        launch: ArrayLike = (),
        t_max: float | None = None,
        length: float = 9.0,
        rtol: float = 1e-6,
        atol: float = 1e-7,
        view: float = 2.0,
        pixel: float = 1.0 / 180.0,
        window: tuple[float, float, float, float] | None = None,
        cut: float = 0.0,
        _memory: Memory | None = None,
    ) -> None:
        if isinstance(system, str):
            setting = named_setting(system)
            system, psi = setting["system"], setting.get("psi") if psi is None else psi
            z = setting.get("z") if z is None else z
        if not isinstance(system, SYSTEM_KINDS):
            raise ValueError(f"system is {system!r}; give an ELinear or a System.")
        z = () if z is None else z
        psi = constructors.constant() if psi is None else checked_psi("psi", psi)
        view, pixel, count = number("view", view), number("pixel", pixel), whole_number("count", count, MOST_SEEDS)
        if not view > 1.0:
            raise ValueError(f"view is {view}; give a finite radius greater than 1 (the equator).")
        if not LEAST_PIXEL <= pixel < 1.0:
            raise ValueError(f"pixel is {pixel}; give the size of a pixel in picture units, from 1e-10 to 1.")
        self.system: AnySystem = system
        self.psi: Psi = psi
        self.z = slow_values(z, system.m, needed=False) if not system.frozen else ()
        self.seeds = None if seeds is None else checked_seeds(seeds)
        self.launch = checked_seeds(launch)
        self.count, self.rtol, self.atol = count, number("rtol", rtol), number("atol", atol)
        self.t_max, self.length = None if t_max is None else number("t_max", t_max), float(length)
        stepping(rtol=self.rtol, atol=self.atol, length=self.length)  # refuses what no trajectory may have
        if window is not None and not (
            len(window) == 4 and np.isfinite(window).all() and window[0] < window[1] and window[2] < window[3]
        ):
            raise ValueError(f"window is {window}; give finite left < right and bottom < top.")
        self.view, self.pixel, self.window, self.cut = view, pixel, window, number("cut", cut)
        self._memory = Memory() if _memory is None else _memory
        self._begin()

    def _begin(self) -> None:
        """Freeze the system, and know no layer yet."""
        self.coefficients: FrozenSystem = self.system.at(self.z)
        self._own: dict[str, Any] = {}
        self._inputs: dict[str, Hashable] = {}  # values of `INPUTS`, each found once
        self.problem: LayerProblem = _Problem(self)

    def evolve(self, **changes: Any) -> Scene:
        """Return a scene with some inputs changed, sharing every layer that the change does not reach.

        Parameters
        ----------
        **changes
            Any parameter of `Scene`, and whatever the system's own `evolve` takes: coefficients (a, b, d, f, f1, f2,
            B, g), formulas (U, W), parameters by name.

        Raises
        ------
        ValueError
            An input is unknown or invalid; this scene stays as it was.
        """
        own = {name: changes.pop(name) for name in tuple(changes) if name in _PARAMETERS}
        system = own.get("system", self.system)
        if changes:
            if system.frozen:
                raise ValueError("this scene was made from a system frozen at one z; give it a system to change.")
            system = system.evolve(**changes)
        if not own and system.m == self.system.m:  # all else was checked when this scene was made
            scene = object.__new__(Scene)
            scene.__dict__.update(self.__dict__, system=system)
            scene._begin()
            return scene
        values = {**{name: getattr(self, name) for name in _PARAMETERS}, **own, "system": system}
        return Scene(values.pop("system"), values.pop("psi"), values.pop("z"), **values, _memory=self._memory)

    def __getitem__(self, name: str) -> Any:
        if name in self._own:
            return self._own[name]
        if name not in layers:
            if name not in LAYER_OF_FUNCTION:
                raise ValueError(f"{name!r} is no layer; there are {', '.join((*layers, *LAYER_OF_FUNCTION))}.")
            return self[LAYER_OF_FUNCTION[name]]
        layer = layers[name]

        memory, key = self._memory, self.key(*layer.inputs)
        result = memory.find(name, key)
        if result is ABSENT:
            after = None if memory.before is None else memory.before(self, name)
            result = layer.compute(self)
            if after is not None:
                after()
            memory.keep(name, key, result)
            memory.runs[name] += 1
        self._own[name] = result
        return result

    def to_holoviews(self) -> Any:
        """Return the picture as a HoloViews overlay, to add to, restyle and lay out.

        It is drawn by ``codim2_app.holoviews``, which loads HoloViews' Bokeh backend if none is loaded.

        Returns
        -------
        holoviews.Overlay

        Raises
        ------
        ValueError
            The app that draws is not installed.
        """
        return drawing.overlay(self)

    def plot(self, ax: Any = None) -> Any:
        """Draw the picture into Matplotlib axes, and return them; without axes, return `to_holoviews`.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional

        Raises
        ------
        ValueError
            Matplotlib, or the app, which draws, is not installed.
        """
        return self.to_holoviews() if ax is None else drawing.plot(self, ax)

    def _records(self) -> Iterator[dict[str, Any]]:
        """Yield limit directions and critical sets, with their places in the projected disc."""
        equator = self["equator"]
        for i, (theta, outwards, along) in enumerate(
            zip(equator.theta.tolist(), equator.lambda_rho.tolist(), equator.lambda_theta.tolist(), strict=True), 1
        ):
            kind = f"{'attracts' if outwards < 0.0 else 'repels'}, {'attracts' if along < 0.0 else 'repels'} along"
            yield {"name": f"Q{i}", "kind": kind, "p_1": math.cos(theta), "p_2": math.sin(theta)}
        for i, C in enumerate(self["critical"], 1):
            yield {"name": f"C{i}", "kind": C.kind, "p_1": float(C.p[0]), "p_2": float(C.p[1])}

    def __repr__(self) -> str:
        return f"Scene({self.system!r}, {self.psi!r}, z={self.z})"

    def _repr_svg_(self) -> str | None:
        return drawing.svg(self)

    def _repr_html_(self) -> str:
        results = (self["classification"], self["equator"], self["critical"])
        tables = "".join(result._repr_html_() for result in results)
        return drawing.image(self) + tables

    def __iter__(self) -> Iterator[str]:
        return iter(layers)

    def __len__(self) -> int:
        return len(layers)

    def __contains__(self, name: object) -> bool:
        return name in layers or name in LAYER_OF_FUNCTION

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        return self is other or all(equal_values(getattr(self, name), getattr(other, name)) for name in _PARAMETERS)

    def __hash__(self) -> int:
        return hash((type(self), self.count, self.view, self.pixel, self.cut))

    def __reduce__(self) -> tuple[Any, ...]:
        """Be pickled, and copied, by the inputs: what has been computed stays here."""
        return _again, ({name: getattr(self, name) for name in _PARAMETERS},)

    def ask_before(self, before: Callable[[Scene, str], Callable[[], None] | None]) -> None:
        """Let ``before(scene, name)`` be called before a layer of this lineage is computed.

        It may raise, or return what is called when the layer has been computed.
        """
        self._memory.before = before

    def results(self) -> dict[str, Any]:
        """Return the layers that are known for these inputs, by name."""
        found = dict(self._own)
        for name, kept in tuple(self._memory.results.items()):
            result = kept.get(self.key(*layers[name].inputs))
            if result is not None:
                found[name] = result
        return found

    def give(self, results: Mapping[str, Any]) -> None:
        """Keep layers that were computed for these inputs elsewhere."""
        for name, result in results.items():
            self._memory.keep(name, self.key(*layers[name].inputs), result)

    def key(self, *inputs: str) -> tuple[Hashable, ...]:
        """Return the present values of some inputs of layers ("plane", "slow", "psi", …), hashable."""
        known = self._inputs
        for name in inputs:
            if name not in known:
                known[name] = INPUTS[name](self)
        return tuple(map(known.__getitem__, inputs))

    @property
    def runs(self) -> Mapping[str, int]:
        """Return how often each layer has been computed in this scene and those it evolved from or into."""
        return MappingProxyType(self._memory.runs)
