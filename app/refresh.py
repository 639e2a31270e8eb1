"""From a request of the browser to one frame: state, then scene, then only what is visible and has changed.

The browser decides when to ask: one request is out at a time and newer values replace older ones there, so that
nothing ever queues here.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.regularisation import Psi
from codim2_core.scene import Scene
from codim2_core.systems import ELinear

from . import atlas, glyphs
from .packing import pack, quantise
from .state import COEFFICIENTS, ExplorerState, InputError, build_psi, build_system, clean, scene_changes
from .theme import REACH

#: Angles of arrowheads travel as int16 multiples of this.
ANGLE_STEP = np.pi / 32767

#: Layers made by the compiled integrator.
ORBITS = ("outside", "inside", "continuations")
#: Where arrowheads sit on an orbit, as fractions of its length.
ARROWS = {"outside": (0.3, 0.7), "inside": (0.35, 0.75), "continuations": (0.5,)}
#: Kinds of branches that each nullcline control shows.
NULLCLINES = {"rho": ("rho",), "theta": ("theta",), "lines": ("U1", "U2")}

#: Controls of the pad, where f is dragged over the plane (f1, f2): a system that locks one of them has no pad.
PAD = ("a", "b", "d", "f1", "f2")
#: Blocks of the curves in that plane, in the order of the layer "atlas_curves".
CURVES = ("saddle_node", "transcritical")

Blocks = dict[str, NDArray[Any]]

#: What the core raises for input that it cannot use.
FAILURES = (ValueError, ArithmeticError, np.linalg.LinAlgError)


class Frames:
    """The picture of one browser: its state, its scene, and which results it has been sent.

    Parameters
    ----------
    state : ExplorerState
    system : ELinear, optional
        Drawn instead of the system of the controls a, b, d, f, k, B, g.
    ready : callable, optional
        Says whether the compiled integrator is ready for this Psi; until then trajectories are left out.
    """

    def __init__(
        self, state: ExplorerState, system: ELinear | None = None, ready: Callable[[Psi], bool] = lambda _psi: True
    ) -> None:
        self.state = state
        self.values = state.values()
        self.scene = make_scene(self.values, system)
        self.locked = locked_controls(self.scene)
        self.has_pad = not set(PAD) & set(self.locked)
        self.ready = ready
        self._sent: dict[str, Any] = {}

    def answer(self, request: Mapping[str, Any]) -> bytes:
        """Return the frame for ``{"id": number, "set": {control: value}, "all", "rest", "theorems": bool}``.

        ``all`` asks for every layer again, as a browser does that has just connected; ``rest`` says that no control
        is moving, so that there is time for the regions of the plane of f; ``theorems``, that their list is open. A
        value that cannot be used, and a computation that fails, leave the last good picture: the frame then holds
        only ``errors``, with the name of the control and a sentence.
        """
        identity = request.get("id", 0)
        sent = {} if request.get("all") else self._sent
        errors: dict[str, str] = {}
        good: dict[str, Any] = {}
        for name, value in (request.get("set") or {}).items():
            try:
                good[name] = clean(name, value)
            except InputError as error:
                errors[error.control] = str(error)
        beside = {name for name in ("rest", "theorems") if request.get(name)}
        if request.get("all"):
            beside.add("rest")
        if self.has_pad:
            beside.add("pad")
        drawn = self._accept(good, sent, errors, beside)
        if drawn is None and "rest" in beside and good:
            # the browser still lacks what was left out while the last good picture was moving
            drawn = self._accept({}, sent, errors, beside)
        if drawn is None:
            return pack({"id": identity, "errors": errors}, {})
        header, blocks = drawn
        return pack({"id": identity, "errors": errors, **header}, blocks)

    def _accept(
        self, good: Mapping[str, Any], sent: Mapping[str, Any], errors: dict[str, str], beside: Collection[str]
    ) -> tuple[dict[str, Any], Blocks] | None:
        """Draw with all changes or, where that fails, with those that can be had one after the other."""
        try:
            return self._draw(good, sent, beside)
        except FAILURES as error:
            if len(good) < 2:
                errors[_culprit(error, next(iter(good), ""))] = str(error)
                return None
        kept: dict[str, Any] = {}
        drawn = None
        for name, value in good.items():
            try:
                drawn = self._draw({**kept, name: value}, sent, beside)
                kept[name] = value
            except FAILURES as error:
                errors[_culprit(error, name)] = str(error)
        return drawn

    def _draw(
        self, changes: Mapping[str, Any], sent: Mapping[str, Any], beside: Collection[str]
    ) -> tuple[dict[str, Any], Blocks]:
        values = {**self.values, **changes}
        changed = [name for name in changes if values[name] != self.values[name]]
        evolution = scene_changes([name for name in changed if name not in self.locked], values)
        if "z" in evolution:
            evolution["z"] = slow_position(self.scene, values["z"])
        scene = self.scene.evolve(**evolution) if evolution else self.scene
        header, blocks, now_sent = make_frame(scene, values, sent, self.ready(scene.psi), beside)
        self.scene, self.values, self._sent = scene, values, now_sent
        if changed:
            self.state.param.update(**{name: values[name] for name in changed})
        return header, blocks


def _culprit(error: Exception, name: str) -> str:
    return error.control if isinstance(error, InputError) else name


def slow_position(scene: Scene, z: float) -> tuple[float, ...]:
    """Return z with the further slow variables, if there are any, at 0."""
    m = scene.system.m if isinstance(scene.system, ELinear) else 0
    return (z, *[0.0] * (m - 1)) if m else ()


def make_scene(values: Mapping[str, Any], system: ELinear | None = None) -> Scene:
    """Return the scene of these values, or of `system` at z = values["z"] (further slow variables at 0)."""
    system = build_system(values) if system is None else system
    z = (values["z"], *[0.0] * (system.m - 1)) if system.m else ()
    return Scene(system, build_psi(values), z=z, count=values["trajectories"], view=REACH)


def locked_controls(scene: Scene) -> tuple[str, ...]:
    """Name the controls that cannot change a user's own system: coefficients given as text, or not there."""
    system = scene.system
    if not isinstance(system, ELinear):
        return COEFFICIENTS
    named = dict(system.parameters)
    given = {"a": system.a, "b": system.b, "d": system.d, "f1": system.f[0], "f2": system.f[1]}
    if system._matrix is not None:  # made by from_matrix: a, b, d follow from the rotation, and f is turned by it
        given = {}
    free = {*named, *(name for name, value in given.items() if isinstance(value, float))}
    locked = tuple(name for name in COEFFICIENTS if name not in free)
    return locked if system.m else (*locked, "z")


