"""C in a visitor's hand: f puts it where it is held."""

import math

import numpy as np
import pytest
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.frame.scenes import make_scene
from codim2_app.picture.state.controls import ExplorerState, first_values
from codim2_app.picture.state.drag_critical_set import MAX_GRAB_RADIUS, push_for
from codim2_app.view.refresh import Frames

import codim2_core as c2

VALUES = {**first_values(), "a": -2.0, "b": 0.7, "d": -1.3, "z": 0.5, "k1": 0.4, "k2": -0.3, "psi": "hill", "n": 3.0}


def held(place, values=VALUES):
    return push_for(make_scene(values), values, place)


@pytest.mark.parametrize("place", [(0.3, -0.5), (-0.7, 0.6), (0.0, 0.0), (0.95, 0.0)])
def test_inside_the_critical_set_is_there(place):
    scene = make_scene({**VALUES, **held(place)})
    ((C),) = c2.critical_sets(scene.system, scene.psi, VALUES["z"])
    assert C.p == pytest.approx(place, abs=1e-3)


@pytest.mark.parametrize("place", [(1.2, 0.5), (-1.0, 0.0), (30.0, 40.0)])
def test_outside_there_is_none_and_e_is_the_place(place):
    scene = make_scene({**VALUES, **held(place)})
    assert c2.critical_sets(scene.system, scene.psi, VALUES["z"]) == ()
    a, b, d, f1, f2 = scene.coefficients.plane
    e = np.linalg.solve([[a, -b], [b, d]], [-f1, -f2])
    r = math.hypot(*place)
    assert e == pytest.approx(np.array(place) * min(1.0, MAX_GRAB_RADIUS / r), abs=1e-3)


@pytest.mark.parametrize("place", [None, "C", [1.0], [1.0, math.nan], [1.0, "x"], {"x": 1}])
def test_what_is_no_place_moves_nothing(place):
    assert held(place) == {}


def test_another_system_is_not_moved():
    assert held((0.1, 0.2), {**VALUES, "system": "own"}) == {}


def test_a_frame_moves_f_and_tells_the_sliders():
    frames = Frames(ExplorerState())
    frames.answer({"all": True})
    header, _ = unpack(frames.answer({"id": 1, "set": {"grab": [0.4, -0.2]}}))
    assert header["set"].keys() - {"cut"} == {"f1", "f2"}
    assert [header["critical"]["x"][0], header["critical"]["y"][0]] == pytest.approx([0.4, -0.2], abs=1e-3)
    frames.publish()
    assert {name: getattr(frames.state, name) for name in header["set"]} == header["set"]
    header, _ = unpack(frames.answer({"id": 2, "set": {"grab": ["x"]}}))
    assert "set" not in header


@pytest.mark.parametrize("order", [("grab", "f1"), ("f1", "grab"), ("a", "grab", "f2")])
def test_what_is_set_with_it_counts_in_its_order(order):
    """Requests that came one after the other are one for the server; it is drawn as if each had been."""
    asked = {"grab": [0.4, -0.2], "f1": 0.3, "f2": -0.1, "a": -2.5}
    together, apart = Frames(ExplorerState()), Frames(ExplorerState())
    together.answer({"set": {name: asked[name] for name in order}})
    for name in order:
        apart.answer({"set": {name: asked[name]}})
    one, other = ({**each.values, "cut": None} for each in (together, apart))  # names follow the way that was drawn
    assert one == other


@pytest.mark.parametrize(("refused", "then"), [("a", {"a"}), ("f1", set())])
def test_what_is_refused_is_told_unless_it_is_f_and_held_then(refused, then):
    frames = Frames(ExplorerState())
    frames.answer({"set": {refused: "x"}})
    header, _ = unpack(frames.answer({"set": {"grab": [0.4, -0.2]}}))
    assert header["errors"].keys() == then
    assert header["set"].keys() - {"cut"} == {"f1", "f2"}
