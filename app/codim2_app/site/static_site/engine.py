"""The server's half of a page, in a worker of the visitor's browser: messages in, messages out.

There is one thread and it belongs to an event loop. What a server computes in the background another worker computes,
or this one between two messages, when the frame that requested it has left (`other_worker`).
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from functools import cache
from typing import Any
from urllib.parse import parse_qsl

from codim2_core.results.words import printed_sentence

from ...picture.frame.background_results import serve_with
from ...picture.frame.work_queue import WorkQueue
from ...picture.phrases import say
from ...view.answers import AnswerQueue
from ...view.markup import markup_of_frame
from ...view.opening import link_of, opening_messages
from ...view.refresh import Frames
from .other_worker import MAX_WORK_SECONDS, OtherWorker


class Engine:
    """The answers to one explorer; those of one page share a worker.

    Parameters
    ----------
    query : str
        Of the page's address.
    edition : str
        Of the folder.
    send : callable
        Sends a message, a mapping, to the page.

    Attributes
    ----------
    opening : str
        What the page's script must know, as JSON.
    first : bytes
        The page's first frame.
    elsewhere : tuple of str
        What is said here of what a server can do.
    """

    elsewhere = tuple(map(printed_sentence, (say("no scipy"), say("stopped after", seconds=MAX_WORK_SECONDS))))

    def __init__(self, query: str, edition: str, send: Callable[[dict[str, Any]], Any]) -> None:
        self._edition = edition
        loop = asyncio.get_event_loop()
        serve_with(_queue_of(other_worker()))
        self._link = link_of(dict(parse_qsl(query.removeprefix("?"), keep_blank_values=True)))
        frames = Frames(self._link.state, errors=self._link.errors)
        self.opening, self.first = opening_messages(frames, self._link, edition, worker=True)
        self._answers = AnswerQueue(frames, send, loop.call_soon, loop.call_later)

    def markup(self) -> str:
        """Return the explorer's markup, with the first picture."""
        return markup_of_frame(self._link, self.first, worker_edition=self._edition)

    def answer(self, message: str) -> None:
        """Answer a message of the page, as JSON, now or once the answer is there."""
        self._answers.answer(json.loads(message))

    def leave(self) -> None:
        """Compute nothing more: the explorer has gone."""
        self._answers.leave()


def other_worker() -> OtherWorker:
    """Return what computes in the background for all explorers of this worker."""
    return _other_worker_of(asyncio.get_event_loop())


@cache
def _other_worker_of(loop: asyncio.AbstractEventLoop) -> OtherWorker:
    return OtherWorker(loop.call_soon)


@cache
def _queue_of(executor: OtherWorker) -> WorkQueue:
    return WorkQueue(executor)