def make_frame(
    scene: Scene,
    values: Mapping[str, Any],
    sent: Mapping[str, Any],
    ready: bool = True,
    beside: Collection[str] = ("pad", "rest"),
) -> tuple[dict[str, Any], Blocks, dict[str, Any]]:
    """Return header and blocks of one frame, and what the browser then holds.

    Only visible layers are computed, and only those whose result is another object than the one in `sent` are
    packed. `scene` shares results that a change does not reach, so that identity is the whole test. What goes with
    the picture is named in `beside`: "pad", the curves of the plane of f; "rest", its regions too, which take as long
    as all else in a frame; "theorems".
    """
    visible = set(values["layers"])
    now = dict(sent)
    header: dict[str, Any] = {"ready": ready}
    blocks: Blocks = {}

    def fresh(key: str, result: Any) -> bool:
        if key in now and now[key] is result:
            return False
        now[key] = result
        return True

    nullclines = [name for name in NULLCLINES if name in visible]
    for layer in ("nullclines_inside", "nullclines_outside") if nullclines else ():
        _add_nullclines(blocks, layer, nullclines, scene[layer], fresh)
    for name in ORBITS:
        if ready and name in visible and fresh(name, scene[name]):
            orbits = scene[name]
            _add_lines(blocks, name, orbits.offsets, orbits.buffer, ARROWS[name])
    if ready and "cycles" in visible and fresh("cycles", scene["cycles"]):
        header["cycles"] = glyphs.cycle_columns(scene["cycles"])
        _add_lines(blocks, "cycles", *glyphs.join([c.points for c in scene["cycles"]]), where=(0.25, 0.75))
    if ready and "separatrices" in visible and fresh("separatrices", scene["separatrices"]):
        for direction in ("stable", "unstable"):
            branches = [b.points for b in scene["separatrices"] if b.inside and b.direction == direction]
            _add_lines(blocks, f"separatrices_{direction}", *glyphs.join(branches), where=(0.5,))
    equator, cycle, critical = scene["equator"], scene["equator_cycle"], scene["critical"]
    if fresh("equator", equator):
        header["equator"] = glyphs.equator_columns(equator)
        header["sense"] = glyphs.equator_arrows(equator, 0 if cycle is None else int(cycle.direction))
        header["all_directions"] = bool(equator.all_directions)
        header["cycle"] = None if cycle is None else float(cycle.exponent)
    if fresh("critical", critical):
        header["critical"] = glyphs.critical_columns(critical)
    name = scene["classification"]
    if fresh("classification", name):
        header["portrait"] = {
            "case": name.case,
            "name": name.name,
            "sentence": name.sentence,
            "degeneracies": [[item.name, item.sentence] for item in name.degeneracies],
        }
    if "pad" in beside:
        _add_atlas(header, blocks, scene, "rest" in beside, fresh)
    if ready and "theorems" in beside and fresh("certificates", scene["certificates"]):
        header["theorems"] = glyphs.certificate_rows(scene["certificates"])
    flow = scene["slow_flow"]
    header["slow_flow"] = None if flow is None else [float(v) for v in flow]
    header["f"] = [float(scene.coefficients.f1), float(scene.coefficients.f2)]
    return header, blocks, now


