"""The explorer in a notebook: the same view as the page."""

from __future__ import annotations

import os
import sys
import warnings
from collections.abc import Mapping
from numbers import Real
from typing import Any

import numpy as np
from param.parameterized import resolve_ref, resolve_value

from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import catalogue
from codim2_core.systems.presets.presets import presets
from codim2_core.systems.psi import constant
from codim2_core.systems.psi.function import Psi
from codim2_core.systems.typed import System

from ..panels.parameters.axes import axes_there
from ..picture.frame.scenes import locked_controls
from ..picture.state.choices import SLOW_CONTROLS
from ..picture.state.chosen_system import System_, titles
from ..picture.state.cleaning import InputError, clean
from ..picture.state.controls import CONTROL_NAMES, ExplorerState
from .cell import running_kernel
from .explorer import ExplorerView, with_parameters
from .shared import SHARED_CONTROLS

LAYOUT = frozenset({"sizing_mode", "width", "height", "margin", "styles", "stylesheets"})


def explorer(
    system: System_ | Scene | str | Mapping[str, Any] | None = None, psi: Psi | str | None = None, **state: Any
) -> ExplorerView:
    """Return the live explorer, to be shown by a notebook.

    Parameters
    ----------
    system : ELinear, System, Scene, str or mapping, optional
        Your own system. Its parameters, and the numbers of an `ELinear`, have sliders; what is given as text has not.
        Or a scene: its system, Psi and z. Or the name of a preset or of an example. Or values of controls by name.
    psi : Psi or str, optional
        A regularisation function, or the name of its family.
    **state
        Values of controls: preset, system (an example's name), parameters, a, b, d, f1, f2, z, k1, k2, B1, B2, g0,
        n, psi_text, trajectories, layers, panel, ... As in the core, f is (f1, f2), B is (B1, B2), g a number, and z
        may be a sequence. And parameters of a Panel component: sizing_mode, width, height, margin, styles, stylesheets.

    Returns
    -------
    ExplorerView
        ``view.state`` holds the values (param), ``view.scene`` is what is drawn, ``view.orbits`` what was launched.

    Raises
    ------
    ValueError
        A name or a value is not allowed, or the system cannot be evaluated.

    Notes
    -----
    With ``panel.config.comms = "ipywidgets"`` the notebook's file keeps the libraries, 7 MB once a kernel, and no
    picture: a page in which no kernel runs shows nothing. Tried in JupyterLab only.

    Examples
    --------
    >>> view = explorer(a=-1, b=1, d=-1, f=(0, 0))
    >>> view = explorer("case1-cm0")
    """
    from . import extensions, warmup

    for sentence in extensions.register_all():
        warnings.warn(sentence, stacklevel=2)
    layout = {name: state.pop(name) for name in LAYOUT & state.keys()}
    linked = {name: value for name, value in state.items() if name in SHARED_CONTROLS and resolve_ref(value)}
    state = {name: resolve_value(value) if name in linked else value for name, value in state.items()}
    if isinstance(system, Scene):
        psi, state, system = psi or system.psi, {"z": system.z, **state}, _own_system(system)
    elif isinstance(system, str):
        name = "preset" if system in presets else "system"
        if system not in presets and system not in titles():
            known = ", ".join([*list(presets)[:3], *list(catalogue)[:2]])
            raise ValueError(f"{system!r} is neither a preset nor an example; give one such as {known}.")
        system, state = None, {name: system, **state}
    elif isinstance(system, Mapping):
        system, state = None, {**system, **state}
    elif not (system is None or isinstance(system, (ELinear, System))):
        raise ValueError(
            f"system is {type(system).__name__} {str(system)[:40]!r}; give an ELinear, a System, a Scene, the name of "
            "a preset, or values of controls by name."
        )
    values = _clean(_as_controls(state, psi))
    if system is not None:
        if "system" in values or values.get("preset"):
            raise ValueError("a system is given already; leave out preset and system, or the system itself.")
        values = {**_values_of(system, values), **values}
    _bring_resources()
    warmup.start()
    view = with_parameters(ExplorerView, system)(ExplorerState.from_values(values), system, **layout)
    refused = view.refused
    if refused:
        raise ValueError(" ".join(refused))
    view.param.update(**linked)
    return view


