"""The paper's figures as values of the controls."""

from __future__ import annotations

from collections.abc import KeysView, Sequence
from typing import Any

from codim2_core.results.paper import cite
from codim2_core.systems.examples import catalogue
from codim2_core.systems.presets.preset import Preset
from codim2_core.systems.presets.presets import presets

from ..draw.layers import default_layers

#: Layers of a figure that shows where approaches lead.
WITH_OUTCOMES = [
    "outside", "inside", "continuations", "cycles", "rho", "theta", "lines", "equator", "critical",
    "outcomes", "basins",
]  # fmt: skip
#: Layers of Figure 13: the two conics and where they meet.
CONICS = ["conics", "equator", "critical"]
#: What opens the view of a preset.
VIEWS: dict[str, dict[str, Any]] = {
    "sphere": {"panel": "solid", "solid": "sphere"},
    "stack": {"panel": "solid", "solid": "stack"},
    "filippov": {"panel": "solid", "solid": "filippov"},
    "outcomes": {"panel": "numbers", "layers": WITH_OUTCOMES},
    "connections": {"layers": [*default_layers(), "separatrices"]},
    "conics": {"panel": "numbers", "layers": CONICS},
    "psi": {"panel": "psi"},
    "planes": {"panel": "planes"},
    "along": {"panel": "along"},
    "time": {"panel": "orbits", "orbit_eps": "show"},
}


def portraits() -> list[dict[str, Any]]:
    """Return one entry for each preset: key, group, title, the paper's figure, note, and its own values.

    All that it sets is `controls.preset_values`.
    """
    return [
        {
            "key": preset.name,
            "group": preset.group,
            "title": preset.title,
            "label": cite(preset.label, titled=True),
            "note": preset.note,
            "values": _values(preset),
        }
        for preset in presets.values()
    ]


def portrait_values(key: str) -> dict[str, Any]:
    """Return the own values of one of them."""
    return _values(presets[key])


def portrait_keys() -> KeysView[str]:
    """Return the keys of all portraits."""
    return presets.keys()


def _values(preset: Preset) -> dict[str, Any]:
    values: dict[str, Any] = {
        "psi": preset.family,
        "n": preset.psi.parameter or 2.0,
        "texts": {},
        "parameters": {},
        **VIEWS.get(preset.view, {}),
    }
    z = (*preset.z, 0.0, 0.0, 0.0, 0.0)
    values.update(zip(("z", "z2", "z3", "z4"), z, strict=False))
    if preset.example:
        example = catalogue[preset.example]
        return {"system": preset.example, **values, **_start(example.launch, example.t_end)}
    values.update((name, getattr(preset, name)) for name in ("a", "b", "d", "f1", "f2"))
    if preset.B:
        values.update(zip(("B1", "B2", "g0"), (*preset.B[0], preset.g[0]), strict=True))
    if preset.launch:
        values.update(_start(preset.launch, preset.t_end))
    return {"system": "normal", **values}


def _start(launch: Sequence[float], t_end: float) -> dict[str, Any]:
    return {"launch": ", ".join(f"{v:g}" for v in launch), "t_end": t_end}
