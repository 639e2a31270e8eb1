"""The explorer's own page, over one websocket: requests in JSON, frames in bytes, and what a page asks for besides.

``/live`` with the query of the page's address. The server begins with a text, ``{"config", "offered"}``, and the first
frame. A page then sends one JSON object a message: ``{"id", "set", "rest", "window"}`` asks for a frame, which comes
as bytes; ``{"take": …}`` and ``{"room": …}`` are answered in JSON, and where that says ``"file": true`` the next
message is the file. A page that draws itself says so: ``{"note": values}`` is not answered.
"""

from __future__ import annotations

import json
import logging
from collections import deque
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from ..draw.packing import unpack
from ..frame.budget import Budget
from ..state.chosen_system import NORMAL
from ..state.request_reading import MOST_CONTROLS
from ..state.system_opening_values import opening_values
from ..view.answers import AnswerQueue
from ..view.markup import edition
from ..view.opening import link_of, opening_messages
from ..view.refresh import Frames
from ..view.warmup import FormulaQuota, is_ready_for_all
from .application import is_known, visitor_of
from .kept import Kept
from .session_queue import Rota

#: Bytes of one message from a browser: a request is a few hundred.
MOST_SENT = 200_000
#: Bytes that are kept for all: first frames by address (10 kB each), and pages with them (200 kB).
MOST_FIRSTS, MOST_PAGES = 4_000_000, 16_000_000
#: What a page may ask for at once: a frame, files, and a room.
MOST_ASKED = 8
#: Names of what is asked or told besides frames.
ASIDE = frozenset({"take", "room", "note"})
#: Why a connection is closed before its page has begun, as codes of websockets: all places are taken; a fault here.
CLOSE_FULL, CLOSE_FAILED, REFUSED = 1013, 1011, 1008

_log = logging.getLogger(__name__)


def query_of(arguments: Mapping[str, list[bytes]]) -> dict[str, str]:
    """Return the query of an address, as Tornado has it."""
    return {name: values[-1].decode("utf-8", "replace") for name, values in arguments.items() if values}


def key_of(query: Mapping[str, str]) -> tuple[tuple[str, str], ...]:
    """Return what an address is kept by."""
    return tuple(sorted(query.items()))


def open_page(query: Mapping[str, str], places: LivePages) -> tuple[Frames, str, bytes]:
    """Return what a page shows, what its script must know, and its first frame, which is kept if it is whole."""
    link = link_of(query)
    budget = Budget(FormulaQuota().elsewhere)
    frames = Frames(link.state, None, is_ready_for_all, link.errors, budget)
    config, first = opening_messages(frames, link, edition(), engine=places.engine)
    header, _ = unpack(first)
    if header.get("ready") and "picture" not in header.get("late", ()):
        key = key_of(query)
        places.firsts.keep(key, first, len(first) + len(str(key)))
    return frames, config, first


def merge_requests(kept: Mapping[str, Any], newer: Mapping[str, Any]) -> dict[str, Any]:
    """Return the request for a frame in place of two: what both set, in the order in which it was set."""
    merged = dict(newer)
    merged["all"] = kept.get("all") is True or newer.get("all") is True
    old, new = kept.get("set"), newer.get("set")
    if isinstance(old, dict):
        new = new if isinstance(new, dict) else {}
        gone = opening_values(NORMAL) if "system" in new else ()  # what another system brings is newer
        both = {**{name: value for name, value in old.items() if name not in new and name not in gone}, **new}
        merged["set"] = both if len(both) <= MOST_CONTROLS else new
    return merged


class LivePages:
    """The pages that are open in this process, and their turns.

    Attributes
    ----------
    most : int
        Pages that there may be.
    engine : mapping or None
        What pages are told of a worker of their own.
    open : set of LiveConnection
    rota : Rota
    firsts, pages : Kept
        First frames by address, and pages with them.
    frames, openings, refused : int
        How many have been sent, were let in, and found no place.
    """

    def __init__(self, most: int, engine: Mapping[str, Any] | None = None) -> None:
        self.most, self.engine, self.open, self.rota = most, engine, set[LiveConnection](), Rota()
        self.firsts, self.pages = Kept[bytes](MOST_FIRSTS), Kept[tuple[bytes, bytes, str]](MOST_PAGES)
        self.frames = self.openings = self.refused = 0

    def beat(self) -> None:
        """Give each page a sign of life."""
        for page in self.open:
            with suppress(WebSocketClosedError):
                page.ping(b"")

    @property
    def full(self) -> bool:
        """Whether all are taken."""
        return len(self.open) >= self.most


