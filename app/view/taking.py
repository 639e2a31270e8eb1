"""Files that a browser takes away: made beside the frames, in its turn, and sent over its session."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..export.taking import TYPES, Wish, seen_by, taken
from ..frame.turns import Failed
from .refresh import Frames

#: What it is called among the jobs of a browser: one at a time, a newer wish replaces an older.
JOB = "take"


class Taking:
    """The files that one browser asks for.

    Parameters
    ----------
    frames : Frames
        What it shows.
    """

    def __init__(self, frames: Frames) -> None:
        self.frames = frames

    def answer(
        self, request: Any, reply: Callable[[dict[str, Any]], None], later: Callable[[Callable[[], None]], None]
    ) -> None:
        """Answer a request, now or once the file is made.

        Parameters
        ----------
        request : object
            As a browser sent it: ``{"id", "kind", "theme", "legend", "sliders", "window", "layers"}``.
        reply : callable
            Sends ``{"taken": id, "name", "type", "file"}`` or ``{"taken": id, "error": sentence}``.
        later : callable
            Has a function called by the thread that answers; may be called by any thread.
        """
        about = {"taken": request.get("id", 0) if isinstance(request, Mapping) else 0}
        try:
            wish = Wish.read(request)
        except ValueError as error:
            reply({**about, "error": str(error)})
            return
        view = seen_by(request, self.frames.values, self.frames.own)
        key = repr((view, wish))

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
