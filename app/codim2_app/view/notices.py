"""Notices about values of an address that cannot be used, sent with the first frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from codim2_core.scene import Scene
from codim2_core.systems.elinear import ELinear
from codim2_core.systems.typed import System

from ..lessons.library import lessons
from ..picture.phrases import say
from ..picture.slow_layers.typed_start import launch_of
from ..picture.state.chosen_system import NORMAL, texts_of
from ..picture.state.cleaning import InputError


def left_out(scene: Scene, values: Mapping[str, Any], given: bool) -> list[str]:
    """Say what was requested in vain: parameters and boxes that the system has not, a lesson, a motion's start."""
    said = []
    system = scene.system
    if not isinstance(system, (ELinear, System)):
        return said
    own = () if values["system"] == NORMAL and not given else [*system.parameters]
    boxes = [] if given else list(texts_of(values["system"], {}))
    for key, asked, there in (("no such parameter", "parameters", own), ("no such box", "texts", boxes)):
        unknown = [name[:20] for name in values[asked] if name not in there]
        if unknown:
            has = f"it has {', '.join(there)}" if there else "it has none"
            said.append(say(key, names=", ".join(unknown[:3]), there=has))
    if values["lesson"] and values["lesson"] not in lessons():
        named, some = values["lesson"][:40], ", ".join(list(lessons())[:3])
        said.append(say("no such lesson", name=named, some=some))
    try:
        launch_of(values, system)
    except InputError as error:
        said.append(str(error))
    return said
