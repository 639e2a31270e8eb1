"""Faces of an atlas's curves: our own against shapely's, which unites lines on a grid and polygonizes them.

Run ``python -m tests.benchmarks faces``, with shapely (extra bench).
"""

from __future__ import annotations

import time

import numpy as np

import codim2_core as c2
from codim2_core.bifurcations.atlases import faces, regions

ATLASES = {
    "case1-cm4": lambda: c2.atlas("case1-cm4", ranges=("f1", "f2")),
    "case3-n3": lambda: c2.atlas("case3-n3", ranges=("f1", "f2")),
    "a disc": lambda: c2.atlas("spinning_disc", "constant", {"k": (0.3, 1.0), "mu": (0.05, 1.0)}),
    "Bogdanov-Takens": lambda: c2.atlas(
        c2.System(U=("s", "mu + k*s + c**2 - 1/4 + c*s"), parameters={"mu": -0.1, "k": 0.2}), "tanh",
        {"mu": (-1.5, 0.5), "k": (-1.5, 1.5)},
    ),
}  # fmt: skip
GRID = 1e-9  # of the unit square


def report(quick: bool = False) -> str:
    """Return a table of counts, areas and times; quickly for two atlases."""
    import shapely

    rows = [
        "| atlas | faces | shapely's | areas differ by | ms | shapely's | atlas, ms |",
        "|---|---|---|---|---|---|---|",
    ]
    own, given = regions.net_of, []
    regions.net_of = lambda lines: given.append(lines) or own(lines)
    try:
        for name, make in list(ATLASES.items())[: 2 if quick else None]:
            make()
            begun = time.perf_counter()
            make()
            whole, lines = time.perf_counter() - begun, given[-1]
            begun = time.perf_counter()
            ours = own(lines).faces()
            first = time.perf_counter() - begun
            every = [faces.FRAME, *(faces._extend_to_lines(i, lines) for i in range(len(lines)))]
            begun = time.perf_counter()
            united = shapely.union_all([shapely.LineString(line) for line in every], grid_size=GRID)
            theirs = shapely.get_parts(shapely.polygonize([united]))
            second = time.perf_counter() - begun
            areas = np.sort([face.area for face in ours]), np.sort(shapely.area(theirs))
            apart = f"{abs(areas[0] - areas[1]).max():.0e}" if len(ours) == len(theirs) else "–"
            times = " | ".join(f"{1e3 * t:.1f}" for t in (first, second, whole))
            rows.append(f"| {name} | {len(ours)} | {len(theirs)} | {apart} | {times} |")
    finally:
        regions.net_of = own
    return "\n".join(rows)
