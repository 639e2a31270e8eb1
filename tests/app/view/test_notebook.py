import pytest
from bokeh.document import Document
from bokeh.models import ImportedStyleSheet
from codim2_app import explorer
from codim2_app.picture.draw.packing import unpack
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.explorer import ExplorerView

import codim2_core as c2


def test_model_names_no_other_host():
    root = explorer().get_root(Document())
    assert not [model for model in root.references() if isinstance(model, ImportedStyleSheet)]
    assert any("notebook" in sheet for sheet in root.stylesheets)


def test_shown_once_more_it_is_as_it_is_now():
    view = explorer(a=-2)
    config = view.get_root(Document()).data.config
    assert config["values"]["a"] == config["defaults"]["a"] == -2.0
    view._handle_msg({"id": 1, "set": {"a": -1.5}})
    again = view.get_root(Document()).data
    assert again.config["values"]["a"] == -1.5
    assert "-1.5" in again.markup
    header, _ = unpack(again.first)
    assert "portrait" in header


@pytest.fixture
def shown():
    """A view that is shown, the frames that its browser gets, and what asks for one as the browser does."""
    view = explorer(a=-2, b=0, d=-1, f1=-0.5, f2=0)
    document = Document()
    document.add_root(view.get_root(document))
    sent = []
    view._send_msg = lambda data: sent.append(unpack(data["frame"])[0])
    return view, sent


def test_a_value_set_in_python_is_one_frame(shown):
    view, sent = shown
    view.state.a = -1.2
    assert [header["set"] for header in sent] == [{"a": -1.2}]
    assert view.frames.scene.coefficients.a == -1.2
    view.state.param.update(a=-1.0, f1=0.25)
    assert [header["set"] for header in sent[1:]] == [{"a": -1.0, "f1": 0.25}]
    assert view.frames.scene.coefficients.plane == (-1.0, 0.0, -1.0, 0.25, 0.0)


def test_a_change_of_the_browser_is_in_the_state_and_no_echo(shown):
    view, sent = shown
    seen = []
    view.watch(lambda event: seen.append((event.name, event.new)), "a")
    view._handle_msg({"id": 5, "set": {"a": -1.7}})
    assert (view.state.a, seen) == (-1.7, [("a", -1.7)])
    assert [header["id"] for header in sent] == [5]


def test_a_watcher_that_sets_another_value_gets_its_own_frame_after_it(shown):
    view, sent = shown
    view.watch(lambda event: setattr(view.state, "d", 2 * event.new), "a")
    view._handle_msg({"id": 6, "set": {"a": -1.5}})
    assert [(header.get("id"), header["set"]) for header in sent] == [(6, {"a": -1.5}), (None, {"d": -3.0})]
    assert view.frames.scene.coefficients.plane[:3] == (-1.5, 0.0, -3.0)


def test_one_state_can_have_two_views():
    state = ExplorerState()
    one, other = ExplorerView(state), ExplorerView(state)
    one._handle_msg({"id": 1, "set": {"a": -1.25}})
    assert other.frames.scene.coefficients.a == state.a == -1.25
    state.f1 = 0.5
    assert one.frames.scene.coefficients.f1 == other.frames.scene.coefficients.f1 == 0.5


def test_a_system_of_any_form_brings_sliders_for_its_parameters():
    system = c2.System(U=("-k*c + z", "-s"), W=("-z",), parameters={"k": 2.0})
    view = explorer(system, z=0.3)
    header, _ = unpack(view.first)
    assert header["system"]["parameters"][0]["name"] == "k"
    assert header["system"]["coefficients"] is False
    assert unpack(explorer(c2.ELinear(-1, "z", -2, g=(0.5,))).first)[0]["system"]["coefficients"] is True
    view.state.parameters = {"k": 0.2}
    assert view.frames.scene.system.at((0.3,)).U((1.0, 0.0)) == pytest.approx([0.1, 0.0])


PSI = c2.psi.hill(3)
GIVEN = [
    c2.ELinear(-3, 0, -1, (0.25, "0.1*z1")), c2.ELinear(-3, 0, -1, (0.25, 0.5)),
    c2.ELinear(-3, 0, -1, (0.25, 0.5), B=((1, 0), (0, 1)), g=(0, 0.5)),
    c2.System(U=("-k*c + z", "-s"), W=("-z",), parameters={"k": 2.0}), c2.System(U=("-c", "-s")),
    c2.examples.ball_in_pool(mu=0.4), c2.examples.nonunique_sliding(),
]  # fmt: skip


@pytest.mark.parametrize("system", GIVEN)
def test_a_scene_is_drawn_as_it_is(system):
    scene = c2.Scene(system, PSI, (0.3, *[0.0] * (system.m - 1)) if system.m else ())
    drawn = explorer(scene).frames.scene
    assert (drawn.system, drawn.psi, drawn.z) == (scene.system, scene.psi, scene.z)
    assert explorer(system, z=0.3 if system.m else 0.0).frames.scene.system == system


def test_a_portrait_an_example_and_a_mapping_are_named_in_one_word():
    assert explorer("case3-n3").frames.values["n"] == 3.0
    assert explorer("case3-n3", z=0.5).frames.values["z"] == 0.5
    assert explorer("ball_in_pool").frames.scene.z == (4.0, 0.0)
    assert explorer({"a": -1.5, "preset": "case1-cm0"}).frames.scene.coefficients.a == -1.5


def test_values_may_be_spelled_as_in_the_core():
    view = explorer(a=-1, b=0, d=-2, f=(1, 2), B=((0.5, 0.25),), g=(0.125,), psi=PSI, z=(0,))
    scene = view.frames.scene
    assert scene.coefficients.plane == (-1.0, 0.0, -2.0, 1.0, 2.0)
    assert (scene.coefficients.B.tolist(), scene.coefficients.g.tolist()) == ([[0.5, 0.25]], [0.125])
    assert scene.psi == PSI
    assert explorer(psi=c2.psi.custom("1/(1+s)**3")).frames.scene.psi == c2.psi.custom("1/(1+s)**3")
    assert explorer(GIVEN[0], PSI).frames.scene.psi == PSI
    assert explorer(c2.examples.ball_in_pool(), z=(9, 0.5)).frames.scene.z == (9.0, 0.5)


@pytest.mark.parametrize(
    ("arguments", "values", "says"),
    [
        (("case1",), {}, "neither a preset nor an example"), ((), {"preset": "case1"}, "no 'case1'"),
        ((3.5,), {}, "give an ELinear"), ((GIVEN[1],), {"preset": "case1-cm0"}, "already"),
        ((), {"f": (1, "z")}, "two numbers"), ((), {"B": ((1, 0), (0, 1))}, "two numbers"),
        ((), {"a": 1e200}, "a is 1 · 10²⁰⁰"), ((), {"system": "own", "texts": {"U1": "c +"}}, "column"),
        ((), {"system": "ball_in_pool", "parameters": {"nu": 1}}, "no parameter nu"),
        ((c2.System(U=("1/z", "-s"), W=("1",)),), {}, "finite"), ((), {"z": (1,) * 5}, "sliders for 4"),
        ((), {"nothing": 1}, "no control"),
    ],
)  # fmt: skip
def test_what_cannot_be_drawn_is_refused_in_one_sentence(arguments, values, says):
    with pytest.raises(ValueError, match=says):
        explorer(*arguments, **values)


def test_portraits_of_the_paper_are_not_offered_in_place_of_a_given_system():
    assert 'select class="preset"' in explorer().markup
    assert 'select class="preset"' not in explorer(GIVEN[0]).markup
