"""A scene: everything that is drawn at one setting, computed when it is first asked for.

Each layer names the inputs that it reads. `Scene.evolve` makes a new scene which shares the results of all layers
whose inputs keep their values, so that a slider recomputes exactly what it reaches, a hidden layer costs nothing,
and going back to a setting just seen is free.
"""

from __future__ import annotations

from collections import Counter, OrderedDict
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from threading import Lock
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..bifurcations import BifurcationCurve, Region, critical_boundary, regions, saddle_node
from ..cycles.limit_cycles import closed_orbits, cycles_of
from ..layer_problem.problem import (
    LayerProblem,
    Result,
    find_critical,
    find_equator,
    find_equator_cycle,
    find_location,
)
from ..nullcline.nullclines import NullclineBranch, inside_nullclines, outside_nullclines
from ..orbits.duration import drawn_duration
from ..orbits.seeds import checked_seeds, ring, structured_seeds, window_seeds
from ..orbits.trajectories import Trajectories, continuation, trajectories
from ..orbits.whole import Orbits
from ..portrait.classify import portrait
from ..portrait.launched import Launched, launched
from ..portrait.outcomes import outcomes_of
from ..portrait.separatrices import Separatrices, separatrices_of
from ..psi import constructors
from ..psi.function import Psi
from ..sliding.flow import sliding_flow
from ..systems.bounds import SMALLEST, slow_values
from ..systems.coefficients import Coefficients
from ..systems.kinds import KINDS, AnySystem
from ..theorems.certificates import Certificate, certificates_of

AROUND = 0.05  # radius of the seeds around an unstable critical set
STEPS = 780  # of half a drawn orbit: one that creeps along a slow direction, 1/300 as fast, is not waited for
CAPTURE = 0.25  # of a pixel: where a drawn trajectory ends, so near its equilibrium that nobody can see the rest
REMEMBERED = 8  # results kept for each layer: a few settings back and forth


@dataclass(frozen=True, slots=True)
class Layer:
    """One layer: the names of the inputs it reads, and how it is made from a scene."""

    inputs: tuple[str, ...]
    compute: Callable[[Scene], Any]


class _Problem(LayerProblem):
    """The layer problem of a scene: what it keeps is kept in the scene's memory, for the scenes to come."""

    def __init__(self, scene: Scene) -> None:
        super().__init__(scene.coefficients, scene.psi)
        self._scene = scene

    def keep(self, find: Callable[[LayerProblem], Result]) -> Result:
        """Return ``find(self)``, computed once for all scenes that agree in what it reads."""
        name = _NAMES.get(find)
        return super().keep(find) if name is None else self._scene[name]


@dataclass
class _Memory:
    """What the scenes of one lineage have computed; `runs` counts the work, for tests and benchmarks."""

    results: dict[str, OrderedDict[Hashable, Any]] = field(default_factory=dict)
    runs: Counter[str] = field(default_factory=Counter)
    lock: Lock = field(default_factory=Lock)  # the jobs beside the frames read the same memory


