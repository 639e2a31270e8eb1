"""What is asked of a page from elsewhere is done by the thread that answers, in its turn, with the document's lock.

Its turn comes once whoever waits for an answer has it: what several have waited for, such as pictures computed beside
the frames, is told one after the other, and others are answered between.

Bokeh's own callbacks of a document hold it, and each other in a cycle: once called they are garbage, which a search
must find before the document goes. What is made here is gone as soon as it was called.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Callable
from functools import partial
from types import TracebackType
from typing import Any
from weakref import WeakKeyDictionary

from bokeh.document import Document
from bokeh.io.doc import patch_curdoc
from tornado.ioloop import IOLoop

#: Has a function called; any thread may ask.
Later = Callable[[Callable[[], None]], Any]
#: Turns of the loop between two parts of what is long. A message takes ten from the line to its answer; with fewer, it
#: would wait for several parts.
TURNS = 16


async def others_first() -> None:
    """Return once whatever has come meanwhile is answered."""
    for _ in range(TURNS):
        await asyncio.sleep(0)


class OneByOne:
    """Lets one in at a time, first come first served, and whoever waits for an answer before the next."""

    def __init__(self) -> None:
        self._lock = asyncio.Lock()

    async def __aenter__(self) -> None:
        await self._lock.acquire()

    async def __aexit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        try:
            await others_first()
        finally:
            self._lock.release()


_told: WeakKeyDictionary[asyncio.AbstractEventLoop, OneByOne] = WeakKeyDictionary()


def later(document: Document) -> Later:
    """Return what has functions called for a document, from the thread that answers; none once its session is over."""
    return partial(IOLoop.current().add_callback, _called, document)


async def _called(document: Document, function: Callable[[], None]) -> None:
    async def call(its: Document) -> None:
        with patch_curdoc(its):
            try:
                function()
            except Exception:  # the loop would log it too, and its task, the error and their frames hold each other
                logging.getLogger(__name__).exception("a page could not be answered")

    async with _told.setdefault(asyncio.get_running_loop(), OneByOne()):
        context = document.session_context
        if context is not None:
            await context.with_locked_document(call)
