"""The Filippov convention in three dimensions: limit vectors, their combinations on Sigma, and what the blowup selects.

The view of fig:generic_nonuniqueness_of_sliding and fig:whylinear, within the panel "3-D": the curve of limit vectors
F*(theta) = (U1, U2, W1), eq:lin_limit_vector, the axis Sigma (U = 0), and on it the candidates.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from codim2_core.layer_problem.critical import critical_sets
from codim2_core.psi.function import Psi
from codim2_core.sliding.filippov import filippov_sliding

from ..frame.draft import Draft
from ..state.chosen import System_

POINTS = 97  # of the curve


def add(draft: Draft, system: System_) -> None:
    """Add the limit vectors and the candidates at the present z, once nothing moves."""
    scene = draft.scene
    z, psi = scene.z, scene.psi
    found = draft.slow("filippov", (system, psi, z), lambda: vectors(system, psi, z))
    if found is not None:
        draft.header["filippov"] = found


def vectors(system: System_, psi: Psi, z: tuple[float, ...]) -> dict[str, Any]:
    """Return the curve, the candidates with the limit vectors that they combine, and the selected slow flows."""
    at = system.at(z)
    theta = np.linspace(0.0, 2.0 * np.pi, POINTS)

    def limit(angles: np.ndarray) -> list[list[float]]:
        e = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return [_short((*u, w[0])) for u, w in zip(at.U(e), at.W(e), strict=True)]

    found = filippov_sliding(system, z)
    return {
        "curve": limit(theta),
        "candidates": [float(vertex[0]) for vertex in found.vertices],
        "combined": [limit(directions) for directions in found.directions],
        "selected": [[float(C.slow_flow[0]), C.kind] for C in critical_sets(system, psi, z)],
        "sentence": found.sentence,
    }


def _short(values: Any) -> list[float]:
    return [float(f"{v:.4g}") for v in values]
