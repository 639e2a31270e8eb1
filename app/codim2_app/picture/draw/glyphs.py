"""Layers of a scene as columns to draw: pure functions, no window needed.

A polyline layer becomes two arrays, the number of points of each piece and all points in one row, so that
separate branches are never joined. Points with a meaning (equator equilibria, critical sets) become columns
of plain numbers and words, which the picture, its hover and the inspector share.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import accumulate
from typing import Any

import numpy as np
from numpy.typing import NDArray

from codim2_core.portrait.layer_problem.eigendirections import Linearised
from codim2_core.results.words import subscript
from codim2_core.scene.launched_orbits import LaunchedOrbits

Points = NDArray[np.float64]

#: Smallest angle between two labels around the circle, in radians, so that Q1 and Q2 stay readable.
LABEL_GAP = 0.16
LABEL_RADIUS = 1.11
#: A label stands next to its direction, since the θ-nullcline runs along it.
LABEL_TURN = 0.095
#: Marks of critical sets: shape, and whether it is filled. Stable is filled, a node a square, a focus a circle.
CRITICAL_MARKS = {
    "stable node": ("square", 1),
    "unstable node": ("square", 0),
    "stable focus": ("circle", 1),
    "unstable focus": ("circle", 0),
    "saddle": ("x", 0),
    "centre (linear)": ("circle_dot", 0),
    "saddle-node": ("triangle", 0),
    "degenerate": ("hex", 0),
}
#: Widths of marks in px: a circle, a square, … of one size do not look equally large.
EQUATOR_SIZES = {"circle": 13, "diamond": 18, "triangle": 15}
CRITICAL_SIZE = 15


def join(pieces: Sequence[Points]) -> tuple[NDArray[np.int64], Points]:
    """Return offsets (k + 1,) and points (n, 2): piece i is ``points[offsets[i]:offsets[i + 1]]``."""
    if not pieces:
        return np.zeros(1, np.int64), np.zeros((0, 2))
    return np.array([0, *accumulate(map(len, pieces))]), np.concatenate(pieces)


def spread(angles: Sequence[float], gap: float = LABEL_GAP) -> list[float]:
    """Move angles apart, each as little as is fair, until neighbours are at least `gap` apart.

    Parameters
    ----------
    angles : (k,) sorted, in radians
        More than there is room for around the circle stay where they are.
    """
    moved = list(angles)
    if len(moved) * gap > 2 * math.pi:
        return moved
    for _ in range(60):
        still = True
        for i in range(len(moved)):
            j = (i + 1) % len(moved)
            if i == j:
                break
            turn = 2 * math.pi if j == 0 else 0.0
            missing = gap - (moved[j] + turn - moved[i])
            if missing > 1e-9:
                moved[i] -= missing / 2
                moved[j] += missing / 2
                still = False
        if still:
            break
    return moved


def equator_type(lambda_rho: float, lambda_theta: float, multiplicity: int = 1) -> str:
    """Name an equator equilibrium by the signs of its eigenvalues.

    lambda_rho decides whether trajectories of the nonsmooth system arrive along this direction.
    """
    radial = "attracting" if lambda_rho < 0 else "repelling" if lambda_rho > 0 else "neutral"
    if multiplicity > 1 or lambda_theta == 0:
        return f"radially {radial}, angularly degenerate"
    angular = "attracting" if lambda_theta < 0 else "repelling"
    if angular == radial:
        return f"radially and angularly {radial}"
    return f"radially {radial}, angularly {angular}"


def equator_columns(equator: Any) -> dict[str, list[Any]]:
    """Return the columns of the equator equilibria Q1, Q2, ... in order of theta.

    ``filled`` is 1 where the equilibrium is radially attracting (trajectories arrive), 0 where it is repelling;
    ``shape`` is "circle" where it is angularly attracting, "diamond" where repelling, "triangle" if degenerate;
    ``colour`` is a key of the themes.
    """
    theta, rho, ang = equator.theta.tolist(), equator.lambda_rho.tolist(), equator.lambda_theta.tolist()
    multiplicity = equator.multiplicity.tolist()
    around = [theta[0] + (angle - theta[0]) % math.tau for angle in theta]  # Q1 need not be the first after 0
    labels = [angle + LABEL_TURN for angle in spread(around)]
    shapes = [
        "triangle" if m > 1 or v == 0 else "circle" if v < 0 else "diamond"
        for v, m in zip(ang, multiplicity, strict=True)
    ]
    return {
        "label": [f"Q{subscript(i + 1)}" for i in range(len(theta))],
        "theta": theta,
        "lambda_rho": rho,
        "lambda_theta": ang,
        "multiplicity": multiplicity,
        "type": [equator_type(r, v, m) for r, v, m in zip(rho, ang, multiplicity, strict=True)],
        "shape": shapes,
        "size": [EQUATOR_SIZES[shape] for shape in shapes],
        "filled": [int(v < 0) for v in rho],
        "colour": [
            "degenerate" if shape == "triangle" or v == 0 else "attr" if v < 0 else "rep"
            for v, shape in zip(rho, shapes, strict=True)
        ],
        "x": [math.cos(v) for v in theta],
        "y": [math.sin(v) for v in theta],
        "label_x": [LABEL_RADIUS * math.cos(v) for v in labels],
        "label_y": [LABEL_RADIUS * math.sin(v) for v in labels],
    }


def equator_arrows(equator: Any, direction: int = 0) -> list[tuple[float, float, float]]:
    """Return arrowheads (x, y, angle) on the equator: the sense of theta' between neighbouring equilibria.

    Parameters
    ----------
    equator : EquatorEquilibria
    direction : {-1, 0, 1}
        Sense of rotation of a closed equator, which has no equilibria.
    """
    theta, slope = equator.theta, equator.lambda_theta
    if equator.all_directions:
        return []
    if not len(theta):
        turns = [(math.pi * (i + 0.5) / 2, direction) for i in range(4)] if direction else []
    else:
        turns = []
        for i in range(len(theta)):
            j = (i + 1) % len(theta)
            gap = float(theta[j] - theta[i]) % math.tau if j != i else math.tau  # Q1 need not be the first after 0
            # Theta leaves a simple zero with the sign of its slope, and reaches the next one with minus its slope
            sense = float(np.sign(slope[i])) or -float(np.sign(slope[j]))
            if gap > 0.25 and sense:
                turns.append((float(theta[i]) + gap / 2, sense))
    return [(math.cos(t), math.sin(t), t + sense * math.pi / 2) for t, sense in turns]


def critical_columns(critical: Sequence[Any]) -> dict[str, list[Any]]:
    """Return the columns of the critical sets C (C1, C2, ... if there are several)."""
    flows = [[] if c.slow_flow is None else [float(v) for v in np.atleast_1d(c.slow_flow)] for c in critical]
    marks = [CRITICAL_MARKS.get(str(c.kind), ("circle", 0)) for c in critical]
    names = ["C"] if len(critical) == 1 else [f"C{subscript(i + 1)}" for i in range(len(critical))]
    return {
        "label": names,
        "x": [float(c.p[0]) for c in critical],
        "y": [float(c.p[1]) for c in critical],
        "kind": [str(c.kind) for c in critical],
        "shape": [shape for shape, _ in marks],
        "size": [CRITICAL_SIZE] * len(marks),
        "filled": [filled for _, filled in marks],
        "colour": ["crit"] * len(marks),
        "e": [[float(v) for v in c.e] for c in critical],
        "x2": [[float(v) for v in c.x2] for c in critical],
        "trace": [float(c.trace) for c in critical],
        "determinant": [float(c.determinant) for c in critical],
        "discriminant": [float(c.discriminant) for c in critical],
        "eigenvalues": [[[float(v.real), float(v.imag)] for v in np.asarray(c.eigenvalues)] for c in critical],
        "slow_flow": flows,
        "sense": [_out_of_page(flow) for flow in flows],
    }


def _out_of_page(flow: list[float]) -> str:
    """Return the sense of z' as the paper's circled dot (out of the page, z1' > 0) or cross."""
    return "" if not flow or flow[0] == 0 else "⊙" if flow[0] > 0 else "⊗"


def cycle_columns(cycles: Any) -> dict[str, Any]:
    """Return the columns of the limit cycles of the layer problem, innermost first, and why there are no others."""
    return {
        "kind": [cycle.kind for cycle in cycles.cycles],
        "period": [float(cycle.period) for cycle in cycles.cycles],
        "multiplier": [float(cycle.multiplier) for cycle in cycles.cycles],
        "direction": [int(cycle.direction) for cycle in cycles.cycles],
        "reason": cycles.reason,
        "notes": list(cycles.notes),
    }


def eigen_columns(objects: Sequence[Linearised]) -> list[dict[str, Any]]:
    """Return the eigenvectors of each object, as x, y, eigenvalue and where; and why others have none."""
    return [
        {
            "directions": [
                [round(d.direction[0], 5), round(d.direction[1], 5), d.value, d.where] for d in one.directions
            ],
            "turning": one.turning,
            "every": one.every,
        }
        for one in objects
    ]


def launched_columns(seeds: NDArray[np.float64], launched: LaunchedOrbits) -> dict[str, Any]:
    """Return where each launched orbit starts, and what is said of it, as columns."""
    return {
        "x": seeds[:, 0].tolist(),
        "y": seeds[:, 1].tolist(),
        "goes": [fate.sentence for fate in launched.goes],
        "comes": [fate.sentence for fate in launched.comes],
    }
