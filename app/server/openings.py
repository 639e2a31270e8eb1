"""Sessions are opened one after the other and in parts: beside them, who is there waits for one part at most."""

from __future__ import annotations

import logging
from typing import Any
from weakref import WeakKeyDictionary

import panel as pn
from bokeh.application.handlers.handler import Handler
from bokeh.document import Document
from panel.io.state import set_curdoc

from ..draw.figure import make_figure
from ..frame.later import others_first
from ..phrases import say
from ..state.cleaning import InputError
from ..state.links import Link
from ..view.explorer import ExplorerView, begin
from ..view.refresh import Frames
from .first_page import opening
from .process.garbage import begun


class Ahead(Handler):
    """Makes a session's figure, its first frame, its explorer and the explorer's models before Bokeh asks for them.

    Between these parts, each of which takes 7 to 10 ms of processor time, others are answered.
    """

    def modify_document(self, doc: Document) -> None:
        """Leave this to `session`."""

    async def on_session_created(self, session_context: Any) -> None:
        """Make the explorer, and let others come."""
        doc = session_context._document  # noqa: SLF001 (as Panel does)
        begun(doc)
        drawn = make_figure()
        await others_first()
        with set_curdoc(doc):
            link = opening(query_of_the_page())
            frames = _begun(link)
        await others_first()
        with set_curdoc(doc):
            view = opened(link, drawn, frames)
        await others_first()
        with set_curdoc(doc):
            view.prepare(doc)
        _ahead[doc] = view
        await others_first()


_ahead: WeakKeyDictionary[Document, ExplorerView] = WeakKeyDictionary()


def query_of_the_page() -> dict[str, str]:
    """Return the query of the address of the page that is being opened."""
    arguments = pn.state.session_args or {}
    return {name: values[-1].decode("utf-8", "replace") for name, values in arguments.items() if values}


def view_of(doc: Document) -> ExplorerView:
    """Return the explorer that was made for a session, or make it: Bokeh may make one without telling of it."""
    view = _ahead.pop(doc, None)
    return opened(opening(query_of_the_page())) if view is None else view


def _begun(link: Link) -> tuple[Frames, bytes] | None:
    """Return what the page of an address shows, and its first frame; None if `opened` is to find out why not."""
    try:
        return begin(link.state, link.errors)
    except Exception:  # it is tried once more, and then told
        return None


def opened(link: Link, drawn: Any = None, frames: tuple[Frames, bytes] | None = None) -> ExplorerView:
    """Return the explorer of an address, with what has been made of it, or the first one and a sentence."""
    try:
        return ExplorerView(link.state, page=True, errors=link.errors, look=link.look, figure=drawn, begun=frames)
    except Exception:  # a visitor sees the explorer and a sentence; the log has the rest
        logging.getLogger(__name__).exception("an address could not be opened")
        return ExplorerView(page=True, errors=(InputError("", say("address failed")),))
