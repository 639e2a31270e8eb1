"""The plane of f in the frames: curves with each change of A, regions when nothing moves."""

import time

import numpy as np
import pytest
from codim2_app.panels.parameters import atlas, atlas_columns
from codim2_app.picture.draw.packing import INT16_STEP, unpack
from codim2_app.picture.frame.process_load import Load
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2
from codim2_core import bifurcations

from ..opening import settled

MATRICES = [(-2, 0, -1), (1, 0.3, -1), (172, 186, -200), (-1, 1, -1), (-0.3, 0, -1), (-1, 0.2, -2)]
DEGENERATE = [(0, 0, 0), (1, 0, 1), (1, 0, 0), (0, 0, -1), (1, 1, -1), (-1, 0, 1e-9), (0, 2, 0), (1e-300, 0, 0)]


@pytest.fixture
def frames(monkeypatch):
    monkeypatch.setattr(atlas, "load", Load())  # measured by nobody, so that it has time
    made = Frames(ExplorerState())
    made.answer({"all": True})
    return made


def atlas_of(frames, rest=False, **values):
    header, blocks = unpack(frames.answer({"id": 1, "set": values, "rest": rest}))
    assert header["errors"] == {}
    names = {name.split(".")[0] for name in blocks} & {"saddle_node", "transcritical", "regions"}
    return header, blocks, names


def lines(blocks, name, size):
    points = blocks[f"{name}.xy"].reshape(-1, 2) * INT16_STEP * size
    return np.split(points, np.cumsum(blocks[f"{name}.n"], dtype=int)[:-1])


def test_curves_go_with_the_matrix_and_regions_at_rest(frames):
    header, _, names = atlas_of(frames, a=-1.7)
    assert names == {"saddle_node", "transcritical"}
    assert "regions" in header["late"]
    assert frames.scene.runs["regions"] == 1  # of the first frame
    header, _, names = atlas_of(frames, rest=True)
    assert names == {"regions"}
    assert "regions" not in header.get("late", [])
    header, _, names = atlas_of(frames, rest=True)
    assert names == set()
    assert "regions" not in header.get("late", [])


def test_of_a_drag_each_third_frame_brings_curves_and_the_one_at_rest_all(frames):
    """They were a quarter of the work of each."""
    drag = [atlas_of(frames, a=-1.7 - 0.01 * i) for i in range(8)]
    assert [bool(names) for _, _, names in drag] == [True, False, False] * 2 + [True, False]
    assert all("regions" in header["late"] for header, _, _ in drag)
    header, _, names = atlas_of(frames, rest=True)
    assert names == {"saddle_node", "transcritical", "regions"}
    assert "regions" not in header.get("late", [])


def test_of_a_drag_in_a_busy_process_only_the_frame_at_rest_brings_curves(frames):
    atlas.load.share = 0.9
    assert not any(atlas_of(frames, a=-1.7 - 0.01 * i)[2] for i in range(8))
    assert atlas_of(frames, rest=True)[2] == {"saddle_node", "transcritical", "regions"}


@pytest.mark.parametrize(
    "change", [{"f1": 0.3}, {"f2": 0.3}, {"z": 0.5}, {"k1": 0.2}, {"psi": "rational"}, {"B1": 2.0}]
)
def test_what_is_no_matrix_sends_no_atlas(frames, change):
    runs = dict(frames.scene.runs)
    assert atlas_of(frames, rest=True, **change)[2] == set()
    assert {name: frames.scene.runs[name] for name in ("atlas_curves", "regions")} == {
        name: runs[name] for name in ("atlas_curves", "regions")
    }


def test_going_back_at_once_leaves_the_regions_that_the_browser_has(frames):
    atlas_of(frames, a=-1.7)
    atlas_of(frames, a=-2.0)
    header, _, names = atlas_of(frames, rest=True)
    assert names == {"saddle_node", "transcritical"}
    assert "regions" not in header.get("late", [])


def test_a_value_that_is_refused_does_not_keep_the_regions_back(frames):
    atlas_of(frames, a=-1.7)
    header, blocks = unpack(frames.answer({"id": 1, "set": {"psi": "custom", "psi_text": "1/(s"}, "rest": True}))
    assert list(header["errors"]) == ["psi_text"]
    assert "regions.xy" in blocks


def test_a_locked_matrix_has_no_pad_and_no_atlas():
    frames = Frames(ExplorerState(), c2.ELinear(-1, "0.1*z1", -2, (0.2, 0.3), B=((1, 0),), g=("z1",)))
    _, _, names = atlas_of(frames, rest=True)
    assert names == set()
    assert "atlas_curves" not in frames.scene.runs
    assert "regions" not in frames.scene.runs


@pytest.mark.parametrize("matrix", MATRICES)
def test_columns_are_the_regions_of_the_core(frames, matrix):
    a, b, d = matrix
    header, blocks = unpack(frames.answer({"all": True, "set": {"a": a, "b": b, "d": d}}))
    columns, expected = header["regions"], bifurcations.regions(c2.ELinear(a, b, d))
    assert columns["name"] == [region.name for region in expected]
    assert columns["bounded"] == [region.bounded for region in expected]
    assert columns["loops"] == [len(region.boundary) for region in expected]
    np.testing.assert_allclose(np.array(columns["inside"]) * columns["size"], [r.inside for r in expected],
                               atol=1e-4 * columns["size"])  # fmt: skip
    sent = lines(blocks, "regions", columns["size"])
    loops = [loop for region in expected for loop in region.boundary]
    assert len(sent) == len(loops)
    for few, many in zip(sent, loops, strict=True):
        assert furthest(many, np.concatenate([few, few[:1]])) < 0.002 * columns["size"]  # 0.3 px of 350
    mine = [
        block for name, block in blocks.items() if name.split(".")[0] in ("regions", "saddle_node", "transcritical")
    ]
    size = sum(block.nbytes for block in mine)
    assert size + len(str(columns)) < 6000


@pytest.mark.parametrize("matrix", MATRICES)
def test_curves_are_those_of_the_core(frames, matrix):
    a, b, d = matrix
    header, blocks, _ = atlas_of(frames, a=a + 0.0, b=b, d=d - 1e-3)
    d = d - 1e-3
    for name, curve in (("saddle_node", bifurcations.saddle_node(c2.ELinear(a, b, d))),
                        ("transcritical", bifurcations.critical_boundary(c2.ELinear(a, b, d)))):  # fmt: skip
        for few, many in zip(lines(blocks, name, header["atlas_size"]), curve.branches, strict=True):
            assert furthest(many, few) < 0.002 * header["atlas_size"]


@pytest.mark.parametrize("matrix", DEGENERATE)
def test_degenerate_matrices_are_drawn(frames, matrix):
    header, _, names = atlas_of(frames, rest=True, **dict(zip("abd", matrix, strict=True)))
    assert names == {"saddle_node", "transcritical", "regions"}
    assert header["regions"]["name"]


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
