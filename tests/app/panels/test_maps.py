"""The panel of maps over two parameters, with small portraits of their regions."""

import pytest
from codim2_app.picture.draw.thumbnails import thumbnails
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.refresh import Frames

import codim2_core as c2

from .opening import CASE3, ask, opened, settled


def test_the_atlas_of_two_slow_variables_has_the_disc_in_which_the_ball_sticks():
    frames = Frames(ExplorerState.from_values({"system": "ball_in_pool", "panel": "atlas"}))
    header = settled(frames, all=True, rest=True)
    assert header["atlas_of"] == ["z", "z2", False]
    assert set(header["map"]["name"]) == {"CM2, stable node", "NCM2"}


def test_each_region_has_a_small_portrait_of_its_own():
    _, header = opened("atlas")
    tiles = header["thumbnails"]
    assert [tile[1] for tile in tiles] == header["map"]["name"]
    assert [tile[0] for tile in tiles] == list(range(len(tiles)))
    for _, name, (f1, f2), svg in tiles:
        assert c2.classify(c2.ELinear(-2, 0, -1, (f1, f2)), c2.psi.constant()).name == name.split(",")[0]
        assert svg.startswith("<svg")
        assert len(svg) < 8000
        assert "NaN" not in svg


MAPS = [("a", "d", {}), ("z", "b", {}), ("n", "f1", CASE3), ("f2", "f1", {})]


@pytest.mark.parametrize(("across", "up", "values"), MAPS)
def test_any_two_parameters_make_a_map(across, up, values):
    frames, header = opened("atlas", across=across, up=up, **values)
    found = header["map"]
    assert header["atlas_of"] == [across, up, False]
    for axis, (low, high) in zip((across, up), found["spans"], strict=True):
        assert low <= frames.values[axis] <= high
    assert sum(found["loops"]) >= len(found["name"]) > 1
    own = {"a": -2.0, "b": 0.0, "d": -1.0, "f1": -0.5, "f2": 0.0, **values}
    for name, place in zip(found["name"], found["inside"], strict=True):
        at = {**own, "k1": 0.5, "z": 0.0, **dict(zip((across, up), place, strict=True))}
        system = c2.ELinear(at["a"], at["b"], at["d"], (at["f1"] + at["k1"] * at["z"], at["f2"]))
        portrait = c2.classify(system, c2.psi.hill(at["n"]) if "n" in at else c2.psi.constant())
        assert name.split(",")[0] == portrait.name
    assert {tile[0] for tile in header["thumbnails"]} <= set(range(len(found["name"])))
    for region, name, place, _ in header["thumbnails"]:
        assert (name, place) == (found["name"][region], found["inside"][region])


def test_moving_along_the_axes_of_a_map_asks_for_no_new_one():
    frames, _ = opened("atlas", across="a", up="d")
    for change in ({"a": 1.0}, {"d": 2.0}, {"a": -3.9, "d": 3.9}, {"B1": 2.0}):
        assert "late" not in ask(frames, **change), change
    assert set(ask(frames, b=0.1)["late"]) == {"map"}


def test_a_part_of_the_plane_of_f_is_mapped():
    frames, header = opened("atlas", atlas_zoom=2)
    assert header["atlas_of"] == ["f1", "f2", True]
    (left, right), (low, high) = header["map"]["spans"]
    assert right - left == high - low == pytest.approx(6 / 16)
    assert left < -0.5 < right
    assert "late" not in ask(frames, f1=-0.45)  # well inside still
    assert "map" in ask(frames, f1=1.0)["late"]
    assert "map" in ask(frames, atlas_zoom=0)["late"]


def test_axes_that_make_no_map_are_said():
    assert "two different" in opened("atlas", across="a", up="a")[1]["unable"]["map"]
    assert "3/(3 + (4s)ⁿ)" in opened("atlas", across="n", up="a")[1]["unable"]["map"]


def test_thumbnails_are_marked_as_the_portrait():
    system = c2.ELinear(-2, 0, -1).at()
    ((_, _, _, svg),) = thumbnails(system, c2.psi.constant(), (), ("f1", "f2"), [(0, "CM4", (0.0, 0.0))])
    assert svg.count('stroke="var(--attr)"') == 4
    assert svg.count('stroke="var(--crit)" stroke-width="4" fill="var(--crit)"') == 1
