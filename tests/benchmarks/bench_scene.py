"""Cost of a cold default scene, layer by layer, next to its trajectories alone; and of importing the core.

Times are of the processor: another program that runs next to it counts less.

Run ``python -m tests.benchmarks scene [--quick]``.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time

import codim2_core as c2
from codim2_core.scene import layers
from codim2_core.scene.layer_table import regions_of

TRAJECTORIES = ("inside", "outside")
ON_REQUEST = ("separatrices", "certificates", "outcomes")  # only when a person asks, or at rest
LAYERS = tuple(layers)
PICTURE = tuple(name for name in LAYERS if name not in ON_REQUEST)  # what a frame of the explorer computes


def cold(preset: str) -> dict[str, float]:
    """Microseconds of each layer of a scene computed for the first time."""
    values = c2.presets[preset]
    regions_of.cache_clear()
    scene = c2.Scene(values.system, values.psi)
    spent = {}
    for name in LAYERS:
        start = time.process_time_ns()
        scene[name]
        spent[name] = 1e-3 * (time.process_time_ns() - start)
    return spent


def layer_rows(repeats: int = 51) -> list[tuple[str, float, float, float, float]]:
    """(preset, picture, all layers, its trajectories, picture / trajectories): medians, the ratio paired by run."""
    rows = []
    for preset in ("case1-cm4", "case1-cm0", "case2-saddle", "case3-n2"):
        cold(preset)
        runs = [cold(preset) for _ in range(repeats)]
        picture = [sum(run[name] for name in PICTURE) for run in runs]
        whole = [sum(run.values()) for run in runs]
        alone = [sum(run[name] for name in TRAJECTORIES) for run in runs]
        ratio = statistics.median(p / t for p, t in zip(picture, alone, strict=True))
        rows.append((preset, *map(statistics.median, (picture, whole, alone)), ratio))
    return rows


def import_seconds(statement: str) -> float:
    """Seconds of one import statement in a fresh interpreter."""
    code = f"import time; t = time.process_time(); {statement}; print(time.process_time() - t)"
    return float(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout)


def import_row(repeats: int = 9) -> tuple[float, float, float]:
    """(ours, numba with scipy.integrate, ratio) in seconds, paired."""
    pairs = [
        (import_seconds("import codim2_core"), import_seconds("import numba, scipy, scipy.integrate"))
        for _ in range(repeats)
    ]
    return (
        statistics.median(p[0] for p in pairs),
        statistics.median(p[1] for p in pairs),
        statistics.median(p[0] / p[1] for p in pairs),
    )


def report() -> str:
    """Return both tables as Markdown."""
    lines = [
        "| cold scene | picture, ms | with separatrices, regions, theorems, ms | its 64 trajectories alone, ms | "
        "picture / trajectories |",
        "|---|---|---|---|---|",
    ]
    for name, picture, whole, alone, ratio in layer_rows():
        lines.append(f"| {name} | {picture / 1e3:.2f} | {whole / 1e3:.2f} | {alone / 1e3:.2f} | {ratio:.2f} |")
    ours, theirs, ratio = import_row()
    lines += ["", "| import, warm cache | s of the processor |", "|---|---|", f"| `import codim2_core` | {ours:.3f} |"]
    lines += [f"| `import numba, scipy, scipy.integrate` | {theirs:.2f} |", f"| ratio, paired | {ratio:.2f} |"]
    return "\n".join([*lines, "", f"Load of the machine then: {os.getloadavg()[0]:.1f}."])
