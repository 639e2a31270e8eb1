"""Every picture as a function from its name to its text: what the SVG says, or the columns that are drawn, as JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from codim2_app.picture.draw.gallery import HOOKS, STRIP
from codim2_app.picture.draw.overlay import elements
from codim2_app.picture.draw.svg import draw, small
from codim2_app.picture.draw.thumbnails import thumbnail as drawn
from codim2_app.picture.state.links import read_link
from codim2_app.view.refresh import Frames

from codim2_core.scene import Scene
from codim2_core.systems.presets.presets import presets
from tests.benchmarks.data import wrapped_rows

from .panels import DRAWN, columns

#: Portraits that are kept in full, besides the small ones of all presets.
WHOLE = ("case1-cm4", "case3-n1", "nonunique-sliding")
LAYERS = [
    "inside", "outside", "continuations", "separatrices", "cycles", "rho", "theta", "lines", "equator", "critical",
]  # fmt: skip

STRIP_SEEDS = 14


def kept_file(name: str) -> Path:
    """Return where a picture is kept: next to the tests, but for the strip, which the page has."""
    return STRIP if name == STRIP.name else Path(__file__).parent / "kept" / name


def thumbnail(key: str) -> str:
    """Return the small portrait of a preset."""
    preset = presets[key]
    scene = Scene(preset.system, preset.psi, preset.z, count=16, view=2.1, pixel=1 / 28)
    return small(scene, 1.5).replace("><", ">\n<") + "\n"


def strip() -> str:
    """Return the small portraits of the page's strip, one a line; fewer starting points than in the others."""
    shown = (presets[key] for key in HOOKS)
    return "".join(f"{drawn(preset.system, preset.psi, preset.z, STRIP_SEEDS)}\n" for preset in shown)


def portrait(key: str) -> str:
    """Return the first picture of a page that opens with a preset; few starting points keep it readable."""
    link = read_link({"preset": key, "trajectories": "12", "layers": ",".join(LAYERS)})
    return draw(Frames(link.state).answer({"all": True}), LAYERS).replace("><", ">\n<") + "\n"


def overlay(key: str) -> str:
    """Return what HoloViews draws of a preset: elements from bottom to top, with their columns."""
    preset = presets[key]
    made = elements(Scene(preset.system, preset.psi, preset.z, count=12, pixel=1 / 28))
    return wrapped_rows({name: _columns(element) for name, element in made.items()})


def _columns(element: Any) -> Any:
    if element.vdims:
        return {str(d): [_plain(v) for v in element.dimension_values(d)] for d in element.dimensions()}
    return [[[_plain(v) for v in point] for point in np.asarray(piece)] for piece in element.split(datatype="array")]


def _plain(value: Any) -> Any:
    return round(float(value), 3) + 0.0 if isinstance(value, float) else str(value)


def pictures() -> Mapping[str, Callable[[], str]]:
    """Return the function of each picture by the name of its file."""
    found: dict[str, Callable[[], str]] = {}
    for key in presets:
        found[f"small-{key}.svg"] = lambda key=key: thumbnail(key)
    for key in WHOLE:
        found[f"portrait-{key}.svg"] = lambda key=key: portrait(key)
    found[STRIP.name] = strip
    found["overlay-case1-cm4.json"] = lambda: overlay("case1-cm4")
    for name in DRAWN:
        found[f"panel-{name}.json"] = lambda name=name: columns(name)
    return found
