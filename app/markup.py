"""The page's HTML, written by the server, so that controls and first picture are there before any script runs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, Template, select_autoescape

from .portraits import portraits
from .state import LAYERS, MAX_TRAJECTORIES, NUMBERS, ExplorerState
from .theme import LIGHT, THEMES, VIEW

STATIC = Path(__file__).parent / "static"
SCRIPTS = ("frames.js", "picture.js", "controls.js", "pad.js", "inspector.js", "explorer.js")

PSI_NAMES = {
    "constant": "1",
    "rational": "1/(1 + s)",
    "exponential": "exp(−s)",
    "tanh": "s/sinh²√s",
    "hill": "3/(3 + (4s)ⁿ)",
    "custom": "your own …",
}

#: Controls by group: the matrix A, f, the slow variable, the slow flow.
GROUPS = {"A": ("a", "b", "d"), "f": ("f1", "f2"), "z": ("z", "k1", "k2"), "slow": ("B1", "B2", "g0")}


@cache
def _template(name: str) -> Template:
    loader = FileSystemLoader(STATIC)
    return Environment(loader=loader, autoescape=select_autoescape(), trim_blocks=True).get_template(name)


@cache
def stylesheet() -> str:
    """Return the style sheet; every rule is scoped to `.codim2`."""
    return (STATIC / "explorer.css").read_text(encoding="utf-8")


@cache
def script() -> str:
    """Return the front end as one ES module."""
    return "\n".join((STATIC / name).read_text(encoding="utf-8") for name in SCRIPTS)


def slider_range(low: float, high: float, value: float) -> tuple[float, float, float]:
    """Return (low, high, step) of a slider, widened to hold the value; the same rule as in controls.js."""
    size = abs(value)
    if value < low or value > high:
        reach = _round_up(size)
        low, high = (-reach, reach) if low < 0 else (low, reach)
    return low, high, 10.0 ** (len(str(int(high - low))) - 4)


def _round_up(size: float) -> float:
    """Return 1, 2 or 5 times a power of ten, at least 1.2 times the size."""
    target, power = 1.2 * size, 1.0
    while power * 10 <= target:
        power *= 10
    return next(power * k for k in (1, 2, 5, 10) if power * k >= target)


def config(state: ExplorerState, locked: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return what the front end must know: controls, presets, defaults, colours."""
    return {
        "numbers": list(NUMBERS),
        "ranges": {name: list(state.param[name].softbounds) for name in NUMBERS},
        "values": state.values(),
        "defaults": ExplorerState().values(),
        "layers": list(LAYERS),
        "presets": {item["key"]: item for item in portraits()},
        "themes": THEMES,
        "view": VIEW,
        "locked": list(locked),
    }


def explorer_html(state: ExplorerState, first: Mapping[str, Any] | None = None) -> str:
    """Return the explorer's markup: controls with their values, legend, and the first picture as SVG.

    Parameters
    ----------
    state : ExplorerState
    first : mapping, optional
        "svg", and the words of the portrait: "name", "case", "sentence".
    """
    values = state.values()

    def control(name: str) -> dict[str, Any]:
        declared = state.param[name]
        low, high, step = slider_range(declared.softbounds[0], declared.softbounds[1], values[name])
        return {"name": name, "symbol": declared.label, "doc": declared.doc, "value": values[name],
                "low": low, "high": high, "step": step}  # fmt: skip

    groups = groupby(portraits(), key=lambda item: item["group"])
    return _template("explorer.html").render(
        css=stylesheet(),
        groups={group: [control(name) for name in names] for group, names in GROUPS.items()},
        exponent=control("n"),
        portraits=[(group, list(items)) for group, items in groups],
        psi_names=PSI_NAMES,
        layers=LAYERS,
        values=values,
        most=MAX_TRAJECTORIES,
        first=first or {},
        colours=LIGHT,
    )


def page_template() -> str:
    """Return the page around the explorer, for Bokeh's server; it asks no other host for anything."""
    return (STATIC / "page.html").read_text(encoding="utf-8")
