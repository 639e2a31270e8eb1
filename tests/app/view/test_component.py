"""The explorer as a Panel component: its values are parameters, its layout is Panel's."""

from typing import get_origin, get_type_hints

import panel as pn
import pytest
from bokeh.document import Document
from codim2_app import explorer
from codim2_app.picture.state.controls import ExplorerState
from codim2_app.view.shared import SHARED_CONTROLS, ControlTypes


def test_a_value_is_watched_and_set_as_any_parameter():
    view, seen = explorer(a=-1.5), []
    view.param.watch(lambda *events: seen.extend((event.name, event.new) for event in events), ["a", "d"])
    view._handle_msg({"id": 1, "set": {"a": -1.25}})
    assert (view.a, seen) == (-1.25, [("a", -1.25)])
    view.param.update(a=-1.0, d=-0.5)
    assert view.scene.coefficients.plane[:3] == (-1.0, 0.0, -0.5)
    assert (view.state.a, view.state.d) == (-1.0, -0.5)
    assert seen[1:] == [("a", -1.0), ("d", -0.5)]


def test_what_is_refused_leaves_view_and_state_as_they_were():
    view = explorer(a=-1.5)
    with pytest.raises(ValueError, match="finite"):
        view.a = float("nan")
    assert (view.a, view.state.a, view.scene.coefficients.a) == (-1.5, -1.5, -1.5)
    with pytest.raises(ValueError, match="no 'nothing'"):
        view.preset = "nothing"
    assert (view.preset, view.state.preset) == ("", "")


def test_bind_link_and_references():
    view, slider = explorer(a=-1.5), pn.widgets.FloatSlider(start=-4, end=4, value=0.5)
    assert pn.bind(lambda a: 2 * a, view.param.a)() == -3.0
    view.link(slider, a="value", bidirectional=True)
    view.a = -0.75
    assert slider.value == -0.75
    slider.value = 0.25
    assert (view.a, view.scene.coefficients.a) == (0.25, 0.25)
    follower = explorer(a=slider)
    assert follower.scene.coefficients.a == 0.25
    slider.value = 1.0
    assert follower.scene.coefficients.a == 1.0


def test_a_clone_has_the_values_of_its_own():
    view = explorer(a=-1.5, width=300)
    other = view.clone(b=0.5, height=200)
    assert (other.a, other.b, other.width, other.height) == (-1.5, 0.5, 300, 200)
    other.a = 1.0
    assert view.a == -1.5


@pytest.mark.parametrize(
    "layout", [{"width": 420}, {"height": 300}, {"sizing_mode": "fixed", "width": 300, "height": 200}, {"margin": 7}]
)
def test_its_layout_is_that_of_a_component(layout):
    root = explorer(**layout).get_root(Document())
    for name, value in layout.items():
        assert getattr(root, name) == value
    assert (root.sizing_mode == "stretch_width") is (not {"width", "sizing_mode"} & layout.keys())


def test_a_template_s_dark_theme_is_its_first(monkeypatch):
    monkeypatch.setattr(type(pn.config), "theme", "dark")
    assert explorer().config["dark"] is True


def test_the_types_of_the_parameters_are_those_of_the_controls():
    """A checker of types reads them: an assignment of text to f1 is an error, of a number none."""
    told = get_type_hints(ControlTypes)
    assert tuple(told) == SHARED_CONTROLS
    for name, kind in told.items():
        assert isinstance(getattr(ExplorerState(), name), get_origin(kind) or kind), name
