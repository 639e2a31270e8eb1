"""Basins on the projected disc: which critical set, cycle or limit direction the layer problem leads to from where.

Where several critical sets attract, their basins decide which slow flow follows (Section 5.3). Cells are refined
only where neighbours lead elsewhere.
"""

from __future__ import annotations

import math
import reprlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..results.result import Pictured, column_rows
from ..results.tables import html_table, point, table_number
from ..systems.kinds import AnySystem, takes_names
from ..systems.psi.function import Psi
from .cycles.limit_cycles import LimitCycles, cycles_of
from .layer_problem.problem import LayerProblem
from .omega_limits import CAPTURE, critical_label, drawn_time, omega_limits
from .orbits.trajectories import trajectories

COARSEST = 32  # cells across the disc at first
OUTSIDE, UNDECIDED_CELL = -2, -1
RTOL = 1e-5
DISC = (-1.0, 1.0, -1.0, 1.0)


Box = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False)
class Basins(Pictured):
    """Basins of attraction of the layer problem, as a class for each cell of the disc.

    Attributes
    ----------
    cells : ndarray of int8 (n, n)
        Place in `destinations` for the centre of each cell of the box, rows by rising y; -1 undecided (on a border,
        or slower than was followed), -2 outside the disc.
    destinations : tuple of str
        "C" (or "C1", ...), "cycle 1", "Q2", "equator".
    slow_flow : tuple of (ndarray (m,) or None)
        z' at each destination; None where it leaves Sigma.
    evaluations : int
        Evaluations of the field.
    box : (left, right, bottom, top)
        The part of the disc that the cells cover.
    """

    cells: NDArray[np.int8] = field(repr=False)
    destinations: tuple[str, ...]
    slow_flow: tuple[NDArray[np.float64] | None, ...]
    evaluations: int
    box: Box = DISC

    @property
    def shares(self) -> tuple[float, ...]:
        """The part of the cells of the disc that leads to each destination; what is left of 1 is undecided."""
        inside = max(1, int((self.cells != OUTSIDE).sum()))
        return tuple(float((self.cells == i).sum()) / inside for i in range(len(self.destinations)))

    def _records(self) -> Iterator[dict[str, Any]]:
        return column_rows({"leads_to": self.destinations, "share": self.shares})

    def _tables_(self) -> str:
        flows = ["–" if flow is None else point(flow) for flow in self.slow_flow]
        found = list(zip(self.destinations, map(table_number, self.shares), flows, strict=True))
        return html_table(("leads to", "share of the cells", "slow flow z′"), found)


@takes_names
def basins(
    system: AnySystem,
    psi: Psi,
    z: ArrayLike = (),
    *,
    n: int = 128,
    cycles: LimitCycles | None = None,
    box: Box = DISC,
) -> Basins:
    """Find the basins on the projected disc, (3.26).

    Parameters
    ----------
    system, psi, z
        As everywhere.
    n : int
        Cells across the box: 32 times a power of two.
    cycles : LimitCycles, optional
        The limit cycles, if they are known already.
    box : (left, right, bottom, top)
        The part of the disc, seen nearer; by default the square around it.

    Returns
    -------
    Basins
        A basin thinner than 1/32 of the box (1/16 of the radius) may be missed, since cells are refined only where
        neighbours of the coarsest 32 x 32 cells differ.

    Raises
    ------
    ValueError
        n is not 32 times a power of two, or the box is no box.

    Examples
    --------
    >>> from codim2_core import ELinear, basins, psi
    >>> found = basins(ELinear(1.0, 0.3, -1.2, (0.2, 0.45)), psi.constant(), n=64)
    >>> found.destinations
    ('Q3', 'Q1')
    """
    return basins_of(LayerProblem(system.at(z), psi).give(cycles_of, cycles), n, box)


def basins_of(problem: LayerProblem, n: int = 128, box: Box = DISC) -> Basins:
    """Find the basins of a layer problem, with the parameters of `basins`."""
    times, rest = divmod(n, COARSEST)
    if rest or times < 1 or times & (times - 1):
        raise ValueError(f"n is {n}; give 32 times a power of two: 32, 64, 128, …")
    box = _check_box(box)
    at, psi, equator, critical = problem.at, problem.psi, problem.equator, problem.critical
    cycles = cycles_of(problem)
    time = drawn_time(at, equator)
    names: list[str] = [critical_label(critical, i) for i, C in enumerate(critical) if C.kind.startswith("stable")]
    evaluations = 0

    def lead(points: NDArray[np.float64]) -> NDArray[np.int8]:
        nonlocal evaluations
        lines = trajectories(at, psi, points, t_max=time, rtol=RTOL, atol=RTOL, capture=CAPTURE, samples="ends")
        evaluations += lines.evaluations
        found = np.full(len(points), UNDECIDED_CELL, np.int8)
        for i, end in enumerate(omega_limits(at, psi, lines, equator, critical, lambda: cycles, rtol=RTOL)):
            if end.label == "undecided":
                continue
            if end.label not in names:
                names.append(end.label)
            found[i] = names.index(end.label)
        return found

    size = COARSEST
    cells = np.full((size, size), OUTSIDE, np.int8)
    inside = _cells_in_box(size, box)
    cells[inside] = lead(_centres(size, box)[inside])
    while size < n:
        size *= 2
        border = np.kron(_border_cells(cells), np.ones((2, 2), bool))
        cells = np.kron(cells, np.ones((2, 2), np.int8))
        inside = _cells_in_box(size, box)
        again = inside & (border | (cells == OUTSIDE))
        cells[~inside] = OUTSIDE
        cells[again] = lead(_centres(size, box)[again])
    cells.flags.writeable = False
    flows = []
    for name in names:
        if name.startswith("C"):
            flows.append(critical[int(name[1:] or 1) - 1].slow_flow)
        elif name.startswith("cycle"):
            flows.append(cycles[int(name.split()[1]) - 1].slow_flow)
        else:
            flows.append(None)
    return Basins(cells, tuple(names), tuple(flows), evaluations, box)


def _check_box(box: Box) -> Box:
    try:
        left, right, bottom, top = map(float, box)
    except (TypeError, ValueError, OverflowError):
        left = right = bottom = top = math.nan
    if not (-math.inf < left < right < math.inf and -math.inf < bottom < top < math.inf):
        raise ValueError(f"box is {reprlib.repr(box)}; give left, right, bottom, top, with left < right, bottom < top.")
    return left, right, bottom, top


def _centres(size: int, box: Box) -> NDArray[np.float64]:
    left, right, bottom, top = box
    part = (np.arange(size, dtype=np.float64) + 0.5) / size
    return np.stack(np.meshgrid(left + part * (right - left), bottom + part * (top - bottom)), axis=-1)


def _cells_in_box(size: int, box: Box) -> NDArray[np.bool_]:
    return np.hypot(*np.moveaxis(_centres(size, box), -1, 0)) < 1.0


def _border_cells(cells: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Cells with a neighbour, across an edge or a corner, of another kind; the outside is no kind."""
    padded = np.pad(cells, 1, constant_values=OUTSIDE)
    size = len(cells)
    found = np.zeros_like(cells, bool)
    for i in (0, 1, 2):
        for j in (0, 1, 2):
            other = padded[i : i + size, j : j + size]
            found |= (other != cells) & (other != OUTSIDE) & (cells != OUTSIDE)
    return found
