"""The socket of a page, where Bokeh and Panel are others than known; tests/faults asks it what no page sends."""

import asyncio
import logging
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from bokeh.events import ButtonClick
from bokeh.models import Button, ColumnDataSource
from bokeh.protocol import Protocol
from bokeh.server.server import Server
from codim2_app.frame.later import TURNS
from codim2_app.server import sockets
from codim2_app.server.first_page import Page
from codim2_app.server.page import OURS, take_over
from codim2_app.server.sockets import PromptSocket, _Parts, untraced
from panel.io.server import DocHandler, WSHandler
from tornado.locks import Lock
from tornado.web import Application, RequestHandler
from tornado.websocket import WebSocketHandler

from tests.benchmarks.bokeh_wire import Wire


def targets(application):
    return [rule.target for rule in application.wildcard_router.rules]


def test_routes_of_panel_are_answered_here(caplog):
    known = Application([("/ws", WSHandler), ("/?", DocHandler), ("/other", RequestHandler)])
    take_over(known)
    assert targets(known)[:3] == [PromptSocket, Page, RequestHandler]
    assert not caplog.records


@pytest.mark.parametrize("other", [object(), Application([("/ws", WebSocketHandler)])])
def test_routes_that_are_not_found_answer_as_they_did_and_that_is_told(other, caplog):
    take_over(other)
    assert len(caplog.records) == len(OURS)
    assert "DocHandler answers" in caplog.text


def test_parts_of_a_message_are_websocket_frames():
    async def kept():
        parts = _Parts(Lock())
        for size in (3, 300, 70_000):
            await parts.write_message(b"x" * size, binary=True)
        await parts.write_message("é")
        return parts.frames

    frames = run(kept())
    heads = [b"\x82\x03", b"\x82\x7e\x01\x2c", b"\x82\x7f" + (70_000).to_bytes(8, "big"), b"\x81\x02"]
    assert frames[::2] == heads
    assert [len(part) for part in frames[1::2]] == [3, 300, 70_000, 2]


def run(doing):
    """Run what waits for nothing but its turn."""
    try:
        for _ in range(1 + TURNS):
            assert doing.send(None) is None
    except StopIteration as done:
        return done.value
    raise AssertionError("it waits")


@pytest.mark.parametrize("closed", ["never", "before", "meanwhile", "afterwards"])
def test_a_page_that_is_closed_while_it_opens_loses_its_connection_once(monkeypatch, closed):
    class Document:
        models = ("a model", "another")

    class Session:
        connection_count, document = 0, Document
        request_expiration = staticmethod(lambda: done.append("may be forgotten"))

    class Connection:
        session = Session

    async def opening(self, _):
        done.append("opened")
        if closed == "meanwhile":
            self.on_close()
        self.connection = Connection

    done = []
    monkeypatch.setattr(WSHandler, "_async_open", opening)
    monkeypatch.setattr(WSHandler, "on_close", lambda self: self.connection and done.append("lost"))
    monkeypatch.setattr(sockets, "views", {})
    monkeypatch.setattr(sockets, "closed", {})
    socket = PromptSocket.__new__(PromptSocket)
    socket.connection = None
    socket.application, socket.application_context = Application(), Places()
    if closed == "before":
        socket.on_close()
    run(socket._async_open(""))
    if closed == "afterwards":
        socket.on_close()
    assert done == {"never": ["opened"], "before": []}.get(closed, ["opened", "lost", "may be forgotten"])
    had = {} if closed in ("never", "before") else {Document: [socket, *Document.models]}
    assert sockets.closed == had


class Places:
    """Two sessions, of which one has its page."""

    def __init__(self):
        self.sessions = [type("Session", (), {"connection_count": count}) for count in (1, 0)]


@pytest.mark.parametrize(("most", "fails", "code"), [(1, False, 1013), (2, True, 1011), (2, False, None)])
def test_a_page_that_cannot_be_joined_loses_its_connection(monkeypatch, caplog, most, fails, code):
    """Or it would wait for ever; one that came while there was a place may find none."""
    done = []

    async def opening(_, token):
        done.append(token)
        if fails:
            raise RuntimeError("a fault")

    monkeypatch.setattr(WSHandler, "_async_open", opening)
    socket = PromptSocket.__new__(PromptSocket)
    socket.application, socket.application_context = Application(most_sessions=most), Places()
    socket.close = lambda code=None, _=None: done.append(code)
    run(socket._async_open("token"))
    assert done == (["token"] if code != 1013 else []) + ([code] if code else [])
    assert ("could not be opened" in caplog.text) == fails


