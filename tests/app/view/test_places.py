"""The explorer where it is shown by others than Jupyter and its own server: marimo, Voila, a file."""

import sys

import panel as pn
import pytest
from bokeh.document import Document
from codim2_app import explorer
from codim2_app.picture.draw.gallery import HOOKS
from codim2_app.picture.draw.packing import unpack
from codim2_app.server.cli import main
from panel.io.model import add_to_doc
from panel.io.save import Comm

from tests.core.formulas.jit.fresh import computed


@pytest.fixture
def config():
    """Panel's settings, which are put back."""
    kept = pn.config.comms, pn.config.inline
    yield pn.config
    pn.config.comms, pn.config.inline = kept


class MarimoComm(Comm):
    """As marimo's own: what is sent are a message's header, metadata and content, and buffers."""

    def __init__(self, **options):
        super().__init__(**options)
        self._comm, self.sent = True, []

    def send(self, data=None, metadata=None, buffers=None):
        self.sent.append((data, buffers))


MarimoComm.__module__ = "marimo._plugins.ui._impl.from_panel"


def test_a_page_of_marimo_has_each_frame_as_a_parameter(config, monkeypatch):
    """It drops what is no change of a model (marimo 0.25), and takes BokehJS from Python only if it is told to."""
    monkeypatch.setitem(sys.modules, "marimo", sys)
    view, document, comm = explorer("case1-cm4"), Document(), MarimoComm()
    assert config.inline
    root = view._render_model(document, comm)
    add_to_doc(root, document, True)
    comm.sent.clear()
    view._handle_msg({"id": 7, "set": {"f1": -0.25}})
    assert (view.f1, unpack(view.latest)[0]["id"]) == (-0.25, 7)
    assert bytes(view.latest) in [bytes(one) for _, buffers in comm.sent for one in buffers or ()]
    assert any(
        data and f'"id":"{root.data.id}"' in data.replace(" ", "") and '"latest"' in data for data, _ in comm.sent
    )
    view.f1 = 0.5
    assert unpack(view.latest)[0]["set"] == {"f1": 0.5}


def test_a_view_in_two_cells_of_marimo_lives_in_both():
    """Showing one, marimo binds each comm that the view names among its `values` to the newest cell (marimo 0.25)."""
    view, comms = explorer("case1-cm4"), []
    for cell in ("first", "second"):
        document, comm = Document(), MarimoComm()
        root = view._render_model(document, comm)
        view._comms[root.ref["id"]] = (comm, comm)
        add_to_doc(root, document, True)
        comms.append(comm)
        for one, _ in view._comms.values():
            one._ui_element_id = cell
    assert [comm._ui_element_id for comm in comms] == ["first", "second"]
    view._handle_msg({"id": 7, "set": {"f1": -0.25}})
    for comm in comms:
        assert bytes(view.latest) in [bytes(one) for _, buffers in comm.sent for one in buffers or ()]


def test_nothing_is_sent_twice_elsewhere():
    view, document = explorer("case1-cm4"), Document()
    document.add_root(view.get_root(document))
    view._handle_msg({"id": 7, "set": {"f1": -0.25}})
    assert view.latest == b""


def test_voila_shows_the_live_view(config, monkeypatch):
    explorer("case1-cm4")
    assert config.comms == "default"
    monkeypatch.setenv("SERVER_SOFTWARE", "voila/0.5.13")
    explorer("case1-cm4")
    assert config.comms == "ipywidgets"


@pytest.mark.parametrize("kind", ["png", "pdf"])
def test_a_view_is_saved_as_the_command_writes_it(tmp_path, kind):
    explorer("case1-cm4").save(tmp_path / f"view.{kind}")
    assert main(["figure", "case1-cm4", "-o", str(tmp_path / f"command.{kind}")]) == 0
    sizes = [len((tmp_path / f"{name}.{kind}").read_bytes()) for name in ("view", "command")]
    assert (tmp_path / f"view.{kind}").read_bytes()[1:4] == {"png": b"PNG", "pdf": b"PDF"}[kind]
    assert sizes[0] == sizes[1]


def test_the_strip_of_a_page_is_drawn_where_nothing_is_compiled(tmp_path):
    code = "from codim2_app.picture.draw.gallery import gallery\n"
    code += "found = [one['drawn'].count('<path') for one in gallery()]"
    drawn, compiled = computed(tmp_path, code)
    assert len(drawn) == len(HOOKS)
    assert min(drawn) > 1
    assert compiled == []
