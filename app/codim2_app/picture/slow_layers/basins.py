"""The layer "Basins": to which critical set, cycle or limit direction each point of the disc leads."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.portrait.basins import DISC, Box, basins_of
from codim2_core.scene import Scene

from ..frame.frame_context import FrameContext

BASIN_COLOUR_COUNT = 4  # colours of the theme
CELLS_ACROSS = 128  # across the disc: smoothed, five pixels of a picture of 640
FINE_CELLS_ACROSS = 256  # across a part of it, of which between three and six eighths are seen: as fine
NEAR_WINDOW = 1.5  # a window narrower than this, in radii, is near


def add(draft: FrameContext) -> None:
    """Add the basins, once nothing moves."""
    if not draft.ready:
        return
    scene = draft.scene
    system, part = scene.key("plane", "slow", "psi"), part_of(scene.window)
    same = draft.now.get("basins", (None,))[0] == system
    found = draft.slow("basins", (system, part), basin_columns, scene, *part)
    late = draft.header.get("late", [])
    if same and "basins" in late:
        late[late.index("basins")] = "window"  # what the browser has is coarse, or a part of what is seen, but true
    if found is not None:
        header, runs = found
        draft.header["basins"] = header
        draft.blocks["basins"] = runs


def part_of(window: tuple[float, ...] | None) -> tuple[Box, int]:
    """Return a square that holds what is seen of the disc, and how many cells are across it.

    It is the whole square around the disc, or one of a net on which a small pan stays: its side is 2 over a power of
    two, its corner a multiple of a quarter of that.
    """
    if window is None or max(window[1] - window[0], window[3] - window[2]) >= NEAR_WINDOW:
        return DISC, CELLS_ACROSS
    left, right, bottom, top = (max(-1.0, min(1.0, v)) for v in window)
    if left >= right or bottom >= top:  # nothing of the disc is seen
        return DISC, CELLS_ACROSS
    side, size = 2.0, max(right - left, top - bottom)
    while 0.75 * side / 2.0 >= size:
        side /= 2.0
    if side == 2.0:
        return DISC, FINE_CELLS_ACROSS
    x, y = (math.floor(low / (side / 4.0)) * (side / 4.0) for low in (left, bottom))
    return (x, x + side, y, y + side), FINE_CELLS_ACROSS


def basin_columns(
    scene: Scene, box: Box = DISC, cells: int = CELLS_ACROSS
) -> tuple[dict[str, Any], NDArray[np.uint16]]:
    """Return words and colours of the basins, and the cells of a box row by row as runs: how many, of which.

    Rows rise with y. The colours are keys of the themes, "" for none: outside the disc, undecided, each destination.
    """
    found = basins_of(scene.problem, cells, box)
    flat = found.cells.ravel()
    # a new run in the middle, or one over all of 256 x 256 cells were too long for 16 bits
    starts = np.union1d([0, len(flat) // 2], np.flatnonzero(np.diff(flat)) + 1)
    lengths = np.diff(np.append(starts, len(flat)))
    # 0 is outside the disc, 1 undecided, 2 and on the destinations
    runs = np.column_stack([lengths, flat[starts] + 2]).astype(np.uint16)
    flows = [None if flow is None else [float(f"{v:.4g}") for v in flow] for flow in found.slow_flow]
    named = list(found.destinations)
    colours = [
        "cross" if name.startswith("Q") or name == "equator" else f"basin-{i % BASIN_COLOUR_COUNT + 1}"
        for i, name in enumerate(named)
    ]
    colours = ["", "undecided", *colours]
    header = {"cells": cells, "box": list(box), "destinations": named, "flows": flows, "colours": colours}
    return header, runs
