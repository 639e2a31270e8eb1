"""Data of all that is drawn, as tables: columns in the field's words, each with its unit and its meaning."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from codim2_core.scene import Scene

from ..picture.draw import glyphs
from ..picture.draw.layers import Part, default_layers, layers_in_paint_order
from ..picture.slow_layers import basins, outcomes

#: Columns of a curve of the picture.
PLACE_COLUMNS = {
    "curve": ("", "number of the curve, from 0"),
    "px": ("1", "first coordinate in the picture: p₁ on the hemisphere, (1 + ρ) cos θ outside"),
    "py": ("1", "second coordinate in the picture: p₂ on the hemisphere, (1 + ρ) sin θ outside"),
}
DIRECTION_COLUMNS = {
    "label": ("", "name in the picture"),
    "theta": ("rad", "angle θ of the limit direction"),
    "lambda_rho": ("1/T", "eigenvalue λ_ρ along ρ, of the time T with dT = dt/|(x, y)|"),
    "lambda_theta": ("1/T", "eigenvalue λ_θ along θ"),
    "multiplicity": ("", "of the zero of Θ"),
    "type": ("", "what attracts and what repels"),
}
CRITICAL = {
    "label": ("", "name in the picture"),
    "c": ("1", "first component of e = (c, s)"),
    "s": ("1", "second component of e"),
    "x2": ("1", "x/ε there"),
    "y2": ("1", "y/ε there"),
    "px": ("1", "first coordinate in the picture"),
    "py": ("1", "second coordinate in the picture"),
    "kind": ("", "of the linearisation J"),
    "trace": ("1/τ", "tr J, of the fast time τ with dt = ε dτ"),
    "determinant": ("1/τ²", "det J"),
    "discriminant": ("1/τ²", "(tr J)² − 4 det J"),
    "eigenvalue1_re": ("1/τ", "first eigenvalue of J"),
    "eigenvalue1_im": ("1/τ", "its imaginary part"),
    "eigenvalue2_re": ("1/τ", "second eigenvalue of J"),
    "eigenvalue2_im": ("1/τ", "its imaginary part"),
}
CYCLES = {
    "curve": ("", "number of the curve in the table cycles"),
    "kind": ("", "stable or unstable"),
    "period": ("τ", "of the fast time τ with dt = ε dτ"),
    "multiplier": ("1", "of the return map"),
}
LAUNCHED = {
    "px": ("1", "first coordinate of the start"),
    "py": ("1", "second coordinate of the start"),
    "goes": ("", "where it goes"),
    "comes": ("", "where it comes from"),
}
ARCS = {
    "start": ("rad", "angle of approach at which the arc begins"),
    "end": ("rad", "angle at which it ends"),
    "kind": ("", "what becomes of what approaches there"),
}
BASIN_COLUMNS = {
    "px": ("1", "first coordinate of the middle of a cell"),
    "py": ("1", "second coordinate of the middle of a cell"),
    "destination": ("", "where the orbits from there end; empty if undecided"),
}


@dataclass(frozen=True)
class Table:
    """One table."""

    columns: Mapping[str, tuple[str, str]]
    data: Mapping[str, Any]  # (k,) The same names: numbers, or text

    def __len__(self) -> int:
        return len(next(iter(self.data.values())))


def tables(scene: Scene, layers: Collection[str] | None = None) -> dict[str, Table]:
    """Return all that is drawn of a scene, a table for each layer or part of one; those with no rows are left out.

    Parameters
    ----------
    scene : Scene
    layers : collection of str, optional
        Those that are drawn; default those that the explorer shows at first.
    """
    drawn = default_layers() if layers is None else layers
    found: dict[str, Table] = {}
    if "equator" in drawn:
        found["limit_directions"] = _select_columns(DIRECTION_COLUMNS, glyphs.equator_columns(scene["equator"]))
    if "critical" in drawn:
        found["critical_sets"] = _critical_table(scene)
    for layer in layers_in_paint_order():
        if layer.name in drawn and not (layer.optional and not len(scene.launch)):
            found |= {part.name: _curve_table(part, scene) for part in layer.parts}
    if "cycles" in drawn:
        cycles = glyphs.cycle_columns(scene["closed_orbits"])
        found["limit_cycles"] = _select_columns(CYCLES, {**cycles, "curve": list(range(len(cycles["kind"])))})
    if "launched" in drawn and len(scene.launch):
        launched = glyphs.launched_columns(scene.launch, scene["launched"])
        found["launched"] = _select_columns(LAUNCHED, {**launched, "px": launched["x"], "py": launched["y"]})
    if "outcomes" in drawn:
        found["outcomes"] = _select_columns(ARCS, outcomes.outcome_columns(scene["outcomes"]))
    if "basins" in drawn:
        found["basins"] = _basin_table(scene)
    return {name: table for name, table in found.items() if len(table)}


def data_frames(scene: Scene, layers: Collection[str] | None = None) -> dict[str, Any]:
    """Return the same tables as pandas data frames; units and meanings are in ``frame.attrs``."""
    import pandas

    frames = {}
    for name, table in tables(scene, layers).items():
        frames[name] = pandas.DataFrame(dict(table.data))
        frames[name].attrs.update(columns={column: " ".join(said) for column, said in table.columns.items()})
    return frames


def _select_columns(columns: Mapping[str, tuple[str, str]], data: Mapping[str, Any]) -> Table:
    return Table(columns, {name: np.asarray(data[name]) for name in columns})


def _curve_table(part: Part, scene: Scene) -> Table:
    offsets, points = part.pieces(scene[part.scene])
    sizes = np.diff(offsets).astype(np.intp)  # of 32 bits in a browser
    data = {"curve": np.repeat(np.arange(len(sizes)), sizes), "px": points[:, 0], "py": points[:, 1]}
    return Table(PLACE_COLUMNS, data)


def _critical_table(scene: Scene) -> Table:
    columns = glyphs.critical_columns(scene["critical"])
    count = len(columns["label"])
    pairs = {name: np.asarray(columns[name], float).reshape(count, 2) for name in ("e", "x2")}
    eigenvalues = np.asarray(columns["eigenvalues"], float).reshape(count, 2, 2)
    data = {
        **columns, "c": pairs["e"][:, 0], "s": pairs["e"][:, 1], "x2": pairs["x2"][:, 0], "y2": pairs["x2"][:, 1],
        "px": columns["x"], "py": columns["y"],
        **{f"eigenvalue{i + 1}_{part}": eigenvalues[:, i, j] for i in (0, 1) for j, part in enumerate(("re", "im"))},
    }  # fmt: skip
    flows = columns["slow_flow"]
    slow = {f"slow_flow{j + 1}": [flow[j] for flow in flows] for j in range(len(flows[0]) if flows else 0)}
    said = {name: ("1/t", f"z{name.removeprefix('slow_flow')}′ on the critical set") for name in slow}
    return _select_columns({**CRITICAL, **said}, {**data, **slow})


def _basin_table(scene: Scene) -> Table:
    header, runs = basins.basin_columns(scene)
    cells = header["cells"]
    which = np.repeat(runs[:, 1], runs[:, 0]).astype(int)
    names = np.array(["", "", *header["destinations"]])
    row, column = np.divmod(np.arange(cells * cells), cells)
    inside = which > 0
    px, py = (2 * np.stack((column, row))[:, inside] + 1) / cells - 1  # the middle of each cell
    return Table(BASIN_COLUMNS, {"px": px, "py": py, "destination": names[which[inside]]})


def table_rows(table: Table) -> Iterator[tuple[Any, ...]]:
    """Return the rows of a table as plain values."""
    return zip(*(column.tolist() for column in table.data.values()), strict=True)
