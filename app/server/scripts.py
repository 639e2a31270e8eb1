"""Scripts that a page asks for when they are first needed: no part of its first load."""

from __future__ import annotations

from functools import cache

from tornado.web import RequestHandler

from ..draw.bundle import bundle
from ..view.markup import STATIC


@cache
def text_of(name: str) -> str:
    """Return a script with what it imports, as one ES module."""
    return bundle(STATIC / name)


class TakeAway(RequestHandler):
    """Answers with the menu "Take away"."""

    def get(self) -> None:
        """Send the script; a browser asks each time whether it is still the same."""
        self.set_header("Content-Type", "text/javascript; charset=utf-8")
        self.set_header("Cache-Control", "no-cache")
        self.finish(text_of("takeaway.js"))
