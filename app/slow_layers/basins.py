"""The layer "Basins": to which critical set, cycle or limit direction each point of the disc leads."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.portrait.basins import basins_of
from codim2_core.scene import Scene

from ..frame.draft import Draft

BASINS = 4  # colours of the theme
CELLS = 128  # across the disc: smoothed, five pixels of a picture of 640


def add(draft: Draft) -> None:
    """Add the basins, once nothing moves."""
    if not draft.ready:
        return
    scene = draft.scene
    found = draft.slow("basins", scene.key("plane", "slow", "psi"), columns, scene)
    if found is not None:
        header, runs = found
        draft.header["basins"] = header
        draft.blocks["basins"] = runs


def columns(scene: Scene) -> tuple[dict[str, Any], NDArray[np.uint16]]:
    """Return words and colours of the basins, and the cells row by row as runs: how many, of which.

    Rows rise with y. The colours are keys of the themes, "" for none: outside the disc, undecided, each destination.
    """
    found = basins_of(scene.problem, CELLS)
    flat = found.cells.ravel()
    starts = np.concatenate([[0], np.flatnonzero(np.diff(flat)) + 1])
    lengths = np.diff(np.append(starts, len(flat)))
    # 0 is outside the disc, 1 undecided, 2 and on the destinations
    runs = np.column_stack([lengths, flat[starts] + 2]).astype(np.uint16)
    flows = [None if flow is None else [float(f"{v:.4g}") for v in flow] for flow in found.slow_flow]
    named = list(found.destinations)
    colours = [
        "cross" if name.startswith("Q") or name == "equator" else f"basin-{i % BASINS + 1}"
        for i, name in enumerate(named)
    ]
    header = {"cells": CELLS, "destinations": named, "flows": flows, "colours": ["", "undecided", *colours]}
    return header, runs
