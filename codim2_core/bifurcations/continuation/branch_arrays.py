"""Build the public branch from its points: folds and ends, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...results.words import say
from .continuation_points import ReturnMapPoint
from .result import CycleBranch, CyclePoint

#: Of one point: value, period, amplitude, exponent, and where the cycle crosses its section.
PointRow = tuple[float, float, float, float, float, float]


def point_row(turn: ReturnMapPoint) -> PointRow:
    """Return the row of a closed turn."""
    return turn.value, turn.period, turn.amplitude, turn.exponent, *turn.p


def build_branch(
    name: str, rows: Sequence[PointRow], folds: Sequence[ReturnMapPoint], start: CyclePoint, end: CyclePoint
) -> CycleBranch:
    """Make a branch of its rows in order, limits at ends that are no cycles among them."""
    table = np.array(rows)
    points = []
    for t in folds:
        text = say("branch folds", name=name, value=t.value)
        points.append(CyclePoint("fold of cycles", t.value, t.period, t.amplitude, text))
    exponent = np.ascontiguousarray(table[:, 3])
    columns: dict[str, Any] = {
        "value": table[:, 0],
        "period": table[:, 1],
        "amplitude": table[:, 2],
        "exponent": exponent,
        "multiplier": np.exp(np.clip(exponent, -700.0, 700.0)),
        "stable": exponent < 0.0,
        "section": table[:, 4:6],
    }
    for key, array in columns.items():
        columns[key] = np.ascontiguousarray(array)
        columns[key].flags.writeable = False
    return CycleBranch(start=start, end=end, folds=tuple(points), **columns)
