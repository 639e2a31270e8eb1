"""How the layers of a scene grow with the number of trajectories, pixel, tolerance and view; and their shares.

Run ``python -m tests.benchmarks.bench_growth [--quick]``. Each scene is new, so that nothing is remembered; the
layers' needs are computed first, so that each layer is charged for itself alone.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Sequence

import numpy as np

import codim2_core as c2

from .bench_scene import PICTURE
from .pictures import Plot, plot

PRESETS = ("case1-cm4", "case3-n3")
AXES: dict[str, Sequence[float]] = {
    "count": (16, 64, 256, 1024, 2000),
    "pixel": (0.05, 0.02, 0.0056, 2e-3, 5e-4, 1e-4),
    "tolerance": tuple(10.0**-k for k in range(2, 13)),
    "view": (1.2, 1.5, 2.0, 3.0, 5.0, 10.0),
}
TITLES = {
    "count": "trajectories", "pixel": "pixel, picture units", "tolerance": "rtol of trajectories", "view": "view",
}  # fmt: skip
LEAST = 0.06  # of the picture: layers below it at every setting are drawn as one
Spent = dict[str, float]


def scene_of(preset: str, axis: str, value: float) -> c2.Scene:
    """A new scene with one thing changed."""
    values = c2.presets[preset]
    changes = (
        {"count": int(value)}
        if axis == "count"
        else {"rtol": value, "atol": value / 10.0}
        if axis == "tolerance"
        else {axis: value}
    )
    return c2.Scene(values.system, values.psi, **changes)  # type: ignore[arg-type]


def layers_of(preset: str, axis: str, value: float) -> Spent:
    """Seconds of each layer, in the order in which a frame asks for them."""
    scene, spent = scene_of(preset, axis, value), {}
    for name in PICTURE:
        start = time.perf_counter()
        scene[name]
        spent[name] = time.perf_counter() - start
    return spent


def measure(quick: bool = False) -> dict[tuple[str, str], dict[float, Spent]]:
    """Medians of each layer by (preset, axis) and value, measured in turns over the values."""
    turns = 3 if quick else 15
    found: dict[tuple[str, str], dict[float, Spent]] = {}
    for preset in PRESETS[: 1 if quick else 2]:
        for axis, values in AXES.items():
            runs: dict[float, list[Spent]] = {value: [] for value in values}
            for value in values:
                layers_of(preset, axis, value)
            for _ in range(turns):
                for value in values:
                    runs[value].append(layers_of(preset, axis, value))
            found[preset, axis] = {
                value: {name: statistics.median(run[name] for run in taken) for name in PICTURE}
                for value, taken in runs.items()
            }
    return found


def growth(rows: dict[float, Spent]) -> float:
    """Exponent of the trajectories' time over the upper half of the axis."""
    values = sorted(rows)[len(rows) // 2 - 1 :]
    times = [rows[value]["inside"] + rows[value]["outside"] for value in values]
    return float(np.polyfit(np.log(values), np.log(times), 1)[0])


def text(found: dict[tuple[str, str], dict[float, Spent]]) -> str:
    """Shares of a default frame, and times along each axis, as Markdown."""
    presets = list(dict.fromkeys(preset for preset, _ in found))
    shares = {preset: found[preset, "count"][64] for preset in presets}
    lines = [f"| share of a default frame | {' | '.join(presets)} |", "|---" * (len(presets) + 1) + "|"]
    for name in sorted(PICTURE, key=lambda name: -shares[presets[0]][name]):
        cells = [f"{shares[p][name] / sum(shares[p].values()):.0%}" for p in presets]
        lines.append(f"| {name} | {' | '.join(cells)} |")
    lines.append("| all, ms | " + " | ".join(f"{1e3 * sum(shares[p].values()):.2f}" for p in presets) + " |")
    lines += ["", "| a new scene, ms of the picture (of its trajectories) | |", "|---|---|"]
    for (preset, axis), rows in found.items():
        cells = [
            f"{value:g}: {1e3 * sum(spent.values()):.2f} ({1e3 * (spent['inside'] + spent['outside']):.2f})"
            for value, spent in rows.items()
        ]
        extra = f"; trajectories grow as count^{growth(rows):.2f}" if axis == "count" else ""
        lines.append(f"| {preset}, {TITLES[axis]} | {', '.join(cells)}{extra} |")
    return "\n".join(lines)


def plots(found: dict[tuple[str, str], dict[float, Spent]]) -> list[Plot]:
    """Time of each layer along each axis."""
    drawn = []
    for (preset, axis), rows in found.items():
        curves: dict[str, list[tuple[float, float]]] = {"picture": []}
        whole = {value: sum(spent.values()) for value, spent in rows.items()}
        large = [name for name in PICTURE if any(spent[name] > LEAST * whole[v] for v, spent in rows.items())]
        for value, spent in rows.items():
            curves["picture"].append((value, whole[value]))
            for name in large:
                curves.setdefault(name, []).append((value, spent[name]))
            rest = sum(spent[name] for name in PICTURE if name not in large)
            if rest:
                curves.setdefault("all others", []).append((value, rest))
        drawn.append(plot(f"{preset}: {axis}", curves, first="picture", x=TITLES[axis]))
    return drawn


def report(quick: bool = False) -> str:
    """Return the tables as Markdown."""
    return text(measure(quick))


if __name__ == "__main__":
    print(report("--quick" in sys.argv))
