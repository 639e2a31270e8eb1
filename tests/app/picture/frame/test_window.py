import numpy as np
import pytest
from codim2_app.picture.draw.glyphs import join
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.draw.theme import PICTURE_REACH
from codim2_app.picture.frame.window import MOVING_PIXEL, Window, inputs
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames
from hypothesis import given
from hypothesis import strategies as st

from tests.app.near import gaps

NEAR = [-0.35, -0.15, 0.0, 0.2, 0.2 / 700]
WIDE = [-8.0, 8.0, -8.0, 8.0, 16 / 700]


@pytest.mark.parametrize(
    "value",
    [None, "x", [1, 2], [0, 1, 0, "x", 1], [0, np.nan, 0, 1, 1], [1, 0, 0, 1, 1], [-500, 500, -500, 500, 1],
     [0, 1e-9, 0, 1, 1], [1e9, 1e9 + 1, 0, 1, 1]],
)  # fmt: skip
def test_what_no_tool_can_show_is_no_window(value):
    assert Window.read(value) is None


def test_the_whole_picture_is_as_without_a_window():
    scene = Frames(ExplorerState()).scene
    assert {name: getattr(scene, name) for name in inputs(None, rest=True)} == inputs(None, rest=True)


def test_what_is_seen_is_in_reach_and_at_rest_as_fine_as_the_screen():
    near, wide = Window.read(NEAR), Window.read(WIDE)
    assert inputs(near, rest=True)["pixel"] == pytest.approx(NEAR[4], rel=0.2)
    assert inputs(near, rest=False)["pixel"] == MOVING_PIXEL
    assert inputs(near, rest=True)["view"] == PICTURE_REACH
    assert inputs(wide, rest=True)["view"] > np.hypot(8, 8)
    assert inputs(wide, rest=False)["pixel"] > MOVING_PIXEL


@given(st.lists(st.integers(0, 12), max_size=5), st.integers(0, 9))
def test_a_cut_keeps_all_that_is_seen_and_joins_nothing(sizes, seed):
    random = np.random.default_rng(seed)
    pieces = [random.uniform(-1, 1, (size, 2)) for size in sizes]
    window = Window.read([-0.2, 0.3, 0.1, 0.6, 0.001])
    offsets, points, of = window.clip_curves(*join(pieces))

    def steps(found):
        joined = [np.column_stack([piece[:-1], piece[1:]]).tolist() for piece in found]
        return {tuple(step) for piece in joined for step in piece}

    whole = [{tuple(point) for point in piece.tolist()} for piece in pieces]
    cuts = np.split(points, offsets[1:-1]) if len(points) else []
    assert all({tuple(p) for p in cut.tolist()} <= whole[i] for cut, i in zip(cuts, of, strict=False))
    kept = steps(cuts)
    assert kept <= steps(pieces)
    for x, y, u, v in steps(pieces) - kept:  # no point of what is left out lies in the window
        for share in np.linspace(0, 1, 30):
            at = x + share * (u - x), y + share * (v - y)
            assert not (-0.2 <= at[0] <= 0.3 and 0.1 <= at[1] <= 0.6)


def lines(buffer):
    header, blocks = unpack(buffer)
    scale = 1 if header.get("exact") else 4 / 32767
    counts = blocks["inside.n"].tolist(), blocks["outside.n"].tolist()
    return header, counts, {name: blocks[f"{name}.xy"].reshape(-1, 2) * scale for name in ("inside", "outside")}


def test_zooming_out_shows_orbits_beyond_the_first_square():
    frames = Frames(ExplorerState())
    frames.answer({"all": True})
    _, _, found = lines(frames.answer({"id": 1, "rest": True, "window": WIDE}))
    assert np.abs(found["outside"]).max() > 7.5
    quadrants = {tuple(v) for v in np.sign(found["outside"][np.abs(found["outside"]).max(axis=1) > 5])}
    assert len(quadrants) == 4


def test_zooming_in_refines_at_rest_and_sends_only_what_is_seen():
    frames = Frames(ExplorerState())
    frames.answer({"all": True})
    moving = frames.answer({"id": 1, "set": {"f1": -0.45}, "window": NEAR})
    header, _, coarse = lines(moving)
    assert "window" in header["late"]
    header, (counts, _), fine = lines(frames.answer({"id": 2, "rest": True, "window": NEAR}))
    assert "window" not in header.get("late", [])
    inside = fine["inside"]
    assert len(counts) > 10

    def seen(p):
        return ((p >= (-0.35, 0.0)) & (p <= (-0.15, 0.2))).all(axis=1).sum()

    assert seen(inside) > 2 * seen(coarse["inside"])
    assert len(moving) < 60_000
    assert unpack(frames.answer({"id": 3, "rest": True, "window": NEAR}))[1] == {}
    header, _, whole = lines(frames.answer({"id": 4, "rest": True}))
    assert "exact" not in header
    assert np.abs(whole["inside"]).max() > 0.9


def test_an_orbit_that_is_seen_from_near_lies_where_it_does_from_far():
    frames = Frames(ExplorerState())
    _, _, far = lines(frames.answer({"all": True}))
    _, _, near = lines(frames.answer({"id": 1, "rest": True, "window": NEAR}))
    [point] = near["inside"][np.argmin(np.hypot(*(near["inside"] - (-0.25, 0.1)).T))][None]
    assert gaps(point[None], frames.scene["inside"].points) < 1e-6
    assert far["inside"].shape != near["inside"].shape


def test_each_piece_is_told_whose_it_is_also_where_a_zoom_cuts_it():
    values = {"layers": ["lines", "launched", "separatrices"], "orbits": "0.3,0.2;0.1,0.1,-:b;1.3,0.2:slow"}
    frames = Frames(ExplorerState(trajectories=0, panel="psi", **values))
    header, _ = unpack(frames.answer({"all": True}))
    assert (header["owners"]["lines_inside"], header["owners"]["launched_2"]) == (["U1", "U2"], ["O2"])
    assert (header["launched"]["number"], header["launched"]["called"]) == ([1, 3], ["", "slow"])
    assert [row[:2] for row in header["separatrices"]][:2] == [["Q₂", "C"], ["Q₄", "C"]]
    near, blocks = unpack(frames.answer({"id": 1, "rest": True, "window": [-0.9, -0.1, -0.4, 0.4, 0.001]}))
    assert set(near["owners"]["lines_inside"]) == {"U1", "U2"}
    for part, names in near["owners"].items():
        assert len(names) == len(blocks[f"{part}.n"])
