"""First view of a chosen system: a place on Sigma, axes, a motion and a panel that show something of it."""

from __future__ import annotations

from typing import Any

from codim2_core.motion.periodic.search import forcing_period
from codim2_core.systems.examples import catalogue, keys_at_contacts

from .choices import OWN_AXIS, SLOW_CONTROLS
from .chosen_system import NORMAL, has_atlas, starting_launch, starting_z


def opening_values(choice: str) -> dict[str, Any]:
    """Return what a choice of system brings: its first place on Sigma, its own parameters, a motion worth seeing.

    And a panel that has something to show of it: of what is forced, without an atlas, its response. Of a
    mechanism with several contacts it brings a second portrait, of another.
    """
    z = (*starting_z(choice), *(0.0,) * len(SLOW_CONTROLS))
    _, t_end = starting_launch(choice)
    slow = dict(zip(SLOW_CONTROLS, z, strict=False))
    across, up = axes_of(choice)
    motion = {"launch": opening_launch(choice), "t_end": t_end}
    axes = {"drift": "z", "across": across, "up": up, "along": across}
    panel = "atlas" if has_atlas(choice) else "numbers"
    example = catalogue.get(choice)
    if panel != "atlas" and example is not None and example.ranges and forcing_period(example.make()) is not None:
        axes["along"], panel = OWN_AXIS + next(iter(example.ranges)), "response"
    beside = next((portrait_of_system(key) for key in keys_at_contacts(choice) if key != choice), "")
    return {"texts": {}, "parameters": {}, **slow, **motion, **axes, "panel": panel, "beside": beside}


def portrait_of_system(choice: str) -> str:
    """Return the text of a second portrait that differs in the system alone."""
    return f"system={choice}"


def opening_launch(choice: str) -> str:
    """Return the text of the state from which a motion of a choice starts at first."""
    launch, _ = starting_launch(choice)
    return ", ".join(f"{v:g}" for v in launch)


def axes_of(choice: str) -> tuple[str, str]:
    """Return the axes with which the atlas of a system opens: slow variables, or one and the first parameter."""
    example = catalogue.get(choice)
    if example is None:
        return ("f1", "f2") if choice == NORMAL else ("z", "n")
    if len(example.z) > 1:
        return "z", "z2"
    return "z", next((OWN_AXIS + name for name in example.ranges), "n")
