"""What is asked of a page from elsewhere is done by the thread that answers, in its turn, with the document's lock.

After what is long, such as a frame whose picture was computed beside the frames, whoever waits for an answer has it
first: what several have waited for is told one after the other, and others are answered between.

Bokeh's own callbacks of a document hold it, and each other in a cycle: once called they are garbage, which a search
must find before the document goes. What is made here is gone as soon as it was called.
"""

from __future__ import annotations

import asyncio
import logging
import time
from collections.abc import Callable
from functools import partial
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
#: Seconds of processor time of what gives way once it is done. The messages of a room are much shorter, and many.
LONG = 0.005


async def others_first() -> None:
    """Return once whatever has come meanwhile is answered."""
    for _ in range(TURNS):
        await asyncio.sleep(0)


class _Way:
    """Through which those pass one by one who are called, after one that was long only once others were answered.

    Nobody waits in it for a page: one whose line stands still holds its document, and nothing else.
    """

    def __init__(self) -> None:
        self._lock, self._long = asyncio.Lock(), False

    async def passed(self) -> None:
        """Return when it is free."""
        async with self._lock:
            if self._long:
                self._long = False
                await others_first()

    def took(self, seconds: float) -> None:
        """Note the processor time of one who has passed."""
        self._long = self._long or seconds >= LONG


_ways: WeakKeyDictionary[asyncio.AbstractEventLoop, _Way] = WeakKeyDictionary()


def later(document: Document) -> Later:
    """Return what has functions called for a document, from the thread that answers; none once its session is over."""
    return partial(IOLoop.current().add_callback, _called, document)


async def _called(document: Document, function: Callable[[], None]) -> None:
    way = _ways.setdefault(asyncio.get_running_loop(), _Way())

    async def call(its: Document) -> None:
        began = time.thread_time()
        with patch_curdoc(its):
            try:
                function()
            except Exception:  # the loop would log it too, and its task, the error and their frames hold each other
                logging.getLogger(__name__).exception("a page could not be answered")
        way.took(time.thread_time() - began)

    await way.passed()
    context = document.session_context
    if context is not None:
        await context.with_locked_document(call)
