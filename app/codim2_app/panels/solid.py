"""The panel "3-D": the hemisphere of the blowup, and hemispheres along z (Figure 6, Figure 11).

The hemisphere is the picture, which the browser lifts by ebar = sqrt(1 - |p|^2). Along z discs are stacked, with the
limit directions on the cylinder around them and the critical sets inside (Figure 22): their lines are sent once,
and turned in the browser.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.portrait.sliding.along_z import directions_along, slow_portrait
from codim2_core.scene import Scene
from codim2_core.systems.psi.function import Psi

from ..picture.frame.frame_context import FrameContext
from ..picture.state.choices import SLOW_CONTROLS, SOLIDS
from ..picture.state.chosen_system import System_
from . import filippov
from .along import NO_SLOW_VARIABLE, slow_spans
from .panel import Panel

SLICES = 5  # hemispheres along z
SEEDS = 20  # trajectories of each
Z_VALUES = 121  # values of z at which limit directions are followed
MIN_SPACING = 6e-3  # of the disc: points of a line nearer than this are left out


def add(draft: FrameContext) -> None:
    """Add the stack along the slow variable, once nothing moves."""
    scene = draft.scene
    system = draft.system
    if system is None or not system.m:
        if draft.fresh("stack", NO_SLOW_VARIABLE):
            draft.header.setdefault("unable", {}).update(stack=NO_SLOW_VARIABLE, filippov=NO_SLOW_VARIABLE)
        return
    if draft.values["solid"] == "filippov":
        filippov.add_filippov(draft, system)
    axis = min(SLOW_CONTROLS.index(draft.values["drift"]), system.m - 1, len(SLOW_CONTROLS) - 1)
    span = slow_spans(system, draft.values)[axis]
    others = tuple(0.0 if i == axis else v for i, v in enumerate(scene.z))
    if draft.ready:
        key = (system, scene.psi, others, axis, span)
        stack = draft.slow("stack", key, stack_of_discs, system, scene.psi, others, axis, span)
        if stack is not None:
            draft.header["stack"] = {**stack, "control": SLOW_CONTROLS[axis]}


def stack_of_discs(
    system: System_, psi: Psi, others: tuple[float, ...], axis: int, span: tuple[float, float]
) -> dict[str, Any]:
    """Return discs at even values of z, the limit directions on the cylinder, and the critical sets inside it.

    Heights are shares of the span, from 0 to 1.
    """
    low, high = span

    def z_at(value: float) -> tuple[float, ...]:
        return (*others[:axis], float(value), *others[axis + 1 :])

    def share(value: float) -> float:
        return round((float(value) - low) / (high - low), 4)

    discs = []
    for value in np.linspace(low, high, SLICES):
        scene = Scene(system, psi, z_at(value), count=SEEDS)
        discs.append({"z": float(value), "lines": [_flat(line) for line in _orbit_lines(scene["inside"])]})
    found = directions_along(system, span, others, axis, Z_VALUES)
    columns = (found.z, found.theta, found.lambda_rho, found.lambda_theta)
    directions = [
        [share(z), round(float(theta), 4), int(rho < 0.0), int(turn < 0.0)]
        for z, theta, rho, turn in zip(*columns, strict=True)
    ]
    portrait = slow_portrait(system, psi, f"z{axis + 1}", span, others)
    sets = [
        {
            "points": [[*_short_list(p), share(z)] for z, p in zip(branch.z, branch.p, strict=True)],
            "stable": branch.stable,
            "flow": float(np.sign(branch.flow[len(branch.z) // 2, axis])),
        }
        for branch in portrait.branches
    ]
    return {"span": [low, high], "discs": discs, "directions": directions, "sets": sets}


def _orbit_lines(orbits: Any) -> list[NDArray[np.float64]]:
    offsets, points = orbits.offsets, orbits.buffer
    return [_thin(points[a:b]) for a, b in pairwise(offsets) if b - a > 1]


def _thin(line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Leave out points that lie within `MIN_SPACING` of the one before along the line; both ends stay."""
    steps = np.hypot(*np.diff(line, axis=0).T)
    along = np.floor(np.cumsum(steps) / MIN_SPACING)
    kept = np.ones(len(line), bool)
    kept[1:-1] = np.diff(along[:-1], prepend=0.0)[: len(line) - 2] > 0 if len(line) > 2 else True
    return line[kept]


def _flat(line: NDArray[np.float64]) -> list[list[float]]:
    return [_short_list(point) for point in line]


def _short_list(values: Any) -> list[float]:
    return [round(float(v), 3) for v in values]


PANEL = Panel(
    "solid",
    "3-D",
    add,
    "The hemisphere in space, hemispheres stacked along z, and Filippov's combinations.",
    {"views": SOLIDS},
)
