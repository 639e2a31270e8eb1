import panel as pn
import pytest
from bokeh.document import Document
from bokeh.models import ImportedStyleSheet
from codim2_app import explorer
from codim2_app.packing import unpack


@pytest.fixture(autouse=True)
def _panel_as_it_was():
    kept = pn.config.inline
    yield
    pn.config.inline = kept


def test_notebook_brings_its_resources():
    explorer()
    assert pn.config.inline


def test_model_names_no_other_host():
    root = explorer().get_root(Document())
    assert not [model for model in root.references() if isinstance(model, ImportedStyleSheet)]
    assert any("notebook" in sheet for sheet in root.stylesheets)


def test_shown_once_more_it_is_as_it_is_now():
    view = explorer(a=-2)
    assert view.get_root(Document()).data.config["values"]["a"] == -2.0
    view.frames.answer({"id": 1, "set": {"a": -1.5}})
    again = view.get_root(Document()).data
    assert again.config["values"]["a"] == -1.5
    assert "-1.5" in again.markup
    header, _ = unpack(again.first)
    assert "portrait" in header
