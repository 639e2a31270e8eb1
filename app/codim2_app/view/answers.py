"""Answer the messages of one browser: a frame now or once its picture is ready, a file, a room."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from concurrent.futures import Future
from typing import Any

from ..lessons.rooms.visitor import Visitor
from ..picture.frame.background_results import Scheduler
from .export_jobs import ExportJobs, Reply
from .refresh import Frames

#: Seconds for which an answer waits for a picture that is computed in the background.
PICTURE_WAIT_SECONDS = 0.25


class _PendingAnswer:
    """An answer that waits. Who keeps what it waits for keeps nothing of its page once it is given, or the page gone.

    Parameters
    ----------
    soon : Scheduler
    answer : callable
        Gives it; called once at most.
    """

    def __init__(self, soon: Scheduler, answer: Callable[[], None]) -> None:
        self._waits: tuple[Scheduler, Callable[[], None]] | None = (soon, answer)

    def come(self, *_: object) -> None:
        """Have it given in its turn; any thread may say so."""
        waits = self._waits
        if waits is not None:
            waits[0](self._give)

    def _give(self) -> None:
        if self._waits is not None:
            self._waits[1]()

    def let_go(self) -> None:
        """Hold nothing any more."""
        self._waits = None


class AnswerQueue:
    """The answers to one browser, whose page shows one model.

    Parameters
    ----------
    frames : Frames
        What it shows.
    send : callable
        Sends a message to it, if it is still there.
    later : Scheduler
        Has a function called in its turn.
    after : callable
        Has a function called after so many seconds, as a loop's `call_later` does.
    address : str
        Of its network.
    """

    def __init__(
        self,
        frames: Frames,
        send: Reply,
        later: Scheduler,
        after: Callable[[float, Callable[[], None]], Any],
        address: str = "",
    ) -> None:
        self.frames, self._send, self._later, self._after = frames, send, later, after
        self.taking = ExportJobs(frames)
        self.visitor = Visitor(frames, address)
        self._held: _PendingAnswer | None = None  # the frame that waits; a newer one replaces it

    def answer(self, request: Any) -> None:
        """Answer a request: for a file (``take``), of a room (``room``), else for a frame; see `Frames.answer`.

        What a page shows that draws itself (``note``) is noted, and not answered.
        """
        if isinstance(request, Mapping) and "take" in request:
            self.taking.answer(request["take"], self._send, self._later)
        elif isinstance(request, Mapping) and "room" in request:
            self.visitor.answer(request["room"], self._tell_of_room, self._later)
        elif isinstance(request, Mapping) and "note" in request:
            self.frames.note(request["note"])
        else:
            self._draw(request)

    def _tell_of_room(self, message: dict[str, Any]) -> None:
        self._send({"room": message})

    def _draw(self, request: Any) -> None:
        frame = self.frames.answer(request)
        pending = self.frames.pending
        if pending is None:
            self._reply(frame)
        else:
            self.frames.keep()
            rest = request.get("rest", False) or request.get("all", False)  # who asks for all is at rest
            self._hold(pending, {"id": request.get("id"), "rest": rest, "window": request.get("window")})
        self.frames.publish()

    def _reply(self, frame: bytes) -> None:
        self._let_go()
        self._send({"frame": frame})

    def _let_go(self) -> None:
        if self._held is not None:
            self._held.let_go()
            self._held = None

    def _hold(self, pending: Future[Any], request: dict[str, Any]) -> None:
        """Answer once the picture is there, or soon without it: the browser then asks again, with its newest values."""
        self._let_go()

        def answer() -> None:
            self._reply(self.frames.answer(request))
            self.frames.publish()

        held = self._held = _PendingAnswer(self._later, answer)
        self._after(PICTURE_WAIT_SECONDS, held.come)
        pending.add_done_callback(held.come)

    def leave(self) -> None:
        """Stop what is computed for this browser alone: it has gone."""
        self._let_go()
        self.frames.jobs.leave()
        self.visitor.leave()
