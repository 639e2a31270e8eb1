"""The panel "Atlas" in the frames: the plane of f(z), maps of typed equations, strips."""

import time

import numpy as np
import pytest
from codim2_app.panels.parameters import atlas_columns
from codim2_app.picture.draw.packing import INT16_STEP, unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2
from codim2_core import bifurcations

from ..opening import settled

MATRICES = [(-2, 0, -1), (1, 0.3, -1), (172, 186, -200), (-1, 1, -1), (-0.3, 0, -1), (-1, 0.2, -2)]
DEGENERATE = [(0, 0, 0), (1, 0, 1), (1, 0, 0), (0, 0, -1), (1, 1, -1), (-1, 0, 1e-9), (0, 2, 0), (1e-300, 0, 0)]


def settled_map(**values):
    """The whole map of f of an opening with some values, and its blocks."""
    frames = Frames(ExplorerState.from_values({"panel": "atlas", **values}))
    request, found = {"all": True}, {}
    while True:
        header, blocks = unpack(frames.answer(request))
        assert header["errors"] == {}
        if "map" in header:
            found = header["map"], blocks
        if not set(header.get("late", [])) & {"map", "map regions"}:
            return frames, *found
        request = {"rest": True}
        time.sleep(0.01)


def lines(blocks, name, size):
    points = blocks[f"{name}.xy"].reshape(-1, 2) * INT16_STEP * size
    return np.split(points, np.cumsum(blocks[f"{name}.n"], dtype=int)[:-1])


@pytest.mark.parametrize("change", [{"f1": 0.3}, {"f2": 0.3}, {"z": 0.5}, {"k1": 0.2}, {"B1": 2.0}])
def test_what_moves_f_of_z_asks_for_no_other_map(change):
    frames, *_ = settled_map()
    header = unpack(frames.answer({"rest": True, "set": change}))[0]
    assert "map" not in header
    assert not {"map", "map regions"} & set(header.get("late", []))


@pytest.mark.parametrize("values", [{"f1": 7.0}, {"k1": 2.0, "z": 3.0}])
def test_the_plane_of_f_holds_f_and_f_of_z(values):
    frames, columns, _ = settled_map(**values)
    at = frames.scene.coefficients
    for (low, high), f, fz in zip(columns["spans"], (frames.values["f1"], frames.values["f2"]), at.f, strict=True):
        assert low < min(f, fz) <= max(f, fz) < high


@pytest.mark.parametrize("matrix", MATRICES)
def test_curves_and_regions_of_the_plane_are_those_of_the_core(matrix):
    _, columns, blocks = settled_map(**dict(zip("abd", matrix, strict=True)))
    (_, reach), _ = columns["spans"]
    system = c2.ELinear(*matrix)
    sent = [one for kind, one in zip(columns["curve"], lines(blocks, "map_curves", reach), strict=True)
            if kind == "saddle-node"]  # fmt: skip
    for curve in bifurcations.saddle_node(system).branches:
        nearest = [min(furthest(curve[i : i + 1], line) for line in sent) for i in range(0, len(curve), 7)]
        assert max(nearest) < 0.004 * reach
    for name, place in zip(columns["name"], columns["inside"], strict=True):
        assert name.split(",")[0] == c2.classify(c2.ELinear(*matrix, place), c2.psi.constant()).name
    names = {region.name for region in bifurcations.regions(system)}
    assert {name.split(",")[0] for name in columns["name"]} == names


@pytest.mark.parametrize("matrix", DEGENERATE)
def test_degenerate_matrices_are_drawn(matrix):
    _, columns, _ = settled_map(**dict(zip("abd", matrix, strict=True)))
    assert columns["name"] or columns["note"]


def test_a_locked_matrix_has_a_map_at_its_z():
    frames = Frames(ExplorerState(), c2.ELinear(-1, "0.1*z1", -2, (0.2, 0.3), B=((1, 0),), g=("z1",)))
    header = unpack(frames.answer({"all": True, "set": {"panel": "atlas"}}))[0]
    assert header["atlas_of"][-1] is False


def furthest(points, line):
    """The largest distance of points (n, 2) from a polyline (k, 2)."""
    if len(line) == 1:
        return float(np.hypot(*(points - line).T).max())
    start, step = line[:-1], np.diff(line, axis=0)
    squared = np.maximum((step**2).sum(1), 1e-300)
    share = np.clip(((points[:, None] - start) * step).sum(2) / squared, 0, 1)
    gap = points[:, None] - start - share[..., None] * step
    return float(np.hypot(gap[..., 0], gap[..., 1]).min(1).max())


