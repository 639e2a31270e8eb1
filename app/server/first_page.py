"""The page as text, the same for all who open one address: what is a visitor's own comes over its websocket."""

from __future__ import annotations

import gzip
from collections import OrderedDict
from collections.abc import Mapping
from functools import cache, lru_cache
from html import escape
from typing import Any

import bokeh
from tornado.web import RequestHandler

from ..view import warmup
from ..view.first_markup import MARKUP, TITLE, page_markup, policy
from ..view.markup import page_frame
from ..view.opening import link_of
from .live import LivePages, query_of
from .scripts import PREVIEW, takes_packed

KEPT_PAGES = 64  # addresses
BUSY = (
    '<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
    '<meta http-equiv="refresh" content="{0}"><meta name="color-scheme" content="light dark"><title>Busy</title>'
    '<p role="status" style="font:18px/1.5 sans-serif;max-width:26em;margin:20vh auto;padding:0 1em">All places on '
    "this server are taken. This page tries again every {0} seconds and opens as soon as one is free."
    "</p></html>"
)
RETRY = 20  # seconds

_pages: OrderedDict[tuple[tuple[str, str], ...], str] = OrderedDict()


def markup_of(query: Mapping[str, str]) -> str:
    """Return the explorer's markup for an address, with its first picture; the same address is drawn once."""
    key = tuple(sorted(query.items()))
    if key in _pages:
        _pages.move_to_end(key)
        return _pages[key]
    markup, complete = page_markup(link_of(query))
    if complete:
        _pages[key] = markup
        if len(_pages) > KEPT_PAGES:
            _pages.popitem(last=False)
    return markup


@cache
def _page_frame() -> str:
    return page_frame(TITLE, f"./static/js/bokeh.min.js?v={bokeh.__version__}", "live")


@lru_cache(maxsize=KEPT_PAGES)
def _ready_page(text: str, ancestors: str) -> tuple[bytes, bytes, str]:
    """Return a page, the same compressed, and what may run in it: made once for all who open one address."""
    page = text.encode()
    return page, gzip.compress(page, 6, mtime=0), policy(page, ancestors)


class Page(RequestHandler):
    """Answers with the page as text."""

    def initialize(self, places: LivePages, ancestors: str) -> None:
        """Take what `make_server` gives."""
        self.places, self.ancestors = places, ancestors

    def get(self) -> None:
        """Answer with the page, or ask to wait where all places are taken."""
        if not self.request.path.endswith("/"):  # all addresses in it are below it
            self.redirect(f"{self.request.path}/?{self.request.query}".rstrip("?"))
            return
        self.set_header("Cache-Control", "no-store")
        if self.places.full:
            self.places.refused += 1
            self.set_status(503)
            self.set_header("Retry-After", str(RETRY))
            self.finish(BUSY.format(RETRY))
            return
        app: Any = self.application
        here = f"{self.request.protocol}://{escape(self.request.host)}{app.prefix}"
        text = _page_frame().replace(f'content="{PREVIEW}"', f'content="{here}/{PREVIEW}"')  # it is asked for whole
        text = text.replace(MARKUP, markup_of(query_of(self.request.arguments)))
        page, packed, allowed = _ready_page(text, self.ancestors)
        self.set_header("Content-Security-Policy", allowed)
        if takes_packed(self):
            self.set_header("Content-Encoding", "gzip")
        self.finish(packed if takes_packed(self) else page)

    head = get

    def prepare(self) -> None:
        """Let what can wait stand back for the first page."""
        warmup.page_asked()

    def on_finish(self) -> None:
        """Let go on what stands back for the first page."""
        warmup.page_sent()