def _own_system(scene: Scene) -> System_:
    if not isinstance(scene.system, (ELinear, System)):
        raise ValueError("the scene was made of a system frozen at one z; make it of an ELinear or a System.")
    return scene.system


def _as_controls(state: Mapping[str, Any], psi: Psi | str | None) -> dict[str, Any]:
    """Return values of controls: f, B, g, z and psi as the core spells them are taken apart."""
    values = dict(state)
    if psi is None:
        psi = values.pop("psi", None)
    if isinstance(psi, Psi):
        values["psi"] = psi.family
        if psi.record.typed:
            values.setdefault("psi_text", psi.text)
        elif psi.record.parameter:
            values.setdefault(psi.record.parameter.name, psi.parameter)
    elif psi is not None:
        values["psi"] = psi
    for name, controls in (("f", ("f1", "f2")), ("B", ("B1", "B2")), ("g", ("g0",))):
        if name in values:
            values.update(zip(controls, _numbers(name, values.pop(name), len(controls)), strict=True))
    if "z" in values and np.ndim(values["z"]):
        z = values.pop("z")
        if len(z) > len(SLOW_CONTROLS):
            raise ValueError(f"z has {len(z)} entries; the explorer has sliders for {len(SLOW_CONTROLS)}.")
        values.update(zip(SLOW_CONTROLS, z, strict=False))
    return values


def _numbers(name: str, given: Any, count: int) -> list[float]:
    flat = np.ravel(np.asarray(given, dtype=object)).tolist()
    if len(flat) != count or not all(isinstance(one, Real) for one in flat):
        form = {"f": "two numbers, (f1, f2)", "B": "two numbers, (B1, B2)", "g": "one number"}[name]
        raise ValueError(f"{name} is {str(given)[:60]}; give {form}, or an ELinear for anything else.")
    return flat


def _clean(state: Mapping[str, Any]) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for name, value in state.items():
        if name not in CONTROL_NAMES:
            raise ValueError(f"{name!r} is no control of the explorer; there are f, B, g, {', '.join(CONTROL_NAMES)}.")
        try:
            values[name] = clean(name, value)
        except InputError as error:
            raise ValueError(str(error)) from error
    return values


def _bring_resources() -> None:
    """Publish BokehJS and Panel for a front end of ipywidgets, once a kernel; other pages ask for them themselves.

    marimo takes them from here instead of a public host, and Voila's pages, which run no script of a cell, are of
    ipywidgets.
    """
    import panel as pn

    config: Any = pn.config  # its attributes are made at run time
    if os.environ.get("SERVER_SOFTWARE", "").startswith("voila"):
        config.comms = "ipywidgets"
    if "marimo" in sys.modules:
        config.inline = True
    if running_kernel() is not None and pn.config.comms != "default" and not getattr(pn.extension, "_loaded", False):
        pn.extension(inline=True)


def _values_of(system: System_, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the controls that show this system at z: coefficients, a panel, and where a motion may start."""
    launch = ", ".join(f"{v:g}" for v in (0.6, 0.8, *[0.0] * system.m))
    if not isinstance(system, ELinear):
        return {"launch": launch, "panel": "numbers", "along": "z", "across": "z", "up": "n"}
    z = [values.get(name, 0.0) for name in SLOW_CONTROLS[: system.m]]
    at = system.at((*z, *[0.0] * (system.m - len(z))))
    shown = {"a": at.a, "b": at.b, "d": at.d, "f1": at.f1, "f2": at.f2, "k1": 0.0, "k2": 0.0, "launch": launch}
    scene = Scene(system, constant(), (*z, *[0.0] * (system.m - len(z))))
    if len(axes_there(scene, ExplorerState.from_values(shown).values(), locked_controls(scene, True))) < 2:
        shown["panel"] = "numbers"  # there is no atlas
    if system.m:
        shown |= {"B1": float(at.B[0, 0]), "B2": float(at.B[0, 1]), "g0": float(at.g[0])}
    return shown