class Scene:
    """Everything drawn for one system at one z; layers are computed when first asked for.

    Parameters
    ----------
    system : ELinear or System, or either frozen at a z
        Layers of the theory of e-linear systems (`ELINEAR_ONLY`) are None for another; `has` says so beforehand.
    psi : Psi, optional
        Default Psi = 1.
    z : (m,) floats
    seeds : (k, 2) points of the picture, optional
        Where trajectories start; default `structured_seeds(count)`.
    count : int
        Number of seeds when they are not given.
    launch : (k, 2) points of the picture, optional
        Where orbits of the layer "launched" start: they are told where they go and where they come from.
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

    Examples
    --------
    >>> scene = Scene(ELinear(-2, 0, -1, (-0.5, 0)))
    >>> scene["classification"].name
    'CM4'
    >>> scene.evolve(f1=-1.5)["classification"].name
    'CM2'
    """

    def __init__(
        self,
        system: AnySystem,
        psi: Psi | None = None,
        z: ArrayLike = (),
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
        _memory: _Memory | None = None,
    ) -> None:
        if not isinstance(system, KINDS):
            raise ValueError(f"system is {system!r}; give an ELinear or a System.")
        if psi is None:
            psi = constructors.constant()
        if not isinstance(psi, Psi):
            raise ValueError(f"psi is {psi!r}; give a regularisation function such as psi.rational().")
        if not (np.isfinite(view) and view > 1.0):
            raise ValueError(f"view is {view}; give a finite radius greater than 1 (the equator).")
        if not (np.isfinite(pixel) and 0.0 < pixel < 1.0):
            raise ValueError(f"pixel is {pixel}; give the size of a pixel in picture units, in (0, 1).")
        self.system, self.psi = system, psi
        self.z = slow_values(z, system.m, needed=False) if not system.frozen else ()
        self.seeds = None if seeds is None else checked_seeds(seeds)
        self.launch = checked_seeds(launch)
        self.count, self.rtol, self.atol = count, float(rtol), float(atol)
        self.t_max, self.length = None if t_max is None else float(t_max), float(length)
        if window is not None and not (
            len(window) == 4 and np.isfinite(window).all() and window[0] < window[1] and window[2] < window[3]
        ):
            raise ValueError(f"window is {window}; give finite left < right and bottom < top.")
        self.view, self.pixel, self.window = float(view), float(pixel), window
        self.coefficients = system.at(self.z)
        self._memory = _Memory() if _memory is None else _memory
        self._own: dict[str, Any] = {}
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
        values = {name: getattr(self, name) for name in _PARAMETERS}
        values.update(own)
        if changes:
            if values["system"].frozen:
                raise ValueError("this scene was made from a system frozen at one z; give it a system to change.")
            values["system"] = values["system"].evolve(**changes)
        return Scene(values.pop("system"), values.pop("psi"), values.pop("z"), **values, _memory=self._memory)

    def __getitem__(self, name: str) -> Any:
        if name in self._own:
            return self._own[name]
        if name not in layers:
            raise ValueError(f"{name!r} is no layer; there are {', '.join(layers)}.")
        layer = layers[name]
        key = self.key(*layer.inputs)
        memory = self._memory
        with memory.lock:
            kept = memory.results.setdefault(name, OrderedDict())
            known = key in kept
            if known:
                kept.move_to_end(key)
                self._own[name] = kept[key]
        if not known:
            self._own[name] = result = layer.compute(self)
            with memory.lock:
                kept[key] = result
                memory.runs[name] += 1
                if len(kept) > REMEMBERED:
                    kept.popitem(last=False)
        return self._own[name]

    def __iter__(self):
        return iter(layers)

    def has(self, name: str) -> bool:
        """Whether a layer exists for this system; one that does not is None."""
        return name in layers and (name not in ELINEAR_ONLY or self.coefficients.typed is None)

    def key(self, *inputs: str) -> tuple[Hashable, ...]:
        """Return the present values of some inputs of layers ("plane", "matrix", "slow", "psi", …), hashable."""
        return tuple(_INPUTS[name](self) for name in inputs)

    @property
    def runs(self) -> Mapping[str, int]:
        """How often each layer has been computed in this scene and those it evolved from or into."""
        return MappingProxyType(self._memory.runs)


_PARAMETERS = (
    "system", "psi", "z", "seeds", "count", "launch", "t_max", "length", "rtol", "atol", "view", "pixel", "window"
)  # fmt: skip

ELINEAR_ONLY = frozenset({"atlas_curves", "regions"})

# The values that layers read, as keys: `plane` is (a, b, d, f1, f2) at z, or the formulas of U and the numbers that
# they read, and `matrix` is (a, b, d), so z itself reaches nothing but what looks along z: `place`.
_INPUTS: dict[str, Callable[[Scene], Hashable]] = {
    "plane": lambda s: s.coefficients.key,
    "matrix": lambda s: _matrix(s),
    "slow": lambda s: s.coefficients.slow_key,
    "place": lambda s: (s.system, s.z) if s.system.moves_with_z else None,
    "psi": lambda s: s.psi,
    "inner seeds": lambda s: (s.count, s.window) if s.seeds is None else _start(s, outside=False).tobytes(),
    "outer seeds": lambda s: (s.count, s.window) if s.seeds is None else _start(s, outside=True).tobytes(),
    "launch": lambda s: s.launch.tobytes(),
    "time": lambda s: (s.t_max, s.length),
    "tolerance": lambda s: (s.rtol, s.atol),
    "view": lambda s: s.view,
    "pixel": lambda s: s.pixel,
}
_STEPPED = ("time", "tolerance", "pixel")


