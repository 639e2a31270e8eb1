"""The layers of the picture: one table, a row a layer, read by the page, the SVG, HoloViews, the legend and the frames.

To add a layer of curves, write its row here and, if the scene does not have it yet, the row of `codim2_core.scene`.
The four layers without `parts` (basins, outcomes, equator, critical) are no curves: `static/picture/picture.js` and
`svg` draw them by name.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import glyphs

#: Offsets (k + 1,) and points (n, 2): piece i is ``points[offsets[i]:offsets[i + 1]]``.
Pieces = tuple[NDArray[np.int64], NDArray[np.float64]]


@dataclass(frozen=True)
class Part:
    """Curves of one look."""

    name: str  # in the packed frame
    colour: str  # a key of the themes, and a custom property of the style sheet
    width: float  # in px
    scene: str = ""  # the layer of the scene that holds it
    # takes what the scene holds, and returns the curves
    pieces: Callable[[Any], Pieces] = lambda result: glyphs.join([curve.points for curve in result])
    # lengths of dashes and gaps in px; () is solid. What differs in meaning differs by more than colour
    dash: tuple[float, ...] = ()
    arrows: bool = False  # whether arrowheads tell the sense of time
    even: bool = False  # whether curves end where they would come too near to one another, see `spacing`
    # takes what the scene holds, and names the object that each curve is of: U1, L2, S3, O4
    owners: Callable[[Any], list[str]] | None = None


@dataclass(frozen=True)
class Layer:
    """A group of curves or marks that a user shows or hides as one."""

    name: str  # of its control, and next to it
    words: str
    height: int  # layers are painted from low to high
    parts: tuple[Part, ...] = ()
    colours: Mapping[str, tuple[str, str]] = field(default_factory=dict)  # those that belong to it
    swatch: str = ""  # declarations of the legend's mark; default a stroke in the look of its first part
    hidden: bool = False  # until it is requested
    compiled: bool = False  # made by the compiled integrator: until that is ready it is left out
    # there is nothing of it until somebody asks; a picture that has nothing of it does not name it
    optional: bool = False
    first: bool = False  # its control is in sight from the start; the others are one step away
    tip: str = ""  # what it is, for its tooltip


def _orbit_lines(result: Any) -> Pieces:
    return result.offsets, result.buffer


def _closed_curves(result: Any) -> Pieces:
    return glyphs.join([cycle.points for cycle in result.cycles])


def _lines_of_kinds(*kinds: str) -> Callable[[Any], Pieces]:
    return lambda branches: glyphs.join([branch.points for branch in branches if branch.kind in kinds])


def _direction_lines(direction: str) -> Callable[[Any], Pieces]:
    return lambda branches: glyphs.join([b.points for b in branches if b.inside and b.direction == direction])


def _of_direction(direction: str) -> Callable[[Any], list[str]]:
    return lambda branches: [f"S{i + 1}" for i, b in enumerate(branches) if b.inside and b.direction == direction]


def _nullcline(name: str, colours: tuple[str, str], widths: tuple[float, float], *kinds: str) -> tuple[Part, Part]:
    """Return the two parts of a nullcline: on the hemisphere, and outside."""

    def by_kind(branches: Any) -> list[str]:
        return [branch.kind for branch in branches if branch.kind in kinds]

    several = by_kind if len(kinds) > 1 else None
    return (
        Part(f"{name}_inside", colours[0], widths[0], "nullclines_inside", _lines_of_kinds(*kinds), owners=several),
        Part(f"{name}_outside", colours[1], widths[1], "nullclines_outside", _lines_of_kinds(*kinds), owners=several),
    )


def _launched_orbits(k: int) -> Callable[[Any], Pieces]:
    """Return every orbit that has colour k: they take turns."""
    return lambda result: glyphs.join([line for i, line in enumerate(result.orbits.points) if i % LAUNCH_COLOURS == k])


def _launched_owners(k: int) -> Callable[[Any], list[str]]:
    return lambda result: [f"O{i + 1}" for i in range(len(result.orbits.points)) if i % LAUNCH_COLOURS == k]


LAUNCH_COLOURS = 6

_ROWS = (
    Layer(
        "outside", "Orbits outside", 50, compiled=True, first=True, colours={"outside": ("#a3b1c2", "#5c6a7d")},
        parts=(
            Part("outside", "outside", 1.2, "outside", _orbit_lines, arrows=True, even=True),
        ),
        tip="The system without regularisation, at radius 1 + |(x, y)|; arrows tell the sense of time.",
    ),
    Layer(
        "inside", "Orbits inside", 60, compiled=True, first=True, colours={"orbit": ("#5f7186", "#aebccc")},
        parts=(Part("inside", "orbit", 1.4, "inside", _orbit_lines, arrows=True, even=True),),
        tip="Orbits of the layer problem, projected from the hemisphere.",
    ),
    Layer(
        "continuations", "Up the hemisphere", 70, compiled=True, colours={"continuation": ("#b3123f", "#ff6b8f")},
        parts=(Part("continuations", "continuation", 1.6, "continuations", _orbit_lines, arrows=True),),
        tip="From each direction along which an open set of trajectories arrives: where they go on the hemisphere.",
    ),
    Layer(
        "separatrices", "Separatrices", 80, compiled=True, hidden=True, colours={"separatrix": ("#6d28d9", "#b794ff")},
        parts=(
            Part("separatrices_stable", "separatrix", 2.0, "separatrices", _direction_lines("stable"), (7, 4),
                 arrows=True, owners=_of_direction("stable")),
            Part("separatrices_unstable", "separatrix", 2.0, "separatrices", _direction_lines("unstable"),
                 arrows=True, owners=_of_direction("unstable")),
        ),
        tip="Stable (dashed) and unstable (full) branches of saddles and half-saddles.",
    ),
    Layer(
        "cycles", "Limit cycles", 90, compiled=True, colours={"cycle": ("#e0121f", "#ff3b47")},
        parts=(Part("cycles", "cycle", 2.8, "closed_orbits", _closed_curves, arrows=True,
                    owners=lambda result: [f"L{i + 1}" for i in range(len(result.cycles))]),),
        tip="Isolated closed orbits of the layer problem.",
    ),
    # nullclines have the paper's colours (matlab1 to matlab4 of Figure 24), lighter on dark
    Layer(
        "rho", "ρ-nullclines", 30, first=True, parts=_nullcline("rho", ("rho", "rho"), (1.8, 1.8), "rho"),
        colours={"rho": ("#0072bd", "#4aa8e8")},
        tip="Where the distance from Σ is at rest: U·e = 0.",
    ),
    Layer(
        "theta", "θ-nullclines", 40, first=True, parts=_nullcline("theta", ("theta", "theta"), (1.8, 1.8), "theta"),
        colours={"theta": ("#d95319", "#ff8552")},
        tip="Where the angle is at rest: Θ = 0.",
    ),
    Layer(
        "lines", "Lines U₁ = 0, U₂ = 0", 20, _nullcline("lines", ("lines-in", "lines-out"), (1.8, 1.4), "U1", "U2"),
        {"lines-in": ("#edb120", "#f2c14e"), "lines-out": ("#7e2f8e", "#c58ad6")},
        swatch="border-image: linear-gradient(90deg, var(--lines-in) 50%, var(--lines-out) 50%) 1",
        tip="Where x or y is at rest: U₁ = 0 and U₂ = 0, in one colour inside and another outside.",
    ),
    Layer(
        "conics", "Hyperbola of the limit directions", 45, hidden=True, colours={"conic": ("#0f766e", "#5eead4")},
        parts=(Part("conics", "conic", 2.4, "conics", lambda result: glyphs.join(result.pieces), (9, 3)),),
        tip="The conic Θ = 0 whose meeting points with the circle are the limit directions; e-linear systems.",
    ),
    Layer(
        "launched", "Launched orbits", 100, compiled=True, optional=True,
        colours={"launch-1": ("#2563eb", "#60a5fa"), "launch-2": ("#c2410c", "#fb923c"),
                 "launch-3": ("#15803d", "#4ade80"), "launch-4": ("#a21caf", "#e879f9"),
                 "launch-5": ("#0f766e", "#2dd4bf"), "launch-6": ("#854d0e", "#facc15")},
        parts=tuple(
            Part(f"launched_{k + 1}", f"launch-{k + 1}", 2.4, "launched", _launched_orbits(k), arrows=True,
                 owners=_launched_owners(k))
            for k in range(LAUNCH_COLOURS)
        ),
        tip="Orbits through points that you have clicked.",
    ),
    Layer(
        "equator", "Limit directions", 110, first=True,
        colours={"attr": ("#15803d", "#4ade80"), "rep": ("#be185d", "#f472b6"), "degenerate": ("#6b7280", "#aab2bf")},
        swatch="width: 10px; height: 10px; border: 0; border-radius: 50%; background: var(--attr)",
        tip="Limit directions Q: filled attract radially, hollow repel; circles attract along θ, diamonds repel.",
    ),
    Layer(
        "critical", "Critical sets", 120, first=True, colours={"crit": ("#c8102e", "#ff5468")},
        swatch="width: 10px; height: 10px; border: 0; background: var(--crit)",
        tip="Critical sets C: equilibria of the layer problem, along which motions slide.",
    ),
    Layer(
        "outcomes", "Approach outcomes", 10, hidden=True,
        colours={"slide": ("#0d9488", "#2dd4bf"), "cross": ("#e8751a", "#fb923c"), "depends": ("#7c3aed", "#a78bfa"),
                 "undecided": ("#64748b", "#94a3b8"), "misses": ("#dfe4ea", "#2c3440")},
        swatch="height: 9px; border: 0; background: linear-gradient(90deg, var(--slide) 50%, var(--cross) 50%)",
        tip="The ring tells, for each angle of approach, whether what comes from there slides or crosses.",
    ),
    Layer(
        "basins", "Basins", 0, hidden=True,
        colours={"basin-1": ("#0d9488", "#2dd4bf"), "basin-2": ("#7c3aed", "#a78bfa"),
                 "basin-3": ("#0284c7", "#38bdf8"), "basin-4": ("#a16207", "#facc15")},
        swatch="width: 16px; height: 10px; border: 0; opacity: .45; "
               "background: linear-gradient(90deg, var(--basin-1) 50%, var(--basin-2) 50%)",
        tip="Where orbits of the layer problem end, by colour.",
    ),
)  # fmt: skip

#: All layers, in the order of the legend.
LAYERS: dict[str, Layer] = {layer.name: layer for layer in _ROWS}

#: A motion in the limit and for eps > 0, which the panel "Motion" draws over the picture, and their colour.
TRACES = (Part("limit", "motion", 1.6), Part("motion", "motion", 2.4, dash=(5, 4)))
TRACE_COLOURS = {"motion": ("#c026d3", "#f0abfc")}


def layers_in_paint_order() -> list[Layer]:
    """Return the layers from bottom to top."""
    return sorted(LAYERS.values(), key=lambda layer: layer.height)


def default_layers() -> list[str]:
    """Name the layers that are shown until a user chooses."""
    return [layer.name for layer in LAYERS.values() if not layer.hidden]


def layer_table() -> list[dict[str, Any]]:
    """Return what the browser must know of each layer, from bottom to top."""
    return [{"name": layer.name, "parts": looks(layer.parts)} for layer in layers_in_paint_order()]


def looks(parts: Iterable[Part]) -> list[dict[str, Any]]:
    """Return how each part is drawn."""
    return [
        {"name": p.name, "colour": p.colour, "width": p.width, "dash": list(p.dash), "arrows": p.arrows} for p in parts
    ]


def swatches() -> str:
    """Return the rules of the legend's marks."""
    return "\n".join(
        f".codim2 .swatch-{layer.name} {{ {layer.swatch or _stroke(layer)} }}" for layer in LAYERS.values()
    )


def _stroke(layer: Layer) -> str:
    part = layer.parts[0]
    return f"border-top: {max(part.width, 1.5):g}px {'dashed' if part.dash else 'solid'} var(--{part.colour})"
