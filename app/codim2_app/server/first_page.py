"""The page as text, the same for all who open one address: what is a visitor's own comes over its websocket."""

from __future__ import annotations

import gzip
from functools import cache
from html import escape
from typing import Any

import bokeh
from tornado.web import RequestHandler

from ..view import warmup
from ..view.first_markup import MARKUP, TITLE, policy
from ..view.markup import explorer_html, markup_of_frame, page_frame
from ..view.opening import link_of
from .application import is_known, visitor_of
from .live import LivePages, key_of, open_page, query_of
from .scripts import PREVIEW, takes_packed

BUSY = (
    '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
    '<meta http-equiv="refresh" content="{0}"><meta name="color-scheme" content="light dark"><title>Busy</title>'
    '<p role="status" style="font:18px/1.5 sans-serif;max-width:26em;margin:20vh auto;padding:0 1em">All places on '
    "this server are taken. This page tries again every {0} seconds and opens as soon as one is free."
    "</p></html>"
)
RETRY = 20  # seconds


@cache
def _page_frame() -> str:
    return page_frame(TITLE, f"./static/js/bokeh.min.js?v={bokeh.__version__}", "live")


class Page(RequestHandler):
    """Answers with the page as text."""

    def initialize(self, places: LivePages, ancestors: str) -> None:
        """Take what `make_server` gives."""
        self.places, self.ancestors = places, ancestors

    async def get(self) -> None:
        """Answer with the page in its turn, or ask to wait where all places are taken."""
        if not self.request.path.endswith("/"):  # all addresses in it are below it
            self.redirect(f"{self.request.path}/?{self.request.query}".rstrip("?"))
            return
        self.set_header("Cache-Control", "no-store")
        if not self.places.has_place(visitor_of(self.request)):
            self.places.refused += 1
            self.set_status(503)
            self.set_header("Retry-After", str(RETRY))
            self.finish(BUSY.format(RETRY))
            return
        page, packed, allowed = await self.places.rota.take_turn(self._page, visitor_of(self.request))
        self.set_header("Content-Security-Policy", allowed)
        if takes_packed(self):
            self.set_header("Content-Encoding", "gzip")
        self.finish(packed if takes_packed(self) else page)

    def _page(self) -> tuple[bytes, bytes, str]:
        """Return the page, the same compressed, and what may run in it.

        Its first picture is the one that the line of this address began with; where no line has, the page is without.
        """
        application: Any = self.application
        query = query_of(self.request.arguments)
        key = key_of(query)
        here = f"{self.request.protocol}://{self.request.host.lower()}"
        here = escape(here) + application.prefix if is_known(here, application.listed) else "."
        kept = self.places.pages.get((key, here))
        if kept is not None:
            return kept
        link = link_of(query)
        first = self.places.firsts.get(key)
        if first is None and not key:  # the page that most begin with
            first = open_page(query, self.places)[2]
        shown = explorer_html(link.state, {}, (), link.look, docs=True)
        if first is not None:
            shown = markup_of_frame(link, first, docs=True)
        text = _page_frame().replace(f'content="{PREVIEW}"', f'content="{here}/{PREVIEW}"')  # it is requested whole
        page = text.replace(MARKUP, shown).encode()
        made = page, gzip.compress(page, 6, mtime=0), policy(page, self.ancestors)
        if key in self.places.firsts:
            self.places.pages.keep((key, here), made, sum(map(len, made)))
        return made

    head = get

    def prepare(self) -> None:
        """Let what can wait stand back for the first page."""
        warmup.page_asked()

    def on_finish(self) -> None:
        """Let go on what stands back for the first page."""
        warmup.page_sent()
