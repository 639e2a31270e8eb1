"""The panels next to the picture: what the open one is sent in a frame. A closed panel costs nothing.

What is cheap goes with every frame. What is slower is computed in the background (`frame.background_results`) once the
controls rest; until the browser has it, its name is in ``header["late"]``, and the panel shows that it has old results.
"""

from __future__ import annotations

from importlib import import_module

from ..picture.frame.budget import OmittedLayer, PendingLayer
from ..picture.frame.faults import FAILURES, sentence_of
from ..picture.frame.frame_context import FrameContext
from ..picture.slow_layers import basins, outcomes
from ..picture.state.controls import set_options
from . import challenge
from .panel import Panel

#: Modules next to this one that end with a `PANEL`, in the order of the tabs: a new panel is one more name here.
MODULES = (
    "lessons", "parameters.atlas", "numbers", "orbits", "parameters.planes", "parameters.diagram", "theorems", "along",
    "solid", "parameters.response", "psi", "census",
)  # fmt: skip
#: Tabs in sight from the first; the others are one step away.
FIRST = 4
#: By key.
PANELS_BY_NAME: dict[str, Panel] = {}
#: Layers of the picture that are computed as panels are, by name.
LAYERS = {"basins": basins.add, "outcomes": outcomes.add}


def register(panel: Panel) -> None:
    """Add a panel: its tab comes last. This must be before the page is made (`codim2_app.view`).

    Raises
    ------
    ValueError
        There is a panel of this key, or its script is missing.
    """
    if panel.key in PANELS_BY_NAME:
        raise ValueError(f"There is a panel {panel.key!r} already; choose another key.")
    if not panel.script.is_file():
        raise ValueError(f"The panel {panel.key!r} has no script: write {panel.script.name} in its folder.")
    PANELS_BY_NAME[panel.key] = panel
    set_options("panel", PANELS_BY_NAME)


def add(draft: FrameContext) -> None:
    """Add what the open panel and the visible layers show to a frame.

    What one has noted as sent before it ends early may not have been: the browser is sent it again.
    """
    wanted = [
        PANELS_BY_NAME[draft.values["panel"]].add,
        *(LAYERS[name] for name in LAYERS if name in draft.values["layers"]),
        *([challenge.add] if draft.values["goal"] else []),
    ]
    for each in dict.fromkeys(wanted):
        had = dict(draft.now)
        try:
            each(draft)
            continue
        except PendingLayer as name:
            draft.missing.append(str(name))
            draft.late(draft.values["panel"])
        except OmittedLayer as why:
            draft.left_out.append(why)
            draft.unable(draft.values["panel"], OmittedLayer.sentence([why]))
        except FAILURES:
            raise
        except Exception as error:  # the picture is drawn without it
            draft.header["fault"] = sentence_of(error, f"the panel {draft.values['panel']}")
        draft.now.clear()
        draft.now.update(had)


for module in MODULES:
    register(import_module(f".{module}", __package__).PANEL)