EQUATIONS = {"U1": "2*c^2 - c - mu", "U2": "-s + k*c*s", "W": "", "where": "mu = 0.5 in [-1, 1]\nk = 0.3 in [-1, 1]"}


def test_equations_typed_whole_have_their_curves_first_and_then_their_regions():
    frames = Frames(ExplorerState.from_values({"system": "own", "texts": EQUATIONS, "panel": "atlas"}))
    maps, late, tiles = [], ["map"], []
    request = {"all": True}
    while late:
        header, blocks = unpack(frames.answer(request))
        late, request = header.get("late", []), {"rest": True}
        if "map" in header:
            maps.append((header["map"], lines(blocks, "map_curves", 1.0)))
            assert "map" not in late  # what there is is not old
        tiles = header.get("thumbnails", tiles)
        time.sleep(0.01)
    (first, _), (last, curves) = maps[0], maps[-1]
    assert first["name"] == [] or len(maps) == 1  # the regions may be there before the browser asks again
    system = c2.System(U=("2*c^2 - c - mu", "-s + k*c*s"), parameters={"mu": 0.5, "k": 0.3})
    whole = c2.atlas(system, c2.psi.constant(), {"mu": (-1, 1), "k": (-1, 1)})
    assert first["curve"] == last["curve"] == [one.kind for one in whole.curves]
    for line, one in zip(curves, whole.curves, strict=True):
        assert furthest(one.points, line) < 2e-3
    assert [(kind, [x, y], says) for kind, x, y, says in last["points"]] == [
        (one.kind, pytest.approx(list(one.place)), one.sentence) for one in whole.points
    ]
    assert last["spans"] == [[-1.0, 1.0], [-1.0, 1.0]]
    assert {"2CM6, saddle, stable node; 5 arrive, 1 leaves", "NCM2; 1 arrives, 1 leaves"} <= set(last["name"])
    assert [tile[1] for tile in tiles] == [atlas_columns.short(name) for name in last["name"]]
    # moving along its axes asks for no other map
    assert "late" not in unpack(frames.answer({"set": {"parameters": {"mu": 0.4}}}))[0]
    assert "map" in unpack(frames.answer({"set": {"texts": {**EQUATIONS, "U2": "-s - k*c*s"}}}))[0]["late"]


def test_an_atlas_of_values_that_have_moved_is_not_waited_for():
    frames = Frames(ExplorerState.from_values({"system": "own", "texts": EQUATIONS, "panel": "atlas"}))
    unpack(frames.answer({"all": True, "rest": True}))
    before = frames.jobs.future("map")
    unpack(frames.answer({"rest": True, "set": {"texts": {**EQUATIONS, "U2": "-s - k*c*s"}}}))
    assert frames.jobs.future("map") is not before
    settled(frames, rest=True)


@pytest.mark.parametrize(
    ("texts", "axis"),
    [({**EQUATIONS, "U2": "-s", "where": "mu = 0.5 in [-1, 1]"}, "own:mu"), ({"U1": "c^2 - z", "U2": "-s"}, "z")],
)
def test_one_parameter_has_a_strip_and_none_says_what_to_do(texts, axis):
    frames = Frames(ExplorerState.from_values({"system": "own", "texts": texts, "panel": "atlas"}))
    header = settled(frames, all=True)
    assert header["atlas_of"] == [axis, "", False]
    assert header["map"]["spans"][1] == [0.0, 1.0]
    assert len(header["thumbnails"]) == len(header["map"]["name"]) > 1
    assert "plane" in header["map"]["note"]
    header = settled(frames, set={"texts": {"U1": "c^2 - 1/4", "U2": "-s", "W": "", "where": ""}})
    assert "parameter" in header["unable"]["map"]


@pytest.mark.parametrize(
    ("matrix", "possible"), [((-2, 0, -1), False), ((1, 0.3, -1), False), ((172, 186, -200), True)]
)
def test_bifurcations_of_cycles_are_offered_in_case_three_only(matrix, possible):
    frames = Frames(ExplorerState.from_values({"panel": "atlas", **dict(zip("abd", matrix, strict=True))}))
    assert unpack(frames.answer({"all": True}))[0]["cycles_possible"] is possible
