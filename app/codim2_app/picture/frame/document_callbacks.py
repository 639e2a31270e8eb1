"""Run calls from other threads in the thread that answers a page, in order.

Bokeh's own callbacks of a document hold it, and each other in a cycle: once called they are garbage, which a search
must find before the document goes. What is made here is gone as soon as it was called.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from functools import partial

from bokeh.document import Document
from bokeh.io.doc import patch_curdoc
from tornado.ioloop import IOLoop

from .background_results import Scheduler


def next_tick_scheduler(document: Document) -> Scheduler:
    """Return what has functions called for a document of Bokeh's, with its lock; none once its session is over."""
    return partial(IOLoop.current().add_callback, _call_next_tick, document)


async def _call_next_tick(document: Document, function: Callable[[], None]) -> None:
    async def call(its: Document) -> None:
        with patch_curdoc(its):
            try:
                function()
            except Exception:  # the loop would log it too, and its task, the error and their frames hold each other
                logging.getLogger(__name__).exception("a page could not be answered")

    context = document.session_context
    if context is not None:
        await context.with_locked_document(call)