class LiveConnection(WebSocketHandler):
    """One page's connection."""

    def initialize(self, places: LivePages) -> None:
        """Take what `make_server` gives."""
        self.places = places
        self.answers: AnswerQueue | None = None
        self._request: dict[str, Any] | None = None  # for a frame, with all that has been set since the last one
        self._asked: deque[Callable[[], None]] = deque()  # in the order in which it came; `_request` is one of them
        self._writing = False

    def check_origin(self, origin: str) -> bool:
        """Let pages of this server in, and of the hosts that it was told of."""
        app: Any = self.application
        return is_known(origin, app.names)

    def open(self, *_: str, **__: str) -> None:
        """Let a page in, in its turn."""
        self.set_nodelay(True)
        self._loop = IOLoop.current()
        if self.places.full:
            self.places.refused += 1
            self.close(CLOSE_FULL, "all places are taken")
            return
        self.places.open.add(self)
        self.places.rota.come_in(self._begin, visitor_of(self.request))

    def _begin(self) -> None:
        if self not in self.places.open:
            return
        try:
            frames, config, first = open_page(query_of(self.request.arguments), self.places)
        except BaseException:  # the page says so; the log has the rest
            _log.exception("a page could not be opened")
            self.close(CLOSE_FAILED, "a page could not be opened")
            return
        self.places.openings += 1
        self.answers = AnswerQueue(frames, self._send, self._later, self._loop.call_later)
        self._write(config)
        self._write(first)

    def on_message(self, message: str | bytes) -> None:
        """Note what is asked for; it is answered in this page's turn."""
        try:
            request = json.loads(message) if isinstance(message, str) else None
        except (ValueError, RecursionError):
            request = None
        if not isinstance(request, dict):
            self._refuse("a message is no JSON object")
        elif ASIDE & request.keys():
            if len(self._asked) < MOST_ASKED:
                self._errand(lambda: self._answer(request))
        elif self._request is None:
            self._request = request
            self._errand(self._answer_request)
        else:
            self._request = merge_requests(self._request, request)

    def _ask(self) -> None:
        if self._asked and self.answers is not None and not self._writing:
            self.places.rota.ask(self)

    def turn(self) -> None:
        """Answer what has been asked for longest, a request for a frame by its newest values."""
        if self._asked:
            self._asked.popleft()()
            self._ask()

    def _answer_request(self) -> None:
        request, self._request = self._request, None
        self._answer(request)

    def _answer(self, request: Any) -> None:
        if self.answers is not None:
            self.answers.answer(request)

    def _later(self, function: Callable[[], None]) -> None:
        """Have a function called in a turn of this page; any thread may ask."""
        self._loop.add_callback(self._errand, function)

    def _errand(self, function: Callable[[], None]) -> None:
        if self in self.places.open:
            self._asked.append(function)
            self._ask()

    def _send(self, message: dict[str, Any]) -> None:
        if "frame" in message:
            self.places.frames += 1
            self._write(message["frame"])
        elif isinstance(file := message.get("file"), bytes):
            self._write(json.dumps({**message, "file": True}))
            self._write(file)
        else:
            self._write(json.dumps(message))

    def _write(self, message: str | bytes) -> None:
        """Send; who does not read has no further turn until it has read."""
        self._writing = True
        try:
            sent = self.write_message(message, binary=isinstance(message, bytes))
        except WebSocketClosedError:  # `on_close` tidies up
            return
        self._last = sent
        self._loop.add_future(sent, self._sent)

    def _sent(self, sent: Any) -> None:
        if sent.exception() is not None or sent is not self._last:
            return
        self._writing = False
        self._ask()

    def _refuse(self, why: str) -> None:
        _log.warning("%s; its connection is closed.", why)
        self.close(REFUSED, why)

    def on_close(self) -> None:
        """End what was computed for this page alone."""
        self.places.open.discard(self)
        self.places.rota.leave(self)
        answers, self.answers = self.answers, None
        self._asked.clear()
        if answers is not None:
            answers.leave()
