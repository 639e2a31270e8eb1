"""Build the scene that is drawn from the values of the controls, and evolve it when they change."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from codim2_core.portrait.layer_problem.equator import cut_that_keeps_names
from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.examples import keys_at_contacts
from codim2_core.systems.typed import System

from ..draw.theme import PICTURE_REACH
from ..state.choices import COEFFICIENTS, SLOW_CONTROLS
from ..state.chosen_psi import build_psi
from ..state.chosen_system import NORMAL, System_, TextError, build, parameters_of
from ..state.cleaning import InputError
from ..state.launches import read_launches
from ..state.system_opening_values import opening_values, portrait_of_system
from .budget import OmittedLayer, PendingLayer

#: Text of f(z) = f + z k and of z' = B e + g. It never changes, so that nothing is parsed again on a tick:
#: the numbers travel as parameters of the system.
F_TEXT = ("f1 + k1*z", "f2 + k2*z")
B_TEXT = (("B1", "B2"),)
G_TEXT = ("g0",)


def make_scene(values: Mapping[str, Any], system: System_ | None = None) -> Scene:
    """Return the scene of these values, or of `system` instead of the one that they choose.

    Raises
    ------
    InputError
        A text or a value cannot be used.
    """
    system = chosen_system(values) if system is None else system
    psi, launch = build_psi(values), launch_points(values)
    place, cut = position(values, system.m), values["cut"]
    return Scene(system, psi, place, count=values["trajectories"], launch=launch, view=PICTURE_REACH, cut=cut)


def launch_points(values: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Return where the launched orbits that are shown start."""
    return [(orbit.x, orbit.y) for orbit in read_launches(values["orbits"]) if not orbit.hidden]


def chosen_system(values: Mapping[str, Any]) -> System_:
    """Return the system that the values choose.

    Raises
    ------
    InputError
        With "text:" and the name of the box.
    """
    if values["system"] == NORMAL:
        return ELinear(
            values["a"],
            values["b"],
            values["d"],
            f=F_TEXT,
            B=B_TEXT,
            g=G_TEXT,
            parameters={name: values[name] for name in COEFFICIENTS[3:]},
        )
    try:
        return build(values["system"], values["texts"], values["parameters"])
    except TextError as error:
        raise InputError(f"text:{error.box}", str(error)) from error


def position(values: Mapping[str, Any], m: int) -> tuple[float, ...]:
    """Return z: the values of the sliders, and 0 for slow variables that have none."""
    return tuple(values[name] for name in SLOW_CONTROLS[:m]) + (0.0,) * (m - len(SLOW_CONTROLS))


def complete_changes(values: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the changes with what another choice of system brings: its first place on Sigma, its own parameters.

    The panel stays open unless it is the atlas and the new system has none; a second one unless it is of a contact.
    """
    wanted = dict(changes)
    choice = wanted.get("system")
    if choice is None or choice == values["system"]:
        return wanted
    brought = opening_values(choice)
    if values["panel"] != "atlas":
        del brought["panel"]
    if not brought["beside"] and values["beside"] not in map(portrait_of_system, keys_at_contacts(values["system"])):
        del brought["beside"]
    return {**brought, **wanted}


def evolve_scene(
    scene: Scene, values: Mapping[str, Any], changed: Collection[str], given: Mapping[str, float] | None = None
) -> Scene:
    """Return the scene after some values have changed; it shares all that they do not reach.

    Parameters
    ----------
    given : mapping, optional
        The system is the user's own, from Python, and no value chooses another: its parameters as it came.
    """
    changes: dict[str, Any] = {}
    system = scene.system
    if given is None and {"system", "texts"} & set(changed):
        system = changes["system"] = chosen_system(values)
    elif given is not None or values["system"] == NORMAL:
        changes.update((name, values[name]) for name in changed if name in COEFFICIENTS)
    if "parameters" in changed and isinstance(system, (ELinear, System)):
        # a parameter without a value is as the system came with it
        first = parameters_of(values["system"], values["texts"]) if given is None else given
        own = dict(system.parameters)
        wanted = {**first, **values["parameters"]}
        changes.update((name, v) for name, v in wanted.items() if name in own and own[name] != v)
    if "system" in changes or set(SLOW_CONTROLS) & set(changed):
        changes["z"] = position(values, system.m if isinstance(system, (ELinear, System)) else 0)
    if {"psi", "n", "psi_text"} & set(changed):
        changes["psi"] = build_psi(values)
    if "orbits" in changed:
        changes["launch"] = launch_points(values)
    if "trajectories" in changed:
        changes["count"] = values["trajectories"]
    if "cut" in changed:
        changes["cut"] = values["cut"]
    return scene.evolve(**changes) if changes else scene


def cut_after(before: Scene, scene: Scene, changed: Collection[str]) -> float:
    """Return the angle from which the limit directions of a changed scene are counted.

    Names follow while a value moves, and are the first ones again of another system.
    """
    if {"preset", "system", "texts"} & set(changed):
        return 0.0
    if before.key("plane") == scene.key("plane"):
        return scene.cut
    try:
        return cut_that_keeps_names(before["equator"], scene["equator"], scene.cut)
    except (PendingLayer, OmittedLayer):  # not to be had in this frame
        return scene.cut


def locked_controls(scene: Scene, given: bool) -> tuple[str, ...]:
    """Name the controls that cannot change this scene: coefficients given as text, or not there."""
    system = scene.system
    if not given:
        return ()
    if not isinstance(system, ELinear):
        return COEFFICIENTS
    named = dict(system.parameters)
    given_as = {"a": system.a, "b": system.b, "d": system.d, "f1": system.f[0], "f2": system.f[1]}
    if system.given_matrix is not None:  # made by from_matrix: a, b, d follow from the rotation, and f is turned by it
        given_as = {}
    free = {*named, *(name for name, value in given_as.items() if isinstance(value, float))}
    locked = tuple(name for name in COEFFICIENTS if name not in free)
    return locked if system.m else (*locked, "z")
