"""Small pictures of results, which a notebook shows: what each shows, by its type, and the picture as SVG."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import singledispatch
from itertools import pairwise
from typing import Any

import numpy as np

from codim2_core.bifurcations.atlases.result import Atlas
from codim2_core.bifurcations.continuation.result import CycleBranches
from codim2_core.bifurcations.diagrams.eigenvalue_path import LinearisationPath
from codim2_core.bifurcations.diagrams.result import Branches, SpecialValue
from codim2_core.bifurcations.plane.curve import BifurcationCurve
from codim2_core.bifurcations.plane.regions import Regions
from codim2_core.motion.periodic.result import PeriodicMotion, ResponseCurve
from codim2_core.motion.result import Simulation
from codim2_core.numerics.dense import DenseMotion
from codim2_core.portrait.basins import Basins
from codim2_core.portrait.cycles.limit_cycles import LimitCycles
from codim2_core.portrait.nullcline.nullclines import Nullclines
from codim2_core.portrait.orbits.trajectories import Trajectories
from codim2_core.portrait.separatrix_branches import Separatrices
from codim2_core.portrait.sliding.slow_portrait_result import SlowPortrait
from codim2_core.scene import Scene
from codim2_core.scene.launched_orbits import LaunchedOrbits
from codim2_core.systems.mechanics.several.result import ContactMotion
from codim2_core.systems.presets.preset import Preset
from codim2_core.systems.psi.function import Psi

from ...picture.draw import glyphs
from ...picture.draw.layers import layers_in_paint_order
from ...picture.draw.packing import Polylines, pack
from ...picture.draw.svg import content
from ...picture.draw.vector.parts import Placement, rim, stroke, words
from .chart import close_svg, line_chart, regions, thin_out
from .sketch import BASIN_COLOURS, Cells, Curves, LineChart, RegionChart, Sketch

#: px of the screen.
SKETCH_SIDE = 360
MAX_SVG_BYTES = 36_000  # bytes: as text of an HTML image a third more
#: Starting points and pixel of a small portrait; the next ones are tried where it is too large.
SKETCHED = ((40, 1 / 90), (16, 1 / 50), (0, 1 / 50))
#: Curves that are drawn, and points of all of them.
PIECES, MAX_SKETCH_POINTS = 200, 4000
#: Cells across a small picture of them.
MAX_BASIN_CELLS = 64
UNDECIDED_CELL = -1


def svg(result: Any) -> str:
    """Return a small picture, under 50 kB.

    Raises
    ------
    TypeError
        There is none of results of this type.
    """
    if isinstance(result, Scene):
        return portrait(result)
    if isinstance(result, Preset):
        return portrait(Scene(result.system, result.psi, result.z))
    shown = sketch(result)
    if isinstance(shown, LineChart):
        return line_chart(shown)[0]
    if isinstance(shown, RegionChart):
        return regions(shown)
    return _cells_svg(shown) if isinstance(shown, Cells) else _hemisphere_svg(shown)


def portrait(result: Scene) -> str:
    """Return a scene with the layers that the explorer shows at first."""
    made = ""
    for count, pixel in SKETCHED:
        seeds = result.seeds if count else np.zeros((0, 2))
        scene = result.evolve(count=min(count, result.count), seeds=seeds, pixel=pixel)
        layers = [
            layer
            for layer in layers_in_paint_order()
            if not layer.hidden and not (layer.optional and not len(result.launch))
        ]
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
        made = content(pack(header, blocks), [layer.name for layer in layers], Placement(text=32.0))
        if len(made) < MAX_SVG_BYTES:
            break
    return close_svg(made, 1000, 1000, SKETCH_SIDE, SKETCH_SIDE)


@singledispatch
def sketch(result: Any) -> Sketch:
    """Return what the picture of a result shows.

    Raises
    ------
    TypeError
        There is none of results of this type.
    """
    raise TypeError(f"there is no picture of a {type(result).__name__}.")


@sketch.register
def _trajectories(result: Trajectories) -> Sketch:
    return _curves(result.points, "orbit")


@sketch.register
def _cycles(result: LimitCycles) -> Sketch:
    return _curves([cycle.points for cycle in result.cycles], "cycle")


@sketch.register
def _separatrices(result: Separatrices) -> Sketch:
    return _curves([branch.points for branch in result.branches], "separatrix")


@sketch.register
def _simulation(result: Simulation) -> Sketch:
    return _over_time(result, _state_names(result), [False] * result.states.shape[1])


@sketch.register
def _contact_motion(result: ContactMotion) -> Sketch:
    clocks = np.isclose(result.states - result.states[0], (result.times - result.times[0])[:, None]).all(axis=0)
    return _over_time(result, result.names, clocks)


@sketch.register
def _periodic(result: PeriodicMotion) -> Sketch:
    run = result.run
    clock = run.states[:1, 2:] + np.outer((run.times - run.times[0]) / result.period, result.advance)
    even = (result.advance != 0.0) & np.isclose(run.states[:, 2:], clock).all(axis=0)
    return _over_time(run, _state_names(run), [False, False, *even])


def _state_names(run: Simulation) -> tuple[str, ...]:
    return ("x", "y", *(f"z{i + 1}" for i in range(run.states.shape[1] - 2)))


def _over_time(run: DenseMotion, names: Sequence[str], left_out: Sequence[bool]) -> LineChart:
    return LineChart([(n, run.times, run.states[:, i]) for i, n in enumerate(names) if not left_out[i]], "t", "")


@sketch.register
def _response(result: ResponseCurve) -> Sketch:
    swings, what = (result.amplitude, "z₁") if result.amplitude.shape[1] else (result.velocity_amplitude, "x")
    lines = [
        ("stable" if result.stable[part][0] else "unstable", result.values[part], swings[part, 0])
        for part in _runs(result.stable)
    ]
    return LineChart(lines, result.along, f"amplitude of {what}")


@sketch.register
def _curve(result: BifurcationCurve) -> Sketch:
    return LineChart([(result.name, branch[:, 0], branch[:, 1]) for branch in result.branches], "f₁", "f₂")


@sketch.register
def _draw_branches(result: Branches) -> Sketch:
    lines = [(branch.kind, branch.value, branch.theta) for branch in result.limit_directions]
    lines += [(f"C, {one.kind}", one.value, np.unwrap(np.arctan2(*one.e.T[::-1]))) for one in result.critical]
    marks = [
        (one.kind, one.value, math.atan2(one.place[1], one.place[0]))
        for one in result.special
        if isinstance(one, SpecialValue)
    ]
    return LineChart(lines, result.along, "θ", marks)


@sketch.register
def _linearisation(result: LinearisationPath) -> Sketch:
    pieces = [(result.kind[i], slice(i, j + 1)) for i, j in result.pieces if result.exists[i]]
    return LineChart([(kind, result.values[part], result.trace[part]) for kind, part in pieces], result.name, "tr J")


@sketch.register
def _cycle_branches(result: CycleBranches) -> Sketch:
    pieces = [(branch, part) for branch in result for part in _runs(branch.stable)]
    lines = [("stable" if b.stable[part][0] else "unstable", b.value[part], b.amplitude[part]) for b, part in pieces]
    return LineChart(lines, result.name, "size")


@sketch.register
def _slow_portrait(result: SlowPortrait) -> Sketch:
    widths = np.ptp(np.concatenate([branch.e for branch in result.branches]), axis=0) if result.branches else (1, 0)
    i = int(widths[1] > widths[0])
    return LineChart([(branch.kind, branch.z, branch.e[:, i]) for branch in result.branches], "z", "cs"[i])


@sketch.register
def _psi(result: Psi) -> Sketch:
    s = np.linspace(0.0, 4.0, 161)
    return LineChart([("Ψ", s, result(s))], "s", "Ψ")


@sketch.register
def _atlas(result: Atlas) -> Sketch:
    return RegionChart([(one.name, one.boundary) for one in result.regions], result.ranges, *result.names)


@sketch.register
def _regions(result: Regions) -> Sketch:
    every = np.concatenate([ring for region in result for ring in region.boundary] or [np.ones((1, 2))])
    size = 1.3 * float(np.abs(every).max())
    span = (-size, size)
    frame = np.array([(-size, -size), (size, -size), (size, size), (-size, size)])
    areas = [(one.name, one.boundary if one.bounded else (frame, *one.boundary)) for one in result]
    return RegionChart(areas, (span, span), "f₁", "f₂")


@sketch.register
def _nullclines(result: Nullclines) -> Sketch:
    named = {"rho": "rho", "theta": "theta", "U1": "soft", "U2": "soft"}
    return Curves([(named[branch.kind], branch.points) for branch in result])


@sketch.register
def _launched(result: LaunchedOrbits) -> Sketch:
    halves = (result.orbits.backward.points, result.orbits.forward.points)
    return Curves([("orbit", line) for half in halves for line in half], [line[0] for line in halves[1]])


@sketch.register
def _basins(result: Basins) -> Sketch:
    return Cells(result.cells, result.box, result.destinations)


def _cells_svg(shown: Cells) -> str:
    cells, (left, right, bottom, top) = shown.cells, shown.box
    while len(cells) > MAX_BASIN_CELLS:  # each of four stands for all: the picture is small
        cells = cells[::2, ::2]
    place = Placement((left, right, bottom, top), decimals=1)
    side = place.side / len(cells)
    paths: dict[int, list[str]] = {}
    for row, line in enumerate(cells):
        for part in _runs(line):
            x, y, wide = part.start * side, place.side - (row + 1) * side, (part.stop - part.start) * side
            paths.setdefault(int(line[part.start]), []).append(f"M{x:.0f} {y:.0f}h{wide:.0f}v{side:.1f}h-{wide:.0f}Z")
    colours = {i: BASIN_COLOURS[i % len(BASIN_COLOURS)] for i in range(len(shown.names))} | {
        UNDECIDED_CELL: "undecided"
    }
    areas = [
        f'<path d="{"".join(path)}" fill="var(--{colours[which]})" opacity=".45" shape-rendering="crispEdges"/>'
        for which, path in sorted(paths.items())
        if which in colours
    ]
    circle = f"{rim(place)} {stroke('ink', 2, (), place)}/>"
    names = [(name, colours[i]) for i, name in enumerate(shown.names)]
    said = "".join(
        words(20, 50 + 44 * i, name, 36.0).replace("--ink", f"--{colour}") for i, (name, colour) in enumerate(names)
    )
    return close_svg("".join(areas) + circle + said, 1000, 1000, SKETCH_SIDE, SKETCH_SIDE)


def _runs(values: Any) -> list[slice]:
    """Return the runs of equal values."""
    ends = [0, *(np.flatnonzero(np.diff(values)) + 1).tolist(), len(values)]
    return [slice(first, last) for first, last in pairwise(ends) if first < last]


def _curves(pieces: Sequence[Any], colour: str) -> Curves:
    return Curves([(colour, piece) for piece in pieces])


def _hemisphere_svg(shown: Curves) -> str:
    """Return the first `PIECES` of some curves."""
    place, pieces = Placement(), shown.pieces
    each = MAX_SKETCH_POINTS // min(max(1, len(pieces)), PIECES)
    lines = ""
    for colour in dict.fromkeys(colour for colour, _ in pieces):
        kept = [thin_out(np.asarray(piece), each) for own, piece in pieces[:PIECES] if own == colour]
        lines += f'<path d="{place.path(map(place.points, kept))}" {stroke(colour, 1.4, (), place)}/>'
    circle = f"{rim(place)} {stroke('ink', 2, (), place)}/>"
    dots = (f'<circle cx="{x}" cy="{y}" r="11" fill="var(--orbit)"/>' for x, y in place.points(shown.places).tolist())
    over = "".join(dots) if len(shown.places) else ""
    return close_svg(lines + circle + over, 1000, 1000, SKETCH_SIDE, SKETCH_SIDE)
