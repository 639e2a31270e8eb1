"""Files that a browser takes away: made beside the frames, in its turn, and sent over its session."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..export.film import count_of, joined, part_of, pictures
from ..export.play import PLAY
from ..export.taking import TYPES, Wish, named, seen_by, taken
from ..export.view import View
from ..frame.turns import Failed
from ..phrases import say
from .refresh import Frames

#: What it is called among the jobs of a browser: one at a time, a newer wish replaces an older.
JOB = "take"
#: Pictures of a film that are drawn in one turn.
PART = 4


class Taking:
    """The files that one browser asks for.

    Parameters
    ----------
    frames : Frames
        What it shows.
    """

    def __init__(self, frames: Frames) -> None:
        self.frames = frames
        self._film: object = None

    def answer(
        self, request: Any, reply: Callable[[dict[str, Any]], None], later: Callable[[Callable[[], None]], None]
    ) -> None:
        """Answer a request, now or once the file is made.

        Parameters
        ----------
        request : object
            As a browser sent it: ``{"id", "kind", "theme", "legend", "sliders", "window", "layers"}``, or
            ``{"id", "stop": true}`` for a film that is no longer wanted.
        reply : callable
            Sends ``{"taken": id, "name", "type", "file"}`` or ``{"taken": id, "error": sentence}``; before, of a film,
            ``{"taken": id, "done": pictures, "all": pictures}``.
        later : callable
            Has a function called by the thread that answers; may be called by any thread.
        """
        about = {"taken": request.get("id", 0) if isinstance(request, Mapping) else 0}
        self._film = None  # a newer wish replaces an older, and so does the wish to stop
        if isinstance(request, Mapping) and request.get("stop"):
            reply({**about, "error": say("film stopped")})
            return
        try:
            wish = Wish.read(request)
        except ValueError as error:
            reply({**about, "error": str(error)})
            return
        view = seen_by(request, self.frames.values, self.frames.own)
        key = repr((view, wish))
        if wish.kind == "gif":
            self._draw(about, view, wish, key, reply, later)
            return

        def look() -> None:
            result = self.frames.jobs.ask(JOB, key, taken, view, wish)
            if isinstance(result, Failed):
                reply({**about, "error": result.sentence})
            elif result is not None:
                name, data = result
                reply({**about, "name": name, "type": TYPES[wish.kind], "file": data})
            elif (future := self.frames.jobs.future(JOB)) is not None:
                future.add_done_callback(lambda _: later(look))

        look()

    def _draw(
        self,
        about: dict[str, Any],
        view: View,
        wish: Wish,
        key: str,
        reply: Callable[[dict[str, Any]], None],
        later: Callable[[Callable[[], None]], None],
    ) -> None:
        """Answer with a film, drawn a part at a time: others have their turns between, and it can be stopped."""
        mine = self._film = object()
        drawn: list[bytes] = []
        count, part = count_of(wish.slider), max(PART, part_of(wish.slider))

        def look() -> None:
            if self._film is not mine:
                return
            jobs, first = self.frames.jobs, len(drawn)
            if first < count:
                last = min(first + part, count)
                result = jobs.ask(JOB, (key, first), pictures, view, wish.slider, wish.moving, count, first, last)
            else:
                result = jobs.ask(JOB, (key, "film"), joined, tuple(drawn), ".gif", wish.slider == PLAY)
            if isinstance(result, Failed):
                reply({**about, "error": result.sentence})
            elif result is None:
                future = jobs.future(JOB)
                if future is not None:
                    future.add_done_callback(lambda _: later(look))
            elif first < count:
                drawn.extend(result)
                reply({**about, "done": len(drawn), "all": count})
                later(look)
            else:
                reply({**about, "name": named(view, wish), "type": TYPES[wish.kind], "file": result})

        look()
