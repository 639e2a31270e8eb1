"""A panel over parameters opens on parameters that the system has, whatever is typed and whichever Ψ is chosen."""

import pytest
from codim2_app import explorer
from codim2_app.panels.parameters.axes import axes_there
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.phrases import say
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.picture.state.slider_range import slider_range
from codim2_app.view.refresh import Frames

import codim2_core as c2

from ..opening import settled

TYPED = {
    "a name": {"system": "typed", "texts": {"f1": "-1/2 + k*z"}},
    "two names": {"system": "typed", "texts": {"a": "-q", "f1": "-1/2 + k*z"}},
    "nothing of z": {"system": "typed", "texts": {"f1": "-1/2 + k"}},
    "the parameter of Ψ": {"system": "typed", "psi": "hill"},
    "no slow variable": {"system": "own", "texts": {"U1": "-2*c + k", "U2": "-s", "W": "", "where": ""}},
    "no name": {"system": "own", "texts": {"U1": "-2*c", "U2": "-s", "W": "", "where": ""}, "psi": "hill"},
}
GIVEN = {
    "a ball": c2.examples.ball_in_pool(),
    "f as text": c2.ELinear(-1, "0.1*z1", -2, ("k*z1", "q"), B=((1, 0),), parameters={"k": 1.0, "q": 0.2}),
    "no z": c2.System(U=("-2*c + k", "-s"), parameters={"k": 0.3}),
    "a parameter called a": c2.System(U=("-a*c", "-s"), parameters={"a": 0.3}),
    "a matrix": c2.ELinear.from_matrix([[-1, 2], [0, -3]], ("0.1*z", 0.2)),
}


def shown(frames, panel):
    header, _ = unpack(frames.answer({"id": 1, "set": {"panel": panel}, "rest": True, "all": True}))
    return header


def why_not(header, name):
    return header.get("unable", {}).get(name)


def hold(frames):
    header = shown(frames, "diagram")
    assert why_not(header, "diagram") is None
    there = [axis[0] for axis in header["axes"]]
    assert frames.values["along"] in there
    assert why_not(shown(frames, "atlas"), "map") is None


@pytest.mark.parametrize("values", TYPED.values(), ids=TYPED.keys())
def test_typed_systems(values):
    hold(Frames(ExplorerState.from_values({**values, "layers": [], "trajectories": 0})))


@pytest.mark.parametrize("system", GIVEN.values(), ids=GIVEN.keys())
def test_systems_from_python(system):
    view = explorer(system, layers=[], trajectories=0)
    view.frames.ready = lambda *_: True
    assert why_not(unpack(view.frames.answer({"all": True, "rest": True}))[0], "map") is None  # it opens on something
    hold(view.frames)
    assert (view.state.across, view.state.up) == (view.frames.values["across"], view.frames.values["up"])


def test_the_axes_follow_what_is_typed():
    frames = Frames(ExplorerState.from_values({"system": "typed", "panel": "atlas"}))
    header, _ = unpack(frames.answer({"id": 1, "set": {"texts": {"d": "-1 + q"}}, "rest": True}))
    assert header["set"]["up"] == "own:q"
    assert why_not(header, "map") is None
    header, _ = unpack(frames.answer({"id": 2, "set": {"psi": "hill"}, "rest": True}))
    assert frames.values["up"] == "own:q"  # it is there


def test_an_axis_that_was_chosen_stays_and_a_sentence_says_that_it_is_not_there():
    frames = Frames(ExplorerState.from_values({"up": "n"}))
    assert why_not(shown(frames, "atlas"), "map") == say("n of another Ψ")
    view = explorer(c2.ELinear(-1, "0.1*z1", -2, (0.2, 0.3)), across="b")
    assert why_not(shown(view.frames, "atlas"), "map") == say("axis given", symbol="b")


def test_numbers_alone_have_no_diagram_and_open_on_what_they_have():
    frames = Frames(ExplorerState.from_values({"system": "own", "texts": TYPED["no name"]["texts"]}))
    assert why_not(shown(frames, "diagram"), "diagram") == say("no parameter")
    assert explorer(c2.ELinear.from_matrix([[-1, 2], [0, -3]], (0.1, 0.2))).state.panel == "numbers"


RANGES = {
    "the plane of f": ({}, {"f1": [-1.0, 0.0]}),
    "across an atlas": ({"across": "a", "up": "b"}, {"a": [-3.0, -1.0], "b": [0.0, 0.5]}),
    "outside of its range": ({"across": "a", "up": "b"}, {"a": [0.0, 1.0]}),
}


@pytest.mark.parametrize(("axes", "ranges"), RANGES.values(), ids=RANGES.keys())
def test_the_atlas_follows_the_ranges_of_the_sliders(axes, ranges):
    frames = Frames(ExplorerState(panel="atlas", **axes))
    first = settled(frames, all=True)
    header = settled(frames, set={"ranges": ranges})
    names = frames.values["across"], frames.values["up"]
    assert header["errors"] == {}
    firsts = [tuple(ExplorerState.param[name].softbounds) for name in names]
    expected = [
        slider_range(*ranges.get(name, softbounds), frames.values[name])[:2]
        for name, softbounds in zip(names, firsts, strict=True)
    ]
    assert [tuple(span) for span in header["map"]["spans"]] == expected
    assert header["map"]["spans"] != first.get("map", {}).get("spans")
    settled(frames, set={"ranges": {}})
    assert frames.values["ranges"] == {}


def test_the_diagram_and_the_slow_flow_follow_the_ranges_of_the_sliders():
    frames = Frames(ExplorerState(panel="diagram", along="d"))
    assert settled(frames, all=True)["diagram"]["span"] == list(ExplorerState.param["d"].softbounds)
    assert settled(frames, set={"ranges": {"d": [-1.5, -0.5]}})["diagram"]["span"] == [-1.5, -0.5]
    along = Frames(ExplorerState(panel="along", ranges={"z": [0.0, 0.5]}))
    assert settled(along, all=True)["along"]["span"] == [0.0, 0.5]


@pytest.mark.parametrize(
    ("ranges", "span"), [({}, [0.25, 0.75]), ({"own:q": [0.0, 1.0]}, [0.0, 1.0])], ids=["typed", "set by hand"]
)
def test_a_range_that_is_typed_with_a_parameter_is_that_of_the_diagram(ranges, span):
    texts = {"d": "-1 - q", "where": "q = 0.5 in [0.25, 0.75]"}
    frames = Frames(
        ExplorerState.from_values({"system": "typed", "texts": texts, "panel": "diagram", "along": "own:q"})
    )
    assert settled(frames, all=True, set={"ranges": ranges})["diagram"]["span"] == span


def test_an_axis_whose_parameter_has_left_the_typed_equations_makes_way():
    boxes = {"U2": "mu*s + f", "where": "k = -1 in [-2, 2]\nmu = -1 in [-2, 2]\nf = 0.5 in [-2, 2]"}
    frames = Frames(ExplorerState(system="own", panel="atlas", layers=[], texts={**boxes, "U1": "k*c - 0.5"}))
    frames.answer({"all": True, "set": {"across": "own:k", "up": "own:mu"}})
    assert (frames.values["across"], frames.values["up"]) == ("own:k", "own:mu")
    frames.answer({"set": {"texts": {"U1": "c - 0.5", "U2": boxes["U2"], "where": boxes["where"].partition("\n")[2]}}})
    there = axes_there(frames.scene, frames.values)
    assert "own:k" not in there
    assert frames.values["across"] in there
    assert frames.values["up"] == "own:mu"
