"""Small pictures of results, which a notebook shows: `svg` draws what the core has computed, by its type."""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatch
from typing import Any

import numpy as np

from codim2_core.bifurcations import BifurcationCurve
from codim2_core.cycles.limit_cycles import LimitCycles
from codim2_core.diagrams.result import Diagram
from codim2_core.motion.result import Simulation
from codim2_core.orbits.trajectories import Trajectories
from codim2_core.portrait.separatrix import Separatrices
from codim2_core.scene import Scene

from ..draw import glyphs
from ..draw.layers import painted
from ..draw.packing import Polylines, pack
from ..draw.svg import content
from ..draw.vector.parts import Place, disc, stroke
from .chart import chart, finished, thinned

#: px of the screen.
SIDE = 360
MOST = 45_000  # bytes
#: Starting points and pixel of a small portrait; the next ones are tried where it is too large.
SKETCHED = ((40, 1 / 90), (16, 1 / 50), (0, 1 / 50))
#: Curves that are drawn, and points of all of them.
PIECES, POINTS = 200, 4000


@singledispatch
def svg(result: Any) -> str:
    """Return a small picture, under 50 kB.

    Raises
    ------
    TypeError
        There is none of results of this type.
    """
    raise TypeError(f"there is no picture of a {type(result).__name__}.")


@svg.register
def portrait(result: Scene) -> str:
    """Return a scene with the layers that the explorer shows at first."""
    made = ""
    for count, pixel in SKETCHED:
        seeds = result.seeds if count else np.zeros((0, 2))
        scene = result.evolve(count=min(count, result.count), seeds=seeds, pixel=pixel)
        layers = [layer for layer in painted() if not layer.hidden and not (layer.optional and not len(result.launch))]
        blocks = {
            part.name: Polylines(*part.pieces(scene[part.scene]), part.arrows)
            for layer in layers
            for part in layer.parts
        }
        cycle, equator = scene["equator_cycle"], scene["equator"]
        header = {
            "equator": glyphs.equator_columns(equator),
            "sense": glyphs.equator_arrows(equator, 0 if cycle is None else int(cycle.direction)),
            "all_directions": bool(equator.all_directions),
            "critical": glyphs.critical_columns(scene["critical"]),
        }
        made = content(pack(header, blocks), [layer.name for layer in layers], Place(text=32.0))
        if len(made) < MOST:
            break
    return finished(made, 1000, 1000, SIDE, SIDE)


@svg.register
def _trajectories(result: Trajectories) -> str:
    return _curves(result.points, "orbit")


@svg.register
def _cycles(result: LimitCycles) -> str:
    return _curves([cycle.points for cycle in result.cycles], "cycle")


@svg.register
def _separatrices(result: Separatrices) -> str:
    return _curves([branch.points for branch in result.branches], "separatrix")


@svg.register
def _simulation(result: Simulation) -> str:
    names = ("x", "y", *(f"z{i + 1}" for i in range(result.states.shape[1] - 2)))
    return chart([(name, result.times, result.states[:, i]) for i, name in enumerate(names)], "t", "")


@svg.register
def _curve(result: BifurcationCurve) -> str:
    return chart([(result.name, branch[:, 0], branch[:, 1]) for branch in result.branches], "f₁", "f₂")


@svg.register
def _diagram(result: Diagram) -> str:
    return chart([(branch.kind, branch.value, branch.theta) for branch in result.equator], result.name, "θ")


def _curves(pieces: Sequence[Any], colour: str) -> str:
    """Return curves of the picture over the hemisphere, the first `PIECES` of them."""
    place = Place()
    kept = [thinned(np.asarray(piece), POINTS // min(max(1, len(pieces)), PIECES)) for piece in pieces[:PIECES]]
    path = place.path(place.points(piece) for piece in kept)
    lines = f'<path d="{path}" {stroke(colour, 1.4, (), place)}/>'
    circle = disc(1.0, place).replace("/>", f" {stroke('ink', 2, (), place)}/>")
    return finished(lines + circle, 1000, 1000, SIDE, SIDE)