@pytest.mark.parametrize(("asked", "code"), [("PULL-DOC-REQ", 1011), ("PATCH-DOC", None)])
def test_a_page_without_its_document_loses_its_connection(monkeypatch, asked, code):
    answer = Protocol().create("ERROR", "r1", "/secret/path")

    async def failed(_, __):
        return answer

    closed = []
    monkeypatch.setattr(WSHandler, "_handle", failed)
    socket = PromptSocket.__new__(PromptSocket)
    socket.application = Application()
    socket.close = lambda code=None, _=None: closed.append(code)
    told = run(socket._handle(Protocol().create("PULL-DOC-REQ") if asked == "PULL-DOC-REQ" else answer))
    assert closed == ([code] if code else [])
    assert told is (None if code else answer)
    assert "secret" not in str(answer.content)


def record_of(do):
    try:
        do()
    except Exception:
        return logging.LogRecord("bokeh", logging.ERROR, "", 0, "long %s", ("words",), sys.exc_info())
    raise AssertionError("it succeeds")


def test_a_visitors_message_that_fails_in_bokeh_is_a_line_and_a_fault_here_keeps_its_traceback():
    theirs = record_of(lambda: Protocol().create("NOTHING"))
    assert untraced(theirs)
    assert theirs.exc_info is None
    assert theirs.getMessage() == "a message cannot be handled: ProtocolError"
    ours = record_of(lambda: 1 / 0)
    assert untraced(ours)
    assert ours.exc_info is not None
    plain = logging.LogRecord("bokeh", logging.ERROR, "", 0, "words", (), None)
    assert untraced(plain)
    assert plain.getMessage() == "words"


class Other:
    """A websocket's connection of which nobody knows the stream."""

    def __init__(self, socket):
        self._connection = socket.ws_connection

    def __getattr__(self, name):
        if name == "stream":
            raise AttributeError(name)
        return getattr(self._connection, name)


@pytest.mark.parametrize("way", ["one write", "Bokeh's messages are others", "Tornado's connections are others"])
def test_a_page_is_answered_in_one_write_or_where_that_cannot_be_in_bokehs_own_way(way, monkeypatch, caplog):
    """The same buffer arrives; that it goes in parts is told once."""
    wrote = []
    monkeypatch.setattr(PromptSocket, "whole", True)
    write = WSHandler.write_message
    noted = lambda self, *part, **how: wrote.append(part) or write(self, *part, **how)
    monkeypatch.setattr(WSHandler, "write_message", noted)
    if way == "Bokeh's messages are others":
        monkeypatch.delattr(_Parts, "write_message")
    if way == "Tornado's connections are others":
        begin = PromptSocket.open
        monkeypatch.setattr(
            PromptSocket, "open", lambda self: begin(self) or setattr(self, "ws_connection", Other(self))
        )

    async def served():
        def page(doc):
            button, source = Button(), ColumnDataSource({"frame": np.zeros(3, np.int16)})
            button.on_event(ButtonClick, lambda _: source.update(data={"frame": np.arange(3, dtype=np.int16)}))
            button.tags = [source]
            doc.add_root(button)

        server = Server({"/": page}, port=0)
        take_over(server._tornado)
        server.start()
        try:
            return await asyncio.to_thread(lambda: asyncio.run(clicked(server.port)))
        finally:
            server.stop()

    async def clicked(port):
        wire = await Wire.connect(port)
        await wire.event("button_click", wire.root)
        buffer = await wire.patch()
        await wire.close()
        return buffer

    with ThreadPoolExecutor(1) as pool:
        buffer = pool.submit(asyncio.run, served()).result()
    assert np.frombuffer(buffer, np.int16).tolist() == [0, 1, 2]
    told = [record for record in caplog.records if "others than known" in record.getMessage()]
    assert (bool(wrote), len(told), PromptSocket.whole) == (
        (False, 0, True) if way == "one write" else (True, 1, False)
    )
