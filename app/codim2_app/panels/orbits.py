"""The panel "Motion": what was launched, with where it goes and comes from; the chosen orbit, or start, over time."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from codim2_core.motion.simulate import simulate
from codim2_core.portrait.layer_problem.hemisphere import scaling_from_disc
from codim2_core.portrait.orbits.in_time import LEAST_RADIUS, angle_along, in_time
from codim2_core.systems.kinds import FrozenSystem
from codim2_core.systems.psi.function import Psi

from ..picture.frame.frame_context import FrameContext
from ..picture.phrases import say
from ..picture.slow_layers import typed_start
from ..picture.slow_layers.short import short
from ..picture.slow_layers.typed_start import RTOL
from ..picture.state.chosen_system import System_
from ..picture.state.launches import TYPED, read_launches, selected_place
from .panel import Panel

CONTINUATION_FACTOR = (
    1.5  # times as long as it takes to Sigma is a motion for eps > 0 followed: what it does there is seen too
)


def add(draft: FrameContext) -> None:
    """Add the chosen orbit over time, and its motion for eps > 0 if it is wanted, once nothing moves."""
    i = selected_place(read_launches(draft.values["orbits"]), draft.values["orbit"])
    if i is None:
        return
    if i == TYPED:
        typed_start.add(draft)
        return
    if not draft.ready:
        draft.late("orbit")
        return
    scene = draft.scene
    launched = scene["launched"]
    seed, clock = tuple(scene.launch[i].tolist()), launched.orbits.times[i]
    if np.hypot(*seed) == 1.0:
        if draft.fresh("orbit", launched):
            draft.unable("orbit", say("no time passes"))
        return
    span = float(clock[0]), float(clock[-1])
    key = (i, seed, span, scene.key("plane", "psi"))
    orbit = draft.slow("orbit", key, over_time, scene.coefficients, scene.psi, seed, span)
    if orbit is not None:
        draft.header["orbit"] = {"index": i, "m": len(scene.z), **orbit}
        draft.now["orbit ends"] = key, orbit["t"][-1]
    if draft.values["orbit_eps"] == "show" and draft.system is not None:
        followed, end = draft.now.get("orbit ends", (None, 0.0))
        if followed != key:  # the motion lasts as long as the orbit, which is to come, or cannot be followed
            if draft.now.get("orbit") != key:
                draft.late("orbit_motion")
            return
        eps = 10.0 ** draft.values["log_eps"]
        lasts = end * (CONTINUATION_FACTOR if launched.goes[i].after is not None else 1.0)
        wanted = (draft.system, scene.psi, eps, seed, scene.z, lasts)
        motion = draft.slow("orbit_motion", wanted, regularised_motion, *wanted)
        if motion is not None:
            draft.header["orbit_motion"] = {"index": i, **motion}


def over_time(at: FrozenSystem, psi: Psi, seed: tuple[float, float], span: tuple[float, float]) -> dict[str, Any]:
    """Return an orbit over time as the browser draws it."""
    orbit = in_time(at, psi, seed, span)
    return {
        "fast": orbit.fast,
        "t": short(orbit.time),
        "states": [short(column) for column in (*orbit.xy.T, orbit.theta, orbit.radius)],
        "picture": [short(column) for column in orbit.points.T],
    }


def regularised_motion(
    system: System_,
    psi: Psi,
    eps: float,
    seed: tuple[float, float],
    z: tuple[float, ...],
    lasts: float,
) -> dict[str, Any]:
    """Return the motion for eps > 0 from where an orbit starts, in the units of the orbit, as the browser draws it."""
    radius = math.hypot(*seed)
    fast = radius < 1.0
    unit = eps if fast else 1.0
    start = scaling_from_disc(seed) if fast else np.array(seed) * ((radius - 1.0) / radius)
    run = simulate(system, psi, (*(unit * start).tolist(), *z), (0.0, unit * lasts), eps=eps, rtol=RTOL)
    drawn = run.drawn()
    x, y = drawn.states[:, 0] / unit, drawn.states[:, 1] / unit
    rho = np.hypot(x, y)
    angle = angle_along(np.column_stack([x, y]), LEAST_RADIUS * (1.0 if fast else eps))
    height = np.hypot(*drawn.points.T) if fast else rho
    return {
        "eps": eps,
        "t": short(drawn.times / unit),
        "states": [short(column) for column in (x, y, angle, height, *drawn.states[:, 2:].T)],
        "picture": [short(column) for column in drawn.points.T],
        "phases": [[p.kind, p.t_start / unit, p.t_end / unit, p.reason] for p in run.phases],
    }


PANEL = Panel(
    "orbits",
    "Motion",
    add,
    "Orbits launched by a click on the picture or from a typed start, over time: in the limit ε → 0, and for ε > 0.",
)
