"""The Filippov convention in three dimensions: limit vectors, their combinations on Sigma, and what the blowup selects.

The view of Figure 3 and Figure 12, within the panel "3-D": the curve of limit vectors
F*(theta) = (U1, U2, W1), (4.3), the axis Sigma (U = 0), and on it the candidates; for the e-linear system
the plane of affine combinations, and its one point on Sigma.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from codim2_core.portrait.layer_problem.critical import critical_sets
from codim2_core.portrait.sliding.filippov import AffinePlane, affine_plane, filippov_sliding
from codim2_core.systems.psi.function import Psi

from ..picture.frame.frame_context import FrameContext
from ..picture.slow_layers.short import short
from ..picture.state.chosen_system import System_

CURVE_POINTS = 97  # of the curve
MAX_HALF_SIDE = (
    6.0  # half the side of the plane's square, in (lambda1, lambda2): a cross farther out is outside the view
)


def add_filippov(draft: FrameContext, system: System_) -> None:
    """Add the limit vectors and the candidates at the present z, once nothing moves."""
    scene = draft.scene
    z, psi = scene.z, scene.psi
    found = draft.slow("filippov", (system, psi, z), vectors, system, psi, z)
    if found is not None:
        draft.header["filippov"] = found


def vectors(system: System_, psi: Psi, z: tuple[float, ...]) -> dict[str, Any]:
    """Return the curve, the plane, the candidates with what they combine, and the selected slow flows."""
    at = system.at(z)
    theta = np.linspace(0.0, 2.0 * np.pi, CURVE_POINTS)

    def limit(angles: np.ndarray) -> list[list[float]]:
        e = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return [short((*u, w[0]), 4) for u, w in zip(at.U(e), at.W(e), strict=True)]

    found, plane = filippov_sliding(system, z), affine_plane(system, z)
    corners = (
        [] if plane is None else [_square_corner(plane, vertex) for vertex in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    )
    return {
        "plane": corners,
        "cross": None if plane is None or plane.point is None else short(plane.point[:1], 4)[0],
        "curve": limit(theta),
        "candidates": [float(vertex[0]) for vertex in found.vertices],
        "combined": [limit(directions) for directions in found.directions],
        "selected": [[float(C.slow_flow[0]), C.kind] for C in critical_sets(system, psi, z)],
        "sentence": found.sentence if plane is None else f"{plane.sentence} {found.sentence}",
    }


def _square_corner(plane: AffinePlane, vertex: tuple[int, int]) -> list[float]:
    """Return the combination at a corner of a square in (lambda1, lambda2) that holds the unit disc and the cross."""
    reach = 1.15 if plane.place is None else min(MAX_HALF_SIDE, max(1.15, 1.15 * float(np.abs(plane.place).max())))
    return short((plane.matrix @ (reach * np.array(vertex)) + plane.offset)[:3], 4)
