"""Files that a page loads: scripts, each compressed once for all visitors."""

from __future__ import annotations

import gzip
import re
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from bokeh.server.views.static_handler import StaticHandler
from tornado.web import RequestHandler, StaticFileHandler

from ..view.markup import SCRIPT_FOLDER, digest, export_script, presenter_script, script

PREVIEW = "preview.jpg"  # what a link looks like where it is pasted; `python -m tests.browser.picture` makes it
YEAR = 365 * 86400  # seconds


#: The explorer's own, by name.
SCRIPTS = {"explorer.js": script, "export_menu.js": export_script, "presenter.js": presenter_script}


@cache
def _read_script(name: str) -> bytes:
    return gzip.compress(SCRIPTS[name]().encode(), 9, mtime=0)


@lru_cache(maxsize=64)
def _file(path: str, changed: float) -> bytes:  # noqa: ARG001 (a file that has changed is another one)
    return gzip.compress(Path(path).read_bytes(), 9, mtime=0)


def takes_packed(handler: RequestHandler) -> bool:
    """Whether a browser takes a whole file compressed."""
    headers = handler.request.headers
    return "gzip" in headers.get("Accept-Encoding", "") and "Range" not in headers


class Script(RequestHandler):
    """Answers with one of the explorer's own scripts; whoever asks for this version (``?v=``) may keep it."""

    def get(self, name: str) -> None:
        """Send the script, to be kept by who asks for this version of it; else a browser asks each time."""
        self.set_header("Content-Type", "text/javascript; charset=utf-8")
        kept = f"public, max-age={YEAR}, immutable" if self.get_query_argument("v", "") == digest() else "no-cache"
        self.set_header("Cache-Control", kept)
        if takes_packed(self):
            self.set_header("Content-Encoding", "gzip")
            self.finish(_read_script(name))
        else:
            self.finish(SCRIPTS[name]())


class _Packed(StaticFileHandler):
    """Files as Tornado answers them, but compressed once: the scripts of a page cost 140 ms of processor time."""

    async def get(self, path: str, include_body: bool = True) -> None:
        """Answer with the file."""
        if not takes_packed(self):
            await super().get(path, include_body)
            return
        self.path = self.parse_url_path(path)
        absolute = self.validate_absolute_path(self.root, self.get_absolute_path(self.root, self.path))
        if absolute is None:
            return
        self.absolute_path = absolute
        self.modified = self.get_modified_time()
        self.set_headers()
        self.clear_header("Accept-Ranges")
        if self.should_return_304():
            self.set_status(304)
            return
        self.set_header("Content-Encoding", "gzip")
        data = _file(absolute, Path(absolute).stat().st_mtime)
        self.set_header("Content-Length", str(len(data)))
        if include_body:
            self.finish(data)


class BokehScript(_Packed, StaticHandler):
    """One of BokehJS's files."""


#: What is answered with files.
ROUTES: list[tuple[Any, ...]] = [
    (rf"/({'|'.join(map(re.escape, SCRIPTS))})", Script),
    (rf"/({PREVIEW})", StaticFileHandler, {"path": SCRIPT_FOLDER}),
    (r"/static/(js/bokeh\.min\.js)", BokehScript),  # the only one that a page loads
]
