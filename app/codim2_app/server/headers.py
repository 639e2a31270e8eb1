"""Security headers of every answer: which hosts a page may ask, who may embed it, and nothing about the server.

A page runs two kinds of script: files of this server, and its own inline scripts, allowed one by one by their hashes.
Styles are inline: BokehJS writes a style sheet into each shadow root. Nothing is evaluated from text, and nobody else
gets a request.
"""

from __future__ import annotations

from tornado.httputil import HTTPHeaders
from tornado.web import OutputTransform

from ..view.first_markup import policy


def embedders(sources: str) -> str:
    """Return who may embed the pages: some sources, and always the server itself.

    The second portrait is a frame of the same page, and opens it to nobody else.
    """
    others = [source for source in sources.split() if source.lower() not in ("'none'", "'self'")]
    return " ".join(["'self'", *others])


def transform(sources: str) -> type[OutputTransform]:
    """Return what Tornado applies to every answer, before it is compressed."""
    ancestors = embedders(sources)

    class Headers(OutputTransform):
        """Adds the headers."""

        def transform_first_chunk(
            self,
            status_code: int,
            headers: HTTPHeaders,
            chunk: bytes,
            finishing: bool,  # noqa: ARG002 (Tornado gives it)
        ) -> tuple[int, HTTPHeaders, bytes]:
            if "Server" in headers:
                del headers["Server"]
            headers["X-Content-Type-Options"] = "nosniff"
            headers["Referrer-Policy"] = "no-referrer"
            if "Content-Security-Policy" not in headers:
                page = headers.get("Content-Type", "").startswith("text/html")
                headers["Content-Security-Policy"] = policy(chunk if page else b"", ancestors)
            return status_code, headers, chunk

    return Headers
