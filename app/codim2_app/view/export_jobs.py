"""Files that a browser takes away: made in the background, in its turn, and sent over its session."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from ..exports.export_request import PROOF, SHOWN, TYPES, ExportRequest, file_name, make_file, seen_by
from ..exports.film import count_of, encode_film, part_of, pictures
from ..exports.play import PLAY
from ..exports.view import View
from ..picture.frame.background_results import Scheduler
from ..picture.frame.work_queue import FailedResult
from ..picture.phrases import say
from .refresh import Frames

#: What the parts of a film are called among the jobs of a browser.
JOB = "take"
#: Pictures of a film that are drawn in one turn.
FILE_MESSAGE = 4

Reply = Callable[[dict[str, Any]], None]


@dataclass(frozen=True, eq=False)
class _FilmJob:
    """A film that is drawn: what its messages begin with, what it is of, its pictures, and those of one turn."""

    about: dict[str, Any]
    view: View
    wish: ExportRequest
    key: str
    count: int
    part: int


class ExportJobs:
    """The files that one browser asks for.

    Parameters
    ----------
    frames : Frames
        What it shows.
    """

    def __init__(self, frames: Frames) -> None:
        self.frames = frames
        self._film: _FilmJob | None = None

    def answer(self, request: Any, reply: Reply, later: Scheduler) -> None:
        """Answer a request, now or once the file is made.

        Parameters
        ----------
        request : object
            As a browser sent it: ``{"id", "kind", "theme", "legend", "sliders", "window", "layers"}``; with
            ``"stop": true`` if it is no longer wanted, a film or (kind "proof") a proof.
        reply : callable
            Sends ``{"taken": id, "name", "type", "file"}`` or ``{"taken": id, "error": sentence}``; before, of a film,
            ``{"taken": id, "done": pictures, "all": pictures}``.
        later : callable
            Has a function called by the thread that answers; may be called by any thread.
        """
        about = {"taken": request.get("id", 0) if isinstance(request, Mapping) else 0}
        fields = request if isinstance(request, Mapping) else {}
        of_proof = fields.get("kind") == PROOF
        if fields.get("kind") not in SHOWN:
            self._film = None  # a newer wish replaces an older, and so does the wish to stop
        if fields.get("stop"):
            if of_proof:
                self.frames.jobs.drop(PROOF)
            reply({**about, "error": say("proof stopped" if of_proof else "film stopped")})
            return
        try:
            wish = ExportRequest.read(request)
        except ValueError as error:
            reply({**about, "error": str(error)})
            return
        view = seen_by(request, self.frames.values, self.frames.own)
        key = repr((view, wish))
        if wish.kind == "gif":
            count, part = count_of(wish.slider), max(FILE_MESSAGE, part_of(wish.slider))
            self._film = _FilmJob(about, view, wish, key, count, part)
            self._draw(self._film, (), reply, later)
            return
        self._make(about, view, wish, key, reply, later)

    def _make(
        self, about: dict[str, Any], view: View, wish: ExportRequest, key: str, reply: Reply, later: Scheduler
    ) -> None:
        """Answer with a file, once it is made."""
        result = self.frames.jobs.ask(wish.job, key, make_file, view, wish)
        if isinstance(result, FailedResult):
            reply({**about, "error": result.sentence})
        elif result is not None:
            name, data = result
            reply({**about, "name": name, "type": TYPES[wish.kind], "file": data})
        else:
            self._again(wish.job, later, partial(self._make, about, view, wish, key, reply, later))

    def _again(self, job: str, later: Scheduler, look: Callable[[], None]) -> None:
        """Look again when the job that is under way is done.

        What is called is made anew for each look: a function that calls itself later would be held by itself, and
        hold the page's document until a search for garbage finds it.
        """
        future = self.frames.jobs.future(job)
        if future is not None:
            future.add_done_callback(lambda _: later(look))

    def _draw(self, film: _FilmJob, drawn: tuple[bytes, ...], reply: Reply, later: Scheduler) -> None:
        """Answer with a film, drawn a part at a time: others have their turns between, and it can be stopped."""
        if self._film is not film:
            return
        jobs, first, wish, view = self.frames.jobs, len(drawn), film.wish, film.view
        if first < film.count:
            last = min(first + film.part, film.count)
            which = view, wish.slider, wish.moving, film.count, first, last
            result = jobs.ask(JOB, (film.key, first), pictures, *which)
        else:
            result = jobs.ask(JOB, (film.key, "film"), encode_film, drawn, ".gif", wish.slider == PLAY)
        if isinstance(result, FailedResult):
            reply({**film.about, "error": result.sentence})
        elif result is None:
            self._again(JOB, later, partial(self._draw, film, drawn, reply, later))
        elif first < film.count:
            drawn = (*drawn, *result)
            reply({**film.about, "done": len(drawn), "all": film.count})
            later(partial(self._draw, film, drawn, reply, later))
        else:
            reply({**film.about, "name": file_name(view, wish), "type": TYPES[wish.kind], "file": result})
