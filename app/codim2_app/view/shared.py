"""The values of the state as parameters of the view: it is watched, bound and linked like any Panel component."""

from __future__ import annotations

from copy import copy
from typing import Any

import param

from ..picture.state.controls import CONTROL_NAMES, ExplorerState

#: All values but the text of the launched orbits, as ``view.orbits`` are the orbits themselves, and a page's second
#: portrait.
SHARED_CONTROLS = tuple(name for name in CONTROL_NAMES if name not in ("orbits", "beside"))


class ControlTypes:
    """Types of the parameters that `declare` makes, for those who read types: ``view.f1 = 0.5``."""

    a: float
    b: float
    d: float
    f1: float
    f2: float
    system: str
    texts: dict[str, Any]
    parameters: dict[str, Any]
    z: float
    z2: float
    z3: float
    z4: float
    k1: float
    k2: float
    B1: float
    B2: float
    g0: float
    psi: str
    n: float
    psi_text: str
    trajectories: int
    layers: list[str]
    preset: str
    panel: str
    along: str
    zoom: int
    across: str
    cycle_curves: str
    census: str
    census_size: int
    atlas_zoom: int
    up: str
    solid: str
    drift: str
    log_eps: float
    launch: str
    orbit: int
    pinned: str
    orbit_eps: str
    lesson: str
    quiz: str
    goal: str
    t_end: float
    cut: float
    ranges: dict[str, Any]


def declare(view: type[param.Parameterized]) -> None:
    """Give a class of views a parameter for each shared value; a widget or another reference may be its value."""
    for name in SHARED_CONTROLS:
        parameter = copy(ExplorerState.param[name])
        parameter.allow_refs = True
        view.param.add_parameter(name, parameter)


def join(view: Any, state: ExplorerState) -> None:
    """Let the parameters of a view and the state that it shows follow each other.

    What the state refuses is refused with the same error, and both are then what they were.
    """

    def follow(*_: Any) -> None:
        new = {name: getattr(state, name) for name in SHARED_CONTROLS}
        view.param.update(**{name: value for name, value in new.items() if value != getattr(view, name)})

    def hand_on(*changes: param.parameterized.Event) -> None:
        try:
            state.param.update(**{change.name: change.new for change in changes})
        finally:
            follow()

    state.param.watch(follow, list(SHARED_CONTROLS))
    view.param.watch(hand_on, list(SHARED_CONTROLS))
