"""The site below /docs/, as `codim2 docs` has built it; where it has not been, a page that says how."""

from __future__ import annotations

import mimetypes

from tornado.web import HTTPError, RequestHandler

from .docs_folder import site

UNBUILT = (
    "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>codim2: no documentation</title>"
    "<main><h1>The documentation is not built here</h1><p>On this server: <code>pip install 'codim2[docs]' &amp;&amp; "
    'codim2 docs</code>, and start it again.</p><p><a href="../">To the explorer</a></p></main></html>'
)


#: Of a worker's script: what it loads is compiled in the browser.
WORKER_POLICY = "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'"


class Docs(RequestHandler):
    """Answers ``docs/PATH`` with a file of the site."""

    def get(self, path: str) -> None:
        """Send a file, whole, so that its inline scripts can be allowed by their hashes; 404 where there is none."""
        folder = site()
        self.set_header("Cache-Control", "no-cache")
        if folder is None:
            self.set_status(404)
            self.finish(UNBUILT)
            return
        try:
            file = (folder / path / ("index.html" if path.endswith("/") or not path else "")).resolve()
            found = file.is_relative_to(folder.resolve()) and file.is_file()
        except (OSError, ValueError):  # too long a name, or one that no system has
            raise HTTPError(404) from None
        if not found:
            raise HTTPError(404)
        kind = mimetypes.guess_type(file.name)[0] or "application/octet-stream"
        self.set_header("Content-Type", f"{kind}; charset=utf-8" if kind.startswith("text/") else kind)
        if file.name == "worker.js":
            self.set_header("Content-Security-Policy", WORKER_POLICY)
        self.finish(file.read_bytes())


class ToDocs(RequestHandler):
    """Answers ``docs`` with the way to ``docs/``, below whatever path a proxy shows this server."""

    def get(self) -> None:
        """Send the browser there."""
        self.redirect("docs/")