def _add_atlas(
    header: dict[str, Any], blocks: Blocks, scene: Scene, rest: bool, fresh: Callable[[str, Any], bool]
) -> None:
    curves = scene["atlas_curves"]
    size = atlas.size_of(curves)
    if fresh("atlas_curves", curves):
        header["atlas_size"] = size
        for name, curve in zip(CURVES, curves, strict=True):
            _add_lines(blocks, name, *atlas.curve_lines(curve, size))
    if not rest:
        return
    header["rest"] = True  # the regions that the browser then has are those of these curves
    if fresh("regions", scene["regions"]):
        header["regions"] = atlas.region_columns(scene["regions"], size)
        _add_lines(blocks, "regions", *atlas.region_lines(scene["regions"], size))


def _add_nullclines(
    blocks: Blocks, layer: str, names: Sequence[str], branches: Sequence[Any], fresh: Callable[[str, Any], bool]
) -> None:
    side = layer.removeprefix("nullclines_")
    wanted = [name for name in names if fresh(f"{name}_{side}", branches)]
    for name in wanted:
        kinds = NULLCLINES[name]
        _add_lines(blocks, f"{name}_{side}", *glyphs.join([b.points for b in branches if b.kind in kinds]))


def _add_lines(
    blocks: Blocks,
    name: str,
    offsets: NDArray[np.int64],
    points: NDArray[np.float64],
    where: Sequence[float] = (),
) -> None:
    blocks[f"{name}.n"] = np.diff(offsets).astype(np.uint16)
    blocks[f"{name}.xy"] = quantise(points)
    if where:
        heads = glyphs.arrowheads(offsets, points, where)
        blocks[f"{name}.at"] = quantise(heads[:, :2])
        blocks[f"{name}.angle"] = np.rint(heads[:, 2] / ANGLE_STEP).astype(np.int16)
