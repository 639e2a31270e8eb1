"""Serve /docs/: the site as `codim2 docs` has built it, or each page made when it is read."""

from __future__ import annotations

import mimetypes
from concurrent.futures import ThreadPoolExecutor

from tornado.ioloop import IOLoop
from tornado.web import HTTPError, RequestHandler

from .docs_folder import site

#: Of a worker's script: what it loads is compiled in the browser.
WORKER_POLICY = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'"


#: One page is made at a time: whoever reads takes no more than a thread from those who draw.
MAKER = ThreadPoolExecutor(1, "codim2-pages")


class Docs(RequestHandler):
    """Answers ``docs/PATH``."""

    async def get(self, path: str) -> None:
        """Send a file, whole, so that its inline scripts can be allowed by their hashes; 404 where there is none."""
        self.set_header("Cache-Control", "no-cache")
        folder = site()
        if folder is None:
            self._send(
                *await IOLoop.current().run_in_executor(MAKER, _make_file, path, self.get_query_argument("q", ""))
            )
            return
        try:
            file = (folder / path / ("index.html" if path.endswith("/") or not path else "")).resolve()
            found = file.is_relative_to(folder.resolve()) and file.is_file()
        except (OSError, ValueError):  # too long a name, or one that no system has
            raise HTTPError(404) from None
        if not found:
            raise HTTPError(404)
        if file.name == "worker.js":
            self.set_header("Content-Security-Policy", WORKER_POLICY)
        self._send(file.name, file.read_bytes())

    def _send(self, name: str, content: bytes | None) -> None:
        if content is None:
            raise HTTPError(404)
        kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
        self.set_header("Content-Type", f"{kind}; charset=utf-8" if kind.startswith("text/") else kind)
        self.finish(content)


def _make_file(path: str, words: str) -> tuple[str, bytes | None]:
    """Return the name of a file and what it holds, None for nothing; `words` are looked for."""
    from . import pages  # on first use: few visitors read

    if path in pages.FILES:
        return path, pages.FILES[path].read_bytes()
    if path.startswith("_static/"):
        return path, pages.picture(path.removeprefix("_static/"))
    if words and path in ("", "index.html"):
        return "search.html", pages.search(words)
    return "page.html", pages.page(path.removesuffix(".html") or "index")


class ToDocs(RequestHandler):
    """Answers ``docs`` with the way to ``docs/``, below whatever path a proxy shows this server."""

    def get(self) -> None:
        """Send the browser there."""
        self.redirect("docs/")
