"""The explorer's own page, over one websocket: requests in JSON, frames in bytes, and other requests of a page.

``/live`` with the query of the page's address. The server begins with a text, ``{"config", "offered"}``, and the first
frame. A page then sends one JSON object a message: ``{"id", "set", "rest", "window"}`` asks for a frame, which comes
as bytes; ``{"take": …}`` and ``{"room": …}`` are answered in JSON, and where that says ``"file": true`` the next
message is the file. A page that draws itself says so: ``{"note": values}`` is not answered.
"""

from __future__ import annotations

import json
import logging
import time
from collections import Counter, OrderedDict, deque
from collections.abc import Callable, Hashable, Mapping
from typing import Any, Generic, TypeVar

from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from ..picture.draw.packing import unpack
from ..picture.frame.budget import Budget
from ..picture.state.chosen_system import NORMAL
from ..picture.state.request_reading import MOST_CONTROLS
from ..picture.state.system_opening_values import opening_values
from ..view.answers import AnswerQueue
from ..view.markup import edition
from ..view.opening import link_of, opening_messages
from ..view.refresh import Frames
from ..view.warmup import is_ready
from .application import is_known, visitor_of
from .session_queue import Rota

Value = TypeVar("Value")


class Kept(Generic[Value]):
    """Values by their keys, as many as there is room for.

    Parameters
    ----------
    most : int
        Bytes of all values.
    """

    def __init__(self, most: int) -> None:
        self.most, self.size = most, 0
        self._values: OrderedDict[Hashable, tuple[Value, int]] = OrderedDict()

    def __contains__(self, key: Hashable) -> bool:
        return key in self._values

    def get(self, key: Hashable) -> Value | None:
        """Return a value, or None."""
        if key not in self._values:
            return None
        self._values.move_to_end(key)
        return self._values[key][0]

    def keep(self, key: Hashable, value: Value, size: int) -> None:
        """Keep a value of so many bytes, with its key."""
        if key in self._values:
            self.size -= self._values.pop(key)[1]
        self._values[key] = value, size
        self.size += size
        while self.size > self.most:
            self.size -= self._values.popitem(last=False)[1][1]


#: Bytes of one message from a browser: a request is a few hundred.
MOST_SENT = 200_000
#: Bytes that are kept for all: first frames by address (10 kB each), and pages with them (200 kB).
MOST_FIRSTS, MOST_PAGES = 4_000_000, 16_000_000
#: What a page may ask for at once: a frame, files, and a room; all together in `2 * MOST_SENT` bytes.
MOST_ASKED = 64
#: Pages that one network address may have open.
MOST_OF_ONE = 200
#: Seconds between two pages that come back after their server was gone, in which one is opened; and at most for one.
RETURN_SECONDS, MAX_RETURN_SECONDS = 0.03, 20.0
#: Seconds after which a page that has asked nothing gives its place to another one, where all are taken.
RESTING_SECONDS = 180.0
#: Names of requests and messages other than frames.
ASIDE = frozenset({"take", "room", "note"})
#: Why a connection is closed, as codes of websockets: all places are taken; a fault here; a message that no page sends;
#: the page has rested for long, and another one has its place.
CLOSE_FULL, CLOSE_FAILED, REFUSED, CLOSE_RESTING = 1013, 1011, 1008, 4001

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
    frames = Frames(link.state, None, is_ready, link.errors, Budget())
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
        What pages learn of a worker of their own.
    open : set of LiveConnection
    rota : Rota
    firsts, pages : Kept
        First frames by address, and pages with them.
    frames, openings, refused : int
        How many have been sent, were let in, and found no place.
    """

    def __init__(
        self,
        most: int,
        engine: Mapping[str, Any] | None = None,
        most_of_one: int = MOST_OF_ONE,
        counted: Callable[[int], object] = lambda pages: None,  # noqa: ARG005 (called with the pages that are open)
    ) -> None:
        self.most, self.most_of_one, self.engine, self._counted = most, most_of_one, engine, counted
        self.open, self.addresses, self.rota = set[LiveConnection](), Counter[str](), Rota()
        self.firsts, self.pages = Kept[bytes](MOST_FIRSTS), Kept[tuple[bytes, bytes, str]](MOST_PAGES)
        self.frames = self.openings = self.refused = 0
        self._next_return = 0.0

    def has_place(self, address: str) -> bool:
        """Whether one more page of a network address may be open; one that rests for long gives its place up."""
        if self.addresses[address] >= self.most_of_one:
            return False
        return len(self.open) < self.most or self._resting() is not None

    def let_in(self, page: LiveConnection) -> bool:
        """Give a page a place, or say that there is none."""
        if not self.has_place(page.address):
            self.refused += 1
            return False
        if len(self.open) >= self.most and (resting := self._resting()) is not None:
            self.let_out(resting)
            resting.close(CLOSE_RESTING, "another page has taken its place")
        self.open.add(page)
        self.addresses[page.address] += 1
        self._counted(len(self.open))
        return True

    def let_out(self, page: LiveConnection) -> None:
        """Have a page's place free."""
        if page in self.open:
            self.open.remove(page)
            self._counted(len(self.open))
            self.addresses[page.address] -= 1
            if not self.addresses[page.address]:
                del self.addresses[page.address]

    def turn_of_return(self) -> float:
        """Return the seconds after which a page that has lost its server may come back: one after the other."""
        now = time.monotonic()
        self._next_return = min(max(now, self._next_return + RETURN_SECONDS), now + MAX_RETURN_SECONDS)
        return round(self._next_return - now, 3)

    def _resting(self) -> LiveConnection | None:
        """Return the page that has asked nothing for longest, if that is minutes; who is in a room stays."""
        longest = min((page for page in self.open if not page.is_in_a_room), key=lambda page: page.heard, default=None)
        return None if longest is None or time.monotonic() - longest.heard < RESTING_SECONDS else longest


