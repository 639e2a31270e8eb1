"""Portraits on either side of a degenerate setting, along the control that was moved last."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from codim2_core.bifurcations.diagrams.classes import NeighbouringPortraits
from codim2_core.bifurcations.diagrams.classes import sides as portraits_beside
from codim2_core.portrait.layer_problem.vary import names
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import catalogue
from codim2_core.systems.typed import System

from ..draw.mathml import plain_symbol
from ..state.choices import SLOW_CONTROLS
from ..state.chosen_system import NORMAL
from ..state.controls import ExplorerState


def neighbouring_portraits(scene: Scene, values: Mapping[str, Any], control: str) -> dict[str, Any] | None:
    """Return the portraits a little below and a little above the present value of a control.

    Parameters
    ----------
    scene : Scene
    values : mapping
        Of the controls.
    control : str
        A coefficient, a slow variable, n, or "own:" and a parameter. If the system lacks this one, that of its own
        whose two sides differ.

    Returns
    -------
    dict or None
        "symbol", and "below" and "above", names of portraits; None if nothing can be varied, or changes the name:
        what is only uncertain is no border.
    """
    moved = f"z{SLOW_CONTROLS.index(control) + 1}" if control in SLOW_CONTROLS else control.removeprefix("own:")
    had = _controls(scene, values)
    found: NeighbouringPortraits | None = None
    for name in [moved] if moved in had else had:
        pair = portraits_beside(scene.system, scene.psi, scene.z, name)
        found = found or pair
        if pair is not None and pair.below != pair.above:
            found = pair
            break
    if found is None or {found.below, found.above} == {scene["name"].name}:
        return None
    return {"symbol": _symbol(found.name, values), "below": found.below, "above": found.above}


def _controls(scene: Scene, values: Mapping[str, Any]) -> list[str]:
    """Name what the page has a control for, slow variables first: a system by formulas shows no a, b, d and f."""
    found = names(scene.system, scene.psi, scene.z)
    if values["system"] != NORMAL and isinstance(scene.system, (ELinear, System)):
        shown = dict(scene.system.parameters)
        found = tuple(name for name in found if name in shown or name not in scene.system.variable)
    return sorted(found, key=lambda name: not name.startswith("z"))


def _symbol(name: str, values: Mapping[str, Any]) -> str:
    if name.startswith("z") and name[1:].isdigit():
        i, example = int(name[1:]) - 1, catalogue.get(values["system"])
        if example and i < len(example.slow):
            return example.slow[i][0]
        return "z" if i == 0 else plain_symbol(name)
    return str(ExplorerState.param[name].label) if name in ExplorerState.param else plain_symbol(name)
