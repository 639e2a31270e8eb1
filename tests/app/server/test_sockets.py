"""The socket of a page, where Bokeh and Panel are others than known; tests/faults asks it what no page sends."""

import logging
import sys

import pytest
from bokeh.protocol import Protocol
from codim2_app.server import sockets
from codim2_app.server.first_page import Page
from codim2_app.server.giving_way import TURNS
from codim2_app.server.page import OURS, take_over
from codim2_app.server.sockets import PromptSocket, _Parts, untraced
from panel.io.server import DocHandler, WSHandler
from tornado.locks import Lock
from tornado.web import Application, RequestHandler
from tornado.websocket import WebSocketHandler


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
    socket.application = Application()
    if closed == "before":
        socket.on_close()
    run(socket._async_open(""))
    if closed == "afterwards":
        socket.on_close()
    assert done == {"never": ["opened"], "before": []}.get(closed, ["opened", "lost", "may be forgotten"])
    had = {} if closed in ("never", "before") else {Document: [socket, *Document.models]}
    assert sockets.closed == had


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
