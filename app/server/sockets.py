"""The websocket of a page: a message of Bokeh's in one write, and no more of a visitor's message than may be held.

Each thing done here beyond Bokeh's own handler is left out by itself where Bokeh or Tornado are others than known.
"""

from __future__ import annotations

import logging
import struct
import traceback
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

import bokeh
from bokeh.document import Document
from bokeh.protocol.message import Message
from panel.io.server import WSHandler
from tornado.iostream import StreamClosedError
from tornado.locks import Lock
from tornado.websocket import WebSocketClosedError

from ..phrases import say
from .giving_way import one_by_one
from .process.garbage import asked
from .process.standing_back import answering

#: Bytes of one message from a browser, over all its parts: a request is a few hundred.
MOST_SENT = 200_000
#: Bytes that one part costs beside its own, so that empty ones are not without end.
PART = 100
#: Kinds of messages that a page sends. (Bokeh would let it push a document of its own, too.)
EXPECTED = frozenset({"PULL-DOC-REQ", "PATCH-DOC", "SERVER-INFO-REQ"})

#: What each open page shows; a page that is closed is told so at once, long before Bokeh forgets its session.
views: WeakKeyDictionary[Document, Any] = WeakKeyDictionary()
#: The socket and the models of each page that is closed, which lose each other when Bokeh forgets its session.
closed: WeakKeyDictionary[Document, list[Any]] = WeakKeyDictionary()

#: Why a connection is closed before its page has begun, as codes of websockets: all places are taken; a fault here.
FULL, FAILED = 1013, 1011

_BOKEH = Path(bokeh.__file__).parent
_log = logging.getLogger(__name__)


class _Parts:
    """What Bokeh's messages are sent to: keeps the parts of one message, as websocket frames (RFC 6455, 5.2)."""

    def __init__(self, write_lock: Lock) -> None:
        self.write_lock = write_lock
        self.frames: list[bytes] = []

    async def write_message(self, part: str | bytes, binary: bool = False, locked: bool = True) -> None:  # noqa: ARG002
        """Keep one part; `Message.send` holds the lock meanwhile."""
        data = part.encode() if isinstance(part, str) else part
        size = len(data)
        kind = 0x82 if binary else 0x81
        if size < 126:
            self.frames.append(bytes((kind, size)))
        elif size < 1 << 16:
            self.frames.append(struct.pack("!BBH", kind, 126, size))
        else:
            self.frames.append(struct.pack("!BBQ", kind, 127, size))
        self.frames.append(data)


def full(application: Any, context: Any) -> bool:
    """Whether all places are taken: a session counts while its page is connected."""
    there = sum(session.connection_count > 0 for session in context.sessions)
    return there >= application.settings.get("most_sessions", 10**9)


class PromptSocket(WSHandler):
    """Bokeh's websocket with one write for each message, without Nagle's algorithm, and with bounded messages.

    A frame is a message of five parts. Written one by one they cost half of all that a bare swap costs; and with
    Nagle's algorithm each waits for the browser's delayed acknowledgement, 40 ms.
    """

    #: Whether messages go in one write; no longer once that has failed, in any page.
    whole = True
    _held = 0
    _gone = False  # before its connection was there

    def open(self, *arguments: str, **named: str) -> None:
        """Start the connection."""
        super().open(*arguments, **named)
        self.set_nodelay(True)

    async def _async_open(self, token: str) -> None:
        """Join the page, in its turn, to its session; one that is closed meanwhile would count as open for ever.

        A page that cannot be joined loses its connection, or it would wait for ever: it then says so.
        """
        async with one_by_one(self.application):
            if self._gone:
                return
            if full(self.application, self.application_context):
                self.close(FULL, "all places are taken")
                return
            try:
                with answering:
                    await super()._async_open(token)
            except Exception:  # the loop would log it too, and leave the page without a word
                _log.exception("a session could not be opened")
                self.close(FAILED, "a session could not be opened")
                return
            if self._gone:
                self.on_close()

    def on_close(self) -> None:
        """End what was computed for this page alone."""
        self._gone = self.connection is None
        session = None if self.connection is None else self.connection.session
        super().on_close()
        if session is None or session.connection_count:
            return
        closed[session.document] = [self, *session.document.models]
        session.request_expiration()  # a page that has lost its connection begins a new one
        if view := views.get(session.document):
            view.leave()

    async def on_message(self, fragment: str | bytes) -> None:
        """Take one part of a message, unless the message has grown beyond what a page sends."""
        asked()
        self._held += len(fragment) + PART
        if self._held > MOST_SENT:
            self._refuse(f"a message is larger than {MOST_SENT} bytes")
        else:
            with answering:
                await super().on_message(fragment)

    async def _receive(self, fragment: str | bytes) -> Message[Any] | None:
        try:
            message = await self.receiver.consume(fragment)  # type: ignore[union-attr]  # is there once it is open
        except Exception as error:  # whatever a visitor may write that is no message
            self._refuse(f"a message cannot be read: {type(error).__name__}")
            return None
        if message is None:
            return None
        self._held = 0
        if message.msgtype not in EXPECTED:
            self._refuse("a message is of a kind that no page sends")
            return None
        return message

    async def _handle(self, message: Message[Any]) -> Any:
        if message.msgtype == "PULL-DOC-REQ":  # writing a document takes as long as a part of an opening
            async with one_by_one(self.application):
                answer = await super()._handle(message)
        else:
            answer = await super()._handle(message)
        if isinstance(answer, Message) and answer.msgtype == "ERROR":
            answer.content = {"text": say("fault"), "traceback": None}  # Bokeh would tell where its files lie
            if message.msgtype == "PULL-DOC-REQ":  # without its document a page has nothing to wait for
                self.close(FAILED, "a session could not be shown")
                return None
        return answer

    def _refuse(self, why: str) -> None:
        _log.warning("%s; its connection is closed.", why)
        self.close(1008, why)

    async def send_message(self, message: Message[Any]) -> None:
        """Send one message of Bokeh's protocol."""
        frames = await self._frames(message)
        if frames is None:
            await super().send_message(message)
            return
        connection: Any = self.ws_connection
        try:
            if connection is None or connection.is_closing():
                raise WebSocketClosedError
            await connection.stream.write(frames)
        except (WebSocketClosedError, StreamClosedError):
            _log.info("the browser left before its frame")  # `on_close` tidies up

    async def _frames(self, message: Message[Any]) -> bytes | None:
        """Return a message as it goes over the line; None where Bokeh's own handler is to send it."""
        if not PromptSocket.whole:
            return None
        try:
            parts = _Parts(self.write_lock)
            await message.send(parts)  # type: ignore[arg-type]  # asks for no more than `_Parts` has
            if self.ws_connection is not None:
                _ = self.ws_connection.stream.write  # type: ignore[attr-defined]
        except (AttributeError, TypeError):
            _log.warning("Bokeh's messages are others than known here: each goes in parts, which takes longer.")
            PromptSocket.whole = False
            return None
        return b"".join(parts.frames)


def untraced(record: logging.LogRecord) -> bool:
    """Take the traceback from a record of Bokeh's where a visitor's message fails in Bokeh itself: a filter.

    Anyone can send such messages, so they are a line each. What fails in this program keeps its traceback.
    """
    error = record.exc_info[1] if record.exc_info else None
    if error is not None and error.__traceback__ is not None:
        *_, innermost = traceback.walk_tb(error.__traceback__)
        if _BOKEH in Path(innermost[0].f_code.co_filename).parents:
            record.msg, record.args = "a message cannot be handled: %s", (type(error).__name__,)
            record.exc_info = record.exc_text = None
    return True
