"""The reference motions in MuJoCo, where it is installed: boxes and balls on a plane, as its users would model them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any

import numpy as np

from ...results.arrays import Array
from ...systems.examples.example import GRAVITY
from .record import Comparison, ReferenceMotion

STEP = 1e-3  # s
IMPRATIO = 100.0
CREEP_SPEED = 1e-2  # m/s of the slip: below it creeps; from before it is extrapolated to where it would be zero

MODEL = """
<mujoco>
  <option timestep="{step}" gravity="{pull} 0 -{weight}" cone="elliptic" impratio="{impratio}"
    integrator="implicitfast"/>
  <worldbody>
    <geom type="plane" size="0 0 1" friction="{mu} 0 0" condim="3"/>
    <body pos="0 0 0.05"><freejoint/><geom type="{shape}" size="{size}" mass="1" friction="{mu} 0 0" condim="3"/></body>
  </worldbody>
</mujoco>
"""


def follow_in_mujoco(motion: ReferenceMotion) -> Comparison:
    """Return MuJoCo's values, with elliptic cones and steps of a millisecond, next to the exact ones; or ValueError."""
    if motion.key not in FOLLOWED:
        raise ValueError(f"{motion.key} has no model in MuJoCo here; choose one of {', '.join(FOLLOWED)}.")
    return motion.compare(FOLLOWED[motion.key], "MuJoCo")


def _run(
    shape: str, mu: float, slope: float, velocity: Sequence[float], t_end: float, spin: Sequence[float] = (0, 0, 0)
) -> tuple[Array, Array, Array]:
    """Return times (k,), places (k, 2) and velocities (k, 6) of a box or a ball of 0.1 m."""
    try:
        library: Any = import_module("mujoco")
    except ImportError:
        raise ValueError("MuJoCo is not installed: pip install mujoco.") from None
    model = library.MjModel.from_xml_string(
        MODEL.format(
            step=STEP, pull=GRAVITY * math.sin(slope), weight=GRAVITY * math.cos(slope), impratio=IMPRATIO, mu=mu,
            shape=shape, size="0.05 0.05 0.05" if shape == "box" else "0.05",
        )
    )  # fmt: skip
    data = library.MjData(model)
    for _ in range(200):  # it settles on the plane
        data.qvel[:2] = data.qvel[3:] = 0.0
        library.mj_step(model, data)
    data.qvel[:] = (*velocity, 0.0, *spin)
    data.qpos[:2] = 0.0
    rows = [(0.0, *data.qpos[:2], *data.qvel)]
    while rows[-1][0] < t_end:
        library.mj_step(model, data)
        rows.append((len(rows) * STEP, *data.qpos[:2], *data.qvel))
    found = np.array(rows)
    return found[:, 0], found[:, 1:3], found[:, 3:]


def _time_to_zero(times: Array, speeds: Array) -> float:
    """Return when a speed would be zero that falls evenly before it creeps."""
    last = int(np.argmax(speeds < CREEP_SPEED)) - 1
    first = max(last - 20, 0)
    slope = (speeds[last] - speeds[first]) / (times[last] - times[first])
    return float(times[last] - speeds[last] / slope)


def _box_stops() -> Sequence[float]:
    t, p, v = _run("box", 0.5, 0.0, (6.0 * math.cos(0.4), 6.0 * math.sin(0.4)), 1.5)
    return _time_to_zero(t, np.hypot(v[:, 0], v[:, 1])), float(np.hypot(*p[-1]))


def _ramp_down() -> Sequence[float]:
    t, p, v = _run("box", 0.5, 0.3, (3.0, 0.0), 2.0)
    end = _time_to_zero(t, np.hypot(v[:, 0], v[:, 1]))
    return end, float(np.interp(end, t, p[:, 0]))


def _ramp_slides() -> Sequence[float]:
    _, p, v = _run("box", 0.5, 0.6, (0.0, 0.0), 2.0)
    return float(v[-1, 0]), float(p[-1, 0])


def _struck() -> Sequence[float]:
    t, p, v = _run("sphere", 0.2, 0.0, (2.0, 0.0), 1.0)
    slip = np.abs(v[:, 0] - 0.05 * v[:, 4])
    end = _time_to_zero(t, slip)
    return end, float(v[-1, 0]), float(np.interp(end, t, p[:, 0]))


FOLLOWED: Mapping[str, Callable[[], Sequence[float]]] = {
    "box-stops": _box_stops,
    "ramp-down": _ramp_down,
    "ramp-slides": _ramp_slides,
    "billiard-straight": _struck,
}