class LiveConnection(WebSocketHandler):
    """One page's connection."""

    def initialize(self, places: LivePages) -> None:
        """Take what `make_server` gives."""
        self.places, self.address = places, visitor_of(self.request)
        self.heard = time.monotonic()  # when it requested something last
        self.answers: AnswerQueue | None = None
        self._request: dict[str, Any] | None = None  # for a frame, with all that has been set since the last one
        self._asked: deque[Callable[[], None]] = deque()  # in the order in which it came; `_request` is one of them
        self._asked_bytes = 0  # of messages that wait
        self._writing = False

    @property
    def is_in_a_room(self) -> bool:
        """Whether its visitor has opened or entered one."""
        return self.answers is not None and self.answers.visitor.is_in_a_room

    def check_origin(self, origin: str) -> bool:
        """Let pages of this server in, and of the hosts that it was given."""
        app: Any = self.application
        return is_known(origin, app.names)

    def open(self, *_: str, **__: str) -> None:
        """Let a page in, in its turn."""
        self.set_nodelay(True)
        self._loop = IOLoop.current()
        if not self.places.let_in(self):
            self.close(CLOSE_FULL, "all places are taken")
            return
        self.places.rota.come_in(self._begin, self.address)

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
        self.answers = AnswerQueue(frames, self._send, self._later, self._loop.call_later, self.address)
        self._write(config)
        self._write(first)

    def on_message(self, message: str | bytes) -> None:
        """Note what is requested; it is answered in this page's turn."""
        self.heard = time.monotonic()
        try:
            request = json.loads(message) if isinstance(message, str) else None
        except (ValueError, RecursionError):
            request = None
        if not isinstance(request, dict):
            self._refuse("a message is no JSON object")
        elif ASIDE & request.keys():
            self._ask_aside(request, len(message))
        elif self._request is None:
            self._request = request
            self._errand(self._answer_request)
        else:
            self._request = merge_requests(self._request, request)

    def _ask_aside(self, request: dict[str, Any], size: int) -> None:
        if len(self._asked) >= MOST_ASKED or self._asked_bytes + size > 2 * MOST_SENT:
            self._refuse("more is asked at once than a page asks")
            return

        def answer() -> None:
            self._asked_bytes -= size
            self._answer(request)

        self._asked_bytes += size
        self._errand(answer)

    def _ask(self) -> None:
        if self._asked and self.answers is not None and not self._writing:
            self.places.rota.ask(self)

    def turn(self) -> None:
        """Answer what has waited longest, a request for a frame by its newest values."""
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
        self.places.let_out(self)
        self.places.rota.leave(self)
        answers, self.answers = self.answers, None
        self._asked.clear()
        if answers is not None:
            answers.leave()
