"""The paper's figures as values of the controls."""

from __future__ import annotations

from typing import Any

from codim2_core.presets import presets

#: Presets set these and leave layers, trajectories, k, B and g as they are.
SET_BY_PRESET = ("a", "b", "d", "f1", "f2", "z", "psi", "n")


def portraits() -> list[dict[str, Any]]:
    """Return one entry for each preset: key, group, title, the paper's label, note, and the values it sets."""
    return [
        {
            "key": preset.name,
            "group": preset.group,
            "title": preset.title,
            "label": preset.label,
            "note": preset.note,
            "values": {
                "a": preset.a,
                "b": preset.b,
                "d": preset.d,
                "f1": preset.f1,
                "f2": preset.f2,
                "z": 0.0,
                "psi": "constant" if preset.hill is None else "hill",
                "n": 2.0 if preset.hill is None else float(preset.hill),
            },
        }
        for preset in presets.values()
    ]
