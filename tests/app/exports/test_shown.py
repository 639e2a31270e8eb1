"""Every public result shows itself in a notebook: what public functions are annotated with, and what they return."""

import re
from base64 import b64encode
from functools import cache
from xml.etree import ElementTree

import numpy as np
import pytest

import codim2_core as c2
from codim2_core import bifurcations
from codim2_core.bifurcations.diagrams.eigenvalue_path import linearisation_path
from codim2_core.results.tables import table_number

ONE = c2.psi.constant()
FOUR = c2.ELinear(-2, 0, -1, (-0.5, 0), B=((1, 0),), g=(0.25,))
SADDLE = c2.ELinear(1.0, 0.3, -1.2, (0.2, 0.45))
SPIRAL = c2.ELinear(-1, 1, -1, (0, 0))
CYCLE = c2.presets["case3-n3"]
TWO = c2.examples.nonunique_sliding()
RING = c2.System(U=("-y + x*(1 - x**2 - y**2)", "x + y*(1 - x**2 - y**2)"))
TURNING = c2.System(U=("z*c - s", "c + z*s"), W=("1",))
UNSTEADY = c2.ELinear(-1, 0, -1, ("z", 0), B=((0, 0),), g=(0.25,))

BLOCKS = c2.mechanics.contacts(
    np.eye(4).tolist(), [(((1, 0, 0, 0), (0, 1, 0, 0)), 0.3, 10), (((0, 0, 1, 0), (0, 0, 0, 1)), 0.3, 10)],
    ("4*q", 0, "5 - 4*q", 0), ("u1", "v1", "u2", "v2"), {"q": "u2 - u1"},
)  # fmt: skip

#: What stands in a notebook's cell, and what must be read in it.
#: A mass that is driven round.
DRIVEN = c2.System(U=("-z1 - S*c + cos(2*z3)", "-z2 - S*s + sin(2*z3)"), W=("x", "y", "1"), parameters={"S": 0.5})
RESULTS = {
    "approach_outcomes": lambda: c2.approach_outcomes(FOUR, ONE),
    "basins": lambda: c2.basins(TWO, ONE, 0.0, n=64),
    "basins, nearer": lambda: c2.basins(TWO, ONE, 0.0, n=32, box=(0.0, 0.5, 0.0, 0.5)),
    "branches": lambda: c2.branches(CYCLE.system, CYCLE.psi, "n", (2.5, 3.5)),
    "compare_laws": lambda: c2.compare_laws(
        CYCLE.system, {"sap": (c2.psi.engine("sap"), 1e-3), "ipc": (c2.psi.engine("ipc"), 1e-3)}
    ),
    "census": lambda: c2.census(count=5000),
    "certificates": lambda: c2.certificates(FOUR, ONE),
    "classify": lambda: c2.classify(FOUR, ONE),
    "critical_sets": lambda: c2.critical_sets(TWO, ONE, 0.0),
    "delays": lambda: c2.delays(TURNING, ONE, (-0.6,), {"z1": (-1, 1)}),
    "equator_cycle": lambda: c2.equator_cycle(SPIRAL),
    "equator_equilibria": lambda: c2.equator_equilibria(FOUR),
    "filippov_sliding": lambda: c2.filippov_sliding(TWO, 0.0),
    "limit_cycles": lambda: c2.limit_cycles(CYCLE.system, CYCLE.psi),
    "nullclines": lambda: c2.nullclines(FOUR, ONE),
    "prove_portrait": lambda: c2.prove_portrait(FOUR, ONE),
    "periodic_motion": lambda: c2.periodic_motion(RING, (0.9, 0.1), 6.0),
    "lyapunov_exponents": lambda: c2.lyapunov_exponents(
        DRIVEN, (0.0, -0.55, -0.28, 0.07, 0.0), np.pi, count=16, transient=0
    ),
    "response_curve": lambda: c2.response_curve(DRIVEN, (0.0, -0.55, -0.28, 0.07, 0.0), np.pi, "S", (0.49, 0.51)),
    "separatrices": lambda: c2.separatrices(SADDLE, ONE),
    "simulate": lambda: c2.simulate(SPIRAL, ONE, (0.5, 0.2), (0, 3), eps=0.1),
    "simulate_nonsmooth": lambda: c2.simulate_nonsmooth(FOUR, (0.5, 0.2, 0.0), (0, 3)),
    "slow_portrait": lambda: c2.slow_portrait(UNSTEADY, ONE, "z1", (-2, 2)),
    "variation": lambda: c2.simulate_nonsmooth(FOUR, (0.5, 0.2, 0.0), (0, 3)).variation("a"),
    "trajectories": lambda: c2.trajectories(FOUR, ONE, [(0.1, 0.2), (1.2, 0.3)]),
    "scene": lambda: c2.Scene(FOUR),
    "launched": lambda: c2.Scene(FOUR, launch=[(0.1, 0.2), (1.2, 0.3)])["launched"],
    "preset": lambda: CYCLE,
    "psi": lambda: c2.psi.hill(3),
    "psi.check": lambda: c2.psi.hill(3).check(),
    "bifurcations.closed_equator": lambda: bifurcations.closed_equator(c2.ELinear(-1, 2, 1)),
    "bifurcations.critical_boundary": lambda: bifurcations.critical_boundary(c2.ELinear(-2, 0.5, -1)),
    "bifurcations.hill_changes": lambda: bifurcations.hill_changes(CYCLE.system),
    "bifurcations.hopf": lambda: bifurcations.hopf(c2.ELinear(CYCLE.a, CYCLE.b, CYCLE.d), CYCLE.psi),
    "bifurcations.regions": lambda: bifurcations.regions(c2.ELinear(-2, 0.5, -1)),
    "bifurcations.saddle_node": lambda: bifurcations.saddle_node(c2.ELinear(-2, 0.5, -1)),
    "atlas": lambda: c2.atlas(SADDLE, ONE, {"f1": (-2, 2), "f2": (-2, 2)}),
    "mechanics.contacts": lambda: BLOCKS,
    "contacts at a state": lambda: BLOCKS.decide((0, 0, 0, 0, 0)),
    "motion of contacts": lambda: BLOCKS.simulate_nonsmooth((0, 0, 0, 0, 0), (0, 2)),
    "cycles of branches": lambda: c2.branches(CYCLE.system, CYCLE.psi, "n", (2.5, 3.5)).cycles,
    "linearisation_path": lambda: linearisation_path(CYCLE.system, CYCLE.psi, "n", np.linspace(1.0, 4.0, 31)),
}
PICTURED = {
    "atlas", "basins", "basins, nearer", "branches", "cycles of branches", "launched", "limit_cycles",
    "linearisation_path", "motion of contacts", "nullclines", "periodic_motion", "preset", "psi", "response_curve",
    "scene", "separatrices", "simulate", "simulate_nonsmooth", "slow_portrait", "trajectories",
    "bifurcations.closed_equator", "bifurcations.critical_boundary", "bifurcations.hopf", "bifurcations.regions",
    "bifurcations.saddle_node",
}  # fmt: skip