def _start(scene: Scene, outside: bool) -> np.ndarray:
    if scene.seeds is not None:
        return _sides(scene.seeds)[outside]
    seeds = _structured(scene.count, scene.view)[outside]
    if scene.window is None:
        return seeds
    return np.concatenate([seeds, _sides(window_seeds(scene.count // 2, scene.window))[outside]])


def _sides(seeds: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the seeds on the hemisphere, and those outside or on the equator."""
    outside = np.hypot(seeds[:, 0], seeds[:, 1]) >= 1.0
    return seeds[~outside], seeds[outside]


@lru_cache(maxsize=32)
def _structured(count: int, view: float) -> tuple[np.ndarray, np.ndarray]:
    return _sides(structured_seeds(count, view))


def _stepping(scene: Scene, outside: bool = False) -> dict[str, Any]:
    longest = scene.t_max
    if longest is None:
        problem = scene.problem
        longest = drawn_duration(problem.at, problem.equator, () if outside else problem.critical)
    return {
        "t_max": longest,
        "length": scene.length,
        "rtol": scene.rtol,
        "atol": scene.atol,
        "view": scene.view,
        "pixel": scene.pixel,
        "capture": CAPTURE * scene.pixel,
        "step_limit": STEPS,
    }


def _orbits(scene: Scene, outside: bool) -> Orbits:
    seeds, options = _start(scene, outside), _stepping(scene, outside)
    if not outside and scene.seeds is None and scene.count:
        # What leaves an unstable critical set (to a limit cycle, in Case III) starts nearer to it than any fixed seed.
        rings = [C.p + ring(AROUND, 6) for C in scene["critical"] if C.kind.startswith(("unstable", "centre"))]
        seeds = np.concatenate([seeds, *(r for r in rings if np.hypot(r[:, 0], r[:, 1]).max() < 1.0)])
    # Outside, e is the direction itself: Psi has no say. E-linear systems have a field that is cheapest for Psi = 1.
    cheapest = outside and scene.coefficients.typed is None
    psi = constructors.constant() if cheapest else scene.psi
    halves = (trajectories(scene.coefficients, psi, seeds, backward=back, **options) for back in (True, False))
    return Orbits(*halves)


def _continuations(scene: Scene) -> Trajectories:
    """From each limit direction along which an open set of trajectories arrives, up the hemisphere."""
    equator = scene["equator"]
    arriving = equator.theta[(equator.lambda_rho < 0.0) & (equator.lambda_theta < 0.0)]
    return continuation(scene.coefficients, scene.psi, arriving, **_stepping(scene))


def _launched(scene: Scene) -> Launched:
    return launched(scene.problem, scene.launch, view=scene.view, pixel=scene.pixel)


def _separatrices(scene: Scene) -> Separatrices:
    return separatrices_of(scene.problem, rtol=scene.rtol, pixel=scene.pixel)


def _elinear(scene: Scene) -> Coefficients | None:
    """Return the coefficients of an e-linear system, None for a typed one."""
    at = scene.coefficients
    return at.as_given if at.typed is None else None


def _matrix(scene: Scene) -> tuple[float, float, float] | None:
    """Return a, b, d; all zero where they are so small beside f that a system of them alone is refused."""
    at = _elinear(scene)
    if at is None:
        return None
    a, b, d = at.plane[:3]
    return (a, b, d) if max(abs(a), abs(b), abs(d)) >= SMALLEST else (0.0, 0.0, 0.0)


def _atlas_curves(scene: Scene) -> tuple[BifurcationCurve, BifurcationCurve] | None:
    """Return the saddle-node curve and the ellipse |A^-1 f| = 1 of the plane (f1, f2)."""
    matrix = _matrix(scene)
    return None if matrix is None else (saddle_node(*matrix), critical_boundary(*matrix))


def _regions(scene: Scene) -> tuple[Region, ...] | None:
    matrix = _matrix(scene)
    return None if matrix is None else regions(*matrix)


def _certificates(scene: Scene) -> tuple[Certificate, ...]:
    return certificates_of(scene.problem, scene["cycles"], None if scene.system.frozen else scene.system, scene.z)


def _inside_nullclines(scene: Scene) -> tuple[NullclineBranch, ...]:
    return inside_nullclines(scene.coefficients, scene.psi, scene["equator"].theta.tolist())


def _outside_nullclines(scene: Scene) -> tuple[NullclineBranch, ...]:
    return outside_nullclines(scene.coefficients, scene["equator"].theta.tolist(), scene.view)


layers: Mapping[str, Layer] = MappingProxyType(
    {
        "equator": Layer(("plane",), lambda s: find_equator(s.problem)),
        "equator_cycle": Layer(("plane",), lambda s: find_equator_cycle(s.problem)),
        "location": Layer(("plane",), lambda s: find_location(s.problem)),
        "critical": Layer(("plane", "slow", "psi"), lambda s: find_critical(s.problem)),
        "slow_flow": Layer(("plane", "slow"), lambda s: sliding_flow(s.coefficients)),
        "classification": Layer(("plane", "slow", "psi"), lambda s: portrait(s.problem)),
        "nullclines_inside": Layer(("plane", "psi"), _inside_nullclines),
        "nullclines_outside": Layer(("plane", "view"), _outside_nullclines),
        "inside": Layer(("plane", "psi", "inner seeds", *_STEPPED), lambda s: _orbits(s, outside=False)),
        "outside": Layer(("plane", "outer seeds", "view", *_STEPPED), lambda s: _orbits(s, outside=True)),
        "continuations": Layer(("plane", "psi", *_STEPPED), _continuations),
        "closed_orbits": Layer(("plane", "psi"), lambda s: closed_orbits(s.problem)),
        "cycles": Layer(("plane", "slow", "psi"), lambda s: cycles_of(s.problem)),
        "launched": Layer(("plane", "psi", "launch", "view", "pixel"), _launched),
        "separatrices": Layer(("plane", "psi", "tolerance", "pixel"), _separatrices),
        "outcomes": Layer(("plane", "slow", "psi"), lambda s: outcomes_of(s.problem)),
        "certificates": Layer(("plane", "slow", "psi", "place"), _certificates),
        "atlas_curves": Layer(("matrix",), _atlas_curves),
        "regions": Layer(("matrix",), _regions),
    }
)

# The layers that are functions of the layer problem alone: whoever asks the problem for them asks the scene.
_NAMES: dict[Any, str] = {
    find_equator: "equator",
    find_equator_cycle: "equator_cycle",
    find_location: "location",
    find_critical: "critical",
    portrait: "classification",
    closed_orbits: "closed_orbits",
    cycles_of: "cycles",
    outcomes_of: "outcomes",
}