@cache
def result_of(key):
    """Return a result, which nobody can change: made once for all that looks at it."""
    return RESULTS[key]()


def cells(shown):
    """Texts of the cells of all tables, a row each; the HTML is well-formed."""
    root = ElementTree.fromstring(f"<div>{shown}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


@pytest.mark.parametrize("name", RESULTS)
def test_a_result_shows_itself_in_little(name):
    result = result_of(name)
    shown = result._repr_html_()
    rows = cells(shown)
    assert len(shown) < 50_000
    assert not re.search(r"\bnan\b|var\(--|object at 0x|array\(", shown)
    assert rows or "<p>" in shown or "<img" in shown
    assert ("<img" in shown) == (name in PICTURED)
    if name in PICTURED:
        picture = result._repr_svg_()
        assert b64encode(picture.encode()).decode() in shown
        assert "<path" in picture
    if isinstance(result, tuple):
        assert len(rows) == 1 + len(result)
        assert type(result)(result) == result == tuple(result)


@pytest.mark.parametrize("name", ["critical_sets", "nullclines", "bifurcations.regions", "bifurcations.hill_changes"])
def test_nothing_found_shows_itself_too(name):
    assert cells(type(result_of(name))()._repr_html_()) == []


def test_numbers_are_those_of_the_result():
    found = c2.basins(TWO, ONE, 0.0, n=64)
    _, *rows = cells(found._repr_html_())
    assert [row[0] for row in rows] == list(found.destinations)
    for i, row in enumerate(rows):
        assert row[1] == table_number((found.cells == i).sum() / (found.cells != -2).sum())
    counted = c2.census(count=5000)
    _, *rows = cells(counted._repr_html_())
    assert [(row[0], row[1]) for row in rows] == [(one.name, f"{one.count:,}") for one in counted.table]
    moved = result_of("variation")
    head, *rows = cells(moved._repr_html_())
    assert head[1:] == ["∂/∂x", "∂/∂y", "∂/∂z1", "∂/∂a"]
    assert rows == [
        [name, *map(table_number, row)] for name, row in zip(("x", "y", "z1"), moved.last.tolist(), strict=True)
    ]
    along = c2.slow_portrait(UNSTEADY, ONE, "z1", (-2, 2))
    rows = cells(along._repr_html_())
    assert [row[0] for row in rows if row[0] == "equator"] == [p.kind for p in along.points if p.kind == "equator"]
    assert [table_number(one.low) for one in along.intervals] == [row[0] for row in rows[1 : 1 + len(along.intervals)]]


def test_areas_of_an_atlas_lie_where_the_regions_lie():
    found = result_of("atlas")
    shown = found._repr_svg_()
    areas = re.findall(r'<path d="([^"]*)" fill="([^"]*)"', shown)
    assert len(areas) == len(found.regions)
    for (path, _), region in zip(areas, found.regions, strict=True):
        points = np.array([[float(v) for v in pair.split()] for pair in re.findall(r"[\d.]+ [\d.]+", path)])
        x, y = (points[:, 0] - 44) / 308 * 4 - 2, (8 + 308 - points[:, 1]) / 308 * 4 - 2
        every, drawn = np.concatenate(region.boundary), np.column_stack([x, y])
        assert np.allclose([drawn.min(0), drawn.max(0)], [every.min(0), every.max(0)], atol=0.05)
